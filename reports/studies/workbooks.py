"""Comparison and study as workbooks: tables, results with live formulas, charts."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from openpyxl.cell import WriteOnlyCell
from openpyxl.styles import Alignment
from openpyxl.utils import get_column_letter
from openpyxl.worksheet.worksheet import Worksheet

from kshm.results.chosen import ChosenQuantities, described
from reports.shared.errors import InputError, Problem
from reports.shared.russian import capital, short, uncapital
from reports.studies.comparison import (
    MIN_PERCENT,
    X_TITLE,
    Chart,
    Compared,
    charts,
    conclusions,
    differences,
    results,
    split_rows,
)
from reports.studies.plan import Axis, Chunk, Plan, span_text
from reports.studies.quantities import format_of, symbol_of
from reports.workbook.caches import finish
from reports.workbook.chart_ranges import CurveRanges
from reports.workbook.charts import curves_chart
from reports.workbook.layout import Cell, column_range
from reports.workbook.sheets import CacheValues
from reports.workbook.simple_workbook import bold, hang, lay, new_book
from reports.workbook.styles import excel_format

INPUTS, RESULTS, FIGURES, CURVES = "Данные", "Сравнение", "Диаграммы", "Кривые"
_HEAD = 3  # rows of titles above the values
MAX_ROWS = 100_000
MAX_CURVES = 12
MAX_CHARTS = 24
DATA, SUMMARY, CHARTS = "Результаты", "Сводка", "Диаграммы"
_FIRST = 3  # rows of keys and titles stand above
_NOWHERE = "не меняется"  # the place of an extreme of what stays the same
# Shown where nothing is asked for: of several pins each one's load, for another may lead.
_USUAL = re.compile(r"M_mean|M_max|M_e|N_i_calc|Rpin\d*_max|q_pin_max|worst_main_load")


class _Book:
    def __init__(self, engines: Sequence[Compared]) -> None:
        self.engines = engines
        self.book = new_book()
        self.caches = CacheValues()

    def sheet(self, name: str, widths: Sequence[float], title: str) -> Worksheet:
        sheet = self.book.create_sheet(name)
        for number, width in enumerate(widths, 1):
            sheet.column_dimensions[get_column_letter(number)].width = width
        bold(sheet.cell(1, 1, title), size=13)
        return sheet

    def head(self, sheet: Worksheet, texts: Sequence[str]) -> None:
        for number, text in enumerate(texts, 1):
            bold(sheet.cell(_HEAD, number, text), head=True)

    def formula(self, sheet: Worksheet, at: Cell, text: str, value: float, form: str) -> None:
        cell = sheet.cell(at.row, at.column, text)
        cell.number_format = form
        self.caches.values.setdefault(sheet.title, {})[cell.coordinate] = value


def book_bytes(engines: Sequence[Compared]) -> bytes:
    """Return the finished workbook."""
    book = _Book(engines)
    _data(book)
    _results(book)
    _charts(book, charts(engines))
    return finish(book.book, book.caches)


def _data(book: _Book) -> None:
    labels = [engine.label for engine in book.engines]
    sheet = book.sheet(INPUTS, (52, 14, 10, *[24] * len(labels)), "Чем отличаются исходные данные")
    book.head(sheet, ("Величина", "Обозначение", "Единица", *labels))
    sheet.append(["Двигатель", "", "", *[engine.model.engine.name for engine in book.engines]])
    sheet.append(["Файл", "", "", *[engine.source.name for engine in book.engines]])
    different, only = split_rows(differences(book.engines), labels)
    for row in different:
        symbol = row.symbol.replace("_", "")
        sheet.append([row.title, symbol, row.unit, *row.values])
    sheet.append([only])
    for cells in sheet.iter_rows(min_row=_HEAD + 1):
        for cell in cells:
            cell.alignment = Alignment(wrap_text=True, vertical="top")
            lines = -(-len(str(cell.value or "")) // (48 if cell.column == 1 else 22))
            height = sheet.row_dimensions[cell.row].height or 15
            sheet.row_dimensions[cell.row].height = max(height, 15 * lines)
            if isinstance(cell.value, str):  # names of people are no formulas
                cell.data_type = "s"
    sheet.freeze_panes = Cell(INPUTS, _HEAD + 1, 4).coordinate
    lay(sheet, rows=f"{_HEAD}:{_HEAD}")


def _results(book: _Book) -> None:
    count = len(book.engines)
    labels = [engine.label for engine in book.engines]
    widths = (72, 14, 10, *[16] * count, *[16] * (count - 1))
    sheet = book.sheet(RESULTS, widths, "Результаты; значения — из расчёта файлов листа «Данные»")
    others = [f"{label} к {labels[0]}, %" for label in labels[1:]]
    book.head(sheet, ("Величина", "Обозначение", "Единица", *labels, *others))
    rows, lacking = split_rows(results(book.engines), labels)
    number, group = _HEAD, ""
    for row in rows:
        if row.group != group:
            group, number = row.group, number + 1
            bold(sheet.cell(number, 1, group))
        number += 1
        for column, text in enumerate((row.title, row.symbol, row.unit), 1):
            sheet.cell(number, column, text)
        for index, value in enumerate(row.values):
            cell = sheet.cell(number, 4 + index, value)
            cell.number_format = excel_format(row.quantity(index))
        for index in range(1, count):
            change = row.change(index)
            if change is None:
                continue
            first, current = (Cell(RESULTS, number, 4 + i).coordinate for i in (0, index))
            at = Cell(RESULTS, number, 3 + count + index)
            look = "0.0###" if change < MIN_PERCENT else "0.0"
            book.formula(sheet, at, f"=({current}/{first}-1)*100", change, look)
    number += 2
    sheet.cell(number - 1, 1, lacking or None)
    bold(sheet.cell(number, 1, "Выводы"))
    for sentence in conclusions(labels, rows):
        number += 1
        sheet.cell(number, 1, sentence)
    sheet.freeze_panes = Cell(RESULTS, _HEAD + 1, 4).coordinate
    lay(sheet, rows=f"{_HEAD}:{_HEAD}")


def _charts(book: _Book, charts_of_all: Sequence[Chart]) -> None:
    drawn = book.sheet(FIGURES, (), "Кривые всех двигателей")
    sheet = book.sheet(CURVES, (), "Кривые по углу поворота; внизу — наибольшее и наименьшее")
    longest = max(len(x) for chart in charts_of_all for _, x, _ in chart.curves)
    low, high = _HEAD + longest + 1, _HEAD + longest + 2
    column, texts = 2, ["Строка"]
    sheet.cell(low, 1, "наименьшее")
    sheet.cell(high, 1, "наибольшее")
    pictures = []
    for chart in charts_of_all:
        curves = []
        for engine, x, y in chart.curves:
            label = book.engines[engine].label
            texts += [X_TITLE, f"{chart.y_title}: {label}"]
            for row, (angle, value) in enumerate(zip(x, y, strict=True), _HEAD + 1):
                sheet.cell(row, column, angle)
                sheet.cell(row, column + 1, value)
            last = _HEAD + len(x)
            letter = get_column_letter(column + 1)
            area = f"{letter}{_HEAD + 1}:{letter}{last}"
            book.formula(sheet, Cell(CURVES, low, column + 1), f"=MIN({area})", min(y), "0.000")
            book.formula(sheet, Cell(CURVES, high, column + 1), f"=MAX({area})", max(y), "0.000")
            curve = CurveRanges(
                label,
                column_range(CURVES, column, _HEAD + 1, last),
                column_range(CURVES, column + 1, _HEAD + 1, last),
            )
            book.caches.ranges[curve.x], book.caches.ranges[curve.y] = x, y
            curves.append(curve)
            column += 2
        ends = (0.0, max(x[-1] for _, x, _ in chart.curves))
        picture = curves_chart(chart.title, X_TITLE, chart.y_title, curves, ends)
        picture.x_axis.majorUnit = ends[1] / 12
        pictures.append(picture)
    hang(drawn, pictures, _HEAD)
    lay(sheet, rows=f"1:{_HEAD}", columns="A:A")
    book.head(sheet, texts)
    sheet.row_dimensions[_HEAD].height = 45
    sheet.freeze_panes = Cell(CURVES, _HEAD + 1, 2).coordinate


@dataclass
class _Extreme:
    """Greatest and least value of a quantity and the combinations where they stand."""

    largest: float = -math.inf
    smallest: float = math.inf
    at_largest: tuple[float | int, ...] = ()
    at_smallest: tuple[float | int, ...] = ()

    def see(self, value: float, row: tuple[float | int, ...]) -> None:
        """Take one value into account."""
        if value > self.largest:
            self.largest, self.at_largest = value, row
        if value < self.smallest:
            self.smallest, self.at_smallest = value, row


@dataclass
class StudyBook:
    """Writes rows as they come; only what the charts show is kept."""

    plan: Plan
    wanted: ChosenQuantities
    _extremes: dict[str, _Extreme] = field(default_factory=dict)
    _shown: dict[str, list[float]] = field(default_factory=dict)
    _formats: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        if self.plan.count > MAX_ROWS:
            problem = f"сочетаний {self.plan.count}, а в книге помещается {MAX_ROWS}"
            raise InputError(Problem("-o", problem, "выберите .parquet или .csv"))
        self._book = new_book(rows_only=True)
        self._first = self._book.create_sheet(SUMMARY)
        self._drawn = self._book.create_sheet(CHARTS) if self._charted() else None
        self._data = self._book.create_sheet(DATA)  # the long sheet comes last
        names = self.wanted.names
        self._extremes = {name: _Extreme() for name in names}
        self._shown = {name: [] for name in self._charted()}
        for number, text in enumerate([*(axis.key for axis in self.plan.axes), *names, "error"], 1):
            self._data.column_dimensions[get_column_letter(number)].width = max(16, len(text) + 3)
        self._data.row_dimensions[1].height, self._data.row_dimensions[2].height = 20, 62
        self._formats = [format_of(name, self.wanted) for name in names]
        self._data.freeze_panes = Cell(DATA, _FIRST, len(self.plan.axes) + 1).coordinate
        last = get_column_letter(len(self.plan.axes))
        lay(self._data, rows=f"1:{_FIRST - 1}", columns=f"A:{last}")
        keys = [axis.key for axis in self.plan.axes]
        titles = [_headed(axis.title, axis.unit) for axis in self.plan.axes]
        titles += [_headed(*described(name, self.wanted)) for name in names]
        self._data.append([self._head(text) for text in (*keys, *names, "error")])
        self._data.append([self._head(text) for text in (*titles, "Почему нет результата")])

    def _head(self, text: str) -> WriteOnlyCell:
        return bold(WriteOnlyCell(self._data, text), head=True)

    def _charted(self) -> list[str]:
        """Quantities with a chart each: those asked for, or the usual ones."""
        if len(self.plan.axes) > 2 and not self.plan.pairwise:
            return []
        names = [name for name in self.wanted.names if not name.endswith("_deg")]
        usual = [name for name in names if _USUAL.fullmatch(name)]
        return (usual or names)[:MAX_CHARTS] if len(names) > MAX_CHARTS else names

    def write(self, chunk: Chunk) -> None:
        """Append rows; what has no result stays empty and says why."""
        names = self.wanted.names
        columns = [chunk.values[name].tolist() for name in names]
        for row, values, error in zip(
            chunk.rows, zip(*columns, strict=True), chunk.errors, strict=True
        ):
            numbers = [None] * len(names) if error else self._numbers(values)
            self._data.append([*row, *numbers, error or None])
            for name, value in zip(names, values, strict=True):
                if not error:
                    self._extremes[name].see(value, row)
                if name in self._shown:
                    self._shown[name].append(math.nan if error else value)

    def _numbers(self, values: Sequence[float]) -> list[WriteOnlyCell]:
        cells = []
        for value, form in zip(values, self._formats, strict=True):
            cell = WriteOnlyCell(self._data, value)
            cell.number_format = form
            cells.append(cell)
        return cells

    def close(self) -> None:
        """Give up: the sheet is a file under way."""
        self._data.close()

    def data(self) -> bytes:
        """Return the finished workbook."""
        self._summary()
        ranges = self._charts()
        return finish(self._book, CacheValues(ranges=ranges))

    def _summary(self) -> None:
        sheet = self._first
        lay(sheet, rows=f"{len(self.plan.axes) + 2}:{len(self.plan.axes) + 2}")
        for letter, width in (("A", 26), ("B", 60), ("C", 12)):
            sheet.column_dimensions[letter].width = width
        for number in range(4, 6 + 2 * len(self.plan.axes)):
            sheet.column_dimensions[get_column_letter(number)].width = 17
        for axis in self.plan.axes:
            sheet.append([axis.key, span_text(axis)])
        sheet.append([])
        keys = [axis.key for axis in self.plan.axes]
        sheet.append(
            [self._head(text) for text in
             ("Ключ", "Величина", "Единица", "Наибольшее", *[f"при {key}" for key in keys],
              "Наименьшее", *[f"при {key}" for key in keys])]
        )  # fmt: skip
        for name, extreme in self._extremes.items():
            if extreme.at_largest:
                title, unit = described(name, self.wanted)
                largest, smallest = (
                    WriteOnlyCell(sheet, v) for v in (extreme.largest, extreme.smallest)
                )
                largest.number_format = smallest.number_format = format_of(name, self.wanted)
                still = _level((extreme.smallest, extreme.largest)) is not None
                cells = [
                    (_NOWHERE,) * len(keys) if still else at
                    for at in (extreme.at_largest, extreme.at_smallest)
                ]
                sheet.append([name, title, unit, largest, *cells[0], smallest, *cells[1]])

    def _charts(self) -> dict[str, list[float]]:
        """One chart a quantity; the numbers of their ranges."""
        ranges: dict[str, list[float]] = {}
        sheet = self._drawn
        if sheet is None:
            return ranges
        x = self.plan.axes[0]
        names = self.wanted.names
        charts = []
        for name, values in self._shown.items():
            column = len(self.plan.axes) + 1 + names.index(name)
            curves = []
            for label, first, count in self._runs():
                if not any(map(math.isfinite, values[first : first + count])):
                    continue  # none of its combinations has a result: a key would name no curve
                rows = (_FIRST + first, _FIRST + first + count - 1)
                curve = CurveRanges(
                    label, column_range(DATA, 1, *rows), column_range(DATA, column, *rows)
                )
                ranges[curve.x] = [float(value) for value in x.values[:count]]
                ranges[curve.y] = values[first : first + count]
                curves.append(curve)
            if not curves:
                continue
            title, unit = described(name, self.wanted)
            title = capital(title)
            if all(curve.name for curve in curves):
                title += f"; кривые: {uncapital(self.plan.axes[1].title)}"
            ends = (float(min(x.values)), float(max(x.values)))
            chart = curves_chart(
                title,
                _headed(x.title, x.unit),
                _headed(symbol_of(name, self.wanted), unit),
                curves,
                ends,
            )
            level = _level(values)
            if level is not None:  # else the axis would show rounding
                span = abs(level) / 10 or 1.0
                chart.y_axis.scaling.min, chart.y_axis.scaling.max = level - span, level + span
            charts.append(chart)
        hang(sheet, charts, 1)
        return ranges

    def _runs(self) -> Iterator[tuple[str, int, int]]:
        """Rows of each curve: all of them, or those of one value of the second input."""
        axes = self.plan.axes
        if len(axes) == 1 or self.plan.pairwise:
            yield "", 0, self.plan.count
            return
        count, second = len(axes[0].values), axes[1]
        step = max(1, math.ceil(len(second.values) / MAX_CURVES))
        for number in range(0, len(second.values), step):
            yield _valued(second, number), number * count, count


def _level(values: Sequence[float]) -> float | None:
    """Return the value of a quantity that stays the same but for rounding."""
    finite = [value for value in values if math.isfinite(value)]
    if not finite or max(finite) - min(finite) > 1e-9 * max(map(abs, finite)):
        return None
    return float(f"{finite[0]:.6g}")


def _valued(axis: Axis, number: int) -> str:
    unit = f" {axis.unit}" if axis.unit else ""
    return f"{short(axis.values[number])}{unit}"


def _headed(title: str, unit: str) -> str:
    return f"{title}, {unit}" if unit else title
