"""A canvas in points from its lower left corner, written as one SVG element.

Few elements without identifiers or ``style``: many figures stand in one page, where each element
costs time and identifiers would clash.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from html import escape

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reports.document.figures.labels import line_box, shown, text_size
from reports.document.text.mathsvg import texts_of
from reports.draw.fonts import FAMILY
from reports.draw.writers import PT_PER_MM, svg_element

PAGE_WIDTH = 165.0  # mm of text width
FONT_SIZE = 11.0  # pt
SMALL = 9.5
HALO = 0.55  # pt of white around a text
_CURVE = 0.5522847498  # of the radius: handles of a quarter of a circle
Point = tuple[float, float]
Dash = tuple[float, ...]
THICK, THIN, HAIR = 2.2, 0.9, 0.6
CENTRE: Dash = (10, 2.5, 1.5, 2.5)  # centre line
DASHED: Dash = (4, 2.5)


@dataclass(frozen=True, slots=True)
class LineStyle:
    """How a line is drawn: width [pt], dashes and gaps [pt], colour, ends, joints."""

    width: float = 0.9
    dash: tuple[float, ...] = ()
    colour: str = "#000000"
    cap: str = ""  # by default square, butt where dashed
    miter: bool = False

    @property
    def svg(self) -> str:
        """Attributes of an element."""
        cap = self.cap or ("" if self.dash else "square")
        dashes = ",".join(f"{part:g}" for part in self.dash)
        return (
            (f' stroke-dasharray="{dashes}"' if dashes else "")
            + f' stroke="{self.colour}" stroke-width="{self.width:g}"'
            + (' stroke-linejoin="miter"' if self.miter else "")
            + (f' stroke-linecap="{cap}"' if cap else "")
        )


# Patterns are told apart without colour; widths help where dashes are short.
PATTERNS = (
    LineStyle(1.5),
    LineStyle(1.3, (7, 2.2)),
    LineStyle(1.3, (7, 2, 1.3, 2)),
    LineStyle(1.6, (1.3, 1.7)),
    LineStyle(1.2, (11, 2, 3, 2)),
    LineStyle(1.2, (3, 1.6)),
    LineStyle(2.4, colour="#8a8a8a"),
    LineStyle(1.2, (7, 1.6, 1.3, 1.6, 1.3, 1.6)),
)
GRID = LineStyle(0.45, colour="#c4c4c4")
AXIS = LineStyle(0.8)
EDGE = LineStyle(0.8, miter=True)


class Sheet:
    """Elements in the order of their layers: a higher one covers a lower one.

    Args:
        width: Width [mm].
        height: Height [mm].
    """

    def __init__(self, width: float, height: float) -> None:
        self.width, self.height = width * PT_PER_MM, height * PT_PER_MM
        self._elements: list[tuple[float, str]] = []

    def line(self, points: ArrayLike, look: LineStyle, layer: float = 2) -> None:
        """Draw a polyline."""
        self.lines([points], look, layer)

    def lines(self, lines: Iterable[ArrayLike], look: LineStyle, layer: float = 2) -> None:
        """Several polylines as one element."""
        data = "".join(self._path(points) for points in lines)
        self._add(layer, f'<path d="{data}" fill="none"{look.svg}/>')

    def shape(
        self, points: Sequence[Sequence[float]], fill: str, look: LineStyle | None, layer: float = 3
    ) -> None:
        """Draw a closed polygon."""
        self._filled(f'<path d="{self._path(points)}z"', fill, look, layer)

    def circle(
        self,
        centre: tuple[float, float],
        radius: float,
        fill: str,
        look: LineStyle | None,
        layer: float,
    ) -> None:
        """Draw a circle, as four curves."""
        ((x, y),) = self._down([centre]).tolist()
        r, h = radius, _CURVE * radius
        data = (
            f"M{_n(x)} {_n(y + r)}C{_n(x + h)} {_n(y + r)} {_n(x + r)} {_n(y + h)} {_n(x + r)} "
            f"{_n(y)}C{_n(x + r)} {_n(y - h)} {_n(x + h)} {_n(y - r)} {_n(x)} {_n(y - r)}"
            f"C{_n(x - h)} {_n(y - r)} {_n(x - r)} {_n(y - h)} {_n(x - r)} {_n(y)}"
            f"C{_n(x - r)} {_n(y + h)} {_n(x - h)} {_n(y + r)} {_n(x)} {_n(y + r)}z"
        )
        self._filled(f'<path d="{data}"', fill, look, layer)

    def text(
        self,
        at: tuple[float, float],
        text: str,
        size: float = FONT_SIZE,
        *,
        align: float = 0.5,
        middle: bool = True,
        halo: bool = False,
        layer: float = 3,
    ) -> None:
        """Draw a text; ``$…$`` is set as a formula.

        Args:
            at: Where it stands [pt].
            text: The text.
            size: Of the type [pt].
            align: Share of the text left of the place.
            middle: Half of the text stands above the place, otherwise all of it.
            halo: White below the text.
            layer: Order among other elements.
        """
        words = shown(text)
        width, above, below = line_box(words, size)
        # Not text-anchor, for which WeasyPrint makes a drawing of its own.
        left, y = at[0] - align * width, self.height - at[1]
        if middle:
            y += (above - below) / 2
        if halo:
            box = (left - HALO, y - above - HALO, width + 2 * HALO, above + below + 2 * HALO)
            across, down, wide, tall = map(_n, box)
            self._add(
                layer,
                f'<rect x="{across}" y="{down}" width="{wide}" height="{tall}" fill="#ffffff"/>',
            )
        if "$" in words:
            from reports.document.text.mathtext import read

            runs = texts_of(read(words, size).glyphs, (left, y), _n, inherited=FAMILY)
            self._add(layer, "".join(runs))
            return
        self._add(
            layer,
            f'<text x="{_n(left)}" y="{_n(y)}" font-size="{size:g}">'
            f"{escape(words, quote=False)}</text>",
        )

    def svg(self) -> str:
        """Return the sheet as an SVG element for HTML, the same bytes each time."""
        body = "".join(element for _, element in sorted(self._elements, key=lambda item: item[0]))
        size = (self.width, self.height)
        return svg_element(
            body, f"{_n(self.width)} {_n(self.height)}", size, self.width / PT_PER_MM
        )

    def _add(self, layer: float, element: str) -> None:
        self._elements.append((layer, element))

    def _filled(self, begin: str, fill: str, look: LineStyle | None, layer: float) -> None:
        self._add(layer, f'{begin} fill="{fill}"{look.svg if look else ""}/>')

    def _down(self, points: ArrayLike) -> NDArray[np.float64]:
        """Places from the upper left corner."""
        return np.asarray(points, dtype=np.float64) * (1.0, -1.0) + (0.0, self.height)

    def _path(self, points: ArrayLike) -> str:
        places = np.round(self._down(points), 2) + 0.0  # no negative zeros
        return "M" + "L".join(f"{x:g} {y:g}" for x, y in places.tolist())


def _n(value: float) -> str:
    return f"{round(value, 2) + 0.0:g}"


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
        self.page.line(points, LineStyle(width, dash, colour), self.layer + 2)

    def shape(
        self,
        points: Sequence[Point],
        *,
        fill: str = "none",
        width: float = THIN,
        order: float = 3,
    ) -> None:
        """Draw closed polygon; one of a lower order lies under the others."""
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

    def text(self, at: Point, text: str, size: float = FONT_SIZE, *, halo: bool = True) -> None:
        """Text centred at a place, on white unless ``halo`` is off."""
        self.page.text(at, text, size, halo=halo, layer=self.layer + 3)

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


def _edge(width: float) -> LineStyle | None:
    """Return the outline of a shape."""
    return LineStyle(width, cap="butt", miter=True) if width else None


def polar(centre: Point, radius: float, angle: float) -> Point:
    """Point at an angle clockwise from the vertical [rad]."""
    return (centre[0] + radius * math.sin(angle), centre[1] + radius * math.cos(angle))


def direction(start: Point, end: Point) -> Point:
    """Return the unit vector from one point to another."""
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
