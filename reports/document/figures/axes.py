"""Axes as in a Russian textbook: round marks, units at the ends, heavier lines through zero."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from decimal import Decimal
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reports.document.figures.canvas import AXIS, EDGE, FONT_SIZE, GRID, SMALL, LineStyle, Sheet
from reports.document.figures.labels import Box, line_box, shown, text_size
from reports.shared.russian import fixed

_ANGLE_STEPS = (5.0, 10.0, 15.0, 30.0, 60.0, 90.0, 120.0, 180.0)
_MAX_ANGLES = 13
_FACTORS = (1.0, 2.0, 2.5, 5.0, 10.0)
_BEYOND, _GAP = 11.0, 3.0  # pt from the end of an axis and from its last text to its name
_MARK_GAP = 3.0  # between the texts of neighbouring marks [pt]
_TOP = 0.75  # of the type above the baseline, which half a number's height stands off its mark


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
    marks = [float(mark) for mark in locator.tick_values(float(low), float(high))]
    return at_steps(round(marks[0] / (marks[1] - marks[0])), len(marks), marks[1] - marks[0])


def at_steps(first: int, count: int, step: float) -> Ticks:
    """So many marks at multiples of a step, with the decimals that the step needs."""
    digits = max(0, -int(Decimal(f"{step:.3g}").normalize().as_tuple().exponent))
    marks = tuple((first + index) * step for index in range(count))
    return Ticks(marks, tuple(fixed(mark, digits) for mark in marks))


def angle_ticks(low: float, high: float, *, step: float | None = None) -> Ticks:
    """Return marks of an axis of crank angles [deg]; the axis ends where the curves do."""
    span = high - low
    if step is None:
        step = next((s for s in _ANGLE_STEPS if s >= 30 and span / s < _MAX_ANGLES), 360.0)
        if span / step < 3:
            step = next(s for s in _ANGLE_STEPS if span / s < _MAX_ANGLES)
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    marks = {index * step: fixed(index * step, 0) for index in range(first, last + 1)}
    for end in (low, high):
        if all(abs(end - mark) > 1e-9 for mark in marks):
            marks[end] = ""
    ordered = sorted(marks)
    return Ticks(tuple(ordered), tuple(marks[mark] for mark in ordered))


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


@dataclass(frozen=True, slots=True)
class Axes:
    """A field of a sheet with marks on both axes.

    Attributes:
        page: the sheet.
        field: left, bottom, right and top on it [pt].
        x: marks of the horizontal axis.
        y: marks of the vertical axis.
        reverse: positive x to the left, positive y downwards.
    """

    page: Sheet
    field: Box
    x: Ticks
    y: Ticks
    reverse: tuple[bool, bool] = (False, False)

    def at(self, x: ArrayLike, y: ArrayLike) -> NDArray[np.float64]:
        """Places on the sheet of some points, shape (n, 2)."""
        left, low, right, high = self.field
        ends = (
            (left, right, self.x, self.reverse[0], np.asarray(x, dtype=np.float64)),
            (low, high, self.y, self.reverse[1], np.asarray(y, dtype=np.float64)),
        )
        points = []
        for start, end, ticks, turned, values in ends:
            share = (values - ticks.low) / (ticks.high - ticks.low)
            points.append(start + (end - start) * (1 - share if turned else share))
        return np.stack(np.broadcast_arrays(*points), axis=-1)

    def level(self, y: float, look: LineStyle, layer: float = 2) -> None:
        """Draw a line across the field."""
        self.page.line(self.at([self.x.low, self.x.high], [y, y]), look, layer)

    def dress(
        self,
        *,
        pads: tuple[float, float] = (3, 3),
        edges: tuple[LineStyle, LineStyle] = (EDGE, EDGE),
        zeros: bool = False,
    ) -> None:
        """Grid, edges, numbers with decimal comma, heavier lines through zero.

        Args:
            pads: room between the field and the numbers of x and of y [pt].
            edges: looks of the left and of the lower edge where no axis crosses the field.
            zeros: a line through zero of the abscissa too.
        """
        page, (left, low, right, high) = self.page, self.field
        xs = self.at(self.x.places, self.y.low)[:, 0].tolist()
        ys = self.at(self.x.low, self.y.places)[:, 1].tolist()
        grid = [[(x, low), (x, high)] for x in xs] + [[(left, y), (right, y)] for y in ys]
        page.lines(grid, GRID, 0.5)
        down = self.reverse[1]
        height = high + pads[0] + (1 - _TOP) * SMALL if down else low - pads[0] - _TOP * SMALL
        for x, text in zip(xs, _uncrowded(xs, self.x), strict=True):
            if text:
                page.text((x, height), text, SMALL, middle=False, layer=0.6)
        self.number_y(right=self.reverse[0], pad=pads[1])
        corners = [(left, low), (right, low), (right, high), (left, high)]
        page.line(corners[1:], GRID, 0.6)
        for edge, look in zip((corners[::3], corners[:2]), edges, strict=True):
            page.line(edge, look, 2.5 if look is not GRID else 0.6)
        if self.y.low < 0 < self.y.high:
            self.level(0.0, AXIS, 1.5)
        if zeros and self.x.low < 0 < self.x.high:
            page.line(self.at([0.0, 0.0], [self.y.low, self.y.high]), AXIS, 1.5)

    def number_y(self, *, right: bool = False, pad: float = 3.0, title: str = "") -> None:
        """Numbers of the vertical axis at one of the edges, under a title of their own."""
        side = self.field[2] + pad if right else self.field[0] - pad
        ys = self.at(self.x.low, self.y.places)[:, 1].tolist()
        align = 0.0 if right else 1.0
        for y, text in zip(ys, self.y.texts, strict=True):
            if text:
                anchor = (side, y - _TOP * SMALL / 2)
                self.page.text(anchor, text, SMALL, middle=False, align=align, layer=0.6)
        if title:
            anchor = (side, self.field[3] + _TOP * SMALL / 2 + 3.5)
            self.page.text(anchor, title, FONT_SIZE, align=align, middle=False)

    def name_y(self, text: str) -> None:
        """Name and unit of the vertical axis above its upper end."""
        deep = line_box(shown(text), FONT_SIZE)[2]  # below it the number of the upper end stands
        anchor = (self.field[0] - 8, self.field[3] + max(7.0, deep + _TOP * SMALL / 2 + 1.5))
        self.page.text(anchor, text, FONT_SIZE, align=0.0, middle=False)

    def name_x(self, text: str) -> None:
        """Name and unit of the horizontal axis at its right end, in line with the numbers."""
        anchor = (self.field[2] + self.x.beyond(), self.field[1] - 3 - 0.76 * SMALL)
        self.page.text(anchor, text, FONT_SIZE, align=0.0, middle=False)


def _uncrowded(marks: Sequence[float], ticks: Ticks) -> Sequence[str]:
    """Texts of marks; of marks closer than their texts are wide every second or third, with 0."""
    widest = ticks.width() + _MARK_GAP
    named = [mark for mark, text in zip(marks, ticks.texts, strict=True) if text]
    nearest = min((abs(b - a) for a, b in pairwise(named)), default=widest)
    every = math.ceil(widest / nearest - 1e-9)
    zero = next((n for n, mark in enumerate(ticks.places) if abs(mark) < 1e-12), 0)
    return [text if (n - zero) % every == 0 else "" for n, text in enumerate(ticks.texts)]
