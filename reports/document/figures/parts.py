"""Sketches of piston, pin and rod with the letters of their sizes; proportions of the engine."""

from __future__ import annotations

from collections.abc import Mapping

from kshm.nomenclature.quantity import quantity
from reports.document.figures.canvas import CENTRE, HAIR, SMALL, THIN, Pen, Point, Sheet

Sizes = Mapping[str, float]
_GREY, _BOLD = "#e4e4e4", 1.3
_WIDTH, _HEIGHT = 170.0, 92.0  # of the figure [mm]


def parts_sketch(sizes: Sizes) -> str:
    """Half-section of the piston with its ring, the pin in its bosses, the rod, as SVG.

    Args:
        sizes: ``bore`` and those of the parts by key [mm].
    """
    page = Sheet(_WIDTH, _HEIGHT)
    pen = Pen(page)
    width, top = page.width, page.height
    scale = 0.27 * width / sizes["bore"]
    _piston(pen, (0.05 * width, top - 36), scale, sizes)
    _pin(pen, (0.53 * width, top - 70), 0.24 * width / sizes["pin_length"], sizes)
    _rod(pen, (0.86 * width, top - 60), 0.12 * width / sizes["eye_outer"], sizes)
    for share, letter in ((0.19, "а)"), (0.53, "б)"), (0.86, "в)")):
        pen.text((share * width, 9), letter)
    return page.svg()


def _piston(pen: Pen, corner: Point, k: float, s: Sizes) -> None:
    """Section along the axis: crown, wall, first land, ring, skirt, bosses."""
    x, y = corner
    bore, height, crown = s["bore"] * k, min(s["height"] * k, 180.0), s["crown"] * k
    wall, ring = s["head_wall"] * k, s["ring_radial"] * k
    inner = wall + ring
    outline = [(x, y), (x + bore, y), (x + bore, y - height), (x + bore - wall, y - height),
               (x + bore - inner, y - crown), (x + inner, y - crown), (x + wall, y - height),
               (x, y - height)]  # fmt: skip
    pen.shape(outline, fill=_GREY, width=_BOLD, order=1.6)
    land = max(s["land"] * k, 4.0)
    for number in range(3):
        level = y - 1.6 * land - 2.2 * land * number
        for side in (x, x + bore - ring):
            pen.shape([(side, level), (side + ring, level), (side + ring, level - land),
                       (side, level - land)], fill="#ffffff", width=THIN)  # fmt: skip
    middle = x + bore / 2
    pen.line([(middle, y + 8), (middle, y - height - 8)], HAIR, CENTRE)
    axis = y - 0.55 * height
    pen.circle((middle, axis), s["pin"] * k / 2, fill="#ffffff", width=_BOLD)
    _down(pen, middle + 0.18 * bore, y, y - crown, _letter("crown"), 12)
    _down(pen, x - 8, y, y - height, _letter("height"), -9)
    _down(pen, x + bore + 8, y - 0.35 * height, y - height, _letter("skirt"), 11)
    _across(pen, y - height - 14, x, x + bore, "$D$")
    _across(pen, y + 14, x, x + ring, _letter("ring_radial"))


