"""Diagrams of the sheet in round scales: curves, paths of a vector, wear."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import cast

import numpy as np
from numpy.typing import NDArray

from kshm.nomenclature.quantity import roman
from reports.document.chapters.chapter import worst_pin
from reports.document.chapters.oil_hole import oil_hole
from reports.document.figures.polar import outline
from reports.document.page.charts import ordinate
from reports.document.text.mathsvg import plain
from reports.document.text.terms import Terms
from reports.draw.canvas import (
    AXES,
    CENTRE,
    CONTOUR,
    CURVES,
    DASHED,
    DOTTED,
    GRID,
    THIN,
    Box,
    Canvas,
    Dash,
    Point,
    Words,
    polar,
)
from reports.draw.fonts import fitted, width_of
from reports.formula.numeric import evaluate
from reports.model.charts import ChartSpec, Series
from reports.shared.russian import fixed
from reports.sheet.cell import TEXT, CellArea, Name, headed, legend

_ROUND = (1.0, 2.0, 2.5, 4.0, 5.0)  # digits of the scales of ГОСТ 2.302
_ANGLE_STEPS = (0.5, 1.0, 2.0, 2.5, 4.0, 5.0, 10.0, 20.0, 25.0, 40.0)
STEP = 10.0  # mm between the lines of the grid
_DASHES: tuple[Dash, ...] = ((), DASHED, CENTRE, DOTTED, (8.0, 2.0, 3.0, 2.0))
_ANGLES = (15.0, 30.0, 45.0, 60.0, 90.0, 120.0, 180.0)
_POLE, _FAR = 1.2, 9.0  # radius of a pole; how far its name stands without a line to it
_SIDE, _FOOT = 16.0, 9.0  # room for marks left of and below a diagram
Values = NDArray[np.float64]
_GROUP = re.compile(r"_\(([^)]*)\)")
_SYMBOL = re.compile(r"\$([^$]*)\$")


@dataclass(frozen=True, slots=True)
class Scale:
    """Values along an axis: ``unit`` in a millimetre, from ``low`` to ``high``."""

    unit: float
    low: float
    high: float

    @property
    def length(self) -> float:
        """Length of the axis [mm]."""
        return (self.high - self.low) / self.unit

    def at(self, value: float) -> float:
        """Distance of a value from the beginning of the axis [mm]."""
        return (value - self.low) / self.unit

    def marks(self) -> list[float]:
        """Values at the lines of the grid."""
        count = round(self.length / STEP)
        return [self.low + n * STEP * self.unit for n in range(count + 1)]

    def text(self, value: float) -> str:
        """Return a value at a line of the grid as it is written."""
        return fixed(value, decimals(STEP * self.unit))


def round_scale(low: float, high: float, room: float, *, angle: bool = False) -> Scale:
    """Return the largest round scale at which values fit a room [mm]; ends at lines of the grid."""
    units = iter(_ANGLE_STEPS) if angle else _units((high - low) / room)
    for unit in units:
        step = STEP * unit
        ends = (math.floor(low / step + 1e-9) * step, math.ceil(high / step - 1e-9) * step)
        scale = Scale(unit, ends[0], ends[1] if ends[1] > ends[0] else ends[0] + step)
        if angle:
            scale = Scale(unit, low, high)
        if scale.length <= room + 1e-9:
            return scale
    raise ValueError(f"no scale for {low}…{high} in {room} mm")


def _units(least: float) -> Iterator[float]:
    power = math.floor(math.log10(least)) if least > 0 else -3
    for exponent in range(power - 1, power + 4):
        for digit in _ROUND:
            unit = digit * 10.0**exponent
            if unit >= least * 0.999:
                yield unit


def decimals(step: float) -> int:
    """Decimals that a step of round digits needs."""
    return next((n for n in range(9) if abs(round(step, n) - step) < 1e-9 * step), 9)


def unit_text(unit: float) -> str:
    """Return a scale as it is written."""
    return fixed(unit, decimals(unit))


def symbol(terms: Terms, name: str) -> str:
    """Symbol of a quantity with its index behind a stroke below, as drawings take it."""
    return drawn_symbol(terms.tex(name))


def drawn_symbol(tex: str) -> str:
    """Return a TeX symbol for a drawing: «R′_ш.ш.ср»."""
    text = _GROUP.sub(lambda group: "_" + group[1].replace(" ", "."), plain(tex))
    return text.replace("'", "′").replace(" ", "")


def _unit(terms: Terms, name: str) -> str:
    unit = terms.unit(name)
    return f"{symbol(terms, name)}, {unit}" if unit else symbol(terms, name)


def curves(canvas: Canvas, room: CellArea, terms: Terms, chart: ChartSpec, *, closed: bool) -> None:
    """Columns over an abscissa, with means and other levels across."""
    drawn = chart.drawn_by("report")
    same = [series for series in drawn if series.x == drawn[0].x]
    x, *ys = terms.curves([drawn[0].x, *(series.y for series in same)])
    xs = [x] * len(same)
    for series in drawn[len(same) :]:  # a curve that goes on in another table
        xs.append(terms.column(series.x))
        ys.append(terms.column(series.y))
    levels = [terms.value(level) for level in chart.levels]
    room = headed(canvas, room, chart.words)
    names = [Name(symbol(terms, s.y), _DASHES[n % len(_DASHES)]) for n, s in enumerate(drawn)]
    names += [Name(f"{symbol(terms, n)} = {terms.num(n)} {terms.unit(n)}", CENTRE)
              for n in chart.levels]  # fmt: skip
    if len(names) > 1:
        room = legend(canvas, room, names)
    title = _SYMBOL.sub(lambda match: drawn_symbol(match[1]), ordinate(terms, chart, drawn))
    wide = width_of(_unit(terms, drawn[0].x), TEXT) + 8
    low, high = _ends([*ys, np.asarray(levels)], zero=chart.from_zero)
    left, right = min(float(each.min()) for each in xs), max(float(each.max()) for each in xs)
    across = round_scale(
        min(left, 0.0), right, room.width - _SIDE - wide, angle=chart.x_is_angle
    )  # fmt: skip
    up = round_scale(low, high, room.height - _FOOT - 2 * TEXT - 4)
    of_y, of_x = terms.unit(drawn[0].y), terms.unit(drawn[0].x)
    said = f"{title} (М {unit_text(up.unit)} {of_y}/мм; по горизонтали {unit_text(across.unit)} {of_x}/мм)"  # noqa: E501
    canvas.words((room.left + 2, room.high - TEXT - 1), said, TEXT)
    base = room.low + _FOOT
    origin = (_whole(room.left + _SIDE), _whole(base))
    _field(canvas, origin, across, up, chart.x_is_angle)
    level = up.at(0 if low <= 0 <= high else up.low)
    end = (origin[0] + across.length + 5.5, origin[1] + level - TEXT / 2)
    canvas.words(end, _unit(terms, drawn[0].x), TEXT)
    for number, (series, along, y) in enumerate(zip(drawn, xs, ys, strict=True)):
        points = _points(origin, across, up, along, y)
        dash = _DASHES[number % len(_DASHES)]
        name = f"{chart.id}:{series.y}"
        canvas.line(*points, layer=CURVES, dash=dash, closed=closed, name=name)
    for level in levels:
        high = origin[1] + up.at(level)
        canvas.line((origin[0], high), (origin[0] + across.length, high), layer=AXES)


def _whole(value: float) -> float:
    """Return a place on the grid of millimetres."""
    return float(round(value))


def _ends(columns: Sequence[Values], *, zero: bool) -> tuple[float, float]:
    low = min(float(c.min()) for c in columns if c.size)
    high = max(float(c.max()) for c in columns if c.size)
    return (min(low, 0.0), max(high, 0.0)) if zero or low < 0 < high else (low, high)


def _points(origin: Point, across: Scale, up: Scale, x: Values, y: Values) -> list[Point]:
    xs, ys = origin[0] + across.at(x), origin[1] + up.at(y)  # type: ignore[arg-type]
    return list(zip(xs.tolist(), ys.tolist(), strict=True))  # type: ignore[attr-defined]


def _field(canvas: Canvas, origin: Point, across: Scale, up: Scale, angle: bool) -> None:
    """Grid, axes and marks of a rectangular diagram."""
    (left, base), right, top = origin, origin[0] + across.length, origin[1] + up.length
    for value in up.marks():
        y = base + up.at(value)
        canvas.line((left, y), (right, y), layer=GRID)
        canvas.words((left - 1.5, y - TEXT / 2), up.text(value), TEXT, align=1.0)
    marks = across.marks()
    if angle:
        step = next(s for s in _ANGLES if s / across.unit >= 1.5 * STEP)
        marks = list(np.arange(across.low, across.high + 1e-9, step))
    for number, value in enumerate(marks):
        x = left + across.at(value)
        canvas.line((x, base), (x, top), layer=GRID)
        text = fixed(value, 0) if angle else across.text(value)
        if angle or number % 2 == 0:
            canvas.words((x, base - TEXT - 3.8), text, TEXT, align=0.5)
    zero = base + up.at(0.0) if up.low <= 0 <= up.high else base
    canvas.line((left, zero), (right + 4, zero), layer=THIN)
    canvas.arrow((right + 4, zero), (1.0, 0.0), layer=THIN)
    canvas.line((left, base), (left, top + 4), layer=THIN)
    canvas.arrow((left, top + 4), (0.0, 1.0), layer=THIN)


def path(canvas: Canvas, room: CellArea, terms: Terms, chart: ChartSpec) -> None:
    """Path of a force's end in one scale with the pole and the crank angles."""
    (drawn,) = chart.drawn_by("report")
    x, y = terms.curves([drawn.x, drawn.y])
    signs = (-1.0 if chart.x_reversed else 1.0, -1.0 if chart.y_reversed else 1.0)
    poles = {"O": 0.0} | {
        drawn_symbol(tex): signs[1] * float(evaluate(expr, terms.value))
        for tex, expr in chart.poles
    }
    room = headed(canvas, room, chart.words)
    xs, ys = signs[0] * x, signs[1] * y
    across, up = _equal(xs, [*poles.values(), *ys], room)
    titles = _unit(terms, drawn.x), _unit(terms, drawn.y)
    said = f"М {unit_text(up.unit)} {terms.unit(drawn.y)}/мм; вправо {'−' if signs[0] < 0 else ''}{titles[0]}, вверх {'−' if signs[1] < 0 else ''}{titles[1]}"  # noqa: E501
    canvas.words((room.middle[0], room.high - TEXT - 1), said,
                 fitted(said, room.width, TEXT), align=0.5)  # fmt: skip
    origin = (_whole(room.middle[0] - across.length / 2 + 5), _whole(room.low + _FOOT))
    _square(canvas, origin, across, up, signs)
    points = _points(origin, across, up, xs, ys)
    canvas.line(*points, layer=CURVES, closed=True, name=f"{chart.id}:{drawn.y}")
    frame = (origin[0], origin[1], origin[0] + across.length, origin[1] + up.length)
    marks = [(origin[0] + across.at(0.0), origin[1] + up.at(pole)) for pole in poles.values()]
    # Beyond a narrow grid rather than over the curve.
    _poles(
        canvas, dict(zip(poles, marks, strict=True)), (room.left, room.low, room.right, frame[3])
    )
    _angles(canvas, terms, drawn, (origin, across, up, signs), frame)


