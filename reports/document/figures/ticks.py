"""Marks of axes as in a Russian textbook: round steps, decimal comma, multiples of 30°."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from decimal import Decimal

from reports.document.figures.labels import text_size
from reports.document.figures.style import SMALL
from reports.shared.russian import fixed

_ANGLE_STEPS = (5.0, 10.0, 15.0, 30.0, 60.0, 90.0, 120.0, 180.0)
_MOST_ANGLES = 13
_FACTORS = (1.0, 2.0, 2.5, 5.0, 10.0)
_BEYOND, _GAP = 11.0, 3.0  # pt from the end of an axis and from its last text to its name


@dataclass(frozen=True, slots=True)
class Ticks:
    """Marks of an axis: places, their texts, and the limits they span."""

    places: tuple[float, ...]
    texts: tuple[str, ...]

    @property
    def low(self) -> float:
        """Lower end of the axis."""
        return self.places[0]

    @property
    def high(self) -> float:
        """Upper end of the axis."""
        return self.places[-1]

    def width(self) -> float:
        """Room of the widest text [pt]."""
        return max(text_size(text, SMALL)[0] for text in self.texts)

    def beyond(self) -> float:
        """Room beyond the end of the axis that its last text and a gap after it take [pt]."""
        return max(_BEYOND, text_size(self.texts[-1], SMALL)[0] / 2 + _GAP)


def value_ticks(low: float, high: float, *, count: int = 6, zero: bool = True) -> Ticks:
    """Round marks that enclose a range.

    Args:
        low: Least value to show.
        high: Greatest value to show.
        count: Wanted number of intervals.
        zero: Take zero into the range.

    Raises:
        ValueError: The range is not finite.
    """
    from matplotlib.ticker import MaxNLocator

    low, high = bounds([[low, high, *([0.0] if zero else [])]])
    if high - low <= 1e-12 * max(1.0, abs(high), abs(low)):
        low, high = low - 0.5 * max(1.0, abs(low)), high + 0.5 * max(1.0, abs(high))
    locator = MaxNLocator(count, steps=_FACTORS, min_n_ticks=1)
    places = [float(place) for place in locator.tick_values(float(low), float(high))]
    return at_steps(round(places[0] / (places[1] - places[0])), len(places), places[1] - places[0])


def at_steps(first: int, count: int, step: float) -> Ticks:
    """So many marks at multiples of a step, with the decimals that the step needs."""
    digits = max(0, -int(Decimal(f"{step:.3g}").normalize().as_tuple().exponent))
    places = tuple((first + index) * step for index in range(count))
    return Ticks(places, tuple(fixed(place, digits) for place in places))


def angle_ticks(low: float, high: float, *, step: float | None = None) -> Ticks:
    """Marks of an axis of crank angles [deg]; the axis ends where the curves do."""
    span = high - low
    if step is None:
        step = next((s for s in _ANGLE_STEPS if s >= 30 and span / s < _MOST_ANGLES), 360.0)
        if span / step < 3:
            step = next(s for s in _ANGLE_STEPS if span / s < _MOST_ANGLES)
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    marks = {index * step: fixed(index * step, 0) for index in range(first, last + 1)}
    for end in (low, high):
        if all(abs(end - place) > 1e-9 for place in marks):
            marks[end] = ""
    places = sorted(marks)
    return Ticks(tuple(places), tuple(marks[place] for place in places))


def bounds(columns: Iterable[Iterable[float]]) -> tuple[float, float]:
    """Least and greatest value of several columns.

    Raises:
        ValueError: A value is not finite or there is none.
    """
    values: Sequence[float] = [float(value) for column in columns for value in column]
    if not values or not all(map(math.isfinite, values)):
        msg = "Кривая пуста или содержит не число"
        raise ValueError(msg)
    return min(values), max(values)
