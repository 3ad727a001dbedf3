"""Polar diagrams: the path of a force vector with crank angles marked along it."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reports.document.figures import axes as ax
from reports.document.figures.labels import Room, dense, label_point, text_size
from reports.document.figures.pen import THIN, Pen, Point
from reports.document.figures.style import FONT_SIZE, GRID, MM, PAGE_WIDTH, sheet
from reports.shared.russian import fixed

Values = NDArray[np.float64]
_PRIORITIES = (90.0, 60.0, 30.0, 20.0, 10.0, 5.0)
_LABEL = 8.5


@dataclass(frozen=True, slots=True)
class Pole:
    r"""A pole of the diagram: its name (``$O_{\mathrm{ш}}$``) and place in the diagram's units."""

    label: str
    x: float = 0.0
    y: float = 0.0


def polar_path(
    x: ArrayLike,
    y: ArrayLike,
    angles: ArrayLike,
    x_label: str,
    y_label: str,
    *,
    invert: tuple[bool, bool] = (False, False),
    poles: Sequence[Pole] = (Pole("$O$"),),
    most: float = 150.0,
    least_step: float = 10.0,
) -> str:
    """Path of a vector's end in equal scales, not smoothed, as SVG.

    Args:
        x: Horizontal component, shape (n,).
        y: Vertical component, shape (n,).
        angles: Crank angles of the points [deg], shape (n,).
        x_label: Name and unit of the horizontal component.
        y_label: Name and unit of the vertical component.
        invert: Positive x to the left, positive y downwards.
        poles: Points from which the vector is measured.
        most: Greatest width and height of the field [mm].
        least_step: Finest division of angles to label [deg].

    Raises:
        ValueError: Shapes differ or a value is not finite.
    """
    xs, ys = np.asarray(x, dtype=np.float64), np.asarray(y, dtype=np.float64)
    degrees = np.asarray(angles, dtype=np.float64)
    if xs.shape != ys.shape or xs.shape != degrees.shape or xs.ndim != 1:
        msg = f"Полярная диаграмма: длины {xs.shape}, {ys.shape}, {degrees.shape} не равны"
        raise ValueError(msg)
    x_ticks, y_ticks = _equal_ticks(
        ax.bounds([xs, [pole.x for pole in poles]]), ax.bounds([ys, [pole.y for pole in poles]])
    )
    spans = (x_ticks.high - x_ticks.low, y_ticks.high - y_ticks.low)
    side = y_ticks.width() + 10
    name = max(text_size(x_label, FONT_SIZE)[0] + 24, 24.0)
    widest = min(most * MM, PAGE_WIDTH * MM - side - name)
    scale = min(widest / spans[0], most * MM / spans[1])
    width, height = spans[0] * scale, spans[1] * scale
    left, right = (name, side) if invert[0] else (side, name)
    low, high = (26.0, 18.0) if invert[1] else (18.0, 26.0)
    with sheet((left + width + right) / MM, (low + height + high) / MM) as page:
        axes = page.axes(left, low, width, height)
        ax.dress(axes, x_ticks, y_ticks, invert=invert, zero_lines=(True, True))
        axes.spines["left"].set(**GRID)
        axes.spines["bottom"].set(**GRID)
        if invert[0]:
            axes.yaxis.tick_right()
        if invert[1]:
            axes.xaxis.tick_top()
        axes.tick_params(axis="x", length=0, pad=6)
        axes.tick_params(axis="y", length=0, pad=4)
        pen = Pen(page)

        def place(px: float, py: float) -> Point:
            across = x_ticks.high - px if invert[0] else px - x_ticks.low
            up = y_ticks.high - py if invert[1] else py - y_ticks.low
            return (left + across * scale, low + up * scale)

        room = Room((left + 1, low + 1, left + width - 1, low + height - 1))
        path = np.array([place(px, py) for px, py in zip(xs.tolist(), ys.tolist(), strict=True)])
        room.curves.append(dense(path))
        pen.line([(float(a), float(b)) for a, b in path], 1.3)
        _ends(pen, place, (left, low, width, height), invert, x_label, y_label)
        for pole in poles:
            _pole(pen, room, place(pole.x, pole.y), pole.label, invert)
        _angles(pen, room, path, degrees, least_step)
        return page.svg()


