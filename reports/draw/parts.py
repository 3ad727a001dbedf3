"""Dimensioned drawings of a throw and of the mechanism, true to size, from numbers in mm."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import cast

from reports.draw.canvas import (
    AXES,
    CONTOUR,
    SIZE,
    SIZES,
    THIN,
    Canvas,
    Item,
    Point,
    Words,
    interrupted,
)
from reports.draw.fonts import width_of
from reports.shared.russian import fixed

_MAX_WEB = 1.6  # of the shorter arm beside it: a web whose thickness the arms do not have
ROUND = 0.7  # of a journal's diameter that a web reaches beyond its axis


def number(value: float) -> str:
    """Return a size with the digits it was given with, to a hundredth."""
    digits = next(d for d in range(3) if d == 2 or abs(round(value, d) - value) < 1e-9)
    return fixed(value, digits)


def along(
    canvas: Canvas, start: Point, end: Point, name: str, value: float, letters: float,
    *, heads: bool = True,
) -> None:  # fmt: skip
    """Draw a dimension from one point to another with its name and value beside it."""
    measured(canvas, start, end, f"{name} = {number(value)}", letters, heads=heads)


def measured(
    canvas: Canvas, start: Point, end: Point, text: str, letters: float, *, heads: bool = True
) -> None:
    """Draw a dimension from one point to another with a text beside it."""
    length = math.dist(start, end)
    unit = ((end[0] - start[0]) / length, (end[1] - start[1]) / length)
    size = SIZE if heads else ""
    if heads:
        canvas.line(start, end, layer=SIZES, name=size)
        canvas.arrow(end, unit, letters, name=size)
        canvas.arrow(start, (-unit[0], -unit[1]), letters, name=size)
    turn = math.degrees(math.atan2(unit[1], unit[0]))
    turn = turn - 180 if turn > 90.01 else turn + 180 if turn < -89.99 else turn
    up = (-math.sin(math.radians(turn)), math.cos(math.radians(turn)))
    shares = (0.5, 0.4, 0.6, 0.3, 0.7)
    middles = [(start[0] + s * (end[0] - start[0]), start[1] + s * (end[1] - start[1]))
               for s in shares]  # fmt: skip
    points = [(x + up[0] * gap * letters, y + up[1] * gap * letters)
              for gap in (0.5, -1.6, 1.6, -2.8) for x, y in middles]  # fmt: skip
    if not heads:  # there is no dimension line to stand beside: the line goes on as its words
        beyond = length + 1.6 * letters + width_of(text, letters) / 2
        for far in (beyond, -beyond):  # past its end, or past the circle on the other side
            points.append((start[0] + far * unit[0] - 0.4 * letters * up[0],
                           start[1] + far * unit[1] - 0.4 * letters * up[1]))  # fmt: skip
    label = canvas.words_where_free(
        points, text, letters, align=0.5, angle=round(turn, 3), name=size
    )
    if heads and label:
        canvas.dimension(start, end, cast(Words, canvas.items[-1]))


def across(
    canvas: Canvas, x: float, ends: tuple[float, float], value: float, letters: float
) -> None:
    """Draw a diameter upright within its journal, the value beside the line."""
    low, high = ends
    canvas.line((x, low), (x, high), layer=SIZES, name=SIZE)
    canvas.arrow((x, high), (0.0, 1.0), min(letters, (high - low) / 3), name=SIZE)
    canvas.arrow((x, low), (0.0, -1.0), min(letters, (high - low) / 3), name=SIZE)
    text = f"Ø{number(value)}"
    middle, wide = (low + high) / 2, width_of(text, letters)
    if wide < high - low:
        points = [(x - 0.5 * letters, middle)]
        if canvas.words_where_free(points, text, letters, align=0.5, angle=90.0, name=SIZE):
            canvas.dimension((x, low), (x, high), cast(Words, canvas.items[-1]))
            return
    above = [(x, high + (1 + 1.6 * n) * letters) for n in range(6)]
    if canvas.words_where_free(above, text, letters, align=0.5, name=SIZE):
        canvas.dimension((x, low), (x, high), cast(Words, canvas.items[-1]))


def chain(
    canvas: Canvas, stations: Sequence[float], names: Sequence[str], values: Sequence[float],
    y: float, letters: float,
) -> None:  # fmt: skip
    """Sizes one after another on a line.

    Values without room in between stand below, left ones left of their leaders and the lower
    the nearer to the middle, right ones likewise: so no leader runs through a value.
    """
    below: list[tuple[float, str, Point]] = []
    for start, end, name, value in zip(stations, stations[1:], names, values, strict=False):
        if end - start <= 0:
            continue
        canvas.line((start, y), (end, y), layer=SIZES, name=SIZE)
        head = min(letters, (end - start) / 3)
        canvas.arrow((end, y), (1.0, 0.0), head, name=SIZE)
        canvas.arrow((start, y), (-1.0, 0.0), head, name=SIZE)
        text, middle = f"{name} = {number(value)}", (start + end) / 2
        if width_of(text, letters) < end - start - letters:
            words = canvas.words((middle, y + 0.5 * letters), text, letters, align=0.5, name=SIZE)
            canvas.dimension((start, y), (end, y), words)
        else:
            below.append((middle, text, (start, end)))
    half = -(-len(below) // 2)
    for index, (middle, text, (start, end)) in enumerate(below):
        left = index < half
        level = y - 1.6 * letters * (1 + (index if left else len(below) - 1 - index))
        canvas.line((middle, y), (middle, level - 0.2 * letters), layer=SIZES)
        beside = (middle + (-0.4 if left else 0.4) * letters, level)
        words = canvas.words(beside, text, letters, align=1.0 if left else 0.0, name=SIZE)
        canvas.dimension((start, y), (end, y), words)
    for x in sorted(set(stations)):
        canvas.line((x, y - 0.5 * letters), (x, y + 3 * letters), layer=SIZES)


@dataclass(frozen=True, slots=True)
class ThrowSizes:
    """Sizes of one throw [mm]; ``weights`` says which webs carry counterweights."""

    arms: tuple[float, ...]  # l1 … l6
    webs: tuple[float, float]  # h of the left and the right web, 0 where not given
    radius: float
    pin: float  # diameter
    mains: tuple[float, float]  # diameters
    lengths: tuple[float, float]  # of the main journals
    weights: tuple[bool, bool] = (False, False)
    usual: tuple[float, float] = (0.0, 0.0)  # h of the webs of the calculation where ``webs`` is 0

    @property
    def size(self) -> float:
        """Greatest extent, by which letters are chosen."""
        return max(sum(self.arms) + sum(self.webs) + sum(self.lengths) / 2, 3 * self.radius)


@dataclass(frozen=True, slots=True)
class MechanismSizes:
    """Sizes of the crank mechanism [mm]; ``offset`` of the cylinder axis in the turn's sense."""

    bore: float
    radius: float
    rod: float
    offset: float = 0.0

    @property
    def size(self) -> float:
        """Greatest extent."""
        return 2 * self.radius + self.rod + self.bore


