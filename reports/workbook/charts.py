"""Native Excel charts from chart specifications; the finishing pass fills their caches."""

from __future__ import annotations

from collections.abc import Sequence
from math import floor, isfinite, log10

from openpyxl.chart import ScatterChart
from openpyxl.chart.layout import Layout as PlotLayout
from openpyxl.chart.layout import ManualLayout
from openpyxl.chart.legend import LegendEntry
from openpyxl.chart.shapes import GraphicalProperties

from reports.model.charts import ChartSpec
from reports.model.charts import Series as SeriesSpec
from reports.model.evaluation import Values
from reports.workbook import chart_parts as parts
from reports.workbook.chapters import contents_for, is_smooth_sheet
from reports.workbook.chart_parts import COLOURS, ChartTitle, Curve
from reports.workbook.chart_ranges import (
    CurveRanges,
    Drawn,
    arrow,
    drawn_series,
    limits,
    live_marks,
    live_table,
    marks,
    member_names,
    names_in,
    rays,
    symbol_of,
)
from reports.workbook.layout import FIRST_ROW, Layout

WIDE, HIGH = 408, 272  # px: several beside a table
ROOMY = 480  # px: width of three in a row on a sheet of their own
STUDY = (16.0, 7.6)  # cm
_ZERO = 1e-9  # what rounding leaves of nothing
_EDGE = 1.2  # of a drawing in a unit square, with room for numbers around it
_PARTS = 5  # of a half axis of a polar diagram, at most


def pixels(spec: ChartSpec, *, wide: bool = False) -> tuple[int, int]:
    """Width and height of a chart on the screen."""
    width = ROOMY if wide else WIDE
    return (width, width) if spec.equal_axes else (width, HIGH)


def make_chart(
    spec: ChartSpec, layout: Layout, values: Values, *, oblong: float = 1.0
) -> ScatterChart:
    """Return a scatter chart with straight lines, its plot square where both axes have one scale.

    ``oblong`` is the width over the height of such a chart.

    It comes without numbers: openpyxl takes long for each, see ``ranges_of``.
    """
    chart = _empty(spec.heading)
    curves = drawn_series(spec, layout)
    for number, series in enumerate(curves):
        chart.series.append(
            _series(series, number, layout, smooth=is_smooth(spec, layout), stems=spec.stems)
        )
    if spec.kind == "wear":
        for line in rays(spec, layout):
            chart.series.append(_ray(len(chart.series), line))
    if spec.kind == "scheme":
        for number, (series, _) in enumerate(zip(chart.series, curves, strict=True)):
            series.spPr = _line_of_scheme(number)
        for mark, height in member_names(spec, layout, values):
            chart.series.append(_mark(len(chart.series), mark, "t" if height > 0 else "b"))
    if spec.kind == "polar":
        table = live_table(spec, layout)
        if table:
            chart.series.append(_arrow(len(chart.series), arrow(table, layout)))
        points = live_marks(table, curves[0], layout) if table else marks(spec, layout, values)
        for mark in points:
            chart.series.append(_mark(len(chart.series), mark))
        chart.series.append(_pole(len(chart.series)))
    _axes(chart, spec, (layout, values), oblong)
    is_told = spec.kind == "scheme" or not spec.equal_axes
    _legend(chart, visible=is_told and len(curves) > 1)
    if spec.kind == "scheme" and chart.legend is not None:  # the points are called in place
        further = range(len(curves), len(chart.series))
        chart.legend.legendEntry = [LegendEntry(idx=idx, delete=True) for idx in further]
    return chart


def _line_of_scheme(number: int) -> GraphicalProperties:
    """Axes as drawings have them, thin and of dashes and dots; what turns is thick."""
    if number == 0:
        return parts.stroke(COLOURS[0], dash="lgDashDot")
    return parts.stroke(COLOURS[1], parts.DEEP)


def _ray(number: int, line: CurveRanges) -> Curve:
    """Return a thick line for the worn depth, with the number of its ray at the circle."""
    return Curve(number, line, parts.stroke(parts.RAY, parts.DEEP), None, parts.end_label("t"))


def _arrow(number: int, line: CurveRanges) -> Curve:
    """Return an arrow with its name at the head."""
    look = parts.stroke(parts.RED, end="triangle")
    return Curve(number, line, look, None, parts.end_label("t"))


def _mark(number: int, point: CurveRanges, position: str = "r") -> Curve:
    """Return a small point with its name beside it."""
    marker = parts.dot(4, COLOURS[0])
    return Curve(number, point, parts.hidden(), marker, parts.name_label(position))


def _pole(number: int) -> Curve:
    """Where the vector is measured from."""
    nought = CurveRanges("O", "", "")
    return Curve(number, nought, parts.hidden(), parts.dot(7), parts.name_label())


