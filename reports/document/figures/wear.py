"""Conditional wear diagram of a journal by rays, to scale, with the oil hole."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reports.document.figures.axes import value_ticks
from reports.document.figures.labels import text_size
from reports.document.figures.pen import CENTRE, HAIR, THIN, Pen, Point, polar
from reports.document.figures.style import FONT_SIZE, MM, SMALL, sheet
from reports.shared.russian import fixed

_DEPTH = 0.62  # part of the radius that the greatest sum takes
_FILL = "#d6d6d6"


def wear_diagram(
    sums: ArrayLike,
    ray_angles: ArrayLike,
    hole_angle: float | None,
    *,
    unit: str = "МПа",
    clockwise: bool = True,
    size: float = 112.0,
    top_label: str = "",
) -> str:
    r"""Wear laid off from the circle of the journal inwards, as SVG.

    Args:
        sums: Sum of the forces of each ray, shape (n,), not negative.
        ray_angles: Angles of the rays from the upward direction [deg], shape (n,), rising.
        hole_angle: Angle of the oil hole [deg] like the rays', ``None`` leaves it out.
        unit: Unit of the sums.
        clockwise: Angles count clockwise (else against the clock).
        size: Width of the figure [mm].
        top_label: What the upward direction is, e.g. «к щеке», written above.

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
    turn = 1.0 if clockwise else -1.0
    rays = np.radians(degrees) * turn
    radius = size * MM / 2 - 34
    above, below = 30 + (13 if top_label else 0), 52
    with sheet(size, (2 * radius + above + below) / MM) as page:
        pen = Pen(page)
        centre = (page.width / 2, page.height - radius - above)
        factor = _DEPTH * radius / (float(values.max()) or 1.0)
        outline = _outline(values, degrees)
        curve = [
            polar(centre, radius - depth * factor, math.radians(angle) * turn)
            for angle, depth in outline
        ]
        _shade(pen, centre, radius, curve)
        for number, (ray, value) in enumerate(zip(rays.tolist(), values.tolist(), strict=True), 1):
            pen.line([centre, polar(centre, radius + 8, ray)], HAIR, CENTRE)
            pen.text(polar(centre, radius + 19, ray), roman(number))
            pen.circle(polar(centre, radius - value * factor, ray), 1.6, fill="#000000", width=0)
        pen.circle(centre, radius, width=1.6)
        if hole_angle is not None:
            _hole(pen, centre, radius, hole_angle, turn)
        if top_label:
            pen.text((centre[0], centre[1] + radius + 33), top_label, SMALL)
        _scale(pen, (centre[0], 12.0), factor, float(values.max()), unit)
        return page.svg()


def roman(number: int) -> str:
    """Roman numeral of a small number.

    Raises:
        ValueError: Outside 1 … 39.
    """
    if not 1 <= number <= 39:
        msg = f"Нет римской цифры для луча {number}"
        raise ValueError(msg)
    tens, ones = divmod(number, 10)
    return "X" * tens + ("", "I", "II", "III", "IV", "V", "VI", "VII", "VIII", "IX")[ones]


def _outline(
    values: NDArray[np.float64], degrees: NDArray[np.float64]
) -> list[tuple[float, float]]:
    """Smooth closed curve through the ends, which never overshoots them (monotone cubic)."""
    angles = np.append(degrees, degrees[0] + 360)
    closed = np.append(values, values[0])
    secants = np.diff(closed) / np.diff(angles)
    before = np.roll(secants, 1)
    with np.errstate(divide="ignore", invalid="ignore"):
        harmonic = 2 * before * secants / (before + secants)
    slopes = np.where(before * secants > 0, harmonic, 0.0)
    slopes = np.append(slopes, slopes[0])
    result = []
    for index, step in enumerate(np.diff(angles).tolist()):
        for part in np.linspace(0, 1, 12, endpoint=False).tolist():
            depth = (
                (1 + 2 * part) * (1 - part) ** 2 * closed[index]
                + part * (1 - part) ** 2 * step * slopes[index]
                + part**2 * (3 - 2 * part) * closed[index + 1]
                + part**2 * (part - 1) * step * slopes[index + 1]
            )
            result.append((float(angles[index] + part * step), float(depth)))
    return result


def _shade(pen: Pen, centre: Point, radius: float, curve: Sequence[Point]) -> None:
    pen.circle(centre, radius, fill=_FILL, width=0)
    # The disc lies below; the polygon takes its inside out again.
    pen.axes.patches[-1].set_zorder(0.5)
    pen.shape(curve, fill="#ffffff", width=1.3)
    pen.axes.patches[-1].set_zorder(0.6)


def _hole(pen: Pen, centre: Point, radius: float, degrees: float, turn: float) -> None:
    """Oil channel at the circle, its axis and the angle from the vertical."""
    angle = math.radians(degrees) * turn
    along = (math.sin(angle), math.cos(angle))
    across = (along[1] * 4.2, -along[0] * 4.2)

    def at(distance: float, side: float) -> Point:
        return (
            centre[0] + along[0] * distance + across[0] * side,
            centre[1] + along[1] * distance + across[1] * side,
        )

    deep = radius * 0.30
    pen.shape([at(deep, 1), at(radius, 1), at(radius, -1), at(deep, -1)], fill="#ffffff", width=0)
    for side in (1, -1):
        pen.line([at(deep, side), at(radius, side)], 1.3)
    pen.line([at(deep, 1), at(deep, -1)], 1.3)
    pen.line([centre, at(radius + 10, 0)], THIN, CENTRE)
    shorter = (degrees + 180) % 360 - 180
    if abs(shorter) > 1:
        arc, end = radius * 0.24, math.radians(shorter) * turn
        pen.arc(centre, arc, 0.0, end, arrow=True)
        pen.text(polar(centre, arc + 14, end / 2), f"{fixed(abs(shorter), 0)}°", SMALL)


def _scale(pen: Pen, place: Point, factor: float, largest: float, unit: str) -> None:
    """A bar of round length in the scale of the diagram."""
    ticks = value_ticks(0.0, largest or 1.0, count=2)
    step = ticks.places[1]
    text = f"{ticks.texts[1]} {unit}"
    length, wide = step * factor, text_size(text, FONT_SIZE)[0]
    start = place[0] - (length + 6 + wide) / 2
    for x in (start, start + length):
        pen.line([(x, place[1] - 3), (x, place[1] + 3)], THIN)
    pen.line([(start, place[1]), (start + length, place[1])], THIN)
    pen.text((start + length + 6 + wide / 2, place[1]), text)
