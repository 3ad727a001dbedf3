"""Line drawing in points: what schemes and diagrams are made of."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from reports.document.figures.axes import put
from reports.document.figures.style import FONT_SIZE, Sheet

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.patches import Patch

Point = tuple[float, float]
Dash = str | tuple[int, tuple[float, ...]]
THICK, THIN, HAIR = 2.2, 0.9, 0.6
CENTRE: Dash = (0, (10, 2.5, 1.5, 2.5))  # centre line
DASHED: Dash = (0, (4, 2.5))


class Pen:
    """Draws on a sheet in points from its lower left corner."""

    def __init__(self, page: Sheet) -> None:
        self.axes: Axes = page.plane()

    def line(
        self,
        points: Sequence[Point],
        width: float = THIN,
        dash: Dash = "-",
        colour: str = "#000000",
    ) -> None:
        """Polyline through points."""
        xs, ys = zip(*points, strict=True)
        self.axes.plot(xs, ys, color=colour, linewidth=width, linestyle=dash, clip_on=False)

    def shape(self, points: Sequence[Point], *, fill: str = "none", width: float = THIN) -> None:
        """Closed polygon."""
        from matplotlib.patches import Polygon

        edge = "#000000" if width else "none"
        self._add(
            Polygon(points, closed=True, facecolor=fill, edgecolor=edge, linewidth=width, zorder=3)
        )

    def circle(
        self,
        centre: Point,
        radius: float,
        *,
        fill: str = "none",
        width: float = THIN,
        dash: Dash = "-",
    ) -> None:
        """Circle."""
        from matplotlib.patches import Circle

        self._add(
            Circle(
                centre,
                radius,
                facecolor=fill,
                edgecolor="#000000" if width else "none",
                linewidth=width,
                linestyle=dash,
                zorder=4 if fill != "none" else 2,
            )
        )

    def arc(
        self, centre: Point, radius: float, start: float, end: float, *, arrow: bool = False
    ) -> None:
        """Arc from one angle to another, both clockwise from the vertical [rad]."""
        count = max(8, int(abs(end - start) * radius / 2))
        angles = [start + (end - start) * index / count for index in range(count + 1)]
        points = [polar(centre, radius, angle) for angle in angles]
        self.line(points, HAIR)
        if arrow and abs(end - start) * radius > 6:
            self._head(points[-1], direction(points[-4], points[-1]), 5.5)

    def arrow(self, tail: Point, tip: Point, width: float = 1.2, head: float = 8.0) -> None:
        """Straight arrow."""
        along = direction(tail, tip)
        self.line([tail, (tip[0] - along[0] * head * 0.7, tip[1] - along[1] * head * 0.7)], width)
        self._head(tip, along, head)

    def measure(self, start: Point, end: Point) -> None:
        """Dimension line with heads at both ends."""
        along = direction(start, end)
        self.line([start, end], HAIR)
        self._head(end, along, 5.5)
        self._head(start, (-along[0], -along[1]), 5.5)

    def text(self, place: Point, text: str, size: float = FONT_SIZE, *, halo: bool = True) -> None:
        """Text centred at a place, on white unless ``halo`` is off."""
        put(self.axes, place, text, size, halo=halo)

    def _head(self, tip: Point, along: Point, length: float) -> None:
        side = length * 0.2
        back = (tip[0] - along[0] * length, tip[1] - along[1] * length)
        across = (-along[1] * side, along[0] * side)
        left = (back[0] + across[0], back[1] + across[1])
        right = (back[0] - across[0], back[1] - across[1])
        self.shape([tip, left, right], fill="#000000", width=0)

    def _add(self, patch: Patch) -> None:
        self.axes.add_patch(patch)
        patch.set_clip_on(False)


def polar(centre: Point, radius: float, angle: float) -> Point:
    """Point at an angle clockwise from the vertical [rad]."""
    return (centre[0] + radius * math.sin(angle), centre[1] + radius * math.cos(angle))


def direction(start: Point, end: Point) -> Point:
    """Unit vector from one point to another."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    norm = math.hypot(dx, dy) or 1.0
    return (dx / norm, dy / norm)
