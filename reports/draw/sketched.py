"""Which parts are sketched, from which quantities of a model; to a room on paper."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from math import isfinite

from kshm.nomenclature.symbols import LOWER, symbol_runs
from reports.draw.canvas import Item, fitted
from reports.draw.shaft_sketches import crank_sketch, web_sketch
from reports.draw.sketches import PartSizes, pin_sketch, piston_sketch, rod_sketch
from reports.formula.tex import input_symbol_tex
from reports.model.blocks import Model

LETTERS = 2.5  # mm
Draw = Callable[..., list[Item]]
# Names of quantities by the keys of the drawings, where they are not those of the strength.
_NAMES: dict[str, tuple[str, ...]] = {
    "bore": ("geometry_bore_mm", "cyc_D"),
    "rod": ("L_rod",), "radius": ("r_crank",), "arm": ("throw1_arm_left",),
    "crankpin": ("pin_diameter_1_mm", "crankshaft_pin_diameter_mm"),
    "main": ("main_diameter_1_mm", "crankshaft_main_diameter_mm"),
    "main_length": ("main_length_1_mm",), "next_length": ("main_length_2_mm",),
    "fillet": ("safe_fillet1_mm",), "hole": ("bearings_hole_mm",),
    "crankpin_bore": ("bearings_pin_bore_mm",), "main_bore": ("bearings_main_bore_mm",),
    "left_usual": ("web1_left_mm",), "right_usual": ("web1_right_mm",),
    "left_web": ("throw_1_left_web_mm",), "right_web": ("throw_1_right_web_mm",),
    **{f"l{n}": (f"throw_1_l{n}_mm",) for n in range(1, 7)},
}  # fmt: skip
_MM = 1e-3


@dataclass(frozen=True, slots=True)
class Sketched:
    """A part that is sketched.

    Attributes:
        title: what it is called.
        draw: its drawing.
        lettered: keys of the sizes that are measured.
        plain: keys of those that give its shape alone.
        spare: keys of those of both kinds that may be zero or not there.
        room: width and height at most [mm].
    """

    title: str
    draw: Draw
    lettered: tuple[str, ...]
    plain: tuple[str, ...]
    room: tuple[float, float]
    spare: tuple[str, ...] = ()


SKETCHED: dict[str, Sketched] = {
    "piston": Sketched(
        "Поршень", piston_sketch,
        ("bore", "height", "skirt", "crown", "land", "ring_radial", "groove", "head_wall", "inner"),
        ("pin",), (78.0, 66.0),
    ),
    "pin": Sketched(
        "Поршневой палец", pin_sketch, ("pin_length", "pin", "pin_bore", "bosses", "eye_length"),
        ("bore", "eye_outer"), (62.0, 58.0),
    ),
    "rod": Sketched(
        "Шатун", rod_sketch,
        ("eye_outer", "eye_bore", "pin", "eye_wall", "eye_mean", "bush_wall", "rod", "eye_length",
         "cap_length", "shank_height", "shank_width", "shank_web", "shank_flange", "bolt",
         "bolts_apart", "cap_wall", "shell", "crankpin"), (), (85.0, 72.0),
    ),
    "web": Sketched(
        "Щека", web_sketch, ("web_thickness", "web_width", "arm"), ("main", "crankpin", "radius"),
        (72.0, 52.0),
    ),
    "crank": Sketched(
        "Шейки колена", crank_sketch,
        ("main", "crankpin", "main_bore", "crankpin_bore", "hole", "fillet"),
        (*(f"l{n}" for n in range(1, 7)), "left_web", "right_web", "radius", "main_length",
         "next_length", "left_usual", "right_usual"), (76.0, 56.0),
        ("main_bore", "crankpin_bore", "hole", "fillet", *(f"l{n}" for n in range(1, 7)),
         "left_web", "right_web"),
    ),
}  # fmt: skip


def letter(tex: str) -> str:
    """Return a symbol as drawings write it: ``δ_дн``."""
    return "".join(f"_{text}" if level == LOWER else text for text, level in symbol_runs(tex))


def part_sizes(
    part: Sketched, model: Model, scalars: Mapping[str, float | str]
) -> PartSizes | None:
    """Return sizes of a part with their letters; nothing where one is not known."""
    sizes, names = dict[str, float](), dict[str, str]()
    for key in (*part.lettered, *part.plain):
        known = (_known(name, model, scalars) for name in _NAMES.get(key, (f"st_{key}_mm",)))
        size, tex = next(filter(None, known), (0.0, ""))
        if not isfinite(size) or (size <= 0 and key not in part.spare):
            return None
        sizes[key] = size
        if size and key in part.lettered:
            names[key] = letter(tex)
    return PartSizes(sizes, names)


def _known(name: str, model: Model, scalars: Mapping[str, float | str]) -> tuple[float, str] | None:
    """Value [mm] and TeX of a quantity or of an input; nothing of what is not there."""
    if name in model.fields:
        field = model.fields[name]
        return (float(field.value), input_symbol_tex(field.symbol)) if field.value else None
    if name not in scalars:
        return None
    quantity = model.nodes[name].quantity
    return float(scalars[name]) * quantity.si / _MM, quantity.tex


def sketch(name: str, model: Model, scalars: Mapping[str, float | str]) -> list[Item] | None:
    """Return the sketch of a part; nothing where one of its sizes is not known."""
    part = SKETCHED[name]
    sizes = part_sizes(part, model, scalars)
    return None if sizes is None else fitted(partial(part.draw, sizes, letters=LETTERS), part.room)
