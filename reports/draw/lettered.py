"""A canvas whose dimensions bear letters instead of numbers, and hatched sections."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise, product

from reports.draw.canvas import (
    CONTOUR,
    SIZES,
    THIN,
    Canvas,
    Circle,
    Item,
    Line,
    Point,
    Words,
    interrupted,
)
from reports.draw.fonts import width_of

Ends = tuple[float, float]
Spots = tuple[Point, ...]
# All in heights of the letters.
_SHORT = 3.4  # a shorter dimension has its heads outside
_TAIL = 2.2  # of a dimension whose heads are outside, beyond each end
_BEYOND = 0.6  # of a leader beyond its dimension
_ASIDE = 0.6  # of a letter from its line
_STEP = 1.1  # between the lines of a hatch
_SHARES = (0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8)
_SLENDER = replace(CONTOUR, width=0.5)  # of a small drawing, ГОСТ 2.303
_RINGS, _TURNS = 12, 16  # around a dimension, where its letter looks for room at last


@dataclass
class LetteredCanvas(Canvas):
    """Contours and dimensions by the keys of sizes; letters find room when all else stands.

    Thin straight lines and axes give way to a letter; contours and lines of the layer of sizes,
    such as breaks, keep it away.

    Attributes:
        names: letters by the keys of sizes; what has none is not measured.
        letters: height of the letters [mm].
    """

    names: Mapping[str, str] = field(default_factory=dict)
    letters: float = 2.5
    _waiting: list[tuple[str, Point, Spots]] = field(default_factory=list)

    def across(
        self, key: str, y: float, ends: Ends, feet: float | None = None, side: int = 1
    ) -> None:
        """Measure two abscissae on a level; the letter stands above or, -1, below its line."""
        self._measure(key, y, ends, feet, side, is_upright=False)

    def down(
        self, key: str, x: float, ends: Ends, feet: float | None = None, side: int = 1
    ) -> None:
        """Measure two ordinates; the letter stands to the right of its line or, -1, to the left."""
        self._measure(key, x, ends, feet, side, is_upright=True)

    def ray(self, key: str, start: Point, tip: Point, beyond: float) -> None:
        """Measure a radius whose line goes on to its letter."""
        if key not in self.names:
            return
        length = math.dist(start, tip)
        unit = ((tip[0] - start[0]) / length, (tip[1] - start[1]) / length)
        end = (tip[0] + beyond * unit[0], tip[1] + beyond * unit[1])
        self.line(start, end, layer=SIZES)
        self._pointed(key, tip, unit, end)

    def leader(self, key: str, start: Point, tip: Point) -> None:
        """Point from a letter at what it measures."""
        if key not in self.names:
            return
        length = math.dist(start, tip)
        unit = ((tip[0] - start[0]) / length, (tip[1] - start[1]) / length)
        self.line(start, tip, layer=SIZES)
        self._pointed(key, tip, unit, start)

    def _pointed(self, key: str, tip: Point, unit: Point, end: Point) -> None:
        h, wide = self.letters, width_of(self.names[key], self.letters) / 2
        self.arrow(tip, unit, h)
        side = math.copysign(1.0, end[0] - tip[0])
        spots = [(end[0] + side * (wide + 0.4 * h), end[1] + up * h) for up in (-0.5, 0.3, -1.3)]
        self._waiting.append((key, end, tuple(spots)))

    def _measure(
        self, key: str, at: float, ends: Ends, feet: float | None, side: int, *, is_upright: bool
    ) -> None:
        if key not in self.names:
            return

        def point_at(along: float, aside: float) -> Point:
            return (aside, along) if is_upright else (along, aside)

        h, (low, high) = self.letters, sorted(ends)
        if feet is not None:
            beyond = at + math.copysign(_BEYOND * h, at - feet)
            for end in (low, high):
                self.line(point_at(end, feet), point_at(end, beyond), layer=THIN)
        is_short = high - low < _SHORT * h
        tail = _TAIL * h if is_short else 0.0
        self.line(point_at(low - tail, at), point_at(high + tail, at), layer=SIZES)
        outwards = -1.0 if is_short else 1.0
        for end, way in ((low, -outwards), (high, outwards)):
            self.arrow(point_at(end, at), point_at(way, 0.0), h)
        wide = width_of(self.names[key], h)
        spots = (_beside if is_upright else _over)(low, high, at, side, wide, h, is_short)
        self._waiting.append((key, point_at((low + high) / 2, at), tuple(spots)))

    def hatch(self, *rings: Sequence[Point], lean: int = 1) -> None:
        """Lines at 45° within closed polygons, of which inner ones are holes."""
        step = _STEP * self.letters
        turned = [[((x - lean * y) / math.sqrt(2), (lean * x + y) / math.sqrt(2)) for x, y in ring]
                  for ring in rings]  # fmt: skip
        across = [u for ring in turned for u, _ in ring]
        for number in range(math.ceil(min(across) / step), math.ceil(max(across) / step)):
            u = number * step + 1e-7  # through no corner
            cuts = sorted(
                v + (u - a) / (b - a) * (w - v)
                for ring in turned
                for (a, v), (b, w) in pairwise([*ring, ring[0]])
                if (a < u) != (b < u)
            )
            for first, last in zip(cuts[::2], cuts[1::2], strict=True):
                ends = (((u + lean * v) / math.sqrt(2), (v - lean * u) / math.sqrt(2))
                        for v in (first, last))  # fmt: skip
                self.line(*ends, layer=THIN)

    def lettered(self) -> list[Item]:
        """Place the letters and return all that is drawn."""
        lines: list[Item] = [item for item in self.items if isinstance(item, Line | Circle)]
        solid = Canvas(
            [line for line in lines if isinstance(line, Circle) or line.layer in (CONTOUR, SIZES)]
        )
        placed = Canvas()
        for key, middle, spots in self._waiting:
            words = [self._letter(key, spot) for spot in spots]
            free = next((w for w in words if placed.free(w) and solid.clear(w)), None)
            if free is None:
                leader, free = self._led(key, middle, placed, solid)
                solid.items += leader
                lines += leader
            placed.items.append(free)
        self._waiting.clear()
        return [
            replace(item, layer=_SLENDER)
            if isinstance(item, Line | Circle) and item.layer is CONTOUR else item
            for item in interrupted([*lines, *placed.items])
        ]  # fmt: skip

    def _letter(self, key: str, spot: Point) -> Words:
        return Words(spot, self.names[key], self.letters, align=0.5, name=key)

    def _led(
        self, key: str, middle: Point, placed: Canvas, solid: Canvas
    ) -> tuple[list[Item], Words]:
        """Return a letter with its leader where there is room around a dimension."""
        h = self.letters
        for ring, turn in product(range(2, _RINGS), range(_TURNS)):
            angle = 2 * math.pi * turn / _TURNS
            cos, sin = math.cos(angle), math.sin(angle)
            x, y = middle[0] + ring * h * cos, middle[1] + ring * h * sin
            words = self._letter(key, (x, y - h / 2))
            reach = words.width / 2 * abs(cos) + 0.8 * h
            leader: list[Item] = [Line((middle, (x - reach * cos, y - reach * sin)), SIZES)]
            drawn = Canvas(leader)
            others = (item for item in placed.items if isinstance(item, Words))
            if placed.free(words) and solid.clear(words) and all(map(drawn.clear, others)):
                return leader, words
        return [], self._letter(key, middle)


def _over(
    low: float, high: float, y: float, side: int, wide: float, h: float, is_short: bool
) -> list[Point]:
    """Places of the letter of a level dimension, the middle of its foot."""
    levels = [0.5 * h, -1.6 * h][::side]
    if not is_short:
        return [(low + s * (high - low), y + up) for up in levels for s in _SHARES]
    near, far = 0.7 * h + wide / 2, (_TAIL + 0.4) * h + wide / 2
    ends = [x for n in range(3) for x in (high + near + 0.7 * n * h, low - near - 0.7 * n * h)]
    return [*((x, y + up) for up in levels for x in ends),
            (high + far, y - 0.5 * h), (low - far, y - 0.5 * h)]  # fmt: skip


def _beside(
    low: float, high: float, x: float, side: int, wide: float, h: float, is_short: bool
) -> list[Point]:
    """Places of the letter of an upright dimension, the middle of its foot."""
    sides = (side * (_ASIDE * h + wide / 2), -side * (_ASIDE * h + wide / 2))
    if not is_short:
        return [(x + aside, low + s * (high - low) - h / 2) for aside in sides for s in _SHARES]
    levels = (high + 0.9 * h, low - 1.9 * h)
    return [*((x + aside, y) for aside in sides for y in levels),
            (x, high + (_TAIL + 0.4) * h), (x, low - (_TAIL + 1.5) * h)]  # fmt: skip
