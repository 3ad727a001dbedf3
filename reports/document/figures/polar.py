"""Polar diagrams: paths of a force's end, wear of a journal."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from kshm.nomenclature.quantity import roman
from reports.document.figures.axes import Axes, Ticks, at_steps, bounds, value_ticks
from reports.document.figures.canvas import (
    CENTRE,
    FONT_SIZE,
    GRID,
    HAIR,
    PAGE_WIDTH,
    PATTERNS,
    SMALL,
    THIN,
    Pen,
    Point,
    Sheet,
    polar,
)
from reports.document.figures.curves import LEGEND_ROW, legend
from reports.document.figures.labels import (
    Box,
    LabelField,
    Place,
    Points,
    dense,
    label_point,
    text_size,
)
from reports.draw.writers import PT_PER_MM
from reports.shared.russian import fixed

_PRIORITIES = (90.0, 60.0, 30.0, 20.0, 10.0, 5.0, 1.0)
_LABEL = 8.5
_IN_ROW = 2  # names of a legend
Sides = tuple[bool, bool]  # positive x to the left, positive y downwards
_DEPTH = 0.62  # part of the radius that the greatest sum takes
_FILL = "#d6d6d6"
_BETWEEN = 12  # points of the smooth curve to a ray


@dataclass(frozen=True, slots=True)
class Pole:
    r"""A point the vector is measured from: its name (``$O_{\mathrm{ш}}$``) and place."""

    name: str
    x: float = 0.0
    y: float = 0.0


@dataclass(frozen=True, slots=True)
class Loop:
    """A closed line with a name (``$…$`` for symbols)."""

    name: str
    x: ArrayLike
    y: ArrayLike


def polar_path(
    x: ArrayLike,
    y: ArrayLike,
    angles: ArrayLike,
    titles: tuple[str, str],
    *,
    reverse: Sides = (False, False),
    poles: Sequence[Pole] = (Pole("$O$"),),
    named: Sequence[Loop] = (),
    most: float = 150.0,
    least_step: float = 10.0,
    marked: ArrayLike | None = None,
) -> str:
    """Path of a vector's end in equal scales, through its points and no others, as SVG.

    Args:
        x: Horizontal component, shape (n,).
        y: Vertical component, shape (n,).
        angles: Crank angles of the points [deg], shape (n,).
        titles: Names and units of the two components.
        reverse: Positive x to the left, positive y downwards.
        named: The path itself with its name and other lines in the same axes, for a legend.
        poles: Points from which the vector is measured.
        most: Greatest width and height of the field [mm].
        least_step: Finest division of angles to label [deg]; one of what is counted, as cylinders.
        marked: Angles of the points that get a dot and may get a label, else all [deg].

    Raises:
        ValueError: Shapes differ or a value is not finite.
    """
    columns = [np.asarray(values, dtype=np.float64) for values in (x, y, angles)]
    xs, ys, degrees = columns
    if xs.ndim != 1 or len({column.shape for column in columns}) > 1:
        msg = f"Полярная диаграмма: длины {xs.shape}, {ys.shape}, {degrees.shape} не равны"
        raise ValueError(msg)
    x_ticks, y_ticks = _equal_ticks(
        bounds(
            [
                xs.tolist(),
                [pole.x for pole in poles],
                *(np.asarray(loop.x).tolist() for loop in named),
            ]
        ),
        bounds(
            [
                ys.tolist(),
                [pole.y for pole in poles],
                *(np.asarray(loop.y).tolist() for loop in named),
            ]
        ),
    )
    spans = (x_ticks.high - x_ticks.low, y_ticks.high - y_ticks.low)
    side = y_ticks.width() + 10
    name = text_size(titles[0], FONT_SIZE)[0] + 24
    widest = min(most * PT_PER_MM, PAGE_WIDTH * PT_PER_MM - side - name)
    scale = min(widest / spans[0], most * PT_PER_MM / spans[1])
    width, height = spans[0] * scale, spans[1] * scale
    left, right = (name, side) if reverse[0] else (side, name)
    low, high = (26.0, 18.0) if reverse[1] else (18.0, 26.0)
    legends = LEGEND_ROW * math.ceil(len(named) / _IN_ROW)
    high += legends
    page = Sheet((left + width + right) / PT_PER_MM, (low + height + high) / PT_PER_MM)
    field = (left, low, left + width, low + height)
    axes = Axes(page, field, x_ticks, y_ticks, reverse)
    axes.dress(pads=(6, 4), edges=(GRID, GRID), zeros=True)
    pen = Pen(page, layer=10)
    path = axes.at(xs, ys)
    room = LabelField((left + 1, low + 1, left + width - 1, low + height - 1), [dense(path)])
    pen.line(path.tolist(), 1.3)
    for number, loop in enumerate(named[1:], 1):
        page.line(axes.at(loop.x, loop.y).tolist(), PATTERNS[number % len(PATTERNS)], 10)
    if named:
        legend(axes, [loop.name for loop in named], in_row=_IN_ROW, above=high - legends)
    _ends(pen, axes.at(0.0, 0.0), field, reverse, titles)
    for pole in poles:
        _pole(pen, room, axes.at(pole.x, pole.y), pole.name, reverse)
    rows = _rows(degrees, marked)
    for row in rows.tolist() if marked is not None else ():
        pen.circle(tuple(path[row].tolist()), 0.8, fill="#000000", width=0)
    _angles(pen, room, path, degrees, (rows, least_step))
    return page.svg()


def _equal_ticks(*ranges: tuple[float, float]) -> list[Ticks]:
    """Return marks of both axes with one step, zero included."""
    whole = [(min(low, 0.0), max(high, 0.0)) for low, high in ranges]
    marks = value_ticks(0.0, max(high - low for low, high in whole) or 1.0, count=9).places
    step = marks[1] - marks[0]
    result = []
    for low, high in whole:
        first = math.floor(low / step + 1e-9)
        last = max(math.ceil(high / step - 1e-9), first + 2)
        result.append(at_steps(first, last - first + 1, step))
    return result


def _ends(
    pen: Pen, origin: NDArray[np.float64], field: Box, reverse: Sides, titles: tuple[str, str]
) -> None:
    """Arrows at the positive ends of both axes with their names."""
    left, low, right, high = field
    x_out, y_out = (-1 if item else 1 for item in reverse)
    x_tip = ((left if reverse[0] else right) + 12 * x_out, float(origin[1]))
    y_tip = (float(origin[0]), (low if reverse[1] else high) + 12 * y_out)
    pen.arrow((x_tip[0] - 14 * x_out, x_tip[1]), x_tip, THIN, 6)
    pen.arrow((y_tip[0], y_tip[1] - 14 * y_out), y_tip, THIN, 6)
    wide, tall = (text_size(title, FONT_SIZE)[0] / 2 for title in titles)
    pen.text((x_tip[0] + x_out * (wide + 4), x_tip[1] + 1), titles[0])
    # Right of the axis, but left of one that stands at the figure's right edge.
    aside = tall + 7 if y_tip[0] + 2 * tall + 7 < pen.page.width else -tall - 7
    pen.text((y_tip[0] + aside, y_tip[1] + y_out * 4), titles[1])


def _pole(pen: Pen, room: LabelField, pole: NDArray[np.float64], name: str, reverse: Sides) -> None:
    x, y = pole.tolist()
    pen.circle((x, y), 2.6, fill="#ffffff", width=0.9)
    pen.circle((x, y), 0.8, fill="#000000", width=0)
    room.take((x - 3.5, y - 3.5, x + 3.5, y + 3.5))
    first = (1.0 if reverse[0] else -1.0, -0.7)
    spot = label_point(room, (x, y), text_size(name, FONT_SIZE), first=first)
    if spot:
        pen.text(spot, name)


def _rows(degrees: NDArray[np.float64], marked: ArrayLike | None) -> NDArray[np.intp]:
    """Numbers of the points at the marked angles, of all without them."""
    if marked is None:
        return np.arange(degrees.size)
    distances = np.abs(degrees[:, None] - np.asarray(marked, dtype=np.float64))
    return np.flatnonzero(distances.min(axis=1) < 1e-6)


def _angles(
    pen: Pen,
    room: LabelField,
    path: Points,
    degrees: NDArray[np.float64],
    labelled: tuple[NDArray[np.intp], float],
) -> None:
    """Label as many points as there is room for, the round angles and the farthest first."""
    centre = path.mean(axis=0)
    seen: list[Place] = []
    for index, least in _order(path, degrees, *labelled):
        point = (float(path[index, 0]), float(path[index, 1]))
        if any(math.dist(point, other) < least for other in seen):
            continue
        along = path[min(len(path) - 1, index + 1)] - path[max(0, index - 1)]
        normal = np.array([along[1], -along[0]])
        outwards = -1.0 if normal @ (path[index] - centre) < 0 else 1.0
        first = (float(normal[0]) * outwards, float(normal[1]) * outwards)
        text = fixed(float(degrees[index]), 0)
        if index == 0 and math.dist(path[0], path[-1]) < 0.6:  # the closing point carries both
            text += f", {fixed(float(degrees[-1]), 0)}"
        spot = label_point(room, point, text_size(text, _LABEL), first=first, gaps=(2.5, 4.5, 7.0))
        if spot is not None:
            seen.append(point)
            pen.circle(point, 1.3, fill="#000000", width=0)
            pen.text(spot, text, _LABEL)


def _order(
    path: Points, degrees: NDArray[np.float64], rows: NDArray[np.intp], least_step: float
) -> list[tuple[int, float]]:
    """Points in order of priority of labels, with the clearance of each [pt]."""
    far = int(rows[np.hypot(*(path[rows] - path.mean(axis=0)).T).argmax()])
    order = {far: 0.0}
    for step in (step for step in _PRIORITIES if step >= least_step):
        multiples = np.flatnonzero(np.abs(np.remainder(degrees + step / 2, step) - step / 2) < 1e-6)
        for index in np.intersect1d(multiples, rows).tolist():
            order.setdefault(index, 14.0 if step >= 30 else 24.0)
    return list(order.items())


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
    radius = size * PT_PER_MM / 2 - 34
    above, below = 30 + (13 if top else 0), 52
    page = Sheet(size, (2 * radius + above + below) / PT_PER_MM)
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
    angles_of = angles[:-1] + part * steps
    return list(zip(angles_of.T.ravel().tolist(), depths.T.ravel().tolist(), strict=True))


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


def _scale(pen: Pen, corner: Point, factor: float, largest: float) -> None:
    """Draw a bar of round length in the scale of the diagram."""
    ticks = value_ticks(0.0, largest, count=2)
    text, length = f"{ticks.texts[1]} МПа", ticks.places[1] * factor
    wide = text_size(text, FONT_SIZE)[0]
    start, y = corner[0] - (length + 6 + wide) / 2, corner[1]
    for x in (start, start + length):
        pen.line([(x, y - 3), (x, y + 3)], THIN)
    pen.line([(start, y), (start + length, y)], THIN)
    pen.text((start + length + 6 + wide / 2, y), text)