@dataclass(frozen=True, slots=True)
class ThrowOutline:
    """Where the parts of a drawn throw are [mm]; levels from the axis of the main journals."""

    stations: tuple[float, ...]  # ends of l1, h, l2 … l5, h, l6 from the left support
    inner: tuple[float, float]  # ends of the crankpin
    outer: tuple[float, float]  # faces of the webs at the main journals
    ends: tuple[float, float]  # of the main journals
    low: float  # lower end of the webs
    radius: float
    pin: float  # diameter
    mains: tuple[float, float]  # diameters


def throw_outline(canvas: Canvas, throw: ThrowSizes, scale: float) -> ThrowOutline:
    """Draw webs and journals of a throw from the side."""
    l1, l2, l3, l4, l5, l6 = (scale * arm for arm in throw.arms)
    left_web, right_web = (scale * web for web in throw.webs)
    r, pin = scale * throw.radius, scale * throw.pin
    mains = scale * throw.mains[0], scale * throw.mains[1]
    halves = [scale * length / 2 for length in throw.lengths]
    rod = l1 + left_web + l2
    right = rod + l3 + l4 + l5
    end = right + right_web + l6
    room = _MAX_WEB * min(l1, l2), _MAX_WEB * min(l5, l6)
    usual = [min(scale * h or 1.0, most) for h, most in zip(throw.usual, room, strict=True)]
    thickness = [left_web or usual[0], right_web or usual[1]]
    faces = [(l1 if left_web else l1 - thickness[0] / 2, thickness[0]),
             (right if right_web else right - thickness[1] / 2, thickness[1])]  # fmt: skip
    low = 0.0
    for (face, thick), main, heavy in zip(faces, mains, throw.weights, strict=True):
        foot = -(main / 2 + 0.8 * r) if heavy else -ROUND * main
        low = min(low, foot)
        canvas.box(face, foot, face + thick, r + ROUND * pin, CONTOUR)
    inner = faces[0][0] + faces[0][1], faces[1][0]
    outer, ends = (faces[0][0], faces[1][0] + faces[1][1]), (-halves[0], end + halves[1])
    canvas.box(inner[0], r - pin / 2, inner[1], r + pin / 2, CONTOUR)
    canvas.box(ends[0], -mains[0] / 2, outer[0], mains[0] / 2, CONTOUR)
    canvas.box(outer[1], -mains[1] / 2, ends[1], mains[1] / 2, CONTOUR)
    stations = (0.0, l1, l1 + left_web, rod, rod + l3, rod + l3 + l4, right, right + right_web, end)
    return ThrowOutline(stations, inner, outer, ends, low, r, pin, mains)