def is_blank(spec: ChartSpec, layout: Layout, values: Values) -> bool:
    """Whether all curves of a chart are zero; cells still to be filled in are not."""
    ranges = ranges_of(spec, layout, values)
    ends = [series.y for series in drawn_series(spec, layout) if not series.invisible]
    return all(abs(y) < _ZERO for key in ends for y in ranges[layout.range_of(key)])


def curves_chart(
    title: str, x_title: str, y_title: str, curves: Sequence[CurveRanges], ends: tuple[float, float]
) -> ScatterChart:
    """Curves over an input between its ends; the finishing pass fills in the numbers."""
    chart = _empty(title)
    chart.width, chart.height = STUDY
    for number, curve in enumerate(curves):
        chart.series.append(Curve(number, curve, parts.look(number)))
    _titles(chart, x_title, y_title)
    if ends[0] < ends[1]:
        chart.x_axis.scaling.min, chart.x_axis.scaling.max = ends
    _legend(chart, visible=len(curves) > 1)
    return chart


def drawing(
    title: str, axes: tuple[str, str], lines: Sequence[Drawn], *,
    shape: float = 0.0, downwards: bool = False, unit: bool = False, wide: int = WIDE,
    limit: float = 0.0, step: float = 0.0, turn: float = 0.0,
) -> ScatterChart:  # fmt: skip
    """Lines over axes; ``shape`` is the width of the plot over its height at one scale.

    ``wide`` is the width of the chart [px], ``limit`` that of both axes where they are alike,
    ``step`` their division where it is known, ``turn`` the last crank angle where the abscissa is
    one [deg].
    """
    chart = _empty(title)
    for number, line in enumerate(lines):
        # Of a picture the lines are told by their places.
        is_hidden = line.hidden or line.point
        look = parts.hidden() if is_hidden else parts.look(number, solid=bool(shape))
        marker = parts.dot(9) if line.point else None
        ranges = CurveRanges(line.name, line.x, line.y)
        chart.series.append(Curve(number, ranges, look, marker))
    _titles(chart, *axes)
    _legend(chart, visible=not shape and len(lines) > 2)
    if downwards:
        chart.y_axis.scaling.orientation = "maxMin"
        chart.x_axis.tickLblPos = "high"
    _divide_alike(chart, limit, step)
    _turn(chart, turn)
    if unit:
        for axis in (chart.x_axis, chart.y_axis):
            axis.scaling.min, axis.scaling.max, axis.majorUnit = -1.1, 1.1, 0.55
    if shape:
        height = 2 * HIGH if shape < 1 else HIGH
        high = 0.72
        across = shape * high * height / wide
        chart.layout = PlotLayout(
            manualLayout=ManualLayout(
                layoutTarget="inner", xMode="edge", yMode="edge",
                x=0.53 - across / 2, y=0.14, w=across, h=high,
            )
        )  # fmt: skip
    return chart


def _empty(title: str) -> ScatterChart:
    chart = ScatterChart()
    chart.scatterStyle = "lineMarker"
    chart.style = 2
    chart.roundedCorners = False
    chart.title = ChartTitle(title, 1000)
    chart.visible_cells_only = False  # curves of folded columns are drawn too
    chart.display_blanks = "gap"
    return chart


def _legend(chart: ScatterChart, *, visible: bool) -> None:
    if visible:
        chart.legend.position = "b"
        chart.legend.overlay = False
    else:
        chart.legend = None


def _titles(chart: ScatterChart, x_title: str, y_title: str) -> None:
    """Both axes as Excel shows them: there, with a light grid and their titles."""
    chart.x_axis.axPos = "b"  # openpyxl puts both on the left, where Gnumeric drops the chart
    for axis, title in ((chart.x_axis, x_title), (chart.y_axis, y_title)):
        axis.delete = False
        axis.tickLblPos = "low"
        axis.majorTickMark = "out"
        axis.number_format = "General"
        axis.numFmt.sourceLinked = False
        axis.majorGridlines.spPr = parts.grid()
        if title:
            axis.title = ChartTitle(title, 900)


def _axes(
    chart: ScatterChart, spec: ChartSpec, numbers: tuple[Layout, Values], oblong: float
) -> None:
    layout, values = numbers
    _titles(chart, spec.x_title, spec.y_title)
    if spec.x_is_angle:
        table, column = spec.series[0].x.split(".")
        first, last = values.columns[table][column][[0, -1]].tolist()
        if first == 0:  # a whole turn or cycle; of a part the axis is the program's choice
            _turn(chart, last)
    elif spec.x_step:
        chart.x_axis.majorUnit = spec.x_step
    for axis, is_reversed in ((chart.x_axis, spec.x_reversed), (chart.y_axis, spec.y_reversed)):
        if is_reversed:
            axis.scaling.orientation = "maxMin"
    # The numbers of an axis stand below or left, where the other's least or greatest value is.
    chart.x_axis.tickLblPos = "high" if spec.y_reversed else "low"
    chart.y_axis.tickLblPos = "high" if spec.x_reversed else "low"
    if not spec.equal_axes:
        return
    chart.layout = PlotLayout(
        manualLayout=ManualLayout(
            layoutTarget="inner",
            xMode="edge",
            yMode="edge",
            x=0.52 - 0.35 / oblong,
            y=0.16,
            w=0.7 / oblong,
            h=0.7,
        )
    )
    if table := live_table(spec, layout):
        step = float(values.scalars[layout.keys_of_run(f"{table}_frame.frame_step")[0]])
        _divide_alike(chart, 1.0, step)
    elif spec.kind == "polar":
        _divide_alike(chart, max(map(abs, limits(spec, layout, values))))
    else:  # drawn in a unit square
        for axis in (chart.x_axis, chart.y_axis):
            axis.scaling.min, axis.scaling.max = -_EDGE, _EDGE
            axis.majorUnit = _EDGE / 2
            axis.number_format = "0.0"


