"""Placing of texts in a figure: how large they are, and where they hit nothing."""

from __future__ import annotations

import functools
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from reports.document.text.texts import raised
from reports.document.text.texwords import for_mathtext

Points = NDArray[np.float64]


@functools.lru_cache(maxsize=2048)
def text_size(text: str, size: float) -> tuple[float, float]:
    """Width and height of a text in STIX [pt]; ``$…$`` is set as mathtext."""
    from matplotlib.font_manager import FontProperties
    from matplotlib.textpath import text_to_path

    font = FontProperties(family="STIXGeneral", size=size, math_fontfamily="stix")
    written = shown(text)
    width, height, _ = text_to_path.get_text_width_height_descent(written, font, "$" in written)
    return float(width), float(height)


@functools.lru_cache(maxsize=2048)
def shown(text: str) -> str:
    """A label in matplotlib's words: TeX between dollars translated, «⁻¹» as a superscript."""
    parts = text.split("$")
    if len(parts) % 2 == 0:
        msg = f"Непарный знак $ в подписи рисунка: {text!r}"
        raise ValueError(msg)
    return "".join(
        f"${for_mathtext(part, level_primes=True)}$" if index % 2 else raised(part)
        for index, part in enumerate(parts)
    )


@dataclass(slots=True)
class Room:
    """What is taken already: points of curves and boxes of texts, all in points of the sheet."""

    limits: tuple[float, float, float, float]
    curves: list[Points] = field(default_factory=list)
    boxes: list[tuple[float, float, float, float]] = field(default_factory=list)

    def free(self, box: tuple[float, float, float, float], *, gap: float = 1.0) -> bool:
        """Whether a box (left, bottom, right, top) lies inside and touches nothing."""
        left, bottom, right, top = box
        if (
            left < self.limits[0]
            or bottom < self.limits[1]
            or right > self.limits[2]
            or top > self.limits[3]
        ):
            return False
        for other in self.boxes:
            if (
                left < other[2] + gap
                and right > other[0] - gap
                and bottom < other[3] + gap
                and top > other[1] - gap
            ):
                return False
        return all(not _hits(curve, box, gap) for curve in self.curves)

    def take(self, box: tuple[float, float, float, float]) -> None:
        """Mark a box as used."""
        self.boxes.append(box)

    def clearance(self, box: tuple[float, float, float, float], curves: Iterable[Points]) -> float:
        """Distance from a box to the nearest point of some curves [pt]."""
        best = float("inf")
        for curve in curves:
            dx = np.maximum(np.maximum(box[0] - curve[:, 0], curve[:, 0] - box[2]), 0)
            dy = np.maximum(np.maximum(box[1] - curve[:, 1], curve[:, 1] - box[3]), 0)
            best = min(best, float(np.hypot(dx, dy).min()))
        return best


def _hits(curve: Points, box: tuple[float, float, float, float], gap: float) -> bool:
    x, y = curve[:, 0], curve[:, 1]
    inside = (x > box[0] - gap) & (x < box[2] + gap) & (y > box[1] - gap) & (y < box[3] + gap)
    return bool(inside.any())


def dense(points: Points, spacing: float = 2.0) -> Points:
    """Points along a polyline not farther apart than ``spacing`` [pt], shape (n, 2)."""
    steps = np.hypot(*np.diff(points, axis=0).T)
    length = np.concatenate([[0.0], np.cumsum(steps)])
    if length[-1] == 0:
        return points[:1]
    places = np.linspace(0, length[-1], max(2, int(length[-1] / spacing) + 1))
    return np.column_stack([np.interp(places, length, points[:, axis]) for axis in (0, 1)])


def box_at(
    point: Sequence[float], size: tuple[float, float], direction: tuple[float, float], gap: float
) -> tuple[float, float, float, float]:
    """Box of a text set off from a point in a direction so that it clears it by ``gap``."""
    width, height = size
    norm = max(abs(direction[0]), abs(direction[1])) or 1.0
    x = point[0] + direction[0] / norm * (width / 2 + gap)
    y = point[1] + direction[1] / norm * (height / 2 + gap)
    return (x - width / 2, y - height / 2, x + width / 2, y + height / 2)


def label_curve(
    room: Room, own: Points, others: Sequence[Points], size: tuple[float, float]
) -> tuple[float, float] | None:
    """Centre for the name of a curve: beside it, clear of everything, far from the others."""
    best: tuple[float, tuple[float, float, float, float]] | None = None
    tangent = np.gradient(own, axis=0)
    for share in np.linspace(0.04, 0.96, 60):
        index = int(share * (len(own) - 1))
        normal = (-float(tangent[index, 1]), float(tangent[index, 0]))
        for sign in (1.0, -1.0):
            box = box_at(own[index], size, (sign * normal[0], sign * normal[1]), 3.0)
            if not room.free(box, gap=1.5):
                continue
            score = min(room.clearance(box, others), 40.0) - 6 * abs(share - 0.5)
            if best is None or score > best[0]:
                best = (score, box)
    if best is None or best[0] < -2.0:
        return None
    room.take(best[1])
    return ((best[1][0] + best[1][2]) / 2, (best[1][1] + best[1][3]) / 2)


def label_point(
    room: Room,
    point: tuple[float, float],
    size: tuple[float, float],
    *,
    first: tuple[float, float] = (1.0, 1.0),
    gaps: Sequence[float] = (2.5, 5.0, 9.0, 14.0, 20.0),
) -> tuple[float, float] | None:
    """Centre for the name of a point, as near as there is room, ``None`` if there is none.

    Args:
        room: What is taken; the label's box is added to it.
        point: The point [pt].
        size: Width and height of the text [pt].
        first: Direction to try first; others turn away from it to both sides.
        gaps: Distances to try [pt].
    """
    start = float(np.arctan2(first[1], first[0]))
    turns = (0.0, 0.5, -0.5, 1.0, -1.0, 1.6, -1.6, 2.2, -2.2, 3.1)
    for gap in gaps:
        for turn in turns:
            direction = (float(np.cos(start + turn)), float(np.sin(start + turn)))
            box = box_at(point, size, direction, gap)
            if room.free(box):
                room.take(box)
                return ((box[0] + box[2]) / 2, (box[1] + box[3]) / 2)
    return None
