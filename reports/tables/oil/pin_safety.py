"""Safety of every crankpin: its own bending together with its own torsion."""

from __future__ import annotations

from reports.inputs.sections.bearings import BearingsSection
from reports.spec.blocks import Block, Grid, TableSpec
from reports.spec.listing import column_list, grid_row
from reports.spec.parts import Scope
from reports.spec.shape import Shape, cylinder_table_id, pin_name, rods_table
from reports.tables.loads.crankpins import throw_pull

SHEET, BENDING = "Прочность шеек", "Изгиб шеек"
SK, IACS = "Серенсен, Кинасошвили", "IACS UR M53, по памяти"
_WAYS = {"hole": "h", "fillet": "f"}
_BENT = {"hole": "bend", "fillet": "crank"}


def safety_of(amplitude: str, mean: str, factor: str, way: str) -> str:
    """Safety by an amplitude and a mean, bending or torsion."""
    limit = f"mat_{way}_MPa"
    return f"{limit}/({factor}*{amplitude} + bearings_mean_{way}*abs({mean}))"


def modulus(part: str, number: int | str) -> str:
    """Polar modulus of a journal; the number may be a place for it."""
    d, hole = f"{part}_diameter_{number}_mm", f"bearings_{part}_bore_mm"
    return f"pi/16*{d}**3*(1 - ({hole}/{d})**4)/1000"


def pin_safety(scope: Scope, section: BearingsSection) -> list[Block]:
    """Grid of the crankpins; where they are not split, the moments that bend them."""
    if scope.shape.split:
        return [_grid(scope.shape, _torsion() | _least("turn_fillet", "turn_hole"))]
    given = scope.input.crankshaft.oil_hole_deg is not None
    rows = _torsion() | _bending() | _least("fillet", "hole") | _class(section)
    return [_grid(scope.shape, rows), _moments(scope.shape, scope.cycle, given=given)]


def _grid(shape: Shape, rows: dict[str, tuple[str, str]]) -> Grid:
    numbers = range(1, shape.throws + 1)
    return Grid(
        "safe_pins",
        "Запасы прочности каждой шатунной шейки",
        SHEET,
        tuple(f"шейка {k}" for k in numbers),
        tuple(
            grid_row(key.format(n=1), (text.replace("{k}", str(k)) for k in numbers), source, key)
            for key, (text, source) in rows.items()
        ),
    )


def _torsion() -> dict[str, tuple[str, str]]:
    """Rows of the torsion: key with ``{n}``, formula with ``{k}`` for the pin, source."""
    moment = "P4_5.Mpin{k}_Nm"
    rows = {"safe_pin_W{n}_cm3": (modulus("pin", "{k}"), "сопротивление материалов")}
    for key, sign in (("a", "-"), ("m", "+")):
        text = f"(col_max({moment}) {sign} col_min({moment}))/2/safe_pin_W{{k}}_cm3"
        rows[f"safe_pin_{key}{{n}}_MPa"] = text, "Гоц, П4.5"
    for where, short in _WAYS.items():
        text = safety_of("safe_pin_a{k}_MPa", "safe_pin_m{k}_MPa", f"safe_k{short}_turn", "torsion")
        rows[f"safe_pin_turn_{where}{{n}}"] = text, SK
    return rows


def _bending() -> dict[str, tuple[str, str]]:
    """Rows of the bending in the planes of the oil hole and of the crank, and of both together."""
    rows = {}
    for where, short in _WAYS.items():
        name, moment = _BENT[where], f"throw_bending.M{_BENT[where]}{{k}}_Nm"
        for key, sign in (("a", "-"), ("m", "+")):
            text = f"(col_max({moment}) {sign} col_min({moment}))/2/(safe_pin_W{{k}}_cm3/2)"
            rows[f"safe_pin_{name}_{key}{{n}}_MPa"] = text, "Гоц, 2.6: Rl/4"
        swing, mean = (f"safe_pin_{name}_{key}{{k}}_MPa" for key in "am")
        text = safety_of(swing, mean, f"safe_k{short}_bend", "bending")
        rows[f"safe_pin_bend_{where}{{n}}"] = text, SK
        each = (f"1/safe_pin_{way}_{where}{{k}}**2" for way in ("bend", "turn"))
        rows[f"safe_pin_{where}{{n}}"] = f"1/sqrt({' + '.join(each)})", SK
    return rows