def _turn(chart: ScatterChart, last: float) -> None:
    """Set an abscissa of crank angles from zero; without a last one it is the program's choice."""
    if last:
        chart.x_axis.scaling.min, chart.x_axis.scaling.max = 0, last
        chart.x_axis.majorUnit = last / 12
        chart.x_axis.number_format = "0"


def _divide_alike(chart: ScatterChart, limit: float, step: float = 0.0) -> None:
    """One division on both axes: from equal limits a program then makes equal ends."""
    if not (limit > 0 and isfinite(limit)):  # nothing yet, or cells still to be filled in
        return
    size = 10.0 ** floor(log10(limit))
    parts = (part * size for part in (0.2, 0.5, 1.0, 2.0))
    step = step or next(part for part in parts if limit <= _PARTS * part)
    for axis in (chart.x_axis, chart.y_axis):
        axis.majorUnit = step
        # As many decimals as the divisions have: Gnumeric takes those of the cells otherwise.
        decimals = max(0, -floor(log10(step)))
        axis.number_format = "0." + "0" * decimals if decimals else "0"


def is_smooth(spec: ChartSpec, layout: Layout) -> bool:
    """Curves of motion and inertia have no corners: they are drawn round between their points."""
    return spec.x_is_angle and is_smooth_sheet(spec.sheet, contents_for(layout.model))


def _series(series: SeriesSpec, number: int, layout: Layout, *, smooth: bool, stems: bool) -> Curve:
    name = series.name or symbol_of(series.y, layout)
    curve = CurveRanges(name, layout.range_of(series.x), layout.range_of(series.y))
    if series.point:
        return Curve(number, curve, parts.hidden(), parts.dot(9), parts.name_label())
    look = parts.hidden() if series.invisible else parts.look(number)
    drawn = Curve(number, curve, parts.hidden() if stems else look)
    drawn.smooth = smooth
    if stems:
        drawn.marker = parts.dot(5, COLOURS[number % len(COLOURS)])
        drawn.errBars = parts.stem(look)
    return drawn


def ranges_of(spec: ChartSpec, layout: Layout, values: Values) -> dict[str, list[float]]:
    """Range of each series → its numbers, which the finishing pass puts into the chart."""
    ranges = {}
    for key in (key for series in drawn_series(spec, layout) for key in (series.x, series.y)):
        table, column = key.split(".")
        if table in values.columns:
            numbers = values.columns[table][column].astype(float).tolist()
        else:
            numbers = [float(values.scalars[name]) for name in layout.keys_of_run(key)]
        ranges[layout.range_of(key)] = numbers
    path = drawn_series(spec, layout)[0]
    if spec.kind == "wear":
        circle, wear = (values_of for values_of in spec.drawn_by("workbook")[:2])
        for axis in "xy":
            ends = [ranges[layout.range_of(getattr(series, axis))] for series in (wear, circle)]
            for line, depth, edge in zip(rays(spec, layout), *ends, strict=False):
                ranges[getattr(line, axis)] = [depth, edge]
    if spec.kind == "scheme":
        for point, _ in member_names(spec, layout, values):
            for at in (point.x, point.y):
                cell = next(k for k, c in layout.cells.items() if c.absolute == at)
                ranges[at] = [float(values.scalars[cell])]
    if table := live_table(spec, layout):
        line = arrow(table, layout)
        for at, axis in ((line.x, "x"), (line.y, "y")):
            keys = layout.keys_of_run(f"{table}_arrow.arrow_{axis}")
            ranges[at] = [float(values.scalars[key]) for key in keys]
    if spec.kind == "polar":
        points = live_marks(table, path, layout) if table else marks(spec, layout, values)
        for mark in points:
            row = int(mark.x.rpartition("$")[2]) - FIRST_ROW
            for at, key in ((mark.x, path.x), (mark.y, path.y)):
                ranges[at] = [ranges[layout.range_of(key)][row]]
    return ranges


def names_of(spec: ChartSpec, layout: Layout, values: Values) -> dict[str, str]:
    """Cell of each series that is called by one → its text."""
    table = live_table(spec, layout)
    return names_in(table, layout, values) if table else {}
