"""What the book of the parts' strength cannot say as text: usual sizes, materials, tables."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

from kshm.defaults import (
    ALUMINIUM_EXPANSION,
    BUSH_EXPANSION,
    CAP_SHARE,
    EYE_SHARE,
    GROOVE_SHARE,
    IRON_EXPANSION,
    PISTON_SHARE,
    SIZES_C,
    TURN_SHARE,
)
from kshm.mechanics.strength import EYE_M0, EYE_N0, RING, TORSION, Points
from kshm.nomenclature.quantity import quantity
from kshm.ranges import PART_SHARES, RANGES, side_of
from reports.inputs.sections.strength import PART_MATERIALS, StrengthSection
from reports.model.shape import Scope

_FIGURES = 12  # decimals: what the print has of a slope, without noise
SAFETIES = ("st_eye_top_n", "st_eye_n", "st_shank_nx", "st_shank_ny", "st_bolt_n", "st_web_n")
ODD_FIFTHS = 1.0045237627951384  # sum of 1/n⁵ over odd n: 31/32 ζ(5)
_BASES = {"bore": ("", "D"), "crankpin": ("pin_diameter_1_mm", "dш")}
_NAMES = {"pin": "dп", "ring_radial": "t", "eye_outer": "dг", "eye_length": "lш"}


@dataclass(frozen=True, slots=True)
class PartSize:
    """A size and its usual share of another: ``of`` in print, ``base`` in formulas."""

    key: str
    base: str
    of: str
    low: float
    high: float

    @property
    def share(self) -> float:
        """The middle of what is usual."""
        return round((self.low + self.high) / 2, 6)


def usual_sizes(kind: str) -> tuple[PartSize, ...]:
    """Sizes of a kind of engine, in an order in which each follows from those before."""
    sizes = []
    for key, (base, petrol, diesel) in PART_SHARES.items():
        low, high = diesel if kind == "diesel" else petrol
        name, of = _BASES.get(base) or (f"st_{base}_mm", _NAMES[base])
        sizes.append(PartSize(key, name, of, low, high))
    return tuple(sizes)


def strength_names(scope: Scope) -> dict[str, object]:
    """Names of the book."""
    section = scope.input.strength
    if section is None:
        return {}
    return {
        "sizes": usual_sizes(section.kind),
        "estimated": any(getattr(section, f"{key}_mm") is None for key in PART_SHARES),
        "materials": list(PART_MATERIALS.values()),
        "piston_share": PISTON_SHARE, "cap_share": CAP_SHARE, "groove_share": GROOVE_SHARE,
        "eye_share": EYE_SHARE, "turn_share": TURN_SHARE, "sizes_c": SIZES_C,
        "expansion": {"cylinder": IRON_EXPANSION, "bush": BUSH_EXPANSION,
                      "piston": piston_expansion(section)},
        "usual": {each.key: each for each in usual_stresses(section)}, "safeties": SAFETIES,
        "ring_points": RING, "eye_N0": EYE_N0, "eye_M0": EYE_M0,
        "torsion_lines": list(_lines(TORSION)), "torsion_end": TORSION[-1][0],
        "odd_fifths": ODD_FIFTHS,
    }  # fmt: skip


def piston_expansion(section: StrengthSection) -> float:
    """Expansion of the piston's material [1/K]."""
    return IRON_EXPANSION if section.piston_material == "iron" else ALUMINIUM_EXPANSION


def _lines(points: Points) -> Iterator[tuple[float, float]]:
    """Straight lines between points, each as its value at zero and its slope."""
    for (x, y), (further, other) in pairwise(points):
        slope = round((other - y) / (further - x), _FIGURES)
        yield round(y - slope * x, _FIGURES), slope


@dataclass(frozen=True, slots=True)
class UsualStress:
    """A result of a part with its usual range, in the unit of its quantity."""

    key: str
    low: float
    high: float

    @property
    def most(self) -> float:
        """Greatest usual size of the value, of whatever sign."""
        return max(abs(self.low), abs(self.high))

    @property
    def unit(self) -> str:
        """Unit of both ends."""
        return quantity(self.key).unit_label

    def side(self, value: float) -> int:
        """1 above the range, -1 below, 0 within; see ``side_of``."""
        return side_of(value, (self.low, self.high))


def usual_stresses(section: StrengthSection) -> tuple[UsualStress, ...]:
    """Usual ranges of the results for the materials of an engine."""
    return tuple(
        UsualStress(key, *RANGES[key].of(section.piston_material))
        for key in RANGES if key.startswith("st_")
    )  # fmt: skip
