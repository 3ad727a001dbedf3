"""Line drawing in points: what schemes and diagrams are made of."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence

from reports.document.figures.labels import text_size
from reports.document.figures.sheet import Sheet
from reports.document.figures.style import FONT_SIZE, Look

Point = tuple[float, float]
Dash = tuple[float, ...]
THICK, THIN, HAIR = 2.2, 0.9, 0.6
CENTRE: Dash = (10, 2.5, 1.5, 2.5)  # centre line
DASHED: Dash = (4, 2.5)


class Pen:
    """Draws on a sheet in points from its lower left corner."""

    def __init__(self, page: Sheet, layer: float = 0.0) -> None:
        self.page, self.layer = page, layer

    def line(
        self,
        points: Sequence[Sequence[float]],
        width: float = THIN,
        dash: Dash = (),
        colour: str = "#000000",
    ) -> None:
        """Polyline through points."""
        self.page.line(points, Look(width, dash, colour), self.layer + 2)

    def shape(
        self,
        points: Sequence[Point],
        *,
        fill: str = "none",
        width: float = THIN,
        order: float = 3,
    ) -> None:
        """Closed polygon; one of a lower order lies under the others."""
        self.page.shape(points, fill, _edge(width), self.layer + order)

    def circle(
        self,
        centre: Point,
        radius: float,
        *,
        fill: str = "none",
        width: float = THIN,
        order: float | None = None,
    ) -> None:
        """Circle; a filled one lies above lines."""
        above = (2 if fill == "none" else 4) if order is None else order
        self.page.circle(centre, radius, fill, _edge(width), self.layer + above)

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
        self.line([tail, shifted(tip, along, -0.7 * head)], width)
        self._head(tip, along, head)

    def measure(self, start: Point, end: Point) -> None:
        """Dimension line with heads at both ends."""
        self.line([start, end], HAIR)
        self._head(end, direction(start, end), 5.5)
        self._head(start, direction(end, start), 5.5)

    def text(self, place: Point, text: str, size: float = FONT_SIZE, *, halo: bool = True) -> None:
        """Text centred at a place, on white unless ``halo`` is off."""
        self.page.text(place, text, size, halo=halo, layer=self.layer + 3)

    def throws(
        self,
        centre: Point,
        radius: float,
        angles: Sequence[float],
        size: float,
        *,
        lean: float = 0,
        names: Sequence[str] = (),
    ) -> None:
        """Cranks from the nose [deg]: a thick ray for each direction, its names at the end."""
        self.circle(centre, radius, width=HAIR)
        for angle, members in by_direction(angles, names):
            ray = math.radians(angle + lean)
            end, name = polar(centre, radius, ray), ", ".join(members)
            self.line([centre, end], THICK)
            self.circle(end, 3.1, fill="#ffffff", width=1.2)
            wide = text_size(name, size)[0] / 2
            self.text(
                polar(centre, radius + 0.9 * size + abs(math.sin(ray)) * wide, ray), name, size
            )
        self.circle(centre, 2.5, fill="#ffffff", width=1.2)

    def _head(self, tip: Point, along: Point, length: float) -> None:
        back = shifted(tip, along, -length)
        across = (-along[1], along[0])
        sides = [shifted(back, across, share * length) for share in (0.2, -0.2)]
        self.shape([tip, *sides], fill="#000000", width=0)


def _edge(width: float) -> Look | None:
    """The outline of a shape."""
    return Look(width, cap="butt", miter=True) if width else None


def polar(centre: Point, radius: float, angle: float) -> Point:
    """Point at an angle clockwise from the vertical [rad]."""
    return (centre[0] + radius * math.sin(angle), centre[1] + radius * math.cos(angle))


def direction(start: Point, end: Point) -> Point:
    """Unit vector from one point to another."""
    norm = math.dist(start, end) or 1.0
    return ((end[0] - start[0]) / norm, (end[1] - start[1]) / norm)


def shifted(point: Point, along: Point, distance: float) -> Point:
    """Point moved along a unit vector."""
    return (point[0] + along[0] * distance, point[1] + along[1] * distance)


def by_direction(
    angles: Sequence[float], names: Sequence[str] = ()
) -> Iterator[tuple[float, list[str]]]:
    """Each direction [deg] with the names, otherwise the numbers, of those that share it."""
    numbered = sorted((round(angle % 360, 6) % 360, n) for n, angle in enumerate(angles))
    for angle, members in itertools.groupby(numbered, key=lambda pair: pair[0]):
        yield angle, [names[n] if names else str(n + 1) for _, n in members]
