"""Primitives of a drawing in millimetres; where its words find room."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import pairwise

from reports.draw.fonts import width_of

Point = tuple[float, float]
Box = tuple[float, float, float, float]  # left, low, right, high
Dash = tuple[float, ...]  # strokes and gaps [mm]
DASHED: Dash = (5.0, 2.0)
CENTRE: Dash = (12.0, 2.0, 1.0, 2.0)
DOTTED: Dash = (1.5, 1.5)
_NEAR = 1e-6  # mm; what is farther from a text's box surely does not cut it
SIZE = "size"
_TRIES, _CLOSE, _LEAST = 7, 2e-3, 0.1  # of fitting: how often, how near, how much smaller at once


@dataclass(frozen=True, slots=True)
class Layer:
    """A layer: name in the drawing program, width of its lines [mm], dashes, grey or black."""

    name: str
    width: float
    dash: Dash = ()
    grey: bool = False


# Widths by ГОСТ 2.303: main lines 0.7, thin ones from a third to a half of that.
CONTOUR = Layer("Контур", 0.7)
CURVES = Layer("Кривые", 0.6)
THIN = Layer("Тонкие линии", 0.25)
AXES = Layer("Осевые", 0.25, CENTRE)
GRID = Layer("Сетка", 0.13, grey=True)
LETTERS = Layer("Надписи", 0.3)
SIZES = Layer("Размеры", 0.25)
TABLES = Layer("Таблицы", 0.4)
FRAME = Layer("Рамка", 0.8)
LAYERS = (CONTOUR, CURVES, THIN, AXES, GRID, LETTERS, SIZES, TABLES, FRAME)


@dataclass(frozen=True)
class Line:
    """A polyline; ``dash`` instead of its layer's; ``filled`` closed ones are black."""

    points: tuple[Point, ...]
    layer: Layer = THIN
    closed: bool = False
    filled: bool = False
    dash: Dash = ()
    name: str = ""  # what of the calculation it shows

    @cached_property
    def box(self) -> Box:
        """Bounds on the sheet; asked for by every text, and a curve has hundreds of points."""
        xs, ys = zip(*self.points, strict=True)
        return min(xs), min(ys), max(xs), max(ys)


@dataclass(frozen=True, slots=True)
class Circle:
    """A circle."""

    centre: Point
    radius: float
    layer: Layer = THIN
    filled: bool = False

    @property
    def box(self) -> Box:
        """Bounds on the sheet."""
        (x, y), r = self.centre, self.radius
        return x - r, y - r, x + r, y + r


@dataclass(frozen=True)
class Words:
    """A line of text: height of its capitals, share of it left of the place, turn [deg]."""

    place: Point
    text: str
    height: float = 3.5
    align: float = 0.0
    angle: float = 0.0
    layer: Layer = LETTERS
    name: str = ""  # what of the drawing it belongs to

    @cached_property
    def width(self) -> float:
        """Length of the line."""
        return width_of(self.text, self.height)

    @cached_property
    def box(self) -> Box:
        """Bounds on the sheet; asked for by every other text."""
        width = self.width
        left = -self.align * width
        corners = [(x, y) for x in (left, left + width)
                   for y in (-0.3 * self.height, 1.05 * self.height)]  # fmt: skip
        turn = math.radians(self.angle)
        cos, sin = math.cos(turn), math.sin(turn)
        xs = [self.place[0] + x * cos - y * sin for x, y in corners]
        ys = [self.place[1] + x * sin + y * cos for x, y in corners]
        return min(xs), min(ys), max(xs), max(ys)


@dataclass(frozen=True, slots=True)
class Dimension:
    """A dimension that drawing programs know as such; its lines are drawn beside it.

    The lines, heads and words of a dimension are named :data:`SIZE`; where it is written as an
    entity they are left out.
    """

    start: Point
    end: Point
    text: str
    height: float
    middle: Point  # of the words
    layer: Layer = SIZES

    @property
    def box(self) -> Box:
        """Bounds on the sheet."""
        xs, ys = zip(self.start, self.end, strict=True)
        return min(xs), min(ys), max(xs), max(ys)


Item = Line | Circle | Words | Dimension


def overlap(one: Box, other: Box) -> bool:
    """Whether two boxes cover each other."""
    return one[0] < other[2] and one[2] > other[0] and one[1] < other[3] and one[3] > other[1]


