"""Conditional wear diagram of a journal by rays, to scale, with the oil hole."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from kshm.nomenclature.quantity import roman
from reports.document.figures.labels import text_size
from reports.document.figures.pen import CENTRE, HAIR, THIN, Pen, Point, polar
from reports.document.figures.sheet import Sheet
from reports.document.figures.style import FONT_SIZE, MM, SMALL
from reports.document.figures.ticks import value_ticks
from reports.shared.russian import fixed

_DEPTH = 0.62  # part of the radius that the greatest sum takes
_FILL = "#d6d6d6"
_BETWEEN = 12  # points of the smooth curve to a ray


def wear_diagram(
    sums: ArrayLike,
    ray_angles: ArrayLike,
    hole_angle: float | None,
    *,
    size: float = 112.0,
    top: str = "",
) -> str:
    r"""Wear laid off from the circle of the journal inwards, as SVG.

    Args:
        sums: Sum of the forces of each ray [MPa], shape (n,), not negative.
        ray_angles: Angles of the rays from the upward direction, against the clock [deg],
            shape (n,), rising.
        hole_angle: Angle of the oil hole [deg] like the rays', ``None`` leaves it out.
        size: Width of the figure [mm].
        top: What the upward direction is, e.g. «к щеке», written above.

    Raises:
        ValueError: Shapes differ, a sum is negative or not finite.
    """
    values = np.asarray(sums, dtype=np.float64)
    degrees = np.asarray(ray_angles, dtype=np.float64)
    if values.shape != degrees.shape or values.ndim != 1 or values.size < 3:
        msg = f"Диаграмма износа: {values.shape} сумм при {degrees.shape} лучах"
        raise ValueError(msg)
    if not np.isfinite(values).all() or (values < 0).any():
        msg = "Диаграмма износа: сумма сил отрицательна или не число"
        raise ValueError(msg)
    radius = size * MM / 2 - 34
    above, below = 30 + (13 if top else 0), 52
    page = Sheet(size, (2 * radius + above + below) / MM)
    pen = Pen(page)
    centre = (page.width / 2, page.height - radius - above)
    factor = _DEPTH * radius / (float(values.max()) or 1.0)
    curve = [
        polar(centre, radius - depth * factor, -math.radians(angle))
        for angle, depth in outline(values, degrees)
    ]
    # The disc lies below; the polygon takes its inside out again.
    pen.circle(centre, radius, fill=_FILL, width=0, order=0.5)
    pen.shape(curve, fill="#ffffff", width=1.3, order=0.6)
    rays = (-np.radians(degrees)).tolist()
    for number, (ray, value) in enumerate(zip(rays, values.tolist(), strict=True), 1):
        pen.line([centre, polar(centre, radius + 8, ray)], HAIR, CENTRE)
        pen.text(polar(centre, radius + 19, ray), roman(number))
        pen.circle(polar(centre, radius - value * factor, ray), 1.6, fill="#000000", width=0)
    pen.circle(centre, radius, width=1.6)
    if hole_angle is not None:
        _hole(pen, centre, radius, hole_angle)
    if top:
        pen.text((centre[0], centre[1] + radius + 33), top, SMALL)
    _scale(pen, (centre[0], 12.0), factor, float(values.max()) or 1.0)
    return page.svg()


def outline(values: NDArray[np.float64], degrees: NDArray[np.float64]) -> list[tuple[float, float]]:
    """Smooth closed curve through the ends, which never overshoots them (monotone cubic)."""
    angles = np.append(degrees, degrees[0] + 360)
    closed = np.append(values, values[0])
    steps = np.diff(angles)
    secants = np.diff(closed) / steps
    before = np.roll(secants, 1)
    with np.errstate(divide="ignore", invalid="ignore"):
        harmonic = 2 * before * secants / (before + secants)
    slopes = np.where(before * secants > 0, harmonic, 0.0)
    after = np.roll(slopes, -1)
    part = np.linspace(0, 1, _BETWEEN, endpoint=False)[:, np.newaxis]
    depths = (
        (1 + 2 * part) * (1 - part) ** 2 * closed[:-1]
        + part * (1 - part) ** 2 * steps * slopes
        + part**2 * (3 - 2 * part) * closed[1:]
        + part**2 * (part - 1) * steps * after
    )
    places = angles[:-1] + part * steps
    return list(zip(places.T.ravel().tolist(), depths.T.ravel().tolist(), strict=True))


def _hole(pen: Pen, centre: Point, radius: float, degrees: float) -> None:
    """Oil channel at the circle, its axis and the angle from the vertical."""
    angle, deep = -math.radians(degrees), radius * 0.30

    def at(distance: float, side: float) -> Point:
        return polar(polar(centre, distance, angle), 4.2 * side, angle + math.pi / 2)

    pen.shape([at(deep, 1), at(radius, 1), at(radius, -1), at(deep, -1)], fill="#ffffff", width=0)
    pen.line([at(radius, 1), at(deep, 1), at(deep, -1), at(radius, -1)], 1.3)
    pen.line([centre, at(radius + 10, 0)], THIN, CENTRE)
    turn = degrees % 360
    if turn > 1:
        arc, end = radius * 0.24, -math.radians(turn)
        pen.arc(centre, arc, 0.0, end, arrow=True)
        pen.text(polar(centre, arc + 14, end / 2), f"{fixed(turn, 0)}°", SMALL)


def _scale(pen: Pen, place: Point, factor: float, largest: float) -> None:
    """A bar of round length in the scale of the diagram."""
    ticks = value_ticks(0.0, largest, count=2)
    text, length = f"{ticks.texts[1]} МПа", ticks.places[1] * factor
    wide = text_size(text, FONT_SIZE)[0]
    start, y = place[0] - (length + 6 + wide) / 2, place[1]
    for x in (start, start + length):
        pen.line([(x, y - 3), (x, y + 3)], THIN)
    pen.line([(start, y), (start + length, y)], THIN)
    pen.text((start + length + 6 + wide / 2, y), text)
