"""Dimension lines: with arrows, values beside them, chains that do not crowd."""

from __future__ import annotations

import math
from collections.abc import Sequence

from reports.drawing.lettering import width_of
from reports.drawing.primitives import SIZES, Canvas, Point
from reports.shared.russian import fixed


def number(value: float) -> str:
    """A size with the digits it was given with, to a hundredth."""
    digits = next(d for d in range(3) if d == 2 or abs(round(value, d) - value) < 1e-9)
    return fixed(value, digits)


def along(
    canvas: Canvas, start: Point, end: Point, name: str, value: float, letters: float,
    *, heads: bool = True,
) -> None:  # fmt: skip
    """A dimension from one point to another with its value beside it."""
    length = math.dist(start, end)
    unit = ((end[0] - start[0]) / length, (end[1] - start[1]) / length)
    if heads:
        canvas.line(start, end, layer=SIZES)
        canvas.arrow(end, unit, letters)
        canvas.arrow(start, (-unit[0], -unit[1]), letters)
    turn = math.degrees(math.atan2(unit[1], unit[0]))
    turn = turn - 180 if turn > 90.01 else turn + 180 if turn < -89.99 else turn
    up = (-math.sin(math.radians(turn)), math.cos(math.radians(turn)))
    text = f"{name} = {number(value)}" if name else number(value)
    shares = (0.5, 0.4, 0.6, 0.3, 0.7)
    middles = [(start[0] + s * (end[0] - start[0]), start[1] + s * (end[1] - start[1]))
               for s in shares]  # fmt: skip
    places = [(x + up[0] * gap * letters, y + up[1] * gap * letters)
              for gap in (0.5, -1.6, 1.6, -2.8) for x, y in middles]  # fmt: skip
    canvas.words_where_free(places, text, letters, align=0.5, angle=round(turn, 3))


def across(
    canvas: Canvas, x: float, ends: tuple[float, float], name: str, value: float, letters: float
) -> None:
    """A diameter upright within its journal, the value beside the line."""
    low, high = ends
    canvas.line((x, low), (x, high), layer=SIZES)
    canvas.arrow((x, high), (0.0, 1.0), min(letters, (high - low) / 3))
    canvas.arrow((x, low), (0.0, -1.0), min(letters, (high - low) / 3))
    text = f"{name} {number(value)}"
    middle, wide = (low + high) / 2, width_of(text, letters)
    if wide < high - low:
        places = [(x - 0.5 * letters, middle)]
        if canvas.words_where_free(places, text, letters, align=0.5, angle=90.0):
            return
    above = [(x, high + (1 + 1.6 * n) * letters) for n in range(6)]
    canvas.words_where_free(above, text, letters, align=0.5)


def chain(
    canvas: Canvas, stations: Sequence[float], names: Sequence[str], values: Sequence[float],
    y: float, letters: float,
) -> None:  # fmt: skip
    """Sizes one after another on a line; a value without room stands on a lower level."""
    for start, end, name, value in zip(stations, stations[1:], names, values, strict=False):
        if end - start <= 0:
            continue
        long = end - start
        canvas.line((start, y), (end, y), layer=SIZES)
        head = min(letters, long / 3)
        canvas.arrow((end, y), (1.0, 0.0), head)
        canvas.arrow((start, y), (-1.0, 0.0), head)
        text = f"{name} = {number(value)}"
        middle = (start + end) / 2
        inside = [(middle, y + 0.5 * letters)] if width_of(text, letters) < long else []
        levels = [(middle, y - 1.7 * letters * n) for n in range(1, 8)]
        placed = canvas.words_where_free([*inside, *levels], text, letters, align=0.5)
        if placed and canvas.items[-1].place[1] < y:  # type: ignore[union-attr]
            foot = canvas.items[-1].place[1] + 1.1 * letters  # type: ignore[union-attr]
            canvas.line((middle, y), (middle, foot), layer=SIZES)
    for x in sorted(set(stations)):
        canvas.line((x, y - 0.5 * letters), (x, y + 3 * letters), layer=SIZES)
