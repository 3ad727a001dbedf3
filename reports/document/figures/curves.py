"""Charts in rectangular coordinates: curves over an abscissa, panels, p-V."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reports.document.figures.axes import Axes, Ticks, angle_ticks, at_steps, bounds, value_ticks
from reports.document.figures.canvas import (
    EDGE,
    FONT_SIZE,
    GRID,
    PAGE_WIDTH,
    PATTERNS,
    SMALL,
    LineStyle,
    Pen,
    Sheet,
)
from reports.document.figures.labels import (
    LabelField,
    Points,
    dense,
    label_curve,
    label_point,
    text_size,
)

LETTERS = "абвгдежиклмнпрстуфхцшщэюя"  # without з, о, ё, й, ъ, ы, ь, as the standard lists them
_BOTTOM, _TOP, _BETWEEN = 20.0, 22.0, 38.0  # pt below, above and between the panels
_LEVEL = LineStyle(0.9, (12, 3, 2, 3))
# Of a legend [pt]: length of its lines, the gap before a name, between columns, between rows.
_SAMPLE, _GAP, _COLUMNS_GAP, LEGEND_ROW = 30.8, 8.8, 15.4, 16.5
_IN_ROW, _INSET = 4, 3.3
_NEAR = 1 / 3  # of its length, the abscissa's beginning from which it is drawn from zero
_BESIDE, _DOT = 4.0, 3.4  # pt between the stems of one order; dots at their ends
_THIN = LineStyle(0.6, (5, 2.5))
_RAY, _LEADER, _FAN_ROW, _LOUD = LineStyle(0.9), 16.0, 13.0, 2.8  # of a fan, and its mark [pt]


@dataclass(frozen=True, slots=True)
class PlotCurve:
    """A curve: its name (``$…$`` for symbols) and ordinates."""

    name: str
    y: ArrayLike


@dataclass(frozen=True, slots=True)
class Level:
    """A horizontal line across a chart, such as a mean, with its name."""

    name: str
    y: float


@dataclass(frozen=True, slots=True)
class Mark:
    """A point worth naming, such as an extreme or z on the indicator diagram."""

    name: str
    x: float
    y: float


@dataclass(frozen=True, slots=True)
class Panel:
    """One plot: ``zero`` is taken into the ordinate, ``points`` get dots, ``stems`` no curves.

    The curves of a ``fan`` are alike and have their names at their ends, in a column.
    """

    curves: Sequence[PlotCurve]
    y_title: str
    levels: Sequence[Level] = ()
    marks: Sequence[Mark] = ()
    zero: bool = True
    points: Sequence[tuple[ArrayLike, ArrayLike]] = ()
    stems: bool = False
    fan: bool = False

    def ordinates(self, size: int) -> list[NDArray[np.float64]]:
        """Return the curves as arrays, shape (size,) each.

        Raises:
            ValueError: A curve has another number of values.
        """
        columns = [np.asarray(curve.y, dtype=np.float64) for curve in self.curves]
        for curve, column in zip(self.curves, columns, strict=True):
            if column.shape != (size,):
                msg = f"Кривая «{curve.name}»: {column.shape} значений при {size} абсциссах"
                raise ValueError(msg)
        return columns

    def bounds(self) -> tuple[float, float]:
        """Least and greatest ordinate of all that is drawn."""
        drawn = (*(curve.y for curve in self.curves), *(y for _, y in self.points))
        columns = [np.asarray(y, dtype=np.float64).tolist() for y in drawn]
        return bounds(
            [*columns, [level.y for level in self.levels], [mark.y for mark in self.marks]]
        )


def curves_figure(
    x: ArrayLike,
    panels: Sequence[Panel],
    x_title: str,
    *,
    height: float = 76.0,
    angle: bool = True,
    x_step: float | None = None,
    same_scale: bool = False,
) -> str:
    """Panels over one abscissa, one above the other, as SVG; several are lettered а, б, в ….

    Args:
        x: Abscissa, shape (n,).
        panels: Curves and ordinate of each panel.
        x_title: Name and unit of the abscissa, set under the lowest panel.
        height: Height of a panel [mm].
        angle: Marks at multiples of 30, 60, 90, 120.
        x_step: Step of the marks instead of the one chosen; the axis ends where the curves do.
        same_scale: One range of ordinates for all panels.

    Raises:
        ValueError: Shapes differ or a value is not finite.
    """
    abscissa = np.asarray(x, dtype=np.float64)
    for panel in panels:
        panel.ordinates(abscissa.size)
    low, high = bounds([abscissa.tolist()])
    stepped = angle or x_step is not None
    x_ticks = (
        angle_ticks(low, high, step=x_step) if stepped
        else value_ticks(low, high, zero=low < _NEAR * (high - low))
    )  # fmt: skip
    ranges = [panel.bounds() for panel in panels]
    if same_scale:
        ranges = [bounds(ranges)] * len(ranges)
    y_ticks = [
        value_ticks(*pair, count=max(3, round(height / 13)), zero=panel.zero)
        for pair, panel in zip(ranges, panels, strict=True)
    ]
    left = max(ticks.width() for ticks in y_ticks) + 8
    right = text_size(x_title, FONT_SIZE)[0] + x_ticks.beyond() + 3
    right = max(right, *(_fan_width(panel) for panel in panels))
    # Rows of a legend above the first; those of the other panels stand between them.
    legends = 0 if panels[0].fan else max(len(panels[0].curves) - 1, 0) // _IN_ROW
    top = _TOP + LEGEND_ROW * legends
    page = Sheet(PAGE_WIDTH, height * len(panels))
    room = page.height - _BOTTOM - top - _BETWEEN * (len(panels) - 1)
    tall = room / len(panels)
    for index, (panel, ticks) in enumerate(zip(panels, y_ticks, strict=True)):
        base = page.height - top - tall - index * (tall + _BETWEEN)
        field = (left, base, page.width - right, base + tall)
        axes = Axes(page, field, x_ticks, ticks)
        _plot(axes, abscissa, panel)
        if len(panels) > 1:
            middle = ((field[0] + field[2]) / 2, field[3] + 7)
            page.text(middle, f"{LETTERS[index]})", middle=False)
    axes.name_x(x_title)
    return page.svg()


def _plot(axes: Axes, x: NDArray[np.float64], panel: Panel) -> None:
    axes.dress(edges=(EDGE, EDGE if axes.y.low >= 0 else GRID))
    axes.name_y(panel.y_title)
    lines = [axes.at(x, y) for y in panel.ordinates(x.size)]
    for number, line in enumerate(lines):
        look = _RAY if panel.fan else PATTERNS[number % len(PATTERNS)]
        if panel.stems:
            beside = _BESIDE * (number - (len(lines) - 1) / 2)
            _stems(axes, line + np.array([beside, 0.0]), look)
        else:
            axes.page.line(line, look)
    for number, points in enumerate(panel.points):
        # Segments of no length, which round caps make dots.
        dots = np.repeat(axes.at(*points), 2, axis=0).reshape(-1, 2, 2)
        colour = PATTERNS[number % len(PATTERNS)].colour
        axes.page.lines(dots, LineStyle(2.2, colour=colour, cap="round"))
    for level in panel.levels:
        axes.level(level.y, _LEVEL)
    _name(axes, panel, lines)


def _stems(axes: Axes, tops: NDArray[np.float64], look: LineStyle) -> None:
    """Draw a line from zero to each value, a dot at its end; nothing where the value is zero."""
    feet = np.column_stack([tops[:, 0], np.full(len(tops), axes.at(0.0, 0.0)[1])])
    seen = np.abs(tops - feet)[:, 1] > _DOT / 2
    axes.page.lines(np.stack([feet, tops], axis=1)[seen], replace(look, cap="butt"))
    dots = np.repeat(tops[seen], 2, axis=0).reshape(-1, 2, 2)
    axes.page.lines(dots, LineStyle(_DOT, colour=look.colour, cap="round"))


def _name(axes: Axes, panel: Panel, lines: Sequence[Points]) -> None:
    """Names of marks, levels and curves in order of priority."""
    left, low, right, high = axes.field
    room = LabelField((left + 2, low + 2, right - 2, high - 2))
    lines = [dense(line) for line in lines]
    ends = (axes.x.low, axes.x.high)
    across = [dense(axes.at(ends, y)) for y in (*(level.y for level in panel.levels), 0.0)]
    room.curves += [*lines, *across]
    for mark in panel.marks:
        _mark(
            axes, room, axes.at(mark.x, mark.y).tolist(), mark.name, loud=panel.fan or panel.stems
        )
    for level, line in zip(panel.levels, across, strict=False):
        centre = label_curve(room, line, lines, text_size(level.name, FONT_SIZE))
        if centre:
            axes.page.text(centre, level.name, halo=True)
    if panel.fan:
        _fan(axes, panel.curves, lines)
    if len(panel.curves) < 2 or panel.fan:
        return
    points = []
    for curve, line in () if panel.stems else zip(panel.curves, lines, strict=True):
        others = [other for other in lines if other is not line]
        points.append(label_curve(room, line, others, text_size(curve.name, FONT_SIZE)))
    if points and all(points):
        for curve, centre in zip(panel.curves, points, strict=True):
            axes.page.text(centre or (0, 0), curve.name, halo=True)
    else:
        legend(axes, [curve.name for curve in panel.curves])


def legend(axes: Axes, names: Sequence[str], *, in_row: int = _IN_ROW, above: float = 0.0) -> None:
    """Draw samples of the lines with their names so far above the field [pt], four to a row."""
    shares = np.array_split(np.arange(len(names)), min(in_row, len(names)))
    columns = [share.tolist() for share in shares]
    x, top = (
        axes.field[2] - _INSET,
        axes.field[3] + above + _INSET / 3 + len(columns[0]) * LEGEND_ROW,
    )
    for column in reversed(columns):
        x -= max(text_size(names[n], FONT_SIZE)[0] for n in column)
        for row, n in enumerate(column):
            y = top - (row + 0.7) * LEGEND_ROW
            axes.page.text((x, y), names[n], align=0.0, middle=False)
            sample = [(x - _GAP - _SAMPLE, y + 3.85), (x - _GAP, y + 3.85)]
            axes.page.line(sample, PATTERNS[n % len(PATTERNS)])
        x -= _GAP + _SAMPLE + _COLUMNS_GAP


def _mark(
    axes: Axes, room: LabelField, point: tuple[float, float], name: str, *, loud: bool = False
) -> None:
    """Draw a point with its name; a ``loud`` one is the subject of the figure."""
    size, way = (FONT_SIZE, (1.0, -1.0)) if loud else (SMALL, (1.0, 1.0))
    axes.page.circle((point[0], point[1]), _LOUD if loud else 1.6, "#000000", None, 4)
    gaps = (5.0, 9.0, 14.0, 20.0, 30.0, 45.0) if loud else (2.5, 5.0, 9.0, 14.0, 20.0)
    around = (point[0], point[1])
    centre = label_point(room, around, text_size(name, size), first=way, gaps=gaps)
    if centre:
        axes.page.text(centre, name, size, halo=True)


def _fan_width(panel: Panel) -> float:
    """Width of the names at the ends of a fan [pt]."""
    names = (text_size(curve.name, FONT_SIZE)[0] for curve in panel.curves if panel.fan)
    return max(names, default=-_LEADER) + _LEADER


def _fan(axes: Axes, curves: Sequence[PlotCurve], lines: Sequence[Points]) -> None:
    """Place the names of a fan at the right edge, in the order of the ends, without overlap."""
    ends = [line[-1].tolist() for line in lines]
    rising = sorted(range(len(ends)), key=lambda n: ends[n][1])
    places = spread([ends[n][1] for n in rising], _FAN_ROW, axes.field[1], axes.field[3])
    edge = axes.field[2] + _LEADER
    for number, y in zip(rising, places, strict=True):
        axes.page.lines([[tuple(ends[number]), (edge - 3, y)]], _THIN, 1.2)
        axes.page.text((edge, y), curves[number].name, align=0.0)


def spread(wanted: Sequence[float], gap: float, low: float, high: float) -> list[float]:
    """Return places near the wanted ones, which rise, not closer together than a gap.

    >>> spread([1.0, 1.0, 9.0], 2.0, 0.0, 10.0)
    [0.0, 2.0, 9.0]
    """
    runs: list[tuple[float, int]] = []  # middle and count of places in a row

    def held(middle: float, count: int) -> float:
        half = gap * (count - 1) / 2
        return min(max(middle, low + half), high - half)

    for ordinate in wanted:
        runs.append((held(ordinate, 1), 1))
        while len(runs) > 1:
            (one, first), (other, second) = runs[-2:]
            if other - one >= gap * (first + second) / 2 - 1e-9:
                break
            middle = (one * first + other * second) / (first + second)
            runs[-2:] = [(held(middle, first + second), first + second)]
    return [middle + gap * (n - (count - 1) / 2) for middle, count in runs for n in range(count)]


@dataclass(frozen=True, slots=True)
class ScaledCurve:
    """A curve with a scale of its own over some rows of a common grid.

    Attributes:
        curve: Name and ordinates.
        title: Name and unit of its scale.
        rows: First row of the grid, from below, and their number.
        right: The scale stands at the right edge.
        zero: The scale begins at zero.
        marks: Points with a line to the abscissa and, at the left, to the scale.
        rise: Name of the distance from the last marked point up to the first.
    """

    curve: PlotCurve
    title: str
    rows: tuple[int, int]
    right: bool = False
    zero: bool = False
    marks: Sequence[Mark] = ()
    rise: str = ""


def bands_figure(
    x: ArrayLike,
    bands: Sequence[ScaledCurve],
    x_title: str,
    *,
    height: float = 110.0,
    x_step: float | None = None,
) -> str:
    """Curves over one abscissa in one field, each to a scale of its own, as SVG.

    Args:
        x: Abscissa, shape (n,).
        bands: The curves, from below; one may end before the abscissa.
        x_title: Name and unit of the abscissa.
        height: Height of the figure [mm].
        x_step: Step of the marks of the abscissa.
    """
    abscissa = np.asarray(x, dtype=np.float64)
    x_ticks = angle_ticks(*bounds([abscissa.tolist()]), step=x_step)
    scales = [_scale(np.asarray(b.curve.y), b.rows[1], zero=b.zero) for b in bands]
    rows = max(first + count for first, count in (band.rows for band in bands))
    page = Sheet(PAGE_WIDTH, height)
    sides = [0.0, text_size(x_title, FONT_SIZE)[0] + x_ticks.beyond()]
    for band, ticks in zip(bands, scales, strict=True):
        wide = max(ticks.width(), text_size(band.title, FONT_SIZE)[0])
        sides[band.right] = max(sides[band.right], wide)
    field = (sides[0] + 8, _BOTTOM, page.width - sides[1] - 8, page.height - _TOP)
    step = (field[3] - field[1]) / rows
    blank = Ticks(tuple(range(rows + 1)), ("",) * (rows + 1))
    whole = Axes(page, field, x_ticks, blank)
    whole.dress()
    page.line([(field[2], field[1]), (field[2], field[3])], EDGE, 2.5)
    room = LabelField((field[0] + 2, field[1] + 2, field[2] - 2, field[3] - 2))
    lines = []
    for number, (band, ticks) in enumerate(zip(bands, scales, strict=True)):
        base = field[1] + band.rows[0] * step
        frame = (field[0], base, field[2], base + band.rows[1] * step)
        axes = Axes(page, frame, x_ticks, ticks)
        axes.number_y(right=band.right, title=band.title)
        ordinate = np.asarray(band.curve.y, dtype=np.float64)
        line = axes.at(abscissa[: len(ordinate)], ordinate)
        page.line(line, PATTERNS[number % len(PATTERNS)])
        lines.append(dense(line))
        room.curves.append(lines[-1])
        _points(axes, room, band, field[1])
    for band, line in zip(bands, lines, strict=True):
        others = [other for other in lines if other is not line]
        centre = label_curve(room, line, others, text_size(band.curve.name, FONT_SIZE))
        if centre:
            page.text(centre, band.curve.name, halo=True)
    whole.name_x(x_title)
    return page.svg()


def _scale(y: NDArray[np.float64], count: int, *, zero: bool) -> Ticks:
    """Return marks of exactly so many intervals that hold a curve."""
    low, high = bounds([y.tolist()])
    low = 0.0 if zero else low
    least = max(high - low, 1e-9 * max(1.0, abs(high))) / count
    power = 10.0 ** math.floor(math.log10(least))
    for step in (factor * size for size in (power, 10 * power) for factor in (1, 2, 2.5, 5)):
        first = math.floor(low / step + 1e-9)
        if (first + count) * step >= high * (1 - 1e-9):
            return at_steps(first, count + 1, step)
    return at_steps(math.floor(low / (100 * power)), count + 1, 100 * power)


def _points(axes: Axes, room: LabelField, band: ScaledCurve, foot: float) -> None:
    """Draw marked points of a band with thin lines to its scale and to the abscissa."""
    points = [tuple(axes.at(mark.x, mark.y).tolist()) for mark in band.marks]
    for x, y in points:
        axes.page.lines([[(axes.field[0], y), (x, y)], [(x, y), (x, foot)]], _THIN, 1.2)
        room.curves.append(dense(np.array([(axes.field[0], y), (x, y)])))
    if band.rise and len(points) > 1:
        (x, low), top = points[-1], points[0][1]
        axes.page.lines([[points[0], (x, top)]], _THIN, 1.2)
        Pen(axes.page, 3).arrow((x, low), (x, top), 0.8, 6)
        room.curves.append(dense(np.array([points[0], (x, top), (x, low)])))
    for (x, y), mark in zip(points, band.marks, strict=True):
        axes.page.circle((x, y), 1.6, "#000000", None, 4)
        across = dense(np.array([(axes.field[0], y), (x, y)]))
        centre = label_curve(room, across, room.curves[:-1], text_size(mark.name, SMALL))
        if centre:
            axes.page.text(centre, mark.name, SMALL, halo=True)
    if band.rise and len(points) > 1:
        middle = (points[-1][0], (points[-1][1] + points[0][1]) / 2)
        centre = label_point(room, middle, text_size(band.rise, SMALL), first=(-1.0, 0.0))
        if centre:
            axes.page.text(centre, band.rise, SMALL, halo=True)
