"""Drawings of a throw and of the mechanism on the sheet, to a standard scale."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from functools import partial

from reports.document.figures.parts import mechanism_of, throw_of
from reports.document.text.terms import Terms
from reports.drawing.parts import mechanism_drawing, throw_drawing
from reports.drawing.primitives import Canvas, Item, bounds, moved
from reports.shared.russian import fixed
from reports.sheet.cell import Room, headed

_LETTERS = (3.5, 2.5, 1.8)  # heights to try
# ГОСТ 2.302.
_SCALES = (10.0, 5.0, 4.0, 2.5, 2.0, 1.0, 1 / 2, 1 / 2.5, 1 / 4, 1 / 5, 1 / 10, 1 / 20, 1 / 50)


def throw(canvas: Canvas, room: Room, terms: Terms) -> None:
    """The first throw with its sizes."""
    sizes = throw_of(terms)
    _placed(canvas, room, "Колено вала", partial(throw_drawing, sizes))


def mechanism(canvas: Canvas, room: Room, terms: Terms) -> None:
    """The mechanism with its sizes."""
    sizes = mechanism_of(terms)
    title = "Кривошипно-шатунный механизм"
    _placed(canvas, room, title, partial(mechanism_drawing, sizes))


def _placed(canvas: Canvas, room: Room, title: str, draw: Callable[..., list[Item]]) -> None:
    """A drawing in the middle of a room at the largest scale that fits, in small letters at last.

    Raises:
        ValueError: no scale is small enough.
    """
    free = headed(Canvas(), room, title, ("М 1:1",))
    for letters, scale in itertools.product(_LETTERS, _SCALES):
        items = draw(scale=scale, letters=letters)
        left, low, right, high = bounds(items)
        if right - left <= free.width and high - low <= free.height:
            headed(canvas, room, title, (_said(scale),))
            shift = free.middle[0] - (left + right) / 2, free.middle[1] - (low + high) / 2
            canvas.items += moved(items, *shift)
            return
    msg = f"no scale for {title} in {free.width:.0f} × {free.height:.0f} mm"
    raise ValueError(msg)


def _said(scale: float) -> str:
    """A scale as it stands on a drawing: ``М 1:2,5``."""
    ratio = max(scale, 1 / scale)
    text = fixed(ratio, 0 if abs(ratio - round(ratio)) < 1e-6 else 1)
    return f"М {text}:1" if scale > 1 else f"М 1:{text}"
