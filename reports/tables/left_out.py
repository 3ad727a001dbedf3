"""What a calculation leaves out: tables of an offset or hung engine, inputs without effect."""

from __future__ import annotations

from collections.abc import Iterator

from reports.inputs.sections.input_file import GeometrySection, InputFile
from reports.model.blocks import Block
from reports.model.shape import Scope, Shape
from reports.shared.russian import joined
from reports.tables.contexts import books
from reports.tables.cycle_members import given_by_cycle

_BY_ORDERS = ("piston_motion", "balance", "balance_orders", "firing", "inertia", "torque_orders")
_DEVICES = frozenset({"counterweight_share", "first_shafts_share", "second_shafts_share",
                      "suppression", "shaft_radius_mm"})  # fmt: skip


def left_out(model: InputFile) -> tuple[Block, ...]:
    """Blocks that the same engine would have without offset and articulated rods, but has not."""
    if Shape.of(model).by_orders:
        return ()
    geometry = model.geometry
    if isinstance(geometry, GeometrySection):
        none = {"crank_offset_mm": None, "pin_offset_mm": None}
        geometry = geometry.model_copy(update=none)
    plain = model.model_copy(update={"geometry": geometry, "articulated": None})
    blocks = books(Scope(plain), _BY_ORDERS).blocks
    ids = {block.id for block in books(Scope(model), _BY_ORDERS).blocks}
    return tuple(block for block in blocks if block.id not in ids)


def without_orders(model: InputFile) -> str:
    """Why there are no series by orders, after «из-за»; empty where there are."""
    shape = Shape.of(model)
    moved = {"оси цилиндра": "crank_offset_mm", "поршневого пальца": "pin_offset_mm"}
    reasons = [
        *(
            f"смещения {offset}"
            for offset, key in moved.items()
            if getattr(model.geometry, key, None)
        ),
        *(["прицепных шатунов"] if shape.articulated else []),
    ]
    return joined(reasons) if reasons else ""


def left_out_note(model: InputFile) -> str:
    """What is not calculated and why, in a line that names the sheets; empty where all is."""
    sheets = list(dict.fromkeys(block.sheet for block in left_out(model)))
    if not sheets:
        return ""
    # «Уравновешивание» stands for «Уравновешивание, итоги» and «…, суммы» too.
    named = [f"«{s}»" for s in sheets if (base := s.partition(", ")[0]) == s or base not in sheets]
    return (
        f"Не рассчитано из-за {without_orders(model)} (ряды — для центрального механизма): "
        f"листы {', '.join(named)}"
    )


def unused(model: InputFile) -> set[str]:
    """Names of the inputs that the calculation does not take."""
    devices = set(_DEVICES)
    if model.masses.rod_kg is not None:
        devices.add("rod_small_end_share")
    unused_keys = given_by_cycle(model) | {
        f"balance_{key}" for key in devices - model.balance.asked
    }
    if model.regime.indicated_power_kw is None:
        unused_keys.add("regime_fullness")
    if getattr(model.gas, "combustion_start_deg", None) is not None:
        unused_keys.add("gas_ignition_delay_deg")
    for end in ("nose", "rear"):  # no such counterweight: neither its angle nor its arm counts
        if not getattr(model.crankshaft, f"{end}_mass_kg"):
            unused_keys |= {f"crankshaft_{end}_{key}" for key in ("mass_kg", "angle_deg", "arm_mm")}
    return unused_keys | {f"balance_web_{size}_share" for size in _web_sizes(model)}


def _web_sizes(model: InputFile) -> Iterator[str]:
    """Sizes of the webs that are given as such, so that no share of the bore counts."""
    arms = model.crankshaft.arms
    for size in ("thickness", "width"):
        of_arms = size == "thickness" and all(arm.left_web_mm and arm.right_web_mm for arm in arms)
        if of_arms or any(getattr(each, f"web_{size}_mm") for each in model.web_sections.values()):
            yield size