def _least(*ways: str) -> dict[str, tuple[str, str]]:
    least = f"min({', '.join(f'safe_pin_{way}{{k}}' for way in ways)})"
    return {
        "safe_pin_n{n}": (least, "наименьший из двух"),
        "safe_pin_rank{n}": ("round(0 - safe_pin_n{k}, 6)", "округлено до шести знаков"),
    }


def _class(section: BearingsSection) -> dict[str, tuple[str, str]]:
    """Rows of the rule of the classification societies."""
    scale = "bearings_size_factor*bearings_surface_factor"
    radius = "0.06*pin_diameter_{k}_mm", "оценка: 0,06d, без источника"
    if section.fillet_mm is not None:
        radius = "bearings_fillet_mm", "задано"
    rows = {"safe_fillet{n}_mm": radius}
    radii = {"fillet": "safe_fillet{k}_mm", "hole": "(bearings_hole_mm/2)"}
    for where, short in _WAYS.items():
        strength = (
            "mat_making*(0.42*mat_tensile_MPa + 39.3)*(0.264 + 1.073*pin_diameter_{k}_mm**(0-0.2)"
            f" + (785 - mat_tensile_MPa)/4900 + 196/mat_tensile_MPa*sqrt(1/{radii[where]}))"
        )
        bent = f"safe_k{short}_bend*safe_pin_{_BENT[where]}_a{{k}}_MPa"
        turned = f"safe_k{short}_turn*safe_pin_a{{k}}_MPa"
        rows |= {
            f"safe_class_{where}{{n}}_MPa": (strength, IACS),
            f"safe_equal_{where}{{n}}_MPa": (f"{scale}*sqrt(({bent})**2 + 3*({turned})**2)", IACS),
            f"safe_Q_{where}{{n}}": (
                f"safe_class_{where}{{k}}_MPa/safe_equal_{where}{{k}}_MPa",
                "не меньше 1,15 по правилу",
            ),
        }
    return rows


def _moments(shape: Shape, rows: tuple[float, ...], *, given: bool) -> TableSpec:
    """What bends every crankpin at the middle of its throw, Gots 2.6: Rl/4."""
    lines = ["phi_deg"]
    for k in range(1, shape.throws + 1):
        inward, ahead = _throw_force(shape, k)
        pin = pin_name(k) if len(shape.pins) > 1 else ""
        turn = "rad(crankshaft_oil_hole_deg)" if given else f"rad(hole_pin{pin}_deg)"
        lever = f"F_piston*of_mm(throw{k}_length)/4"
        lines += [
            f"Mbend{k}_Nm = of_MPa({inward}*cos({turn}) + {ahead}*sin({turn}))*{lever}"
            " | Гоц, 2.6: Rl/4",
            f"Mcrank{k}_Nm = of_MPa({inward})*{lever} | Гоц, 2.6: Rl/4",
        ]
    return TableSpec(
        "throw_bending",
        "Ш.и2",
        "Моменты, изгибающие каждую шатунную шейку",
        BENDING,
        column_list(*lines),
        rows,
        note=(
            "Первый столбец шейки — в плоскости её масляного отверстия, второй — в плоскости "
            "колена. Момент — как у балки на двух опорах с силой посередине пролёта."
        ),
    )


def _throw_force(shape: Shape, throw: int) -> tuple[str, str]:
    """R_к of a throw towards the shaft and along the rotation, (42)."""
    if not shape.single_rods:
        return f"{rods_table(throw)}.Ksum_MPa", f"{rods_table(throw)}.Tsum_MPa"
    of = cylinder_table_id(shape.groups[throw - 1][0])
    return f"({of}.K_MPa - K_r_rod - {throw_pull(throw)})", f"{of}.T_MPa"