def _poles(canvas: Canvas, poles: dict[str, Point], within: Box) -> None:
    """Small circles, each with its name nearer to it than to the others, or at a thin line."""
    for pole in poles.values():
        canvas.circle(pole, _POLE, layer=CONTOUR)
    for name, pole in poles.items():
        half = width_of(name, TEXT) / 2
        middles = {
            at: (at[0] + half, at[1] + TEXT / 2)
            for at in _beside(pole, name, TEXT, (45, 135, -45, -135, 90, -90), (2.5, 5, 8, 12, 18))
        }
        poles_inside = [at for at, middle in middles.items()
               if min(poles.values(), key=partial(math.dist, middle)) == pole]  # fmt: skip
        if not canvas.words_where_free(poles_inside, name, TEXT, within):
            continue
        middle = middles[cast(Words, canvas.items[-1]).place]
        far = math.dist(pole, middle)
        if far > _FAR:
            along = np.subtract(middle, pole) / far
            ends = pole + np.outer((_POLE, far - half - 0.5), along)
            canvas.line(*map(tuple, ends.tolist()), layer=THIN)


def _equal(xs: Values, ys: Sequence[float], room: CellArea) -> tuple[Scale, Scale]:
    """Scales of one unit by which both extents fit."""
    spans = (min(0.0, float(xs.min())), max(0.0, float(xs.max()))), (min(0.0, *ys), max(0.0, *ys))
    free = room.width - 24, room.height - _FOOT - 2 * TEXT - 4
    unit = max(round_scale(*span, size).unit for span, size in zip(spans, free, strict=True))
    while True:
        step = STEP * unit
        scales = []
        for low, high in spans:
            first, last = np.floor(low / step + 1e-9), np.ceil(high / step - 1e-9)
            scales.append(Scale(unit, first * step, max(last, first + 2) * step))
        if all(s.length <= size + 1e-9 for s, size in zip(scales, free, strict=True)):
            return scales[0], scales[1]
        unit = round_scale(0.0, unit * 1.001, 1.0).unit


