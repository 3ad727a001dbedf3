"""Schemes of the sheet: the shaft with its star, what balances it."""

from __future__ import annotations

import math
from collections.abc import Iterator

from reports.document.text.terms import Terms, plain_number
from reports.drawing.lettering import fitted
from reports.drawing.primitives import AXES, CONTOUR, SIZES, THIN, Canvas, Point, polar
from reports.inputs.firing import order_text
from reports.model.shape import Shape
from reports.sheet.cell import TEXT, Room, headed

_BEARING = 5.0  # half a bearing on the scheme
_BEYOND = 3.0  # of an axis beyond the throws, before their numbers
_SECOND = ("F_order_kN", "M_order_Nm")


def shaft(canvas: Canvas, room: Room, terms: Terms) -> None:
    """The shaft from the side and from the nose with the firing order."""
    crankshaft = terms.model.input.crankshaft
    angles = crankshaft.throw_angles_deg
    offsets, period = crankshaft.firing_offsets_deg, Shape.of(terms.model.input).period
    order = (f"Порядок работы {order_text(offsets, period)}",) if len(offsets) > 1 else ()
    room = headed(canvas, room, "Схема коленчатого вала", order)
    star = min(room.width * 0.16, room.height / 2 - 12)
    side = Room(room.left + 4, room.low, room.width - 2 * star - 34, room.height)
    _from_side(canvas, side, angles)
    centre = (room.right - star - 12, room.middle[1])
    _star(canvas, centre, star, angles)


def _from_side(canvas: Canvas, room: Room, angles: tuple[float, ...]) -> list[Point]:
    """Broken line of the shaft; the middles of its throws."""
    pitch = (room.width - 8) / len(angles)
    y, tall = room.middle[1], room.height / 2 - 10
    x = room.left + 4
    canvas.line((room.left, y), (room.right + 2, y), layer=AXES)
    points: list[Point] = [(room.left, y)]
    middles = []
    for number, angle in enumerate(angles, 1):
        high = y + 0.75 * tall * math.cos(math.radians(angle))
        inner = (x + 0.3 * pitch, x + 0.7 * pitch)
        points += [(inner[0], y), (inner[0], high), (inner[1], high), (inner[1], y)]
        middle = ((inner[0] + inner[1]) / 2, high)
        above = 2.0 if high >= y else -2.0 - TEXT
        canvas.words((middle[0], high + above), str(number), TEXT, align=0.5)
        middles.append(middle)
        x += pitch
    points.append((room.right, y))
    canvas.line(*points, layer=CONTOUR)
    for number in range(len(angles) + 1):
        place = room.left + 4 + number * pitch
        half = min(_BEARING, 0.18 * pitch)
        for shift in (-2.0, 2.0):
            canvas.line((place - half, y + shift), (place + half, y + shift), layer=CONTOUR)
    return middles


def _star(canvas: Canvas, centre: Point, radius: float, angles: tuple[float, ...]) -> None:
    for dx, dy in ((radius + _BEYOND, 0.0), (0.0, radius + _BEYOND)):
        ends = (centre[0] - dx, centre[1] - dy), (centre[0] + dx, centre[1] + dy)
        canvas.line(*ends, layer=AXES)
    rays: dict[float, list[str]] = {}
    for number, angle in enumerate(angles, 1):
        rays.setdefault(round(angle % 360, 3), []).append(str(number))
    canvas.circle(centre, 2.0, layer=CONTOUR)
    for angle, numbers in rays.items():
        canvas.line(centre, polar(centre, radius, angle), layer=CONTOUR)
        canvas.circle(polar(centre, radius, angle), 1.5, layer=CONTOUR)
        text = ", ".join(numbers)
        places = [
            (p[0], p[1] - TEXT / 2)
            for r in (6, 9, 13)
            for p in (polar(centre, radius + r + len(text) * abs(math.sin(math.radians(angle))),
                            angle),)
        ]  # fmt: skip
        canvas.words_where_free(places, text, TEXT, align=0.5)


def _free(terms: Terms) -> Iterator[str]:
    """Lines on the free forces and moments of the orders that matter."""
    if not terms.has("F1_before_max"):
        return
    for key, unit, word in (("F1", "кН", "Сила"), ("L1", "Н·м", "Момент")):
        before, after = (terms.num(f"{key}_{when}_max") for when in ("before", "after"))
        yield f"{word} 1-го порядка: до {before}, после {after} {unit}"
    if terms.has("balance_orders.F_order_kN"):
        force, moment = (terms.num(f"balance_orders.{key}", 2.0) for key in _SECOND)
        yield f"2-й порядок до балансирных валов: сила {force} кН, момент {moment} Н·м"


def balance(canvas: Canvas, room: Room, terms: Terms) -> None:
    """Centrifugal forces of the throws and counterweights; what is left of forces and moments."""
    shaft = terms.model.input.crankshaft
    room = headed(canvas, room, "Схема уравновешивания", tuple(_free(terms)))
    side = Room(room.left + 12, room.low + 6, room.width - 24, room.height - 8)
    middles = _from_side(canvas, side, shaft.throw_angles_deg)
    y = side.middle[1]
    for number, (place, angle) in enumerate(zip(middles, shaft.throw_angles_deg, strict=True)):
        up = 1.0 if place[1] >= y else -1.0
        if abs(math.cos(math.radians(angle))) > 0.05:
            long = 7.0 * abs(math.cos(math.radians(angle)))
            start = (place[0] + 4, place[1])
            canvas.line(start, (start[0], start[1] + up * long), layer=SIZES)
            canvas.arrow((start[0], start[1] + up * (long + 3)), (0.0, up))
        pair = shaft.webs[2 * number : 2 * number + 2]
        if any(web.counterweight_kg for web in pair):
            low = y - up * 0.35 * (side.height / 2 - 10)
            canvas.box(place[0] - 4, min(low, y - up * 4), place[0] + 4, max(low, y - up * 4), THIN)
    masses = sorted(web.counterweight_kg for web in shaft.webs)
    mass = "; ".join(dict.fromkeys(map(plain_number, masses)))
    said = f"Kr = {terms.num('K_r')} кН; приведённая масса противовеса щеки {mass} кг"
    height = fitted(said, room.width, TEXT)
    canvas.words((room.middle[0], room.low + 1), said, height, align=0.5)
