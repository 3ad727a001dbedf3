"""Drawings of a throw and of the mechanism on the sheet, to a standard scale."""

from __future__ import annotations

from collections.abc import Callable

from reports.document.figures.parts import mechanism_of, throw_of
from reports.document.text.terms import Terms
from reports.drawing.parts import mechanism_drawing, throw_drawing
from reports.drawing.primitives import Canvas, Item, bounds, moved
from reports.shared.russian import fixed
from reports.sheet.cell import Room, headed

# ГОСТ 2.302.
_SCALES = (10.0, 5.0, 4.0, 2.5, 2.0, 1.0, 1 / 2, 1 / 2.5, 1 / 4, 1 / 5, 1 / 10, 1 / 20, 1 / 50)


def throw(canvas: Canvas, room: Room, terms: Terms) -> None:
    """The first throw with its sizes."""
    sizes = throw_of(terms)
    _placed(canvas, room, "Колено вала", lambda scale: throw_drawing(sizes, scale=scale))


def mechanism(canvas: Canvas, room: Room, terms: Terms) -> None:
    """The mechanism with its sizes."""
    sizes = mechanism_of(terms)
    title = "Кривошипно-шатунный механизм"
    _placed(canvas, room, title, lambda scale: mechanism_drawing(sizes, scale=scale))


def _placed(canvas: Canvas, room: Room, title: str, draw: Callable[[float], list[Item]]) -> None:
    """A drawing in the middle of a room at the largest scale that fits."""
    free = headed(Canvas(), room, title, ("М 1:1",))
    for scale in _SCALES:
        items = draw(scale)
        left, low, right, high = bounds(items)
        if right - left <= free.width and high - low <= free.height:
            break
    said = (
        f"М {fixed(scale, 1 if scale % 1 else 0)}:1"
        if scale >= 1
        else (f"М 1:{fixed(1 / scale, 1 if (1 / scale) % 1 > 1e-6 else 0)}")
    )
    headed(canvas, room, title, (said,))
    middle = free.middle
    shift = middle[0] - (left + right) / 2, middle[1] - (low + high) / 2
    canvas.items += moved(items, *shift)
