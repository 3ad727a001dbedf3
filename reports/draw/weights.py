"""Dimensioned drawings of a web with its counterweight, from numbers in mm."""

from __future__ import annotations

import math
from dataclasses import dataclass

from reports.draw.canvas import AXES, CONTOUR, SIZES, THIN, Canvas, Item, Point, interrupted, polar
from reports.draw.parts import along, number

_STEP = 4.0  # of an arc [deg]
_EDGE = 1.35  # of a journal's radius: the web's edge there


@dataclass(frozen=True, slots=True)
class CounterweightSizes:
    """A web seen along the shaft [mm]: journals, crank radius, sector with its angle [deg]."""

    radius: float
    pin: float
    main: float
    inner: float
    outer: float
    angle: float


def counterweight_drawing(
    web: CounterweightSizes, *, letters: float = 3.5, scale: float = 1.0
) -> list[Item]:
    """A web from the end of the shaft, its counterweight opposite the crankpin.

    Args:
        web: sizes.
        letters: height of the letters on the drawing [mm].
        scale: size of the drawing to that of the web.
    """
    canvas = Canvas()
    r, inner, outer = (scale * size for size in (web.radius, web.inner, web.outer))
    main, pin = scale * web.main / 2, scale * web.pin / 2
    half, centre = web.angle / 2, (0.0, 0.0)
    canvas.circle(centre, main, layer=CONTOUR)
    canvas.circle((0.0, r), pin, layer=CONTOUR)
    canvas.line(*_web(r, main * _EDGE, pin * _EDGE), layer=CONTOUR)
    rim = _arc(outer, 180 - half, 180 + half), _arc(inner, 180 + half, 180 - half)
    canvas.line(*rim[0], *rim[1], rim[0][0], layer=CONTOUR)
    over = 2.5 * letters
    canvas.line((0.0, -outer - over), (0.0, r + pin * _EDGE + over), layer=AXES)
    canvas.line((-outer - over, 0.0), (outer + over, 0.0), layer=AXES)
    canvas.line((-pin * _EDGE - over, r), (pin * _EDGE + over, r), layer=AXES)
    along(canvas, centre, polar(centre, outer, 180 + 0.6 * half), "R_2", web.outer, letters,
          heads=False)  # fmt: skip
    along(canvas, centre, polar(centre, inner, 180 - 0.6 * half), "R_1", web.inner, letters,
          heads=False)  # fmt: skip
    aside = outer + 3 * letters
    canvas.line((0.0, r), (aside + letters, r), layer=THIN)
    along(canvas, (aside, 0.0), (aside, r), "r", web.radius, letters)
    reach = outer + 2 * letters
    for end in (180 - half, 180 + half):
        canvas.line(polar(centre, outer, end), polar(centre, reach + letters, end), layer=THIN)
    canvas.line(*_arc(reach, 180 - half, 180 + half), layer=SIZES)
    canvas.words((0.0, -reach - 1.6 * letters), f"{number(web.angle)}°", letters, align=0.5)
    return interrupted(canvas.items)


def _arc(radius: float, first: float, last: float) -> list[Point]:
    """Points of an arc by angles clockwise from up [deg]."""
    steps = max(1, math.ceil(abs(last - first) / _STEP))
    return [polar((0.0, 0.0), radius, first + (last - first) * n / steps) for n in range(steps + 1)]


def _web(r: float, main: float, pin: float) -> list[Point]:
    """Edge of the web: arcs about both journals and the lines that touch them."""
    tilt = math.degrees(math.asin(max(-1.0, min(1.0, (main - pin) / r))))
    upper = [(x, y + r) for x, y in _arc(pin, -90 + tilt, 90 - tilt)]
    lower = _arc(main, 90 - tilt, 270 + tilt)
    return [*upper, *lower, upper[0]]