def _pin(pen: Pen, middle: Point, k: float, s: Sizes) -> None:
    """Draw the pin with the eye between the bosses."""
    x, y = middle
    length, outer, bore = s["pin_length"] * k, s["pin"] * k, s["pin_bore"] * k
    left = x - length / 2
    for low, high, deep in ((-length / 2, -s["bosses"] * k / 2, 16.0),
                            (-s["eye_length"] * k / 2, s["eye_length"] * k / 2, 12.0),
                            (s["bosses"] * k / 2, length / 2, 16.0)):  # fmt: skip
        pen.shape([(x + low, y + outer / 2 + deep), (x + high, y + outer / 2 + deep),
                   (x + high, y - outer / 2 - deep), (x + low, y - outer / 2 - deep)],
                  width=THIN, order=1.2)  # fmt: skip
    pen.shape([(left, y + outer / 2), (left + length, y + outer / 2),
               (left + length, y - outer / 2), (left, y - outer / 2)],
              fill=_GREY, width=_BOLD, order=1.6)  # fmt: skip
    for side in (1, -1):
        pen.line([(left, y + side * bore / 2), (left + length, y + side * bore / 2)], THIN)
    pen.line([(left - 8, y), (left + length + 8, y)], HAIR, CENTRE)
    below = y - outer / 2 - 30
    _across(
        pen, below, x - s["eye_length"] * k / 2, x + s["eye_length"] * k / 2, _letter("eye_length")
    )
    _across(pen, below - 17, x - s["bosses"] * k / 2, x + s["bosses"] * k / 2, _letter("bosses"))
    _across(pen, below - 34, left, left + length, _letter("pin_length"))
    _down(pen, left + length + 12, y + outer / 2, y - outer / 2, _letter("pin"), 12)
    _down(pen, left - 8, y + bore / 2, y - bore / 2, _letter("pin_bore"), -11)


def _rod(pen: Pen, top: Point, k: float, s: Sizes) -> None:
    """Draw eye with its bush, the shank, the big end; the big end is drawn nearer than it is."""
    x, y = top
    outer, bush, pin = (
        s["eye_outer"] * k / 2,
        s["pin"] * k / 2 + s["bush_wall"] * k,
        s["pin"] * k / 2,
    )
    big, half = s["bolts_apart"] * k / 2, s["crankpin"] * k / 2
    shank, low = s["shank_height"] * k / 2, y - 3.4 * outer
    pen.shape([(x - shank, y - 0.8 * outer), (x + shank, y - 0.8 * outer), (x + 1.2 * shank, low),
               (x - 1.2 * shank, low)], fill=_GREY, width=_BOLD, order=1.0)  # fmt: skip
    scale = min(1.0, 34.0 / big)
    big, half = big * scale, half * scale
    centre = (x, low - half)
    wide, above, below = 1.25 * big, centre[1] + 0.9 * half, centre[1] - 1.35 * half
    corners = [(x - wide, above), (x + wide, above), (x + wide, below), (x - wide, below)]
    pen.shape(corners, fill=_GREY, width=_BOLD, order=1.6)
    pen.circle(centre, half, fill="#ffffff", width=_BOLD)
    pen.line([(x - 1.4 * big, centre[1]), (x + 1.4 * big, centre[1])], THIN)
    for side in (-1, 1):
        bolt = x + side * big
        pen.line([(bolt, centre[1] + 1.1 * half), (bolt, centre[1] - 1.6 * half)], HAIR, CENTRE)
    pen.circle((x, y), outer, fill=_GREY, width=_BOLD, order=1.8)
    pen.circle((x, y), bush, fill="#ffffff", width=THIN, order=1.9)
    pen.circle((x, y), pin, fill="#ffffff", width=THIN, order=2.0)
    _across(pen, y + outer + 10, x - outer, x + outer, _letter("eye_outer"))
    _across(pen, centre[1] - 1.6 * half - 10, x - big, x + big, _letter("bolts_apart"))
    pen.text((x + outer + 12, y + 0.3 * outer), "I", SMALL)
    pen.line([(x - outer - 7, y), (x + outer + 7, y)], HAIR, CENTRE)


def _letter(key: str) -> str:
    """Symbol of a size."""
    return f"${quantity(f'st_{key}_mm').tex}$"


def _across(pen: Pen, level: float, left: float, right: float, name: str) -> None:
    pen.measure((left, level), (right, level))
    pen.text(((left + right) / 2, level), name, SMALL)


def _down(pen: Pen, at: float, high: float, low: float, name: str, aside: float) -> None:
    pen.measure((at, low), (at, high))
    pen.text((at + aside, (low + high) / 2), name, SMALL)