def throw_drawing(throw: ThrowSizes, *, letters: float = 3.5, scale: float = 1.0) -> list[Item]:
    """Return a throw from the side with its chain of lengths, diameters and radius.

    Args:
        throw: sizes.
        letters: height of the letters on the drawing [mm].
        scale: size of the drawing to that of the throw.
    """
    canvas = Canvas()
    drawn = throw_outline(canvas, throw, scale)
    inner, ends, mains, r, pin = drawn.inner, drawn.ends, drawn.mains, drawn.radius, drawn.pin
    over = 2.5 * letters
    canvas.line((ends[0] - over, 0), (ends[1] + over, 0), layer=AXES)
    canvas.line((inner[0] - over, r), (inner[1] + over, r), layer=AXES)
    names = ["l_1", "h_Л", "l_2", "l_3", "l_4", "l_5", "h_П", "l_6"]
    values = [throw.arms[0], throw.webs[0], *throw.arms[1:5], throw.webs[1], throw.arms[5]]
    floor = drawn.low - 4 * letters
    _, _, _, rod, middle, far, *_, end = drawn.stations
    for x in sorted({0.0, rod, middle, far, end}):
        top = mains[0] / 2 + letters if x in (0.0, end) else r + pin / 2 + letters
        canvas.line((x, floor), (x, top), layer=AXES)
    chain(canvas, drawn.stations, names, values, floor, letters)
    reach = ends[0] - 3.5 * letters
    canvas.line((reach - letters, r), (inner[0], r), layer=THIN)
    canvas.line((reach - letters, 0), (ends[0], 0), layer=THIN)
    along(canvas, (reach, 0), (reach, r), "r", throw.radius, letters)
    aside = 1.9 * letters  # from the end of a journal: the letters stand left of the line
    for x, y, d, value in (
        ((inner[0] + inner[1]) / 2 + (inner[1] - inner[0]) / 4, r, pin, throw.pin),
        (ends[0] + max(-ends[0] / 2, aside), 0.0, mains[0], throw.mains[0]),
        ((end + ends[1]) / 2, 0.0, mains[1], throw.mains[1]),
    ):
        across(canvas, x, (y - d / 2, y + d / 2), value, letters)
    return interrupted(canvas.items)


