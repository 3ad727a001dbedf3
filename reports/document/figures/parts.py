"""Drawings of a throw and of the mechanism from the input, as figures and as items."""

from __future__ import annotations

from functools import partial

from reports.document.text.terms import Terms
from reports.drawing.parts import Mechanism, Throw, mechanism_drawing, throw_drawing
from reports.drawing.primitives import Item, bounds
from reports.drawing.svg import svg_of
from reports.spec.shape import Shape

_WIDTH, _HEIGHT = 150.0, 130.0  # of the part on the figure [mm]
_EDGE = 3.0


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
    bore = terms.value("geometry_bore_mm")
    return Mechanism(
        bore, 1000 * terms.value("r_crank"), 1000 * terms.value("L_rod"), 1000 * offset
    )


def throw_figure(throw: Throw) -> str:
    """A throw as SVG for the report."""
    return _figure(throw_drawing(throw, scale=min(_WIDTH / throw.size, 1e3)))


def mechanism_figure(mechanism: Mechanism) -> str:
    """The mechanism as SVG for the report."""
    return _figure(mechanism_drawing(mechanism, scale=_HEIGHT / mechanism.size))


def _figure(items: list[Item]) -> str:
    left, low, right, high = bounds(items)
    return svg_of(items, (left - _EDGE, low - _EDGE, right + _EDGE, high + _EDGE))


def throws_of(terms: Terms) -> list[Throw]:
    """Sizes of all throws."""
    return [throw_of(terms, n) for n in range(1, Shape.of(terms.model.input).throws + 1)]