def moved(items: Iterable[Item], dx: float, dy: float, scale: float = 1.0) -> list[Item]:
    """Items shifted; what is drawn to scale is scaled, words keep their height."""
    shifted: list[Item] = []

    def at(point: Point) -> Point:
        return point[0] * scale + dx, point[1] * scale + dy

    for item in items:
        if isinstance(item, Line):
            shifted.append(replace(item, points=tuple(map(at, item.points))))
        elif isinstance(item, Circle):
            shifted.append(replace(item, centre=at(item.centre), radius=item.radius * scale))
        elif isinstance(item, Dimension):
            start, end, middle = (at(point) for point in (item.start, item.end, item.middle))
            shifted.append(replace(item, start=start, end=end, middle=middle))
        else:
            shifted.append(replace(item, place=at(item.place)))
    return shifted


@dataclass
class Canvas:
    """A list of primitives under construction with a search for free places of words."""

    items: list[Item] = field(default_factory=list)

    def line(self, *points: Point, layer: Layer = THIN, **more: object) -> None:
        """Draw a polyline through points."""
        self.items.append(Line(points, layer, **more))  # type: ignore[arg-type]

    def circle(self, centre: Point, radius: float, layer: Layer = THIN, **more: object) -> None:
        """Draw a circle."""
        self.items.append(Circle(centre, radius, layer, **more))  # type: ignore[arg-type]

    def words(self, point: Point, text: str, height: float = 3.5, **more: object) -> Words:
        """Return a line of text."""
        line = Words(point, text, height, **more)  # type: ignore[arg-type]
        if text:
            self.items.append(line)
        return line

    def box(self, left: float, low: float, right: float, high: float, layer: Layer) -> None:
        """Draw a rectangle."""
        corners = ((left, low), (right, low), (right, high), (left, high))
        self.items.append(Line(corners, layer, closed=True))

    def clear(self, words: Words) -> bool:
        """Whether no contour and no dimension runs through a text."""
        return not any(_cuts(item, words) for item in self.items)

    def free(self, words: Words, gap: float = 0.6) -> bool:
        """Whether a text touches no other."""
        left, low, right, high = words.box
        wide = (left - gap, low - gap, right + gap, high + gap)
        return not any(isinstance(i, Words) and overlap(wide, i.box) for i in self.items)

    def words_where_free(
        self, points: Iterable[Point], text: str, height: float = 3.5, within: Box | None = None,
        *, crossed: bool = True, **more: object,
    ) -> bool:  # fmt: skip
        """Add a text at the first free place, preferably uncrossed; tell whether one was free."""
        candidates = (Words(anchor, text, height, **more) for anchor in points)  # type: ignore[arg-type]
        free = [
            words
            for words in candidates
            if self.free(words) and (within is None or _inside(words.box, within))
        ]
        chosen = [*filter(self.clear, free), *(free if crossed else ())][:1]
        self.items += chosen
        return bool(chosen)

    def dimension(self, start: Point, end: Point, words: Words) -> None:
        """Note that the words tell the distance of two points, for programs that know it."""
        turn = math.radians(words.angle)
        along = (0.5 - words.align) * words.width
        up = words.height / 2
        middle = (
            words.place[0] + along * math.cos(turn) - up * math.sin(turn),
            words.place[1] + along * math.sin(turn) + up * math.cos(turn),
        )
        self.items.append(Dimension(start, end, words.text, words.height, middle))

    def arrow(
        self, tip: Point, along: Point, length: float = 3.5, layer: Layer = SIZES, name: str = ""
    ) -> None:
        """Draw a filled arrow head whose tip points along a unit vector."""
        (x, y), (ux, uy) = tip, along
        back = (x - ux * length, y - uy * length)
        side = 0.16 * length
        points = (tip, (back[0] - uy * side, back[1] + ux * side),
                  (back[0] + uy * side, back[1] - ux * side))  # fmt: skip
        self.items.append(Line(points, layer, closed=True, filled=True, name=name))


def _inside(box: Box, outer: Box) -> bool:
    return (
        box[0] >= outer[0] and box[1] >= outer[1] and box[2] <= outer[2] and box[3] <= outer[3]
    )  # fmt: skip