def mechanism_drawing(
    mechanism: MechanismSizes, *, letters: float = 3.5, scale: float = 1.0, phi: float = 50.0
) -> list[Item]:
    """Cylinder, piston, rod and crank with bore, stroke, length of the rod and radius.

    Args:
        mechanism: sizes.
        letters: height of the letters on the drawing [mm].
        scale: size of the drawing to that of the mechanism.
        phi: crank angle that is drawn [deg].
    """
    canvas = Canvas()
    r, rod, bore = scale * mechanism.radius, scale * mechanism.rod, scale * mechanism.bore
    e = scale * mechanism.offset
    pin = (r * math.sin(math.radians(phi)), r * math.cos(math.radians(phi)))
    piston = (e, pin[1] + math.sqrt(rod**2 - (pin[0] - e) ** 2))
    top, bottom = (math.sqrt((rod + sign * r) ** 2 - e**2) for sign in (1, -1))
    crown, skirt, over = 0.45 * bore, 0.35 * bore, 2.5 * letters
    head = top + crown + over
    for side in (-1, 1):
        wall = e + side * (bore / 2 + 0.4)
        canvas.line((wall, bottom - skirt), (wall, head), layer=CONTOUR)
    canvas.box(e - bore / 2, piston[1] - skirt, e + bore / 2, piston[1] + crown, CONTOUR)
    canvas.circle((0.0, 0.0), r, layer=THIN)
    canvas.line((0.0, 0.0), pin, piston, layer=CONTOUR)
    for joint in ((0.0, 0.0), pin, piston):
        canvas.circle(joint, 0.06 * r + 0.3 * letters, layer=CONTOUR)
    canvas.line((e, -over if not e else bottom), (e, head + over), layer=AXES)
    canvas.line((0.0, -r - over), (0.0, head + over if not e else r + over), layer=AXES)
    canvas.line((-r - over, 0.0), (r + over, 0.0), layer=AXES)
    _sizes(canvas, mechanism, (pin, piston), (top, bottom, head, e), scale, letters)
    return interrupted(canvas.items)


def _sizes(
    canvas: Canvas, mechanism: MechanismSizes, joints: tuple[Point, Point],
    levels: tuple[float, float, float, float], scale: float, letters: float,
) -> None:  # fmt: skip
    pin, piston = joints
    top, bottom, head, e = levels
    bore, r = scale * mechanism.bore, scale * mechanism.radius
    wall = e + bore / 2 + 0.4
    y = head + 2 * letters
    for x in (-bore / 2, bore / 2):
        canvas.line((e + x, head), (e + x, y + letters), layer=THIN)
    along(canvas, (e - bore / 2, y), (e + bore / 2, y), "ØD", mechanism.bore, letters)
    stroke = math.sqrt((mechanism.rod + mechanism.radius) ** 2 - mechanism.offset**2)
    stroke -= math.sqrt((mechanism.rod - mechanism.radius) ** 2 - mechanism.offset**2)
    edge = min(e - bore / 2, -r) - 3 * letters
    for level in (top, bottom):
        canvas.line((edge - letters, level), (e, level), layer=THIN)
    along(canvas, (edge, bottom), (edge, top), "S", stroke, letters)
    along(canvas, pin, piston, "L", mechanism.rod, letters, heads=False)
    along(canvas, (0.0, 0.0), pin, "r", mechanism.radius, letters, heads=False)
    if e:
        low = -r - 5 * letters
        for x in (0.0, e):
            canvas.line((x, low - letters), (x, -r), layer=THIN)
        canvas.words_where_free([(max(0.0, e) + letters, low), (wall, low)],
                                f"e = {number(mechanism.offset)}", letters)  # fmt: skip
