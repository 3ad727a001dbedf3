"""Figures of the report from chart specifications and from sizes of the parts."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reports.document.figures.curves import LETTERS, Level, Mark, Panel, PlotCurve, curves_figure
from reports.document.figures.polar import Loop, Pole, polar_path, wear_diagram
from reports.document.page.numbering import Figure
from reports.document.text.symbols import spoken
from reports.document.text.terms import Terms
from reports.document.text.tex import GREEK
from reports.document.text.texts import significant
from reports.draw.canvas import Canvas, Item, bounds, fitted, moved
from reports.draw.parts import MechanismSizes, ThrowSizes, mechanism_drawing, throw_drawing
from reports.draw.sketched import letter, sketch
from reports.draw.weights import (
    CounterweightSizes,
    FlywheelSizes,
    counterweight_drawing,
    flywheel_drawing,
)
from reports.draw.writers import svg_of
from reports.formula.numeric import evaluate
from reports.model.blocks import TIE
from reports.model.charts import ChartSpec, Series
from reports.model.shape import Shape
from reports.shared.russian import NBSP, fixed

_THROW, _MECHANISM = (98.0, 92.0), (52.0, 92.0)  # width and height of both on the figure [mm]
_BETWEEN, _LETTERS = 8.0, 2.5
_WEB = (80.0, 72.0)  # of the web with its counterweight [mm]
HEIGHT = 76.0  # mm
_LETTER = "A-Za-zΑ-Ωα-ω"
_SYMBOL = re.compile(rf"[{_LETTER}(]*[{_LETTER}][{_LETTER}′²()/0-9]*")
_COMMANDS = {letter: rf"\{name} " for name, letter in reversed(GREEK.items())}
Row = tuple[str, int]  # name of a point of the first curve and its row
Column = NDArray[np.float64]
_TIE = float(TIE)
_NOISE = 1e-9  # of a curve's largest ordinate: what sums leave where they are zero


def throw_of(terms: Terms, number: int = 1) -> ThrowSizes:
    """Sizes of a throw, counted from the nose."""
    shaft = terms.model.input.crankshaft
    arms = shaft.arms[number - 1]
    main = partial(_size, shaft.main_diameter_mm, shaft.main_diameters_mm)
    webs = shaft.webs[2 * number - 2 : 2 * number]
    return ThrowSizes(
        arms=(arms.l1_mm, arms.l2_mm, arms.l3_mm, arms.l4_mm, arms.l5_mm, arms.l6_mm),
        webs=(arms.left_web_mm, arms.right_web_mm),
        radius=1000 * terms.value("r_crank"),
        pin=_size(shaft.pin_diameter_mm, shaft.pin_diameters_mm, number),
        mains=(main(number), main(number + 1)),
        lengths=(shaft.main_lengths_mm[number - 1], shaft.main_lengths_mm[number]),
        weights=(bool(webs[0].counterweight_kg), bool(webs[1].counterweight_kg)),
        usual=(terms.value(f"web{number}_left_mm"), terms.value(f"web{number}_right_mm")),
    )


def _size(common: float | None, sizes: tuple[float, ...] | None, number: int) -> float:
    """Return a diameter common to all journals or one of its own."""
    return sizes[number - 1] if sizes is not None else common or 0.0


def mechanism_of(terms: Terms) -> MechanismSizes:
    """Sizes of the mechanism."""
    offset = terms.value("k_offset") * terms.value("r_crank") if terms.has("k_offset") else 0.0
    # Of an engine that is designed for a power the cycle tells the bore.
    bore = terms.value("geometry_bore_mm" if terms.has("geometry_bore_mm") else "cyc_D")
    return MechanismSizes(
        bore, 1000 * terms.value("r_crank"), 1000 * terms.value("L_rod"), 1000 * offset
    )


def sizes_figure(throw: ThrowSizes, mechanism: MechanismSizes, *, size: float = 1.0) -> str:
    """Return a throw beside the mechanism, each to a scale of its own, as SVG for the report.

    ``size`` makes the drawings smaller, but not their letters.
    """
    rooms = ((size * wide, size * tall) for wide, tall in (_THROW, _MECHANISM))
    draws = (partial(throw_drawing, throw), partial(mechanism_drawing, mechanism))
    return beside_figure([
        fitted(partial(draw, letters=_LETTERS), room)
        for draw, room in zip(draws, rooms, strict=True)
    ])  # fmt: skip


def beside_figure(parts: Sequence[Sequence[Item]]) -> str:
    """Return drawings side by side as SVG, lettered where there are several."""
    canvas = Canvas()
    left_end, ends = 0.0, []
    for items in parts:
        left, _, right, high = bounds(items)
        canvas.items += moved(items, left_end - left, -high)
        ends.append(left_end + (right - left) / 2)
        left_end += right - left + _BETWEEN
    low = bounds(canvas.items)[1] - 2.5 * _LETTERS
    for middle, sign in zip(ends, "аб" if len(parts) > 1 else "", strict=False):
        canvas.words((middle, low), f"{sign})", _LETTERS, align=0.5)
    left, low, right, high = bounds(canvas.items)
    return svg_of(canvas.items, (left - 2, low - 2, right + 2, high + 2))


def sketches_figure(terms: Terms, caption: str, *names: str) -> Figure:
    """Return sketches of parts side by side, with the letters of their sizes, as a figure."""
    sketches = (sketch(name, terms.model, terms.values.scalars) for name in names)
    return Figure(partial(beside_figure, [items for items in sketches if items]), caption)


def _size_words(terms: Terms, keys: Sequence[str]) -> tuple[str, ...]:
    """Sizes as the text has them, with the letters of drawings: «h_м = 19,6»; mm goes unsaid."""
    units = (terms.unit(key).replace("мм", "") for key in keys)
    return tuple(f"{letter(terms.tex(key))} = {terms.num(key)}{unit}"
                 for key, unit in zip(keys, units, strict=True))  # fmt: skip


def counterweight_of(terms: Terms) -> CounterweightSizes:
    """Sizes of the first web with the proposed counterweight."""
    throw = throw_of(terms)
    keys = ("cw_inner_mm", "cw_outer_mm", "cw_angle_deg")
    inner, outer, angle = map(terms.value, keys)
    return CounterweightSizes(throw.radius, throw.pin, throw.mains[0], inner, outer, angle,
                              _size_words(terms, keys))  # fmt: skip


def counterweight_figure(terms: Terms) -> str:
    """Return a web with its counterweight as SVG for the report."""
    return _pictured(partial(counterweight_drawing, counterweight_of(terms), letters=_LETTERS))


def flywheel_of(terms: Terms) -> FlywheelSizes:
    """Sizes of the flywheel."""
    keys = ("fw_outer_mm", "fw_bore_mm", "fw_disc_mm", "fw_rim_mm")
    outer, bore, disc, rim = map(terms.value, keys)
    return FlywheelSizes(outer, bore, disc, rim, _size_words(terms, keys))


def flywheel_figure(terms: Terms) -> str:
    """Return the flywheel as SVG for the report."""
    return _pictured(partial(flywheel_drawing, flywheel_of(terms), letters=_LETTERS))


def _pictured(draw: Callable[..., list[Item]]) -> str:
    items = fitted(draw, _WEB)
    left, low, right, high = bounds(items)
    return svg_of(items, (left - 2, low - 2, right + 2, high + 2))


def throws_of(terms: Terms) -> list[ThrowSizes]:
    """Sizes of all throws."""
    return [throw_of(terms, n) for n in range(1, Shape.of(terms.model.input).throws + 1)]


def chart_figure(
    terms: Terms,
    chart: ChartSpec,
    size: float = HEIGHT,
    *,
    caption: str = "",
    series: tuple[Series, ...] = (),
    levels: tuple[str, ...] = (),
    **more: Any,  # noqa: ANN401
) -> Figure:
    """Return a chart as a figure.

    Args:
        terms: symbols and values.
        chart: what is drawn.
        size: height of curves, greatest side of a path, width of a wear diagram [mm].
        caption: what to say instead of the specification's words.
        series: what is drawn instead of the specification's curves.
        levels: lines across instead of the specification's.
        more: ``rows``, ``marks``, ``fan`` and ``closed`` of curves, ``least_step`` of a path,
            ``top`` of a wear diagram.
    """
    chart = replace(chart, series=series or chart.series, levels=levels or chart.levels)
    draw = _KINDS[chart.kind](terms, chart, size, **more)
    words = caption or chart.words
    return Figure(draw, words, _spoken(terms, words, [chart]))


def panels_figure(
    terms: Terms,
    charts: Sequence[ChartSpec],
    size: float,
    **more: Any,  # noqa: ANN401
) -> Figure:
    """Charts of one group as panels one above the other, ``size`` of a panel [mm]."""
    first = charts[0]
    if len(charts) == 1:
        return chart_figure(terms, first, size, caption=f"{first.group}: {first.panel}")
    words = "; ".join(
        f"{letter}{NBSP}—{NBSP}{chart.panel}"
        for letter, chart in zip(LETTERS, charts, strict=False)
    )
    x, abscissa, columns = _together(terms, charts)
    panels = (_panel(terms, c, columns[n]) for n, c in enumerate(charts))
    draw = partial(
        curves_figure, abscissa, tuple(panels),
        axis_name(terms, x), height=size, **more,
    )  # fmt: skip
    caption = f"{first.group}: {words}"
    return Figure(draw, caption, _spoken(terms, caption, charts))


def _curves(
    terms: Terms,
    chart: ChartSpec,
    size: float,
    *,
    rows: Sequence[Row] = (),
    closed: bool = False,
    fan: bool = False,
    marks: Sequence[Mark] = (),
) -> Callable[[], str]:
    name, x, (columns,) = _together(terms, [chart])
    panel = _panel(terms, chart, columns, rows)
    panel = replace(panel, fan=fan, marks=(*panel.marks, *marks))
    if closed:
        x = np.append(x, x[0])
        curves = (PlotCurve(c.name, np.append(c.y, np.asarray(c.y)[0])) for c in panel.curves)
        panel = replace(panel, curves=tuple(curves))
    return partial(
        curves_figure, x, (panel,), axis_name(terms, name),
        height=size, angle=chart.x_is_angle, x_step=chart.x_step,
    )  # fmt: skip


def _together(terms: Terms, charts: Sequence[ChartSpec]) -> tuple[str, Column, list[list[Column]]]:
    """Return the abscissa of charts, its values and the ordinates of each chart on it."""
    series = [chart.drawn_by("report") for chart in charts]
    name = series[0][0].x
    abscissa, *columns = terms.curves([name, *(s.y for each in series for s in each)])
    ordinates = iter(columns)
    return name, abscissa, [[next(ordinates) for _ in each] for each in series]


def _something(
    series: Sequence[Series], columns: Sequence[Column]
) -> tuple[Sequence[Series], Sequence[Column]]:
    """Drop curves of zeros beside others."""
    sizes = [float(np.abs(column).max(initial=0.0)) for column in columns]
    filled = [number for number, size in enumerate(sizes) if size > _NOISE * max(sizes)]
    columns_shown = filled or range(len(columns))
    return [series[number] for number in columns_shown], [
        columns[number] for number in columns_shown
    ]


def _panel(
    terms: Terms, chart: ChartSpec, columns: Sequence[Column], rows: Sequence[Row] = ()
) -> Panel:
    """Return a panel with its curves; the rows of the table are marked on finer curves."""
    drawn, columns = _something(chart.drawn_by("report"), columns)
    x, y = terms.column(drawn[0].x), terms.column(drawn[0].y)
    marked = len(columns[0]) > len(x)
    if chart.extremes:
        # Of equal extremes the first, as the text says.
        high, low = (
            np.isclose(y, y.max(), rtol=0, atol=_TIE),
            np.isclose(y, y.min(), rtol=0, atol=_TIE),
        )
        rows = (*rows, ("max", int(high.argmax())), ("min", int(low.argmax())))
    return Panel(
        tuple(
            PlotCurve(_name(terms, series), column)
            for series, column in zip(drawn, columns, strict=True)
        ),
        ordinate(terms, chart, drawn),
        tuple(Level(f"${terms.tex(level)}$", terms.value(level)) for level in chart.levels),
        tuple(Mark(name, float(x[row]), float(y[row])) for name, row in rows),
        chart.from_zero,
        tuple((x, terms.column(series.y)) for series in drawn) if marked else (),
        chart.stems,
    )


def _path(
    terms: Terms, chart: ChartSpec, size: float, *, least_step: float = 10.0
) -> Callable[[], str]:
    drawn, *others = chart.drawn_by("report")
    table = drawn.x.partition(".")[0]
    titles = (
        chart.x_tex or axis_name(terms, drawn.x),
        chart.y_tex or axis_name(terms, drawn.y),
    )
    if others:
        titles = (_tex(chart.x_title), _tex(chart.y_title))
    poles = (Pole(f"${tex}$", 0.0, float(evaluate(expr, terms.value))) for tex, expr in chart.poles)
    rows = terms.model.tables[table].rows
    x, y = terms.curves([drawn.x, drawn.y])
    fine = len(x) > len(rows)
    return partial(
        polar_path, x, y, terms.fine[table]["phi_deg"] if fine else rows, titles,
        marked=rows if fine else None, reverse=(chart.x_reversed, chart.y_reversed),
        poles=(Pole("$O$"), *poles),
        named=[
            Loop(_name(terms, series), *terms.curves([series.x, series.y]))
            for series in (drawn, *others) if others
        ],
        most=size, least_step=least_step,
    )  # fmt: skip


def _wear(terms: Terms, chart: ChartSpec, size: float, *, top: str = "") -> Callable[[], str]:
    """Each sum lies where its forces press on the surface, half a turn from its ray."""
    grid = chart.series[0].x.partition(".")[0]
    sums, rays = (
        np.array([terms.value(key) for key in terms.model.grid_runs[f"{grid}.{of}"][:-1]])
        for of in ("ray_sum", "ray_deg")
    )
    return partial(wear_diagram, sums, rays + 180.0, terms.value(chart.hole), size=size, top=top)


_KINDS: dict[str, Callable[..., Callable[[], str]]] = {
    "line": _curves,
    "polar": _path,
    "wear": _wear,
}


def axis_name(terms: Terms, name: str) -> str:
    """Symbol and unit of a column."""
    unit = terms.unit(name)
    return f"${terms.tex(name)}${', ' if unit else ''}{unit}"


def ordinate(terms: Terms, chart: ChartSpec, drawn: Sequence[Series]) -> str:
    """Symbols of a chart's ordinate between dollars and its unit.

    Two curves have both their symbols, more of them the word of the chart.
    """
    if chart.y_tex:
        return chart.y_tex
    symbols = list(dict.fromkeys(terms.tex(series.y) for series in drawn))
    units = {terms.unit(series.y) for series in drawn}
    if len(drawn) > 2 or len(units) > 1 or (len(drawn) > 1 and any(each.name for each in drawn)):
        return _tex(chart.y_title)
    (unit,) = units
    return ", ".join([*(f"${tex}$" for tex in symbols), *([unit] if unit else [])])


def _name(terms: Terms, series: Series) -> str:
    return _tex(series.name) if series.name else f"${terms.tex(series.y)}$"


def _tex(title: str) -> str:
    """Return a plain title with its symbols, «p′, МПа», as TeX between dollars."""

    def symbol(match: re.Match[str]) -> str:
        text = match.group().replace("′", "'").replace("²", "^2")
        text = re.sub("(max|min)$", r"_{\\mathrm{\1}}", text)
        text = "".join(_COMMANDS.get(sign, sign) for sign in text)
        return "$" + re.sub(r"(?<!\^)([0-9]+)", r"_{\1}", text).strip() + "$"

    return _SYMBOL.sub(symbol, title)


def _first(y: NDArray[np.float64]) -> int:
    """Row of the greatest value; of equal ones the first."""
    return int(np.argmax(y >= y.max() - _NOISE * np.abs(y).max()))


def _spoken(terms: Terms, caption: str, charts: Sequence[ChartSpec]) -> str:
    """Alternative text: the caption and the extremes of each curve over an angle."""
    said = []
    for chart in charts:
        for series in chart.drawn_by("report") if chart.x_is_angle else ():
            x, y = terms.column(series.x), terms.column(series.y)
            y = np.where(np.abs(y) < _NOISE * np.abs(y).max(), 0.0, y)
            unit, angle = terms.unit(series.y), spoken(terms.tex(series.x))
            parts = (
                f"{word} {significant(float(y[row]), 4)}{' ' if unit else ''}{unit}"
                f" при {angle} = {fixed(x[row], 0)}°"
                for word, row in (("наибольшее", _first(y)), ("наименьшее", _first(-y)))
            )
            said.append(f"{spoken(terms.tex(series.y))}: {', '.join(parts)}")
    return f"{caption}. {'; '.join(said)}" if said else caption
