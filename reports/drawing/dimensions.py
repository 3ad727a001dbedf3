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
    if not heads:  # there is no dimension line to stand beside: the line goes on as its words
        beyond = length + 1.6 * letters + width_of(text, letters) / 2
        for far in (beyond, -beyond):  # past its end, or past the circle on the other side
            places.append((start[0] + far * unit[0] - 0.4 * letters * up[0],
                           start[1] + far * unit[1] - 0.4 * letters * up[1]))  # fmt: skip
    canvas.words_where_free(places, text, letters, align=0.5, angle=round(turn, 3))


def across(
    canvas: Canvas, x: float, ends: tuple[float, float], value: float, letters: float
) -> None:
    """A diameter upright within its journal, the value beside the line."""
    low, high = ends
    canvas.line((x, low), (x, high), layer=SIZES)
    canvas.arrow((x, high), (0.0, 1.0), min(letters, (high - low) / 3))
    canvas.arrow((x, low), (0.0, -1.0), min(letters, (high - low) / 3))
    text = f"Ø{number(value)}"
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
    """Sizes one after another on a line.

    Values without room in between stand below, left ones left of their leaders and the lower
    the nearer to the middle, right ones likewise: so no leader runs through a value.
    """
    below: list[tuple[float, str]] = []
    for start, end, name, value in zip(stations, stations[1:], names, values, strict=False):
        if end - start <= 0:
            continue
        canvas.line((start, y), (end, y), layer=SIZES)
        head = min(letters, (end - start) / 3)
        canvas.arrow((end, y), (1.0, 0.0), head)
        canvas.arrow((start, y), (-1.0, 0.0), head)
        text, middle = f"{name} = {number(value)}", (start + end) / 2
        if width_of(text, letters) < end - start:
            canvas.words((middle, y + 0.5 * letters), text, letters, align=0.5)
        else:
            below.append((middle, text))
    half = -(-len(below) // 2)
    for place, (middle, text) in enumerate(below):
        left = place < half
        level = y - 1.6 * letters * (1 + (place if left else len(below) - 1 - place))
        canvas.line((middle, y), (middle, level - 0.2 * letters), layer=SIZES)
        beside = (middle + (-0.4 if left else 0.4) * letters, level)
        canvas.words(beside, text, letters, align=1.0 if left else 0.0)
    for x in sorted(set(stations)):
        canvas.line((x, y - 0.5 * letters), (x, y + 3 * letters), layer=SIZES)
