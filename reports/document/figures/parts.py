"""Drawings of a throw and of the mechanism from the input, as figures and as items."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from reports.document.text.terms import Terms
from reports.drawing.parts import Mechanism, Throw, mechanism_drawing, throw_drawing
from reports.drawing.primitives import Canvas, Item, bounds, moved
from reports.drawing.svg import svg_of
from reports.model.shape import Shape

_THROW, _MECHANISM = (98.0, 92.0), (52.0, 92.0)  # width and height of both on the figure [mm]
_BETWEEN, _LETTERS = 8.0, 2.5


def throw_of(terms: Terms, number: int = 1) -> Throw:
    """Sizes of a throw, counted from the nose."""
    shaft = terms.model.input.crankshaft
    arms = shaft.arms[number - 1]
    main = partial(_size, shaft.main_diameter_mm, shaft.main_diameters_mm)
    webs = shaft.webs[2 * number - 2 : 2 * number]
    return Throw(
        arms=(arms.l1_mm, arms.l2_mm, arms.l3_mm, arms.l4_mm, arms.l5_mm, arms.l6_mm),
        webs=(arms.left_web_mm, arms.right_web_mm),
        radius=1000 * terms.value("r_crank"),
        pin=_size(shaft.pin_diameter_mm, shaft.pin_diameters_mm, number),
        mains=(main(number), main(number + 1)),
        lengths=(shaft.main_lengths_mm[number - 1], shaft.main_lengths_mm[number]),
        weights=(bool(webs[0].counterweight_kg), bool(webs[1].counterweight_kg)),
    )


def _size(common: float | None, own: tuple[float, ...] | None, number: int) -> float:
    """A diameter common to all journals or one of its own."""
    return own[number - 1] if own is not None else common or 0.0


def mechanism_of(terms: Terms) -> Mechanism:
    """Sizes of the mechanism."""
    offset = terms.value("k_offset") * terms.value("r_crank") if terms.has("k_offset") else 0.0
    # Of an engine that is designed for a power the cycle tells the bore.
    bore = terms.value("geometry_bore_mm" if terms.has("geometry_bore_mm") else "cyc_D")
    return Mechanism(
        bore, 1000 * terms.value("r_crank"), 1000 * terms.value("L_rod"), 1000 * offset
    )


def sizes_figure(throw: Throw, mechanism: Mechanism, *, size: float = 1.0) -> str:
    """A throw beside the mechanism, each to a scale of its own, as SVG for the report.

    ``size`` makes the drawings smaller, but not their letters.
    """
    rooms = ((size * wide, size * tall) for wide, tall in (_THROW, _MECHANISM))
    draws = (partial(throw_drawing, throw), partial(mechanism_drawing, mechanism))
    parts = [
        _fitted(partial(draw, letters=_LETTERS), room)
        for draw, room in zip(draws, rooms, strict=True)
    ]
    canvas = Canvas()
    place, ends = 0.0, []
    for items in parts:
        left, _, right, high = bounds(items)
        canvas.items += moved(items, place - left, -high)
        ends.append(place + (right - left) / 2)
        place += right - left + _BETWEEN
    low = bounds(canvas.items)[1] - 2.5 * _LETTERS
    for middle, letter in zip(ends, "аб", strict=True):
        canvas.words((middle, low), f"{letter})", _LETTERS, align=0.5)
    left, low, right, high = bounds(canvas.items)
    return svg_of(canvas.items, (left - 2, low - 2, right + 2, high + 2))


def _fitted(draw: Callable[..., list[Item]], room: tuple[float, float]) -> list[Item]:
    """A drawing to the scale at which it fits a room; letters keep their height."""
    scale = 1.0
    for _ in range(6):  # what letters take does not shrink with the drawing
        left, low, right, high = bounds(draw(scale=scale))
        scale *= min(room[0] / (right - left), room[1] / (high - low))
    return draw(scale=scale)


def throws_of(terms: Terms) -> list[Throw]:
    """Sizes of all throws."""
    return [throw_of(terms, n) for n in range(1, Shape.of(terms.model.input).throws + 1)]
