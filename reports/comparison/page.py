"""The comparison as a page: HTML for a browser, the same set on paper as PDF."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from markupsafe import Markup

from kshm.nomenclature.quantity import quantity
from reports.comparison.conclusions import conclusions
from reports.comparison.engines import (
    LEAST_PERCENT,
    X_TITLE,
    Chart,
    Compared,
    Difference,
    Row,
    apart,
    charts,
    differences,
    results,
)
from reports.document.page.blocks import Column, DocumentInfo, TableBlock, table_block
from reports.document.page.numbering import Draft, Label
from reports.document.text.numbers import of_digits
from reports.document.text.texts import rich, spaces_inside
from reports.shared.russian import MINUS, NBSP, comma, fixed, grouped, short

_TITLE = "Сравнение двигателей"
_MOST_PERCENT = 900
_NONE_LEFT = -99.99  # and here hardly anything is left that a table could show
_FEW = 4  # engines that fit beside the words at the usual size


@dataclass(frozen=True, slots=True)
class Placed:
    """A table or a figure with its number."""

    body: TableBlock | Markup
    label: Label
    caption: str


def comparison_page(engines: Sequence[Compared], *, media: Literal["print", "screen"]) -> str:
    """The whole page with style sheet and fonts inside."""
    from reports.document.page.render import environment

    numbering = Draft()
    labels = [engine.label for engine in engines]
    rows, lacking = apart(results(engines), labels)
    different, only = apart(differences(engines), labels)
    data = numbering.section(1, "Чем отличаются исходные данные")
    data_table = Placed(data_block(labels, different), numbering.place("table", "data"),
                        "Исходные данные, которые не совпадают")  # fmt: skip
    shown = numbering.section(1, "Результаты")
    tables = []
    for group in dict.fromkeys(row.group for row in rows):
        block = results_block(labels, [row for row in rows if row.group == group])
        tables.append(Placed(block, numbering.place("table", group), group))
    drawn = numbering.section(1, "Диаграммы")
    figures = [
        Placed(Markup(curves_of(labels, chart)), numbering.place("figure", chart.key), chart.title)
        for chart in charts(engines)
    ]
    ending = numbering.section(1, "Выводы")
    page = environment(media=media).get_template("comparison/page.html.j2").render(
        doc=DocumentInfo(_TITLE, subject=", ".join(labels)),
        title=_TITLE,
        engines=[(engine.label, engine.model.engine.name, engine.source.name)
                 for engine in engines],
        headings=(data, shown, drawn, ending),
        data=data_table,
        only=only,
        tables=tables,
        lacking=lacking,
        figures=figures,
        sentences=conclusions(labels, rows),
        size="dense" if len(labels) <= _FEW else "tiny",
    )  # fmt: skip
    return spaces_inside(page)


def data_block(labels: Sequence[str], found: Sequence[Difference]) -> TableBlock:
    """What differs in the data."""
    columns = [Column("Величина", 2.6, text=True)]
    columns += [Column(label, 1.3, text=True) for label in labels]
    rows = [
        [_titled(row.title, row.unit), *(Markup("{}").format(_text(v)) for v in row.values)]
        for row in found
    ]
    return table_block(columns, rows or [["различий нет", *[""] * len(labels)]])


def _text(value: str | int | float | None) -> str:
    if value is None:
        return "—"
    return value if isinstance(value, str) else comma(f"{value:g}")


def results_block(labels: Sequence[str], rows: Sequence[Row]) -> TableBlock:
    """Values side by side, with the difference from the first engine below each."""
    columns = [Column("Величина", 2.6, text=True), *(Column(label, 1.2) for label in labels)]
    cells = []
    for row in rows:
        values = row.values
        line = []
        for number, value in enumerate(values):
            text = "—" if value is None else of_digits(value, row.quantity(number).digits)
            more = _change(row.change(number) if number else None)
            line.append(Markup("{}<br>{}").format(text, more) if more else Markup(text))
        cells.append([_titled(row.title, row.unit), *line])
    return table_block(columns, cells)


def _change(percent: float | None) -> str:
    """The difference in brackets: of ten times and more nobody reads per cent."""
    if percent is None:
        return ""
    if percent >= _MOST_PERCENT or _NONE_LEFT < percent < LEAST_PERCENT:
        return f"(×{NBSP}{grouped(short(float(f'{1 + percent / 100:.3g}')))})"
    if not float(f"{percent:.1f}"):
        return ""  # alike: the numbers themselves say so
    shown = fixed(percent, 1)
    return f"({'' if shown.startswith(MINUS) else '+'}{shown}{NBSP}%)"


def _titled(title: str, unit: str) -> str | Markup:
    """A title with its unit, which no line divides."""
    if not unit:
        return title
    return Markup('{}, <span class="nb">{}</span>').format(rich(title), rich(unit))


def curves_of(labels: Sequence[str], chart: Chart) -> str:
    """Curves of all engines; a shorter cycle is repeated to the length of the longest."""
    import numpy as np

    from reports.document.figures.curves import Curve, Panel, curves_figure

    grid = np.array(max((x for _, x, _ in chart.curves), key=lambda x: (x[-1], len(x))))
    curves = [
        Curve(labels[engine], np.interp(grid, x, y, period=x[-1])) for engine, x, y in chart.curves
    ]
    return curves_figure(grid, [Panel(curves, _with_symbol(chart))], X_TITLE)


def _with_symbol(chart: Chart) -> str:
    """Symbol and unit of the ordinate, the symbol in TeX."""
    column = chart.key.partition(".")[2]
    _, _, unit = chart.y_title.rpartition(", ")
    tex = quantity(column).tex if column else "M"
    return f"${tex}$, {unit}"
