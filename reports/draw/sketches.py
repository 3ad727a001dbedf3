"""Sketches of parts in the proportions of the engine, with the letters of their sizes.

Every drawing takes a part's sizes in mm by short keys and the letters of those that are asked
for; a size without a letter gives shape and no dimension.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from reports.draw.canvas import AXES, CONTOUR, SIZES, THIN, Item, Point
from reports.draw.lettered import LetteredCanvas

_RINGS = 3
_RING_HEIGHT = 0.028  # of the bore
_MIN_BELT = 0.05  # of the bore, of a piston above its first groove
_TOP = 1.35  # of a bearing's radius, where the shank begins
_SECTION = 5.5  # letters: height of the shank's section, which is enlarged
_BELOW = 3.4  # letters below the cap, for its dimension
LANE = 2.5  # of a dimension from what it measures and from the next one [letters]


@dataclass(frozen=True, slots=True)
class PartSizes:
    """Sizes of a part [mm] and the letters of those that are measured, both by key."""

    sizes: Mapping[str, float]
    names: Mapping[str, str]

    def __getitem__(self, key: str) -> float:
        """Return a size."""
        return self.sizes[key]

    def canvas(self, letters: float) -> LetteredCanvas:
        """Return a canvas that knows the letters."""
        return LetteredCanvas(names=self.names, letters=letters)

    def scaled(self, scale: float) -> dict[str, float]:
        """Return the sizes on the drawing."""
        return {key: scale * size for key, size in self.sizes.items()}


def piston_sketch(part: PartSizes, *, letters: float = 2.5, scale: float = 1.0) -> list[Item]:
    """Return a section of a piston across its pin: crown, head, grooves with rings, skirt.

    Args:
        part: sizes.
        letters: height of the letters on the drawing [mm].
        scale: size of the drawing to that of the part.
    """
    canvas, h = part.canvas(letters), letters
    s = part.scaled(scale)
    bore, height, crown = s["bore"], s["height"], s["crown"]
    outer, groove, inner = bore / 2, s["groove"] / 2, s["inner"] / 2
    tall, land = _RING_HEIGHT * bore, s["land"]
    belt = min(max(height - s["skirt"], crown + 0.1 * bore), 0.8 * height)
    free = belt - _MIN_BELT * bore
    count = next((n for n in (_RINGS, 2) if n * tall + (n - 1) * land < free), 2)
    first = max(0.5 * (belt - count * tall - (count - 1) * land), 0.03 * bore)
    tops = [-first - n * (tall + land) for n in range(count)]
    thin = outer - 0.45 * (outer - inner)  # of the skirt
    corner = min(0.06 * bore, 0.4 * inner)
    half: list[Point] = [(0.0, 0.0), (outer, 0.0)]
    for top in tops:
        half += [(outer, top), (groove, top), (groove, top - tall), (outer, top - tall)]
    half += [(outer, -height), (thin, -height), (thin, -belt - 0.1 * height), (inner, -belt),
             (inner, -crown - corner), (inner - corner, -crown), (0.0, -crown)]  # fmt: skip
    for side in (1, -1):
        outline = [(side * x, y) for x, y in half]
        canvas.line(*outline, layer=CONTOUR)
        canvas.hatch(outline)
        for top in tops:
            edge, back = side * outer, side * (outer - s["ring_radial"])
            ring = ((edge, top), (back, top), (back, top - tall), (edge, top - tall))
            canvas.line(*ring, layer=SIZES, closed=True, filled=True)
    _pin_hole(canvas, s)
    over = 1.5 * h
    canvas.line((0.0, over), (0.0, -height - over), layer=AXES)
    canvas.across("bore", -height - LANE * h, (-outer, outer), -height)
    canvas.down("height", -outer - LANE * h, (-height, 0.0), -outer, -1)
    canvas.down("skirt", outer + 2 * LANE * h, (-height, s["skirt"] - height), outer)
    canvas.down("land", outer + 0.8 * LANE * h, (tops[1], tops[0] - tall), outer)
    canvas.down("crown", 0.2 * bore, (-crown, 0.0))
    canvas.across("ring_radial", 0.9 * LANE * h, (-outer, s["ring_radial"] - outer), tops[0])
    canvas.across("groove", 1.9 * LANE * h, (-groove, groove), tops[0])
    level = min(tops[-1] - tall / 2, -crown - 1.2 * h)
    canvas.across("head_wall", level, (inner, groove), tops[-1] - tall)
    canvas.across("inner", min(level - 2.8 * h, -belt), (-inner, inner), -belt)
    return canvas.lettered()


def _pin_hole(canvas: LetteredCanvas, s: Mapping[str, float]) -> None:
    """Hole of the pin in its boss, between crown and lower end."""
    hole = s["pin"] / 2
    low, high = -s["height"] + 1.2 * hole, -s["crown"] - 1.5 * hole
    level = max(min(-0.58 * s["height"], high), low)
    canvas.circle((0.0, level), hole, layer=CONTOUR)
    canvas.circle((0.0, level), 1.4 * hole, layer=THIN)
    reach = 1.4 * hole + 1.2 * canvas.letters
    canvas.line((-reach, level), (reach, level), layer=AXES)


def pin_sketch(part: PartSizes, *, letters: float = 2.5, scale: float = 1.0) -> list[Item]:
    """Return a section of the pin in the bosses of the piston, the rod's eye between them.

    Args:
        part: sizes.
        letters: height of the letters on the drawing [mm].
        scale: size of the drawing to that of the part.
    """
    canvas, h = part.canvas(letters), letters
    s = part.scaled(scale)
    length, outer, hole = s["pin_length"] / 2, s["pin"] / 2, s["pin_bore"] / 2
    eye, gap = s["eye_length"] / 2, s["bosses"] / 2
    boss, eye_high = 1.45 * outer, s["eye_outer"] / 2
    reach = max(0.96 * s["bore"] / 2, length)
    for side in (1, -1):
        bar = box(-length, length, side * hole, side * outer)
        canvas.line(*bar, layer=CONTOUR, closed=True)
        canvas.hatch(bar)
        head = box(-eye, eye, side * outer, side * eye_high)
        canvas.line(*head, layer=CONTOUR, closed=True)
        canvas.hatch(head, lean=-1)
        for end in (1, -1):
            wall = box(end * gap, end * reach, side * outer, side * boss)
            canvas.line(*wall, layer=CONTOUR, closed=True)
            canvas.hatch(wall, lean=-1)
    for x in (-length, length):
        canvas.line((x, -hole), (x, hole), layer=CONTOUR)
    canvas.line((-reach - h, 0.0), (reach + h, 0.0), layer=AXES)
    high, low = max(eye_high, boss), -max(boss, eye_high)
    canvas.across("eye_length", high + 0.8 * LANE * h, (-eye, eye), eye_high)
    canvas.across("bosses", high + 1.8 * LANE * h, (-gap, gap), boss)
    canvas.across("pin_length", low - 0.9 * LANE * h, (-length, length), -outer)
    canvas.down("pin", reach + 0.9 * LANE * h, (-outer, outer), length)
    canvas.down("pin_bore", -reach - 0.9 * LANE * h, (-hole, hole), -length, -1)
    return canvas.lettered()


def box(left: float, right: float, low: float, high: float) -> list[Point]:
    """Return the corners of a rectangle."""
    return [(left, low), (right, low), (right, high), (left, high)]


def rod_sketch(part: PartSizes, *, letters: float = 2.5, scale: float = 1.0) -> list[Item]:
    """Return a rod from the front, with its shank cut short, from the side, its section enlarged.

    Args:
        part: sizes.
        letters: height of the letters on the drawing [mm].
        scale: size of the drawing to that of the part.
    """
    canvas, h = part.canvas(letters), letters
    s = part.scaled(scale)
    bearing = s["crankpin"] / 2 + s["shell"]
    half = s["bolts_apart"] / 2 + 0.95 * s["bolt"]
    long = min(s["rod"], s["eye_outer"] / 2 + _TOP * bearing + max(0.8 * s["eye_outer"], 5 * h))
    _eye(canvas, s, long)
    _big_end(canvas, s, half)
    is_cut = long < s["rod"]
    _shank(canvas, (-s["shank_height"] / 2, s["shank_height"] / 2), 0.0,
           (_TOP * bearing, long), is_cut, s["eye_outer"] / 2)  # fmt: skip
    left = -half - 1.1 * LANE * h
    canvas.line((-half - 0.4 * h, 0.0), (half + 0.4 * h, 0.0), layer=AXES)
    canvas.down("rod", left, (0.0, long), -s["eye_outer"] / 2, -1)
    side = half + max(s["cap_length"], s["eye_length"]) / 2 + 1.6 * LANE * h
    _side_view(canvas, s, (side, long), is_cut)
    _section(canvas, s, side + max(s["cap_length"], s["eye_length"]) / 2 + 2.2 * LANE * h, long)
    return canvas.lettered()


def _eye(canvas: LetteredCanvas, s: Mapping[str, float], y: float) -> None:
    """Upper end with its bush."""
    h, outer = canvas.letters, s["eye_outer"] / 2
    bush, pin = s["eye_bore"] / 2, s["pin"] / 2
    for radius, layer in ((outer, CONTOUR), (bush, THIN), (pin, CONTOUR)):
        canvas.circle((0.0, y), radius, layer=layer)
    over = h
    canvas.line((-outer - over, y), (outer + over, y), layer=AXES)
    top = y + outer
    canvas.line((0.0, top + over), (0.0, y - outer - over), layer=AXES)
    canvas.across("pin", top + 0.9 * LANE * h, (-pin, pin), y)
    canvas.across("eye_bore", top + 1.8 * LANE * h, (-bush, bush), y)
    canvas.across("eye_outer", top + 2.7 * LANE * h, (-outer, outer), y)
    canvas.across("eye_wall", y, (bush, outer))
    canvas.across("bush_wall", y, (-bush, -pin))
    turn = math.radians(-38)
    tip = (s["eye_mean"] * math.cos(turn), y + s["eye_mean"] * math.sin(turn))
    canvas.ray("eye_mean", (0.0, y), tip, outer - s["eye_mean"] + 2.0 * h)


def _big_end(canvas: LetteredCanvas, s: Mapping[str, float], half: float) -> None:
    """Lower end with its cap, shells and bolts."""
    h, journal, spacing = canvas.letters, s["crankpin"] / 2, s["bolts_apart"] / 2
    bearing, bolt = journal + s["shell"], s["bolt"] / 2
    block, foot, neck = 0.7 * bearing, bearing + s["cap_wall"], s["shank_height"] / 2
    for radius, layer in ((journal, THIN), (bearing, CONTOUR)):
        canvas.circle((0.0, 0.0), radius, layer=layer)
    upper = [(half, 0.0), (half, block), (max(spacing - 1.5 * bolt, neck), block),
             (neck, _TOP * bearing)]  # fmt: skip
    cap = [(-half, 0.0), (-half, -0.7 * bearing), (-0.6 * spacing, -foot), (0.6 * spacing, -foot),
           (half, -0.7 * bearing), (half, 0.0)]  # fmt: skip
    for side in (1, -1):
        canvas.line(*((side * x, y) for x, y in upper), layer=CONTOUR)
    canvas.line(*cap, layer=CONTOUR)
    for side in (1, -1):
        canvas.line((side * bearing, 0.0), (side * half, 0.0), layer=CONTOUR)
        middle = side * spacing
        for edge in (middle - bolt, middle + bolt):
            canvas.line((edge, -0.95 * bearing), (edge, block), layer=THIN)
        canvas.line((middle, -0.95 * bearing - h), (middle, block + h), layer=AXES)
    canvas.line((0.0, -foot - h), (0.0, bearing + h), layer=AXES)
    canvas.across("bolt", block + LANE * h, (spacing - bolt, spacing + bolt), block)
    canvas.down("cap_wall", 0.25 * spacing, (-foot, -bearing))
    canvas.across("shell", 0.0, (-bearing, -journal))
    below = -foot - _BELOW * h
    canvas.across("crankpin", below, (-journal, journal), 0.0)
    canvas.across("bolts_apart", below - LANE * h, (-spacing, spacing), -0.95 * bearing)


def _shank(
    canvas: LetteredCanvas, edges: tuple[float, float], middle: float,
    ends: tuple[float, float], is_cut: bool, radius: float,
) -> None:  # fmt: skip
    """Both edges of a shank from the lower end to the eye, broken where it is cut short."""
    low, high = ends
    for edge in edges:
        away = edge - middle
        reach = high - math.sqrt(max(radius**2 - away**2, 0.0)) if radius else high
        if is_cut:
            gap = 0.4 * canvas.letters
            half = (low + reach) / 2
            canvas.line((edge, low), (edge, half - gap), layer=CONTOUR)
            canvas.line((edge, half + gap), (edge, reach), layer=CONTOUR)
        else:
            canvas.line((edge, low), (edge, reach), layer=CONTOUR)
    if is_cut:
        reach = high - radius
        half, wide = (low + reach) / 2, (edges[1] - edges[0]) / 2
        gap = 0.4 * canvas.letters
        for level in (half - gap, half + gap):
            wave = [(middle + t * wide * 1.25, level + 0.25 * canvas.letters * math.sin(4 * t))
                    for t in (-1.0, -0.6, -0.2, 0.2, 0.6, 1.0)]  # fmt: skip
            canvas.line(*wave, layer=SIZES)


def _side_view(canvas: LetteredCanvas, s: Mapping[str, float], at: Point, is_cut: bool) -> None:
    """Rod along the crankshaft: lengths of both ends."""
    (x, y), h = at, canvas.letters
    bearing = s["crankpin"] / 2 + s["shell"]
    eye, big = s["eye_length"] / 2, s["cap_length"] / 2
    radius, foot, block = s["eye_outer"] / 2, bearing + s["cap_wall"], _TOP * bearing
    canvas.line(*box(x - eye, x + eye, y - radius, y + radius), layer=CONTOUR, closed=True)
    canvas.line(*box(x - big, x + big, -foot, block), layer=CONTOUR, closed=True)
    canvas.line((x - big, 0.0), (x + big, 0.0), layer=CONTOUR)
    wide = s["shank_width"] / 2
    _shank(canvas, (x - wide, x + wide), x, (block, y - radius), is_cut, 0.0)
    for level, reach in ((y, eye), (0.0, big)):
        canvas.line((x - reach - h, level), (x + reach + h, level), layer=AXES)
    canvas.line((x, -foot - h), (x, y + radius + h), layer=AXES)
    canvas.across("eye_length", y + radius + 0.9 * LANE * h, (x - eye, x + eye), y + radius)
    canvas.across("cap_length", -foot - _BELOW * h, (x - big, x + big), -foot)


def _section(canvas: LetteredCanvas, s: Mapping[str, float], x: float, long: float) -> None:
    """Section of the shank, enlarged: height in the plane of swing is drawn upright."""
    h = canvas.letters
    scale = _SECTION * h / s["shank_height"]
    high, wide = scale * s["shank_height"] / 2, scale * s["shank_width"] / 2
    web, flange = scale * s["shank_web"] / 2, scale * s["shank_flange"]
    x, y = x + wide + 0.5 * LANE * h, 0.55 * long
    right = [(wide, high), (wide, high - flange), (web, high - flange)]
    quarter = [*right, *((dx, -dy) for dx, dy in reversed(right))]
    outline = [(x + dx, y + dy) for dx, dy in quarter]
    outline += [(x - dx, y + dy) for dx, dy in reversed(quarter)]
    canvas.line(*outline, layer=CONTOUR, closed=True)
    canvas.hatch(outline)
    over = 1.2 * h
    canvas.line((x - wide - over, y), (x + wide + over, y), layer=AXES)
    canvas.line((x, y - high - over), (x, y + high + over), layer=AXES)
    canvas.down("shank_height", x - wide - LANE * h, (y - high, y + high), x - wide, -1)
    canvas.across("shank_width", y - high - LANE * h, (x - wide, x + wide), y - high)
    canvas.across("shank_web", y + 0.3 * high, (x - web, x + web))
    canvas.down("shank_flange", x + wide + 0.8 * LANE * h, (y + high - flange, y + high), x + wide)
