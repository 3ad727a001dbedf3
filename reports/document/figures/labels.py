"""Placement of labels in a figure: sizes and free places."""

from __future__ import annotations

import functools
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from reports.document.text.tex import for_mathtext
from reports.document.text.texts import raised
from reports.draw.fonts import ASCENT, DESCENT, text_box

Points = NDArray[np.float64]
Box = tuple[float, float, float, float]  # left, bottom, right, top [pt]
Place = tuple[float, float]


_WORD = 8.0  # names of two curves side by side are not read as one [pt]
_SCALE = 100.0  # pt at which texts are measured


def text_size(text: str, size: float) -> tuple[float, float]:
    """Width and height of a text in STIX [pt]; ``$…$`` is set as mathtext."""
    width, height, _ = _measured(shown(text))
    return width * size, height * size


def line_box(words: str, size: float) -> tuple[float, float, float]:
    """Width of a line in mathtext's words, its height above and below the baseline [pt]."""
    width, height, depth = _measured(words)
    return width * size, max(height - depth, ASCENT) * size, max(depth, DESCENT) * size


@functools.lru_cache(maxsize=2048)
def _measured(words: str) -> tuple[float, float, float]:
    """Width, height and depth of a text [em]."""
    if "$" in words:
        from reports.document.text.mathtext import read

        parsed = read(words, _SCALE)
        return parsed.width / _SCALE, parsed.height / _SCALE, parsed.depth / _SCALE
    return text_box(words)


@functools.lru_cache(maxsize=2048)
def shown(text: str) -> str:
    """Return a label in mathtext: TeX between dollars translated, «⁻¹» as a superscript."""
    parts = text.split("$")
    if len(parts) % 2 == 0:
        msg = f"Непарный знак $ в подписи рисунка: {text!r}"
        raise ValueError(msg)
    return "".join(
        f"${for_mathtext(part, level_primes=True)}$" if index % 2 else raised(part)
        for index, part in enumerate(parts)
    )


@dataclass(slots=True)
class LabelField:
    """Occupied places of a figure: points of curves and boxes of texts [pt]."""

    limits: Box
    curves: list[Points] = field(default_factory=list)
    boxes: list[Box] = field(default_factory=list)

    def free(self, box: Box, *, gap: float = 1.0, aside: float = 0.0) -> bool:
        """Whether a box lies inside and touches nothing; ``aside`` keeps off texts of its line."""
        left, bottom, right, top = self.limits
        if box[0] < left or box[1] < bottom or box[2] > right or box[3] > top:
            return False
        wide = (box[0] - gap, box[1] - gap, box[2] + gap, box[3] + gap)
        wider = (wide[0] - aside, wide[1], wide[2] + aside, wide[3])
        return not any(_overlap(wider, other) for other in self.boxes) and not any(
            _hits(curve, wide) for curve in self.curves
        )

    def clearance(self, box: Box, curves: Iterable[Points]) -> float:
        """Distance from a box to the nearest point of some curves [pt]."""
        best = float("inf")
        for curve in curves:
            dx = np.maximum(np.maximum(box[0] - curve[:, 0], curve[:, 0] - box[2]), 0)
            dy = np.maximum(np.maximum(box[1] - curve[:, 1], curve[:, 1] - box[3]), 0)
            best = min(best, float(np.hypot(dx, dy).min()))
        return best

    def take(self, box: Box) -> Place:
        """Mark a box as used; its centre."""
        self.boxes.append(box)
        return ((box[0] + box[2]) / 2, (box[1] + box[3]) / 2)


def _overlap(one: Box, other: Box) -> bool:
    return (
        one[0] < other[2] and one[2] > other[0] and one[1] < other[3] and one[3] > other[1]
    )  # fmt: skip


def _hits(curve: Points, box: Box) -> bool:
    x, y = curve[:, 0], curve[:, 1]
    return bool(((x > box[0]) & (x < box[2]) & (y > box[1]) & (y < box[3])).any())


def dense(points: Points, spacing: float = 2.0) -> Points:
    """Points along a polyline not farther apart than ``spacing`` [pt], shape (n, 2)."""
    length = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    if length[-1] == 0:
        return points[:1]
    distances = np.linspace(0, length[-1], max(2, int(length[-1] / spacing) + 1))
    return np.column_stack([np.interp(distances, length, points[:, axis]) for axis in (0, 1)])


def box_at(point: Sequence[float], size: Place, direction: Place, gap: float) -> Box:
    """Box of a text set off from a point in a direction so that it clears it by ``gap``."""
    width, height = size
    norm = max(abs(direction[0]), abs(direction[1])) or 1.0
    x = point[0] + direction[0] / norm * (width / 2 + gap)
    y = point[1] + direction[1] / norm * (height / 2 + gap)
    return (x - width / 2, y - height / 2, x + width / 2, y + height / 2)


def label_curve(
    room: LabelField, points: Points, others: Sequence[Points], size: Place
) -> Place | None:
    """Centre for the name of a curve: beside it, clear of everything, far from the others."""
    best: tuple[float, Box] | None = None
    tangent = np.gradient(points, axis=0)
    for share in np.linspace(0.04, 0.96, 60):
        index = int(share * (len(points) - 1))
        normal = (-float(tangent[index, 1]), float(tangent[index, 0]))
        for sign in (1.0, -1.0):
            box = box_at(points[index], size, (sign * normal[0], sign * normal[1]), 3.0)
            if not room.free(box, gap=1.5, aside=_WORD):
                continue
            score = min(room.clearance(box, others), 40.0) - 6 * abs(share - 0.5)
            if best is None or score > best[0]:
                best = (score, box)
    return None if best is None or best[0] < -2.0 else room.take(best[1])


def label_point(
    room: LabelField,
    point: Place,
    size: Place,
    *,
    first: Place = (1.0, 1.0),
    gaps: Sequence[float] = (2.5, 5.0, 9.0, 14.0, 20.0),
) -> Place | None:
    """Centre for the name of a point, as near as there is room, ``None`` if there is none.

    Args:
        room: What is taken; the label's box is added to it.
        point: The point [pt].
        size: Width and height of the text [pt].
        first: Direction to try first; others turn away from it to both sides.
        gaps: Distances to try [pt].
    """
    start = float(np.arctan2(first[1], first[0]))
    for gap in gaps:
        for turn in (0.0, 0.5, -0.5, 1.0, -1.0, 1.6, -1.6, 2.2, -2.2, 3.1):
            direction = (float(np.cos(start + turn)), float(np.sin(start + turn)))
            box = box_at(point, size, direction, gap)
            if room.free(box):
                return room.take(box)
    return None
