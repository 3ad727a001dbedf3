"""Cells of the sheet: title, legend, tables, schemes, drawings of the parts to scale."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import NamedTuple

import numpy as np

from reports.document.chapters.balance import asked_devices
from reports.document.chapters.chapter import pin_stems, worst_pin
from reports.document.page.charts import counterweight_of, flywheel_of, mechanism_of, throw_of
from reports.document.text.terms import Terms, plain_number
from reports.document.text.texts import of_digits
from reports.draw.canvas import (
    AXES,
    CONTOUR,
    SIZES,
    TABLES,
    THIN,
    Canvas,
    Dash,
    Item,
    Point,
    bounds,
    moved,
    polar,
)
from reports.draw.fonts import fitted, standard, width_of, wrapped
from reports.draw.parts import mechanism_drawing, throw_drawing
from reports.draw.weights import counterweight_drawing, flywheel_drawing
from reports.inputs.firing import order_text
from reports.model.blocks import ScalarTable
from reports.model.shape import Shape
from reports.shared.russian import capital, fixed

TITLE, TEXT = 5.0, 3.5  # height of letters
_SAMPLE = 12.0  # of a dash beside the name of a curve
ROW = 6.0  # mm
_PADDING = 1.0  # on each side of the words in a cell [mm]
_STEPS = (30.0, 60.0, 90.0, 120.0, 180.0)
_RESULTS = ("M_mean", "M_max", "M_min", "M_e", "p_i_calc", "N_i_calc")
_BEARING = 5.0  # half a bearing on the scheme
_BEYOND = 3.0  # of an axis beyond the throws, before their numbers
_STRESSES = {"st_crown_MPa", "st_press_MPa", "st_pin_bend_MPa", "st_pin_shear_MPa", "st_cap_MPa"}
_SECOND = ("F_order_kN", "M_order_Nm")
_LETTERS = (3.5, 2.5, 1.8)  # heights to try
# ГОСТ 2.302.
_SCALES = (10.0, 5.0, 4.0, 2.5, 2.0, 1.0, 1 / 2, 1 / 2.5, 1 / 4, 1 / 5, 1 / 10, 1 / 20, 1 / 50)


class CellArea(NamedTuple):
    """A rectangle of the sheet [mm]."""

    left: float
    low: float
    width: float
    height: float

    @property
    def high(self) -> float:
        """Its upper edge."""
        return self.low + self.height

    @property
    def right(self) -> float:
        """Its right edge."""
        return self.left + self.width

    @property
    def middle(self) -> Point:
        """Its centre."""
        return self.left + self.width / 2, self.low + self.height / 2


@dataclass(frozen=True, slots=True)
class Name:
    """A curve in the legend."""

    text: str
    dash: Dash = ()


def headed(canvas: Canvas, room: CellArea, title: str, lines: tuple[str, ...] = ()) -> CellArea:
    """Write a title and lines under it; what is left of the room."""
    y = room.high - TITLE - 1.5
    for text in wrapped(title, room.width, TITLE):
        height = fitted(text, room.width, TITLE)
        canvas.words((room.middle[0], y), text, height, align=0.5)
        y -= 1.6 * TITLE
    y += 0.3 * TITLE
    for text in lines:
        for part in wrapped(text, room.width, TEXT):
            canvas.words((room.middle[0], y), part, fitted(part, room.width, TEXT), align=0.5)
            y -= 1.7 * TEXT
    return CellArea(room.left, room.low, room.width, y + 0.6 * TEXT - room.low)


def _shown(dash: Dash) -> Dash:
    """Dashes so short that a sample shows them all, with the first one at both its ends."""
    if not dash:
        return dash
    share = min(1.0, _SAMPLE / (sum(dash) + dash[0]))
    return tuple(round(share * part, 2) for part in dash)


def legend(canvas: Canvas, room: CellArea, names: list[Name]) -> CellArea:
    """Dashes with the names of curves in lines; what is left of the room."""
    x, y = room.left + 2, room.high - TEXT - 1
    for name in names:
        words = replace(canvas.words((0, 0), "", TEXT), text=name.text)
        if x > room.left + 2 and x + _SAMPLE + 2 + words.width > room.right:
            x, y = room.left + 2, y - 1.8 * TEXT
        middle = y + TEXT / 2
        canvas.line((x, middle), (x + _SAMPLE, middle), layer=THIN, dash=_shown(name.dash))
        canvas.words((x + _SAMPLE + 2, y), name.text, TEXT)
        x += _SAMPLE + 8 + words.width
    return CellArea(room.left, room.low, room.width, y - 2 - room.low)


def grid(canvas: Canvas, room: CellArea, rows: Sequence[Sequence[str]]) -> None:
    """Table at the top of an area with a thick line under its heading.

    Columns are as wide as their longest words ask, so that all letters are of one height.
    """
    needs = [max(width_of(text, TEXT) for text in column) for column in zip(*rows, strict=True)]
    share = (room.width - 2 * _PADDING * len(needs)) / sum(needs)
    wides = [need * share + 2 * _PADDING for need in needs]
    tall = min(ROW, room.height / len(rows))
    height = standard(min(TEXT, 0.6 * tall, TEXT * share))
    xs = [room.left + sum(wides[:n]) for n in range(len(wides) + 1)]
    low = room.high - tall * len(rows)
    canvas.box(xs[0], low, xs[-1], room.high, TABLES)
    for x in xs[1:-1]:
        canvas.line((x, low), (x, room.high), layer=TABLES)
    for number, row in enumerate(rows):
        y = room.high - tall * (number + 1)
        if number + 1 < len(rows):
            ends = (xs[0], y), (xs[-1], y)
            canvas.line(*ends, layer=THIN if number else TABLES)
        middle = y + (tall - height) / 2
        for index, text in enumerate(row):
            if index or not number:
                canvas.words((xs[index] + wides[index] / 2, middle), text, height, align=0.5)
            else:
                canvas.words((xs[index] + _PADDING, middle), text, height)


def running(canvas: Canvas, room: CellArea, terms: Terms) -> None:
    """Running-on torques on main journals at a step of the angle that fits the room."""
    throws = Shape.of(terms.model.input).throws
    room = headed(canvas, room, "Набегающие моменты на коренные шейки, Н·м")
    angles = np.asarray(terms.model.tables["P4_4"].rows, dtype=float)
    most = int(room.height / 4.2) - 2
    step = next(s for s in _STEPS if (angles[-1] - angles[0]) / s + 1 <= most or s == _STEPS[-1])
    indices = [n for n, a in enumerate(angles) if abs(np.remainder(a + 1e-6, step)) < 1e-3]
    columns = [terms.column(f"P4_4.Mmain{k}_Nm") for k in range(2, throws + 2)]
    rows = [["φ, °", *(f"шейка {k}" for k in range(2, throws + 2))]]
    digits = terms.quantity("P4_4.Mmain2_Nm").digits
    rows += [[fixed(angles[n], 0), *(of_digits(float(c[n]), digits) for c in columns)]
             for n in indices]  # fmt: skip
    swings = [terms.num(f"dM_main{k}") for k in range(2, throws + 2)]
    rows.append(["размах", *swings])
    grid(canvas, room, rows)


def results(canvas: Canvas, room: CellArea, terms: Terms) -> None:
    """Table of key results."""
    room = headed(canvas, room, "Результаты расчёта")
    worst = pin_stems(Shape.of(terms.model.input))[worst_pin(terms) - 1]
    main = f"main{round(terms.value('worst_main_load'))}"
    keys = [*_RESULTS, f"R{worst}_max_kN", f"q_{worst}_mean", f"R{main}_max_kN", f"q_{main}_mean"]
    rows = [["Величина", "Значение", "Единица"]]
    rows += [
        [capital(terms.title(key)), terms.num(key), terms.unit(key) or "—"]
        for key in keys
        if terms.has(key)
    ]
    grid(canvas, room, rows)


def shaft(canvas: Canvas, room: CellArea, terms: Terms) -> None:
    """Draw the shaft from the side and from the nose with the firing order."""
    crankshaft = terms.model.input.crankshaft
    angles = crankshaft.throw_angles_deg
    offsets, period = crankshaft.firing_offsets_deg, Shape.of(terms.model.input).period
    order = (f"Порядок работы {order_text(offsets, period)}",) if len(offsets) > 1 else ()
    room = headed(canvas, room, "Схема коленчатого вала", order)
    star = min(room.width * 0.16, room.height / 2 - 12)
    side = CellArea(room.left + 4, room.low, room.width - 2 * star - 34, room.height)
    _from_side(canvas, side, angles)
    centre = (room.right - star - 12, room.middle[1])
    _star(canvas, centre, star, angles)


def _from_side(canvas: Canvas, room: CellArea, angles: tuple[float, ...]) -> list[Point]:
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
        journal = room.left + 4 + number * pitch
        half = min(_BEARING, 0.18 * pitch)
        for shift in (-2.0, 2.0):
            canvas.line((journal - half, y + shift), (journal + half, y + shift), layer=CONTOUR)
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
        points = [
            (p[0], p[1] - TEXT / 2)
            for r in (6, 9, 13)
            for p in (polar(centre, radius + r + len(text) * abs(math.sin(math.radians(angle))),
                            angle),)
        ]  # fmt: skip
        canvas.words_where_free(points, text, TEXT, align=0.5)


def _free(terms: Terms) -> Iterator[str]:
    """Lines on the free forces and moments of the orders that matter."""
    if not terms.has("F1_before_max"):
        return
    devices = asked_devices(terms.model.input)
    first, second = ({"counterweight", "first_shafts"} & devices, "second_shafts" in devices)
    for key, unit, word in (("F1", "кН", "Сила"), ("L1", "Н·м", "Момент")):
        before, after = (terms.num(f"{key}_{when}_max") for when in ("before", "after"))
        said = f"до уравновешивания {before}, после {after}" if first else before
        yield f"{word} 1-го порядка и вращающихся масс: {said} {unit}"
    if terms.has("balance_orders.F_order_kN"):
        force, moment = (terms.num(f"balance_orders.{key}", 2.0) for key in _SECOND)
        when = " до балансирных валов" if second else ""
        yield f"2-й порядок{when}: сила {force} кН, момент {moment} Н·м"


def balance(canvas: Canvas, room: CellArea, terms: Terms) -> None:
    """Centrifugal forces of the throws and counterweights; what is left of forces and moments."""
    shaft = terms.model.input.crankshaft
    room = headed(canvas, room, "Схема уравновешивания", tuple(_free(terms)))
    side = CellArea(room.left + 12, room.low + 6, room.width - 24, room.height - 8)
    middles = _from_side(canvas, side, shaft.throw_angles_deg)
    y = side.middle[1]
    for number, (pin, angle) in enumerate(zip(middles, shaft.throw_angles_deg, strict=True)):
        up = 1.0 if pin[1] >= y else -1.0
        if abs(math.cos(math.radians(angle))) > 0.05:
            long = 7.0 * abs(math.cos(math.radians(angle)))
            start = (pin[0] + 4, pin[1])
            canvas.line(start, (start[0], start[1] + up * long), layer=SIZES)
            canvas.arrow((start[0], start[1] + up * (long + 3)), (0.0, up))
        pair = shaft.webs[2 * number : 2 * number + 2]
        if any(web.counterweight_kg for web in pair):
            low = y - up * 0.35 * (side.height / 2 - 10)
            canvas.box(pin[0] - 4, min(low, y - up * 4), pin[0] + 4, max(low, y - up * 4), THIN)
    masses = sorted(web.counterweight_kg for web in shaft.webs)
    mass = "; ".join(dict.fromkeys(map(plain_number, masses)))
    said = f"K_r = {terms.num('K_r')} кН; приведённая масса противовеса щеки {mass} кг"
    height = fitted(said, room.width, TEXT)
    canvas.words((room.middle[0], room.low + 1), said, height, align=0.5)


def throw(canvas: Canvas, room: CellArea, terms: Terms) -> None:
    """Draw the first throw with its sizes."""
    sizes = throw_of(terms)
    _placed(canvas, room, "Колено вала", partial(throw_drawing, sizes))


def mechanism(canvas: Canvas, room: CellArea, terms: Terms) -> None:
    """Draw the mechanism with its sizes."""
    sizes = mechanism_of(terms)
    title = "Кривошипно-шатунный механизм"
    _placed(canvas, room, title, partial(mechanism_drawing, sizes))


def counterweight(canvas: Canvas, room: CellArea, terms: Terms) -> None:
    """Draw a web with the proposed counterweight and its sizes."""
    words = (f"Противовес щеки: {terms.num('cw_mass')} кг, ширина {terms.num('cw_width_mm')} мм, "
             f"доля {terms.num('cw_taken')}")  # fmt: skip
    _placed(canvas, room, words, partial(counterweight_drawing, counterweight_of(terms)))


def flywheel(canvas: Canvas, room: CellArea, terms: Terms) -> None:
    """Draw the flywheel with its sizes."""
    words = f"Маховик: {terms.num('fw_mass')} кг, {terms.num('I_flywheel')} кг·м²"
    _placed(canvas, room, words, partial(flywheel_drawing, flywheel_of(terms)))


def strength(canvas: Canvas, room: CellArea, terms: Terms) -> None:
    """Safeties of the parts beside the allowed one, and stresses beside their usual range."""
    room = headed(canvas, room, "Прочность деталей")
    blocks = {b.id: b for b in terms.model.blocks if isinstance(b, ScalarTable)}
    least = f"не менее {terms.num('strength_safety_allowed')}"
    rows = [["Запас или напряжение", "Значение", "Предел"]]
    rows += [[value.note, fixed(terms.value(value.key), 2), least]
             for value, _ in blocks["strength_allowed"].pairs]  # fmt: skip
    ranged = [pair for pair in blocks["strength_ranges"].pairs if pair[0].expr in _STRESSES]
    rows += [[value.note, fixed(terms.value(value.key), 1), value.usual_text]
             for value, _ in ranged]  # fmt: skip
    grid(canvas, room, rows)


def _placed(canvas: Canvas, room: CellArea, title: str, draw: Callable[..., list[Item]]) -> None:
    """A drawing in the middle of a room at the largest scale that fits, in small letters at last.

    Raises:
        ValueError: no scale is small enough.
    """
    free = headed(Canvas(), room, title, ("М 1:1",))
    for letters, scale in itertools.product(_LETTERS, _SCALES):
        items = draw(scale=scale, letters=letters)
        left, low, right, high = bounds(items)
        if right - left <= free.width and high - low <= free.height:
            headed(canvas, room, title, (_said(scale),))
            shift = free.middle[0] - (left + right) / 2, free.middle[1] - (low + high) / 2
            canvas.items += moved(items, *shift)
            return
    msg = f"no scale for {title} in {free.width:.0f} × {free.height:.0f} mm"
    raise ValueError(msg)


def _said(scale: float) -> str:
    """Return a scale as it stands on a drawing: ``М 1:2,5``."""
    ratio = max(scale, 1 / scale)
    text = fixed(ratio, 0 if abs(ratio - round(ratio)) < 1e-6 else 1)
    return f"М {text}:1" if scale > 1 else f"М 1:{text}"
