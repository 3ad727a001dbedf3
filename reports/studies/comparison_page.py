"""Comparison as page, report chapter and file."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from markupsafe import Markup

from kshm.nomenclature.quantity import quantity
from reports.document.page.blocks import DocumentInfo, TableBlock, TableColumn, table_block
from reports.document.page.numbering import Draft, Label
from reports.document.text.texts import of_digits, rich, spaces_inside
from reports.exports.build import load_input
from reports.exports.numbers import neutralised
from reports.inputs.load import Loaded
from reports.inputs.sections.input_file import InputFile
from reports.shared.errors import InputError, Problem
from reports.shared.files import write_bytes, write_text
from reports.shared.russian import MINUS, NBSP, comma, fixed, grouped, short, uncapital
from reports.studies.comparison import (
    MIN_PERCENT,
    X_TITLE,
    Chart,
    Compared,
    Difference,
    Row,
    charts,
    check_sources,
    conclusions,
    differences,
    read_engines,
    results,
    split_rows,
)

if TYPE_CHECKING:
    from reports.document.chapters.chapter import Chapter


_TITLE = "Сравнение двигателей"
_MAX_PERCENT = 900
_NONE_LEFT = -99.99  # and here hardly anything is left that a table could show
_FEW = 4  # engines that fit beside the words at the usual size
KEY = "report.compare"
_FEW_ENGINES = 3  # engines whose columns fit at the usual size of dense tables
SUFFIXES = (".xlsx", ".pdf", ".html", ".csv", ".json")


@dataclass(frozen=True, slots=True)
class NumberedBlock:
    """A table or a figure with its number."""

    body: TableBlock | Markup
    label: Label
    caption: str


def comparison_page(engines: Sequence[Compared], *, media: Literal["print", "screen"]) -> str:
    """Return the whole page with style sheet and fonts inside."""
    from reports.document.page.render import environment

    numbering = Draft()
    labels = [engine.label for engine in engines]
    rows, lacking = split_rows(results(engines), labels)
    different, only = split_rows(differences(engines), labels)
    data = numbering.section(1, "Чем отличаются исходные данные")
    data_table = NumberedBlock(data_block(labels, different), numbering.place("table", "data"),
                        "Исходные данные, которые не совпадают")  # fmt: skip
    section = numbering.section(1, "Результаты")
    tables = []
    for group in dict.fromkeys(row.group for row in rows):
        block = results_block(labels, [row for row in rows if row.group == group])
        tables.append(NumberedBlock(block, numbering.place("table", group), group))
    drawn = numbering.section(1, "Диаграммы")
    figures = [
        NumberedBlock(
            Markup(curves_of(labels, chart)), numbering.place("figure", chart.key), chart.title
        )
        for chart in charts(engines)
    ]
    ending = numbering.section(1, "Выводы")
    page = environment(media=media).get_template("comparison/page.html.j2").render(
        doc=DocumentInfo(_TITLE, subject=", ".join(labels)),
        title=_TITLE,
        engines=[(engine.label, engine.model.engine.name, engine.source.name)
                 for engine in engines],
        headings=(data, section, drawn, ending),
        data=data_table,
        only=only,
        tables=tables,
        lacking=lacking,
        figures=figures,
        sentences=conclusions(labels, rows),
        size="dense" if len(labels) <= _FEW else "tiny",
    )  # fmt: skip
    return spaces_inside(page)


def data_block(labels: Sequence[str], differing: Sequence[Difference]) -> TableBlock:
    """Return what differs in the data."""
    columns = [TableColumn("Величина", 2.6, text=True)]
    columns += [TableColumn(label, 1.3, text=True) for label in labels]
    rows = [
        [_titled(row.title, row.unit), *(Markup("{}").format(_text(v)) for v in row.values)]
        for row in differing
    ]
    return table_block(columns, rows or [["различий нет", *[""] * len(labels)]])


def _text(value: str | int | float | None) -> str:
    if value is None:
        return "—"
    return value if isinstance(value, str) else comma(f"{value:g}")


def results_block(labels: Sequence[str], rows: Sequence[Row]) -> TableBlock:
    """Values side by side, with the difference from the first engine below each."""
    columns = [
        TableColumn("Величина", 2.6, text=True),
        *(TableColumn(label, 1.2) for label in labels),
    ]
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
    """Return the difference in brackets: of ten times and more nobody reads per cent."""
    if percent is None:
        return ""
    if percent >= _MAX_PERCENT or _NONE_LEFT < percent < MIN_PERCENT:
        return f"(×{NBSP}{grouped(short(float(f'{1 + percent / 100:.3g}')))})"
    if not float(f"{percent:.1f}"):
        return ""  # alike: the numbers themselves say so
    text = fixed(percent, 1)
    return f"({'' if text.startswith(MINUS) else '+'}{text}{NBSP}%)"


def _titled(title: str, unit: str) -> str | Markup:
    """Return a title with its unit, which no line divides."""
    if not unit:
        return title
    return Markup('{}, <span class="nb">{}</span>').format(rich(title), rich(unit))


def curves_of(labels: Sequence[str], chart: Chart) -> str:
    """Curves of all engines; a shorter cycle is repeated to the length of the longest."""
    import numpy as np

    from reports.document.figures.curves import Panel, PlotCurve, curves_figure

    grid = np.array(max((x for _, x, _ in chart.curves), key=lambda x: (x[-1], len(x))))
    curves = [
        PlotCurve(labels[engine], np.interp(grid, x, y, period=x[-1]))
        for engine, x, y in chart.curves
    ]
    return curves_figure(grid, [Panel(curves, _with_symbol(chart))], X_TITLE)


def _with_symbol(chart: Chart) -> str:
    """Symbol and unit of the ordinate, the symbol in TeX."""
    column = chart.key.partition(".")[2]
    _, _, unit = chart.y_title.rpartition(", ")
    tex = quantity(column).tex if column else "M"
    return f"${tex}$, {unit}"


def with_others(path: Path, loaded: Loaded) -> Loaded:
    """Return the input with the files it is compared with among those that were read.

    Raises:
        InputError: one of them is missing or wrong, or there are too many.
    """
    others = _others(path, loaded)
    for other in others:
        load_input(other)
    return replace(loaded, beside=(*loaded.beside, *others))


def _others(path: Path, loaded: Loaded) -> list[Path]:
    names = [name.strip() for name in loaded.model.report.compare.split(";") if name.strip()]
    others = [path.parent / name for name in names]
    for other in others:
        if not other.is_file():
            hint = "укажите файлы от файла исходных данных, через точку с запятой"
            raise InputError(Problem(KEY, f"нет файла {other}", hint))
    if others:
        check_sources([path, *others], where=KEY)
    return others


def comparison_chapters(path: Path, loaded: Loaded) -> tuple[ComparisonChapter, ...]:
    """Return the chapter of a checked input, none where its file names no other engines.

    Raises:
        InputError: a named file is wrong, or an engine gives no finite result.
    """
    others = _others(path, loaded)
    if not others:
        return ()
    models = [loaded.model, *(load_input(other).model for other in others)]
    engines = read_engines([path, *others], models)
    return (
        ComparisonChapter(
            engines=tuple((e.label, e.model.engine.name, e.source.name) for e in engines),
            differences=differences(engines),
            rows=results(engines),
            charts=charts(engines),
        ),
    )


@dataclass(frozen=True, slots=True)
class ComparisonChapter:
    """What the chapter prints; the first engine is that of the report."""

    engines: tuple[tuple[str, str, str], ...]  # label, name, file
    differences: tuple[Difference, ...]
    rows: tuple[Row, ...]
    charts: tuple[Chart, ...]

    def __call__(self, chapter: Chapter) -> Markup:
        """Set the chapter."""
        from reports.document.page.numbering import Figure, TablePlan

        labels = [label for label, *_ in self.engines]
        size = "dense" if len(labels) <= _FEW_ENGINES else "tiny"
        different, only = split_rows(self.differences, labels)
        listed, lacking = split_rows(self.rows, labels)
        data = TablePlan(
            partial(data_block, labels, different),
            "Исходные данные, которые не совпадают", size=size, lined=True,
        )  # fmt: skip
        groups: dict[str, list[Row]] = {}
        for row in listed:
            groups.setdefault(row.group, []).append(row)
        tables = [
            (f"compare_{number}",
             TablePlan(partial(results_block, labels, rows), f"Сравнение: {uncapital(group)}",
                       size=size, lined=True))
            for number, (group, rows) in enumerate(groups.items(), 1)
        ]  # fmt: skip
        figures = [
            (f"compare_{chart.key}",
             Figure(partial(curves_of, labels, chart), f"{chart.title}: сравнение двигателей",
                    f"{chart.title}: {', '.join(labels)}"))
            for chart in self.charts
        ]  # fmt: skip
        return chapter.page(
            "comparison",
            engines=self.engines,
            data=data,
            only=only,
            tables=tables,
            lacking=lacking,
            figures=figures,
            sentences=conclusions(labels, self.rows),
        )


def check_suffix(target: Path) -> None:
    """Refuse an ending that is none of ``SUFFIXES``.

    Raises:
        InputError: it is none of them.
    """
    if target.suffix.lower() not in SUFFIXES:
        problem = f"нужно окончание {', '.join(SUFFIXES)}"
        raise InputError(Problem(target.name, problem, "укажите имя ключом -o"))


def write(sources: Sequence[Path], models: Sequence[InputFile], target: Path) -> None:
    """Write the comparison of checked engines.

    Raises:
        InputError: an engine gives no finite result.
        OutputError: the file cannot be written.
        SystemPartMissing: pango is missing for a PDF.
    """
    engines = read_engines(sources, models)
    suffix = target.suffix.lower()
    if suffix == ".xlsx":
        from reports.studies.workbooks import book_bytes

        write_bytes(target, book_bytes(engines))
        return
    if suffix in (".csv", ".json"):
        write_text(target, _rows_csv(engines) if suffix == ".csv" else _rows_json(engines))
        return
    from reports.document.page.render import render_pdf

    if suffix == ".html":
        write_text(target, comparison_page(engines, media="screen"))
    else:
        write_bytes(target, render_pdf(comparison_page(engines, media="print")))


def _rows(engines: Sequence[Compared]) -> Iterator[dict[str, Any]]:
    """Yield data that differ and results, a row each."""
    for differing in differences(engines):
        yield {
            "group": differing.group or "Данные", "key": "", "title": differing.title,
            "symbol": differing.symbol, "unit": differing.unit, "values": differing.values,
        }  # fmt: skip
    for row in results(engines):
        yield {
            "group": row.group, "key": row.key, "title": row.title, "symbol": row.symbol,
            "unit": row.unit, "values": row.values,
        }  # fmt: skip


def _rows_csv(engines: Sequence[Compared]) -> str:
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    heads = ("group", "key", "title", "symbol", "unit")
    writer.writerow([*heads, *(neutralised(engine.label) for engine in engines)])
    for row in _rows(engines):
        values = ("" if value is None else value for value in row["values"])
        writer.writerow([*(row[head] for head in heads), *values])
    return stream.getvalue()


def _rows_json(engines: Sequence[Compared]) -> str:
    data = {"engines": [engine.label for engine in engines], "rows": list(_rows(engines))}
    return json.dumps(data, ensure_ascii=False, allow_nan=False, indent=1) + "\n"
