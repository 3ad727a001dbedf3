"""What the book of the parts' strength cannot say as text: usual sizes, materials, tables."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from kshm.defaults import CAP_SHARE, GROOVE_SHARE, PART_SHARES, PISTON_SHARE
from reports.inputs.sections.strength import PART_MATERIALS
from reports.model.shape import Scope

Point = tuple[float, float]
_BASES = {"bore": ("", "D"), "crankpin": ("pin_diameter_1_mm", "dш")}
_NAMES = {"pin": "dп", "ring_radial": "t", "eye_outer": "dг", "eye_length": "lш"}
# Of the ring's pressure to the mean one, pear form, from the middle to the gap [deg].
RING = ((0.0, 1.05), (30.0, 1.05), (60.0, 1.14), (90.0, 0.90), (120.0, 0.45), (150.0, 0.67),
        (180.0, 2.85))  # fmt: skip
# Of the pressed eye over the embedding [deg]: N0/P and the size of M0/(P r); the sign is that of
# statics.
EYE_N0 = ((95.0, 0.0), (100.0, 0.0001), (105.0, 0.0005), (110.0, 0.0009), (115.0, 0.0018),
          (120.0, 0.0030), (125.0, 0.0060), (130.0, 0.0085))  # fmt: skip
EYE_M0 = ((95.0, 0.0), (100.0, 0.0), (105.0, 0.0001), (110.0, 0.00025), (115.0, 0.0006),
          (120.0, 0.0011), (125.0, 0.0018), (130.0, 0.0030))  # fmt: skip
# Factor of the torsion of a rectangle by its sides' ratio.
TORSION = ((1.0, 0.208), (1.5, 0.231), (1.75, 0.239), (2.0, 0.246), (2.5, 0.258), (3.0, 0.267),
           (4.0, 0.282))  # fmt: skip


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
        "materials": list(PART_MATERIALS.values()),
        "piston_share": PISTON_SHARE, "cap_share": CAP_SHARE, "groove_share": GROOVE_SHARE,
        "ring_points": _pairs(RING), "eye_N0": _pairs(EYE_N0), "eye_M0": _pairs(EYE_M0),
        "torsion_points": _pairs(TORSION),
    }  # fmt: skip


def _pairs(points: Sequence[Point]) -> list[tuple[Point, Point]]:
    return list(pairwise(points))
