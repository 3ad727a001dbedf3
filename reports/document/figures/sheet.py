"""A sheet to draw on in points from its lower left corner, written as one SVG element.

Few elements without identifiers or ``style``: many figures stand in one page, where each element
costs time and identifiers would clash.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reports.document.figures.labels import line_box, shown
from reports.document.figures.style import FONT_SIZE, HALO, MM, Look
from reports.document.text.fonts import FAMILY, OF_DRAWINGS
from reports.document.text.mathsvg import texts_of

_CURVE = 0.5522847498  # of the radius: handles of a quarter of a circle


class Sheet:
    """Elements in the order of their layers: a higher one covers a lower one.

    Args:
        width: Width [mm].
        height: Height [mm].
    """

    def __init__(self, width: float, height: float) -> None:
        self.width, self.height = width * MM, height * MM
        self._elements: list[tuple[float, str]] = []

    def line(self, points: ArrayLike, look: Look, layer: float = 2) -> None:
        """A polyline."""
        self.lines([points], look, layer)

    def lines(self, lines: Iterable[ArrayLike], look: Look, layer: float = 2) -> None:
        """Several polylines as one element."""
        data = "".join(self._path(points) for points in lines)
        self._add(layer, f'<path d="{data}" fill="none"{look.svg}/>')

    def shape(
        self, points: Sequence[Sequence[float]], fill: str, look: Look | None, layer: float = 3
    ) -> None:
        """A closed polygon."""
        self._filled(f'<path d="{self._path(points)}z"', fill, look, layer)

    def circle(
        self, centre: tuple[float, float], radius: float, fill: str, look: Look | None, layer: float
    ) -> None:
        """A circle, as four curves."""
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
        place: tuple[float, float],
        text: str,
        size: float = FONT_SIZE,
        *,
        align: float = 0.5,
        middle: bool = True,
        halo: bool = False,
        layer: float = 3,
    ) -> None:
        """A text; ``$…$`` is set as a formula.

        Args:
            place: Where it stands [pt].
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
        left, y = place[0] - align * width, self.height - place[1]
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
        """The sheet as an SVG element for HTML, the same bytes each time."""
        body = "".join(element for _, element in sorted(self._elements, key=lambda item: item[0]))
        box = f"{_n(self.width)} {_n(self.height)}"
        return (
            f'<svg class="fig" xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {box}" '
            f'style="width:{self.width / MM:.1f}mm" '
            f'data-size="{self.width:.4g}/{self.height:.4g}" '
            f'font-family="{OF_DRAWINGS}" stroke-linejoin="round">'
            f"{body}</svg>"
        )

    def _add(self, layer: float, element: str) -> None:
        self._elements.append((layer, element))

    def _filled(self, begin: str, fill: str, look: Look | None, layer: float) -> None:
        self._add(layer, f'{begin} fill="{fill}"{look.svg if look else ""}/>')

    def _down(self, points: ArrayLike) -> NDArray[np.float64]:
        """Places from the upper left corner."""
        return np.asarray(points, dtype=np.float64) * (1.0, -1.0) + (0.0, self.height)

    def _path(self, points: ArrayLike) -> str:
        places = np.round(self._down(points), 2) + 0.0  # no negative zeros
        return "M" + "L".join(f"{x:g} {y:g}" for x, y in places.tolist())


def _n(value: float) -> str:
    return f"{round(value, 2) + 0.0:g}"
