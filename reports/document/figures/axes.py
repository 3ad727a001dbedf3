"""Axes as in a Russian textbook: units at the ends, heavier lines through zero."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reports.document.figures.labels import Box, line_box, shown
from reports.document.figures.sheet import Sheet
from reports.document.figures.style import AXIS, EDGE, FONT_SIZE, GRID, SMALL, Look
from reports.document.figures.ticks import Ticks

_GAP = 3.0  # between the texts of neighbouring marks [pt]
_TOP = 0.75  # of the type above the baseline, which half a number's height stands off its mark


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
        places = []
        for start, end, ticks, turned, values in ends:
            share = (values - ticks.low) / (ticks.high - ticks.low)
            places.append(start + (end - start) * (1 - share if turned else share))
        return np.stack(np.broadcast_arrays(*places), axis=-1)

    def level(self, y: float, look: Look, layer: float = 2) -> None:
        """A line across the field."""
        self.page.line(self.at([self.x.low, self.x.high], [y, y]), look, layer)

    def dress(
        self,
        *,
        pads: tuple[float, float] = (3, 3),
        edges: tuple[Look, Look] = (EDGE, EDGE),
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
        left_side = not self.reverse[0]
        side = left - pads[1] if left_side else right + pads[1]
        for y, text in zip(ys, self.y.texts, strict=True):
            place = (side, y - _TOP * SMALL / 2)
            page.text(place, text, SMALL, middle=False, align=float(left_side), layer=0.6)
        corners = [(left, low), (right, low), (right, high), (left, high)]
        page.line(corners[1:], GRID, 0.6)
        for edge, look in zip((corners[::3], corners[:2]), edges, strict=True):
            page.line(edge, look, 2.5 if look is not GRID else 0.6)
        if self.y.low < 0 < self.y.high:
            self.level(0.0, AXIS, 1.5)
        if zeros and self.x.low < 0 < self.x.high:
            page.line(self.at([0.0, 0.0], [self.y.low, self.y.high]), AXIS, 1.5)

    def name_y(self, text: str) -> None:
        """Name and unit of the vertical axis above its upper end."""
        deep = line_box(shown(text), FONT_SIZE)[2]  # below it the number of the upper end stands
        place = (self.field[0] - 8, self.field[3] + max(7.0, deep + _TOP * SMALL / 2 + 1.5))
        self.page.text(place, text, FONT_SIZE, align=0.0, middle=False)

    def name_x(self, text: str) -> None:
        """Name and unit of the horizontal axis at its right end, in line with the numbers."""
        place = (self.field[2] + self.x.beyond(), self.field[1] - 3 - 0.76 * SMALL)
        self.page.text(place, text, FONT_SIZE, align=0.0, middle=False)


def _uncrowded(places: Sequence[float], ticks: Ticks) -> Sequence[str]:
    """Texts of marks; of marks closer than their texts are wide every second or third, with 0."""
    widest = ticks.width() + _GAP
    named = [place for place, text in zip(places, ticks.texts, strict=True) if text]
    nearest = min((abs(b - a) for a, b in pairwise(named)), default=widest)
    every = math.ceil(widest / nearest - 1e-9)
    zero = next((n for n, place in enumerate(ticks.places) if abs(place) < 1e-12), 0)
    return [text if (n - zero) % every == 0 else "" for n, text in enumerate(ticks.texts)]
