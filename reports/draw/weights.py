"""Dimensioned drawings of a web with its counterweight and of a flywheel, from numbers in mm."""

from __future__ import annotations

import math
from dataclasses import dataclass

from reports.draw.canvas import AXES, CONTOUR, SIZES, THIN, Canvas, Item, Point, interrupted, polar
from reports.draw.parts import along, measured

_STEP = 4.0  # of an arc [deg]
_EDGE = 1.35  # of a journal's radius: the web's edge there


@dataclass(frozen=True, slots=True)
class CounterweightSizes:
    """A web seen along the shaft [mm]: journals, crank radius, sector with its angle [deg].

    ``words`` are those beside both radii and the angle of the sector.
    """

    radius: float
    pin: float
    main: float
    inner: float
    outer: float
    angle: float
    words: tuple[str, ...]


def counterweight_drawing(
    web: CounterweightSizes, *, letters: float = 3.5, scale: float = 1.0
) -> list[Item]:
    """Return a web from the end of the shaft, its counterweight opposite the crankpin.

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
    to_inner, to_outer, of_angle = web.words
    measured(canvas, centre, polar(centre, outer, 180 + 0.6 * half), to_outer, letters, heads=False)
    measured(canvas, centre, polar(centre, inner, 180 - 0.6 * half), to_inner, letters, heads=False)
    aside = outer + 3 * letters
    canvas.line((0.0, r), (aside + letters, r), layer=THIN)
    along(canvas, (aside, 0.0), (aside, r), "r", web.radius, letters)
    reach = outer + 2 * letters
    for end in (180 - half, 180 + half):
        canvas.line(polar(centre, outer, end), polar(centre, reach + letters, end), layer=THIN)
    canvas.line(*_arc(reach, 180 - half, 180 + half), layer=SIZES)
    below = [(0.0, -reach - (1.6 + 1.3 * n) * letters) for n in range(4)]
    canvas.words_where_free(below, of_angle, letters, align=0.5)
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


@dataclass(frozen=True, slots=True)
class FlywheelSizes:
    """Diameters of the flywheel and of its rim's bore, thickness of the disc, width of the rim.

    ``words`` are those beside them.
    """

    outer: float
    bore: float
    disc: float
    rim: float
    words: tuple[str, ...]


def flywheel_drawing(
    wheel: FlywheelSizes, *, letters: float = 3.5, scale: float = 1.0
) -> list[Item]:
    """Return a section of the flywheel along its axis.

    Args:
        wheel: sizes [mm].
        letters: height of the letters on the drawing [mm].
        scale: size of the drawing to that of the flywheel.
    """
    canvas = Canvas()
    outer, bore = scale * wheel.outer / 2, scale * wheel.bore / 2
    disc, rim = scale * wheel.disc, scale * wheel.rim
    for side in (1, -1):
        corners = ((0.0, 0.0), (0.0, outer), (rim, outer), (rim, bore), (disc, bore), (disc, 0.0))
        canvas.line(*((x, side * y) for x, y in corners), layer=CONTOUR)
        _hatched(canvas, [(0.0, 0.0, disc, bore), (0.0, bore, rim, outer)], side, letters)
    over = 2.5 * letters
    canvas.line((-over, 0.0), (max(rim, disc) + over, 0.0), layer=AXES)
    whole, inside, thickness, width_of_rim = wheel.words
    for x, y, text in ((-3 * letters, outer, whole), (rim + 3 * letters, bore, inside)):
        end = 0.0 if x < 0 else rim
        for level in (y, -y):
            canvas.line((end, level), (x + math.copysign(letters, x), level), layer=THIN)
        measured(canvas, (x, -y), (x, y), text, letters)
    for width, level, text in ((disc, -outer - 3 * letters, thickness),
                               (rim, outer + 3 * letters, width_of_rim)):  # fmt: skip
        start = -outer if level < 0 else outer
        for x in (0.0, width):
            canvas.line((x, start), (x, level + math.copysign(letters, level)), layer=THIN)
        measured(canvas, (0.0, level), (width, level), text, letters)
    return interrupted(canvas.items)


def _hatched(
    canvas: Canvas, boxes: list[tuple[float, float, float, float]], side: int, letters: float
) -> None:
    """Lines at 45° through boxes above the axis, mirrored for the lower half."""
    step = 1.2 * letters
    for left, low, right, high in boxes:
        shift = math.ceil((low - right) / step) * step
        while shift < high - left:
            first, last = max(left, low - shift), min(right, high - shift)
            if last > first:
                canvas.line((first, side * (first + shift)), (last, side * (last + shift)),
                            layer=THIN)  # fmt: skip
            shift += step
