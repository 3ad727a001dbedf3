"""Scheme of the whole engine: rows of cylinders, throws and the order of the power strokes."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence

from reports.document.figures.labels import text_size
from reports.document.figures.pen import CENTRE, DASHED, HAIR, THICK, Pen, Point, polar
from reports.document.figures.sheet import Sheet
from reports.document.figures.style import FONT_SIZE, MM, SMALL

_GREY = "#e4e4e4"
_ROW = 17.0
_CLEAR = 20.0  # between a letter beside the axis of the shaft and a ray [deg]
_HALF = 15.0  # of a cylinder's width


def engine_scheme(
    axes: Sequence[float],
    throws: Sequence[int],
    throw_angles: Sequence[float],
    offsets: Sequence[float],
    period: float,
    *,
    width: float = 165.0,
) -> str:
    """Engine from the nose and its power strokes over the cycle, as SVG.

    Args:
        axes: Angle of each cylinder's axis from that of cylinder 1 [deg], clockwise.
        throws: Number of each cylinder's throw.
        throw_angles: Angle of each throw from the first [deg], clockwise.
        offsets: Start of each cylinder's power stroke [deg].
        period: Length of the cycle [deg].
        width: Width of the figure [mm].

    Raises:
        ValueError: No cylinders, or lists of different lengths.
    """
    if not axes or not len(axes) == len(throws) == len(offsets):
        msg = "Схема двигателя: нет цилиндров или списки разной длины"
        raise ValueError(msg)
    bars = len(axes) * _ROW + 34
    page = Sheet(width, max(184.0, bars + 14) / MM)
    pen = Pen(page)
    half = page.width * 0.42
    # Banks stand symmetrically: the axis of cylinder 1 leans to the left.
    lean = -max(math.remainder(axis, 360.0) % 360 for axis in axes) / 2
    _front(pen, (half / 2, page.height * 0.42), axes, throw_angles, lean)
    _strokes(pen, (half + 30, page.height / 2), page.width - half - 40, offsets, throws, period)
    return page.svg()


def _front(
    pen: Pen, centre: Point, axes: Sequence[float], throw_angles: Sequence[float], lean: float
) -> None:
    """Rows of cylinders and throws seen from the nose with crank 1 along cylinder 1."""
    radius, near, far = 26.0, 52.0, 88.0
    half = _half_width(axes, near)
    numbered = sorted((round(axis + lean, 6), n) for n, axis in enumerate(axes, 1))
    for axis, members in itertools.groupby(numbered, key=lambda pair: pair[0]):
        angle = math.radians(axis)
        pen.line([centre, polar(centre, far + 8, angle)], HAIR, CENTRE)
        corners = []
        for distance, side in ((near, -1), (near, 1), (far, 1), (far, -1)):
            base = polar(centre, distance, angle)
            corners.append(polar(base, side * half, angle + math.pi / 2))
        pen.shape(corners, fill=_GREY, width=1.2)
        names = [str(number) for _, number in members]
        text = ", ".join(names) if len(names) <= 3 else f"{names[0]}–{names[-1]}"
        place = polar(centre, (near + far) / 2, angle)
        if half < _HALF:  # beside a narrow cylinder, on its free side
            aside = half + text_size(text, SMALL)[0] / 2 + 5
            place = polar(place, math.copysign(aside, axis), angle + math.pi / 2)
        pen.text(place, text, SMALL, halo=False)
    pen.throws(centre, radius, throw_angles, SMALL, lean=lean)
    pen.arc(centre, radius + 18, math.radians(150), math.radians(205), arrow=True)
    pen.text(polar(centre, radius + 27, math.radians(178)), r"$\omega$", SMALL)


def _half_width(axes: Sequence[float], near: float) -> float:
    """Half the width of a cylinder that leaves its neighbours free at their nearest."""
    turns = sorted({round(math.remainder(axis, 360.0), 6) for axis in axes})
    gap = min((b - a for a, b in itertools.pairwise(turns)), default=180.0)
    return min(_HALF, 0.9 * near * math.tan(math.radians(gap) / 2))


def _strokes(
    pen: Pen,
    left: Point,
    length: float,
    offsets: Sequence[float],
    throws: Sequence[int],
    period: float,
) -> None:
    """Power strokes of the cylinders, a row for each, over the angle of the shaft."""
    rows = len(offsets)
    top = left[1] + rows * _ROW / 2
    bottom = top - rows * _ROW
    for mark in range(0, round(period) + 1, 180 if period > 360 else 90):
        x = left[0] + length * mark / period
        pen.line([(x, bottom - 4), (x, top)], HAIR, DASHED)
        pen.text((x, bottom - 12), f"{mark}°", SMALL)
    for row, (offset, throw) in enumerate(zip(offsets, throws, strict=True)):
        middle = top - (row + 0.5) * _ROW
        pen.text((left[0] - 14, middle), f"{row + 1} ({throw})", SMALL)
        for start, end in _parts(offset % period, min(180.0, period / 2), period):
            first, last = (left[0] + length * angle / period for angle in (start, end))
            low, high = middle - 5, middle + 5
            corners = [(first, low), (last, low), (last, high), (first, high)]
            pen.shape(corners, fill=_GREY, width=1.0)
    pen.line([(left[0], bottom), (left[0] + length, bottom)], HAIR)
    pen.text((left[0] + length / 2, top + 9), r"$\varphi$", FONT_SIZE)


def _parts(start: float, length: float, period: float) -> list[tuple[float, float]]:
    """A stroke within the cycle; one that passes its end goes on at its beginning."""
    end = start + length
    if end <= period:
        return [(start, end)]
    return [(start, period), (0.0, end - period)]


def crank_scheme(throw_angles: Sequence[float], *, split: float = 0.0, width: float = 150.0) -> str:
    """Throws of the shaft from the side and from the nose, as SVG.

    Args:
        throw_angles: Angle γ of each throw from the first [deg], clockwise seen from the nose.
        split: Angle from the left half of every pin to its right half [deg], 0 for common pins.
        width: Width of the figure [mm].

    Raises:
        ValueError: No throws.
    """
    if not throw_angles:
        msg = "Схема вала: нет ни одного колена"
        raise ValueError(msg)
    radius, star = 40.0, 34.0
    page = Sheet(width, (2 * radius + 62) / MM)
    pen = Pen(page)
    level = page.height / 2 + 4
    right = page.width - star - 34
    _side_view(pen, (12.0, level), right - star - 42, radius, throw_angles, split)
    _star_view(pen, (right, level), star, throw_angles, split)
    return page.svg()


def _side_view(
    pen: Pen, start: Point, length: float, radius: float, throw_angles: Sequence[float],
    split: float,
) -> None:  # fmt: skip
    """Broken line of the shaft: journals on the axis, pins at r·cos γ above or below it."""
    (x, y), count = start, len(throw_angles)
    pitch = (length - 16) / count
    journal, web = pitch * 0.30, pitch * 0.10
    pen.line([(x - 6, y), (x + length + 6, y)], HAIR, CENTRE)
    points: list[Point] = [(x, y), (x + 8 + journal / 2, y)]
    for number, angle in enumerate(throw_angles, 1):
        left = x + 8 + (number - 1) * pitch + journal / 2
        height, other = (y + radius * math.cos(math.radians(a)) for a in (angle, angle + split))
        inner = (left + web, left + pitch - journal - web)
        middle = (inner[0] + inner[1]) / 2
        halves = [(middle, height), (middle, other)] if split else []
        points += [(left, y), (inner[0], height), *halves, (inner[1], other)]
        points += [(left + pitch - journal, y), (left + pitch - journal / 2, y)]
        height = max(height, other, key=lambda place: abs(place - y))
        above = 10 if height >= y else -10
        pen.text((middle, height + above), str(number))
    points[-1] = (x + length, y)
    pen.line(points, THICK)
    size = min(5.0, journal * 0.35)
    for number in range(count + 1):
        centre = x + 8 + number * pitch
        for side in (-1, 1):
            pen.line([(centre - size, y + side * 4), (centre + size, y + side * 4)], 1.4)


def _star_view(
    pen: Pen, centre: Point, radius: float, throw_angles: Sequence[float], split: float
) -> None:
    """Directions of the throws seen from the nose; throws of one direction share a ray."""
    for dx, dy in ((radius + 8, 0.0), (0.0, radius + 8)):
        ends = [(centre[0] - dx, centre[1] - dy), (centre[0] + dx, centre[1] + dy)]
        pen.line(ends, HAIR, CENTRE)
    rays = list(throw_angles)
    if split:
        rays += [angle + split for angle in throw_angles]
        names = [f"{n}{half}" for half in "лп" for n in range(1, len(throw_angles) + 1)]
        pen.throws(centre, radius, rays, SMALL, names=names)
    else:
        pen.throws(centre, radius, rays, FONT_SIZE)
    turn = _free_direction(rays)
    pen.arc(centre, radius * 0.5, math.radians(turn - 25), math.radians(turn + 25), arrow=True)
    pen.text(polar(centre, radius * 0.5 + 9, math.radians(turn)), r"$\omega$")


def _free_direction(rays: Sequence[float]) -> float:
    """Where a letter between the rays hides none [deg]: at 45°, else amid the widest gap."""
    turns = sorted({round(ray % 360, 6) % 360 for ray in rays})
    if all(abs(math.remainder(ray - 45, 360)) > _CLEAR for ray in turns):
        return 45.0
    gaps = [(after - ray, ray) for ray, after in itertools.pairwise([*turns, turns[0] + 360])]
    width, start = max(gaps)
    return start + width / 2
