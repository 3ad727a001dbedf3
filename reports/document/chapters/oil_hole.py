"""Where the oil hole of a crankpin goes: one decision for the note, the sheet and the workbook."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

from markupsafe import Markup

from reports.document.chapters.chapter import pin_stems
from reports.document.text.terms import Terms
from reports.model.shape import Shape
from reports.shared.russian import fixed

_WIDE_DEG = 60.0  # of a span: beyond it two angles are no place for one hole


class HoleOrigin(Enum):
    """What decides where the hole goes."""

    GIVEN = "как задано"
    FILM = "там, где плёнка толще всего"
    RAYS = "напротив лучей с наименьшими суммами сил"  # two steps find neighbouring ones
    WEAR = ""  # its own chapter says why


@dataclass(frozen=True, slots=True)
class Hole:
    """The oil hole of a crankpin: what decides, and one angle or both ends of a span [deg]."""

    pin: int
    origin: HoleOrigin
    angles: tuple[float, ...]

    @property
    def angle(self) -> Markup | str:
        """The angle or the span in print; empty where wear alone tells it."""
        return "" if self.origin is HoleOrigin.WEAR else Markup(self.text)

    @property
    def text(self) -> str:
        """The angle in print, the span of two, or both where they are far from each other."""
        ends = dict.fromkeys(fixed(angle, 0) for angle in self.angles)
        is_span = (self.angles[-1] - self.angles[0]) % 360 <= _WIDE_DEG
        return ("…" if is_span else "° или ").join(ends) + "°"

    @property
    def why(self) -> str:
        """What decides, in words."""
        return self.origin.value


def oil_hole(terms: Terms, pin: int) -> Hole:
    """Return the hole as given, by the film, or by wear of the pin."""
    model = terms.model.input
    if not terms.has("oil_film1_deg"):
        return _by_wear(terms, pin)
    if model.crankshaft.oil_hole_deg is not None:
        return Hole(1, HoleOrigin.GIVEN, (float(model.crankshaft.oil_hole_deg),))
    ends = [terms.value(f"oil_film{n}_deg") for n in (1, 2)]
    return Hole(1, HoleOrigin.FILM, in_order(ends))


def _by_wear(terms: Terms, pin: int) -> Hole:
    """Of neighbouring rays that two steps find both; else the one of the tables."""
    key = f"hole_{pin_stems(Shape.of(terms.model.input))[pin - 1]}_deg"
    angle, step = terms.value(key), 360.0 / terms.model.input.calculation.wear_rays
    fine = next((each.fine for each in terms.grid_errors if each.key == key), None)
    if fine is None or abs(fine - angle) > 1.01 * step:
        return Hole(pin, HoleOrigin.WEAR, (angle,))
    return Hole(pin, HoleOrigin.RAYS, in_order([angle, fine]))


def in_order(angles: Sequence[float]) -> tuple[float, ...]:
    """Angles as they are printed, the one first from which the other is less than half a turn."""
    first, *others = dict.fromkeys(round(angle) * 1.0 for angle in sorted(angles))
    around = bool(others) and others[-1] - first > 180
    return (*others, first) if around else (first, *others)
