"""Scheme of the whole engine: rows of cylinders, throws and the order of the power strokes."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence

from reports.document.figures.labels import text_size
from reports.document.figures.pen import CENTRE, DASHED, HAIR, THICK, Pen, Point, polar
from reports.document.figures.style import FONT_SIZE, MM, SMALL, sheet

_GREY = "#e4e4e4"
_ROW = 17.0


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
    with sheet(width, max(184.0, bars + 14) / MM) as page:
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
    pen.circle(centre, radius, width=HAIR)
    numbered = sorted((round(axis + lean, 6), n) for n, axis in enumerate(axes, 1))
    for axis, members in itertools.groupby(numbered, key=lambda pair: pair[0]):
        angle = math.radians(axis)
        pen.line([centre, polar(centre, far + 8, angle)], HAIR, CENTRE)
        corners = []
        for distance, side in ((near, -1), (near, 1), (far, 1), (far, -1)):
            base = polar(centre, distance, angle)
            corners.append(polar(base, side * 15.0, angle + math.pi / 2))
        pen.shape(corners, fill=_GREY, width=1.2)
        names = [str(number) for _, number in members]
        text = ", ".join(names) if len(names) <= 3 else f"{names[0]}–{names[-1]}"
        pen.text(polar(centre, (near + far) / 2, angle), text, SMALL, halo=False)
    spread = sorted({round(angle % 360, 6) % 360 for angle in throw_angles})
    for angle in spread:
        ray = math.radians(angle + lean)
        end = polar(centre, radius, ray)
        pen.line([centre, end], THICK)
        pen.circle(end, 3.0, fill="#ffffff", width=1.2)
        names = [
            str(n)
            for n, other in enumerate(throw_angles, 1)
            if abs(math.remainder(other - angle, 360.0)) < 1e-3
        ]
        name = ", ".join(names)
        wide = text_size(name, SMALL)[0]
        pen.text(polar(centre, radius + 9 + abs(math.sin(ray)) * wide / 2, ray), name, SMALL)
    pen.circle(centre, 2.4, fill="#ffffff", width=1.2)
    pen.arc(centre, radius + 18, math.radians(150), math.radians(205), arrow=True)
    pen.text(polar(centre, radius + 27, math.radians(178)), r"$\omega$", SMALL)


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