def _square(canvas: Canvas, origin: Point, across: Scale, up: Scale, signs: Point) -> None:
    left, base = origin
    widest = max(width_of(across.text(signs[0] * value), TEXT) for value in across.marks())
    for number, value in enumerate(across.marks()):
        x = left + across.at(value)
        canvas.line((x, base), (x, base + up.length), layer=GRID)
        if widest < 0.9 * STEP or number % 2 == 0:
            text = across.text(signs[0] * value)
            canvas.words((x, base - TEXT - 3.8), text, TEXT, align=0.5)
    for value in up.marks():
        y = base + up.at(value)
        canvas.line((left, y), (left + across.length, y), layer=GRID)
        canvas.words((left - 1.5, y - TEXT / 2), up.text(signs[1] * value), TEXT, align=1.0)
    x, y = left + across.at(0.0), base + up.at(0.0)
    canvas.line((x, base), (x, base + up.length), layer=AXES)
    canvas.line((left, y), (left + across.length, y), layer=AXES)


def _angles(
    canvas: Canvas, terms: Terms, drawn: Series,
    placed: tuple[Point, Scale, Scale, Point], frame: Box,
) -> None:  # fmt: skip
    """Crank angles beside the points of the table, the rounder ones first."""
    origin, across, up, signs = placed
    rows = np.asarray(terms.model.tables[drawn.x.partition(".")[0]].rows, dtype=float)[:-1]
    xs, ys = signs[0] * terms.column(drawn.x)[:-1], signs[1] * terms.column(drawn.y)[:-1]
    points = _points(origin, across, up, xs, ys)
    centre = np.mean(points, axis=0)
    said: set[int] = set()
    for step in (90.0, 30.0):
        for row in np.flatnonzero(np.abs(np.remainder(rows + 1e-6, step)) < 1e-3).tolist():
            if row in said:
                continue
            (x, y), text = points[row], f"{fixed(rows[row], 0)}°"
            away = math.degrees(math.atan2(x - centre[0], y - centre[1]))
            turns = [away + aside for aside in (0, 180, 45, -45, 90, -90)]
            positions = _beside((x, y), text, 2.5, turns)
            if canvas.words_where_free(positions, text, 2.5, frame, crossed=False):
                canvas.circle((x, y), 0.5, layer=THIN, filled=True)
                said.add(row)


