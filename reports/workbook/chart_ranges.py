"""Ranges that charts draw: curves, rays, named points, limits."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from openpyxl.utils import get_column_letter

from kshm.nomenclature.quantity import quantity, roman
from reports.model.blocks import Grid
from reports.model.charts import ChartSpec, Series
from reports.model.evaluation import Values
from reports.workbook.layout import Layout, column_range, quoted

_ANGLE, _MAX_NAMES = 30, 8  # degrees, and how many of a polar diagram's points have a name
_NAME = (0.35, 0.14)  # room of such a name, of the greatest radius: across and down


@dataclass(frozen=True, slots=True)
class CurveRanges:
    """A curve by the ranges of its numbers."""

    name: str
    x: str
    y: str
    cell: str = ""  # that has the name


@dataclass(frozen=True, slots=True)
class Drawn:
    """A broken line, or a point that moves, by the ranges of its numbers."""

    name: str
    x: str
    y: str
    point: bool = False
    hidden: bool = False  # only keeps the axes in proportion


def drawn_series(spec: ChartSpec, layout: Layout) -> list[Series]:
    """Curves of the workbook's chart, from the fine table those that it has whole."""
    table = live_table(spec, layout)
    return [
        replace(series, x=f"{table}_frame.frame_x", y=f"{table}_frame.frame_y")
        if table and series.invisible
        else drawn_from(series, layout)
        for series in spec.drawn_by("workbook")
    ]


def live_table(spec: ChartSpec, layout: Layout) -> str:
    """Table of a polar diagram whose axes, arrow and names follow its values; none of others."""
    path = spec.series[0]
    table = path.y.partition(".")[0]
    is_live = spec.kind == "polar" and path.y in layout.model.draws
    return table if is_live and f"{table}_marks.mark_label" in layout.model.grid_runs else ""


def live_marks(table: str, path: Series, layout: Layout) -> list[CurveRanges]:
    """Points at round angles, called by cells that are blank where another name is near."""
    labels = layout.cells_of_run(f"{table}_marks.mark_label")
    spec = layout.columns[path.y][0]
    rows = layout.rows_of(spec)[: -1 : (len(spec.rows) - 1) // len(labels)]
    x, y = (f"{quoted(spec.sheet)}!${get_column_letter(layout.column_of(key))}$"
            for key in (path.x, path.y))  # fmt: skip
    return [
        CurveRanges("", f"{x}{row}", f"{y}{row}", label.absolute)
        for row, label in zip(rows, labels, strict=True)
    ]


def member_names(
    spec: ChartSpec, layout: Layout, values: Values
) -> list[tuple[CurveRanges, float]]:
    """Points of a scheme off its pole by the members that they are, with their ordinates.

    Members in one place share a name.
    """
    names: dict[tuple[float, float], list[str]] = {}
    points: dict[tuple[float, float], CurveRanges] = {}
    for series in spec.drawn_by("workbook"):
        grid = next(b for b in layout.model.blocks if b.id == series.y.partition(".")[0])
        assert isinstance(grid, Grid)
        label_of = {c.key: label for row in grid.rows
                    for c, label in zip(row.cells, grid.labels, strict=True) if c}  # fmt: skip
        for x, y in zip(*map(layout.keys_of_run, (series.x, series.y)), strict=True):
            at = round(float(values.scalars[x]), 3) + 0.0, round(float(values.scalars[y]), 3) + 0.0
            if at == (0.0, 0.0) or label_of[y] in names.get(at, ()):
                continue
            names.setdefault(at, []).append(label_of[y])
            points.setdefault(at, CurveRanges("", *(layout.cells[k].absolute for k in (x, y))))
    return [(replace(points[at], name=", ".join(names[at])), at[1]) for at in points]


def arrow(table: str, layout: Layout) -> CurveRanges:
    """Line from the pole to the greatest value, called by the angle of it."""
    x, y = (layout.range_of(f"{table}_arrow.arrow_{axis}") for axis in "xy")
    return CurveRanges("", x, y, layout.cells_of_run(f"{table}_arrow.arrow_deg")[0].absolute)


def names_in(table: str, layout: Layout, values: Values) -> dict[str, str]:
    """Cells of the names of a polar diagram → what stands in them."""
    runs = (f"{table}_marks.mark_label", f"{table}_arrow.arrow_deg")
    keys = [key for run in runs for key in layout.keys_of_run(run)]
    scalars = {layout.cells[key].absolute: values.scalars[key] for key in keys}
    return {at: value if isinstance(value, str) else f"{value:g}°" for at, value in scalars.items()}


def drawn_from(series: Series, layout: Layout) -> Series:
    """Return a curve with the columns that it is drawn from, under its own name."""
    draws = layout.model.draws
    if not (series.x in draws and series.y in draws):
        return series
    name = series.name or symbol_of(series.y, layout)
    return replace(series, x=draws[series.x], y=draws[series.y], name=name)


def symbol_of(key: str, layout: Layout) -> str:
    """Return a symbol of a column or of a grid's row: those are called by quantity."""
    about = layout.model.nodes.get(key) or layout.model.grid_rows.get(key)
    return (about.quantity if about is not None else quantity(key.split(".")[1])).symbol


def rays(spec: ChartSpec, layout: Layout) -> list[CurveRanges]:
    """Worn depth at every ray of a wear diagram, from the wear to the circle."""
    circle, wear = spec.drawn_by("workbook")[:2]
    xs, ys = layout.cells_of_run(wear.x)[:-1], layout.cells_of_run(wear.y)[:-1]
    ends = layout.cells_of_run(circle.x), layout.cells_of_run(circle.y)
    return [
        CurveRanges(roman(number), *(column_range(at.sheet, at.column, at.row, to.row)
                               for at, to in ((x, ends[0][number - 1]), (y, ends[1][number - 1]))))
        for number, (x, y) in enumerate(zip(xs, ys, strict=True), 1)
    ]  # fmt: skip


def marks(spec: ChartSpec, layout: Layout, values: Values) -> list[CurveRanges]:
    """Points of a polar diagram at round angles, called by them: no name upon another."""
    path = drawn_series(spec, layout)[0]
    if path.y not in layout.columns:
        return []
    table = layout.columns[path.y][0]
    angles = table.rows[:-1]
    first = layout.rows_of(table)[0]
    xs, ys = (values.columns[table.id][key.split(".")[1]] for key in (path.x, path.y))
    radius = max((np.hypot(x, y) for x, y in zip(xs, ys, strict=True)), default=0.0)
    round_ones = (index for index, angle in enumerate(angles) if angle % _ANGLE == 0)
    rows: list[int] = []
    for index in sorted(round_ones, key=lambda index: (angles[index] % (3 * _ANGLE), index)):
        are_distant = all(
            abs(xs[index] - xs[other]) > _NAME[0] * radius
            or abs(ys[index] - ys[other]) > _NAME[1] * radius
            for other in rows
        )
        if are_distant and len(rows) < _MAX_NAMES:
            rows.append(index)
    return [
        CurveRanges(f"{angles[index]:g}°", *(
            f"{quoted(table.sheet)}!${get_column_letter(layout.column_of(key))}${first + index}"
            for key in (path.x, path.y)
        ))
        for index in sorted(rows)
    ]  # fmt: skip


def limits(spec: ChartSpec, layout: Layout, values: Values) -> list[float]:
    """Return common limits of both axes of a polar diagram: the run of its corners."""
    return [float(values.scalars[key]) for key in layout.keys_of_run(spec.series[-1].x)]