def _cuts(item: Item, words: Words) -> bool:
    if isinstance(item, Words | Dimension) or (
        isinstance(item, Line) and item.layer not in (CONTOUR, CURVES, SIZES)
    ):
        return False
    left, low, right, high = words.box
    around = (left - _NEAR, low - _NEAR, right + _NEAR, high + _NEAR)
    if not overlap(item.box, around):
        return False
    if isinstance(item, Circle):
        ends = [polar(item.centre, item.radius, turn) for turn in range(0, 375, 15)]
    else:
        ends = [*item.points, item.points[0]] if item.closed else list(item.points)
    return any(_within(a, b, words, 0.0) for a, b in pairwise(ends) if _passes(a, b, around))


def _passes(start: Point, end: Point, box: Box) -> bool:
    """Whether a straight line is not wholly on one side of a box."""
    left, low, right, high = box
    return not (
        (start[0] < left and end[0] < left) or (start[0] > right and end[0] > right)
        or (start[1] < low and end[1] < low) or (start[1] > high and end[1] > high)
    )  # fmt: skip


def _within(start: Point, end: Point, words: Words, gap: float) -> tuple[float, float] | None:
    """From where to where, as shares of its length, a line runs through a text."""
    turn = math.radians(words.angle)
    cos, sin = math.cos(turn), math.sin(turn)

    def turned(point: Point) -> Point:
        x, y = point[0] - words.place[0], point[1] - words.place[1]
        return x * cos + y * sin, y * cos - x * sin

    left = -words.align * words.width
    limits = ((left - gap, left + words.width + gap),
              (-0.3 * words.height - gap, 1.05 * words.height + gap))  # fmt: skip
    low, high = 0.0, 1.0
    for one, other, (least, most) in zip(turned(start), turned(end), limits, strict=True):
        way = other - one
        if abs(way) < 1e-9:
            if not least < one < most:
                return None
            continue
        enters, leaves = sorted(((least - one) / way, (most - one) / way))
        low, high = max(low, enters), min(high, leaves)
    return (low, high) if low < high else None


def interrupted(items: Sequence[Item]) -> list[Item]:
    """Axes and thin straight lines broken where a text stands on them, ГОСТ 2.307."""
    texts = [item for item in items if isinstance(item, Words)]
    visible: list[Item] = []
    for item in items:
        if not isinstance(item, Line) or item.layer not in (AXES, THIN) or len(item.points) != 2:
            visible.append(item)
            continue
        start, end = item.points
        gaps = sorted(filter(None, (_within(start, end, words, 0.5) for words in texts)))
        at = 0.0
        for low, high in [*gaps, (1.0, 1.0)]:
            if low > at:
                between = tuple(
                    (start[0] + t * (end[0] - start[0]), start[1] + t * (end[1] - start[1]))
                    for t in (at, low)
                )
                visible.append(replace(item, points=between))
            at = max(at, high)
    return visible


def polar(centre: Point, radius: float, angle: float) -> Point:
    """Point at an angle clockwise from the vertical [deg]."""
    turn = math.radians(angle)
    return centre[0] + radius * math.sin(turn), centre[1] + radius * math.cos(turn)


def bounds(items: Sequence[Item]) -> Box:
    """Bounds of all items."""
    lefts, lows, rights, highs = zip(*(item.box for item in items), strict=True)
    return min(lefts), min(lows), max(rights), max(highs)


def fitted(draw: Callable[..., list[Item]], room: tuple[float, float]) -> list[Item]:
    """Return a drawing to the scale at which it fits a room; letters keep their height."""
    scale, before = 1.0, (0.0, (0.0, 0.0))  # of nothing, nothing
    items = draw(scale=scale)
    for _ in range(_TRIES):
        left, low, right, high = bounds(items)
        sizes = right - left, high - low
        # What letters take does not grow with the drawing, the rest in proportion.
        nexts = [
            scale + (most - size) * (scale - before[0]) / (size - old)
            for most, size, old in zip(room, sizes, before[1], strict=True)
            if abs(size - old) > _NEAR
        ]
        before, following = (scale, sizes), max(min(nexts, default=scale), _LEAST * scale)
        if abs(following - scale) < _CLOSE * scale:
            break
        scale = following
        items = draw(scale=scale)
    return items