def _beside(
    point: Point,
    text: str,
    height: float,
    turns: Sequence[float],
    afar: Sequence[float] = (2.5, 5, 8),
) -> list[Point]:
    """Places of a text around a point, the near ones first; angles clockwise from above [deg]."""
    half = width_of(text, height) / 2
    ways = [(math.sin(math.radians(turn)), math.cos(math.radians(turn))) for turn in turns]
    return [
        (point[0] + across * (far + half) - half, point[1] + up * far - height / 2)
        for far in afar for across, up in ways
    ]  # fmt: skip


def wear(canvas: Canvas, room: CellArea, terms: Terms, chart: ChartSpec) -> None:
    """Draw sums of the forces laid off from the journal's circle inwards in a round scale."""
    grid = chart.series[0].x.partition(".")[0]
    sums, rays = (
        np.array([terms.value(key) for key in terms.model.grid_runs[f"{grid}.{of}"][:-1]])
        for of in ("ray_sum", "ray_deg")
    )
    room = headed(canvas, room, chart.words)
    radius = _whole(min(room.width, room.height - 3 * TEXT - 4) / 2 - 10)
    scale = round_scale(0.0, float(sums.max()) or 1.0, 0.62 * radius)
    unit = scale.unit
    holes, angle = _holes(terms, chart)
    said = f"М {unit_text(unit)} МПа/мм; отверстие {angle}"
    canvas.words((room.middle[0], room.high - TEXT - 1), said, TEXT, align=0.5)
    centre = (_whole(room.middle[0]), _whole(room.low + radius + 10))
    canvas.circle(centre, radius, layer=CONTOUR)
    angles = rays + 180.0
    points = [
        polar(centre, radius - depth / unit, -angle) for angle, depth in outline(sums, angles)
    ]
    canvas.line(*points, layer=CURVES, closed=True, name=f"{chart.id}:{grid}.ray_sum")
    for number, (angle, depth) in enumerate(zip(angles.tolist(), sums.tolist(), strict=True), 1):
        canvas.line(centre, polar(centre, radius + 3, -angle), layer=AXES)
        canvas.circle(polar(centre, radius - depth / unit, -angle), 0.6, layer=THIN, filled=True)
        anchor = polar(centre, radius + 6.5, -angle)
        canvas.words((anchor[0], anchor[1] - TEXT / 2), roman(number), TEXT, align=0.5)
    for hole in holes:
        ends = (polar(centre, share * radius, -hole) for share in (0.55, 1.0))
        canvas.line(*ends, layer=CONTOUR)


def _holes(terms: Terms, chart: ChartSpec) -> tuple[tuple[float, ...], str]:
    """Angles of the oil hole [deg] and their text; of the crankpin what the note concludes."""
    if not chart.hole.startswith("hole_pin"):
        return (terms.value(chart.hole),), f"{terms.num(chart.hole)}°"
    hole = oil_hole(terms, worst_pin(terms))
    return hole.angles, hole.text