def _equal_ticks(
    x_range: tuple[float, float], y_range: tuple[float, float]
) -> tuple[ax.Ticks, ax.Ticks]:
    """Marks of both axes with one step, zero included."""
    spans = [max(high, 0.0) - min(low, 0.0) for low, high in (x_range, y_range)]
    count = 9
    step_source = ax.value_ticks(0.0, max(spans) or 1.0, count=count)
    step = step_source.places[1] - step_source.places[0]
    found = []
    for low, high in (x_range, y_range):
        first = math.floor(min(low, 0.0) / step + 1e-9)
        last = max(math.ceil(max(high, 0.0) / step - 1e-9), first + 2)
        places = tuple(index * step for index in range(first, last + 1))
        digits = next(d for d in range(8) if math.isclose(round(step, d), step, rel_tol=1e-6))
        found.append(ax.Ticks(places, tuple(fixed(place, digits) for place in places)))
    return found[0], found[1]


def _ends(
    pen: Pen,
    place: Callable[[float, float], Point],
    field: tuple[float, float, float, float],
    invert: tuple[bool, bool],
    x_label: str,
    y_label: str,
) -> None:
    """Arrows at the positive ends of both axes with their names."""
    left, low, width, height = field
    origin = place(0.0, 0.0)
    x_out, y_out = (-1 if invert[0] else 1), (-1 if invert[1] else 1)
    x_tip = (left - 12 if invert[0] else left + width + 12, origin[1])
    y_tip = (origin[0], low - 12 if invert[1] else low + height + 12)
    pen.arrow((x_tip[0] - 14 * x_out, x_tip[1]), x_tip, THIN, 6)
    pen.arrow((y_tip[0], y_tip[1] - 14 * y_out), y_tip, THIN, 6)
    wide = text_size(x_label, FONT_SIZE)[0]
    pen.text((x_tip[0] + x_out * (wide / 2 + 4), x_tip[1] + 1), x_label)
    wide = text_size(y_label, FONT_SIZE)[0]
    pen.text((y_tip[0] + (wide / 2 + 7), y_tip[1] + y_out * 4), y_label)


def _pole(pen: Pen, room: Room, at: Point, label: str, invert: tuple[bool, bool]) -> None:
    pen.circle(at, 2.6, fill="#ffffff", width=0.9)
    pen.circle(at, 0.8, fill="#000000", width=0)
    room.boxes.append((at[0] - 3.5, at[1] - 3.5, at[0] + 3.5, at[1] + 3.5))
    first = (1.0 if invert[0] else -1.0, -0.7)
    spot = label_point(room, at, text_size(label, FONT_SIZE), first=first)
    if spot:
        pen.text(spot, label)


def _angles(pen: Pen, room: Room, path: Values, degrees: Values, least_step: float) -> None:
    """Label as many points as there is room for, the round angles and the farthest first."""
    centre = path.mean(axis=0)
    seen: list[Point] = []
    for index, least in _order(path, degrees, least_step):
        point = (float(path[index, 0]), float(path[index, 1]))
        if any(math.hypot(point[0] - px, point[1] - py) < least for px, py in seen):
            continue
        around = path[max(0, index - 1)], path[min(len(path) - 1, index + 1)]
        normal = (float(around[1][1] - around[0][1]), float(around[0][0] - around[1][0]))
        if normal[0] * (point[0] - centre[0]) + normal[1] * (point[1] - centre[1]) < 0:
            normal = (-normal[0], -normal[1])
        text = _text(index, path, degrees)
        spot = label_point(room, point, text_size(text, _LABEL), first=normal, gaps=(2.5, 4.5, 7.0))
        if spot is not None:
            seen.append(point)
            pen.circle(point, 1.3, fill="#000000", width=0)
            pen.text(spot, text, _LABEL)


def _order(path: Values, degrees: Values, least_step: float) -> list[tuple[int, float]]:
    """Points in the order of their right to a label, with the distance each must keep [pt]."""
    steps = [step for step in _PRIORITIES if step >= least_step]
    far = int(np.hypot(*(path - path.mean(axis=0)).T).argmax())
    order = {far: 0.0}
    for step in steps:
        multiples = np.flatnonzero(np.abs(np.remainder(degrees + step / 2, step) - step / 2) < 1e-6)
        for index in multiples.tolist():
            order.setdefault(index, 14.0 if step >= 30 else 24.0)
    return list(order.items())


def _text(index: int, path: Values, degrees: Values) -> str:
    """The angle; the closing point carries both (0 and 720)."""
    text = fixed(float(degrees[index]), 0)
    if index == 0 and np.hypot(*(path[0] - path[-1])) < 0.6:
        text += f", {fixed(float(degrees[-1]), 0)}"
    return text
