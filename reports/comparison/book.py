"""The comparison as a workbook: data, results with live differences, curves, charts."""

from __future__ import annotations

from collections.abc import Sequence

from openpyxl import Workbook
from openpyxl.styles import Alignment, Font
from openpyxl.utils import get_column_letter
from openpyxl.worksheet.worksheet import Worksheet

from reports.comparison.conclusions import conclusions
from reports.comparison.engines import (
    LEAST_PERCENT,
    X_TITLE,
    Chart,
    Compared,
    apart,
    charts,
    differences,
    results,
)
from reports.workbook.caches import finish
from reports.workbook.charts import curves_chart
from reports.workbook.drawn import Curve
from reports.workbook.gallery import hang, lay
from reports.workbook.layout import Cell, column_range
from reports.workbook.sheets import CacheValues
from reports.workbook.styles import FONT, excel_format

DATA, RESULTS, FIGURES, CURVES = "Данные", "Сравнение", "Диаграммы", "Кривые"
_HEAD = 3  # rows of titles above the values


class _Book:
    def __init__(self, engines: Sequence[Compared]) -> None:
        self.engines = engines
        self.book = Workbook()
        self.book.remove(self.book.active)
        self.book.properties.creator = "kshm"
        self.caches = CacheValues()

    def sheet(self, name: str, widths: Sequence[float], title: str) -> Worksheet:
        made = self.book.create_sheet(name)
        for number, width in enumerate(widths, 1):
            made.column_dimensions[get_column_letter(number)].width = width
        made.cell(1, 1, title).font = Font(name=FONT, bold=True, size=13)
        return made

    def head(self, sheet: Worksheet, texts: Sequence[str]) -> None:
        for number, text in enumerate(texts, 1):
            cell = sheet.cell(_HEAD, number, text)
            cell.font = Font(name=FONT, bold=True)
            cell.alignment = Alignment(wrap_text=True, vertical="center", horizontal="center")

    def formula(self, sheet: Worksheet, at: Cell, text: str, value: float, form: str) -> None:
        cell = sheet.cell(at.row, at.column, text)
        cell.number_format = form
        self.caches.values.setdefault(sheet.title, {})[cell.coordinate] = value


def book_bytes(engines: Sequence[Compared]) -> bytes:
    """The finished workbook."""
    made = _Book(engines)
    _data(made)
    _results(made)
    _charts(made, charts(engines))
    return finish(made.book, made.caches)


def _data(made: _Book) -> None:
    labels = [engine.label for engine in made.engines]
    sheet = made.sheet(DATA, (52, 14, 10, *[24] * len(labels)), "Чем отличаются исходные данные")
    made.head(sheet, ("Величина", "Обозначение", "Единица", *labels))
    sheet.append(["Двигатель", "", "", *[engine.model.engine.name for engine in made.engines]])
    sheet.append(["Файл", "", "", *[engine.source.name for engine in made.engines]])
    different, only = apart(differences(made.engines), labels)
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
    sheet.freeze_panes = Cell(DATA, _HEAD + 1, 4).coordinate
    lay(sheet, rows=f"{_HEAD}:{_HEAD}")


def _results(made: _Book) -> None:
    count = len(made.engines)
    labels = [engine.label for engine in made.engines]
    widths = (72, 14, 10, *[16] * count, *[16] * (count - 1))
    sheet = made.sheet(RESULTS, widths, "Результаты; значения — из расчёта файлов листа «Данные»")
    others = [f"{label} к {labels[0]}, %" for label in labels[1:]]
    made.head(sheet, ("Величина", "Обозначение", "Единица", *labels, *others))
    rows, lacking = apart(results(made.engines), labels)
    number, group = _HEAD, ""
    for row in rows:
        if row.group != group:
            group, number = row.group, number + 1
            sheet.cell(number, 1, group).font = Font(name=FONT, bold=True)
        number += 1
        for column, text in enumerate((row.title, row.symbol, row.unit), 1):
            sheet.cell(number, column, text)
        for place, value in enumerate(row.values):
            cell = sheet.cell(number, 4 + place, value)
            cell.number_format = excel_format(row.quantity(place))
        for place in range(1, count):
            change = row.change(place)
            if change is None:
                continue
            first, own = (Cell(RESULTS, number, 4 + i).coordinate for i in (0, place))
            at = Cell(RESULTS, number, 3 + count + place)
            look = "0.0###" if change < LEAST_PERCENT else "0.0"
            made.formula(sheet, at, f"=({own}/{first}-1)*100", change, look)
    number += 2
    sheet.cell(number - 1, 1, lacking or None)
    sheet.cell(number, 1, "Выводы").font = Font(name=FONT, bold=True)
    for sentence in conclusions(labels, rows):
        number += 1
        sheet.cell(number, 1, sentence)
    sheet.freeze_panes = Cell(RESULTS, _HEAD + 1, 4).coordinate
    lay(sheet, rows=f"{_HEAD}:{_HEAD}")


def _charts(made: _Book, found: Sequence[Chart]) -> None:
    drawn = made.sheet(FIGURES, (), "Кривые всех двигателей")
    sheet = made.sheet(CURVES, (), "Кривые по углу поворота; внизу — наибольшее и наименьшее")
    longest = max(len(x) for chart in found for _, x, _ in chart.curves)
    low, high = _HEAD + longest + 1, _HEAD + longest + 2
    column, texts = 2, ["Строка"]
    sheet.cell(low, 1, "наименьшее")
    sheet.cell(high, 1, "наибольшее")
    pictures = []
    for chart in found:
        curves = []
        for engine, x, y in chart.curves:
            label = made.engines[engine].label
            texts += [X_TITLE, f"{chart.y_title}: {label}"]
            for row, (angle, value) in enumerate(zip(x, y, strict=True), _HEAD + 1):
                sheet.cell(row, column, angle)
                sheet.cell(row, column + 1, value)
            last = _HEAD + len(x)
            letter = get_column_letter(column + 1)
            area = f"{letter}{_HEAD + 1}:{letter}{last}"
            made.formula(sheet, Cell(CURVES, low, column + 1), f"=MIN({area})", min(y), "0.000")
            made.formula(sheet, Cell(CURVES, high, column + 1), f"=MAX({area})", max(y), "0.000")
            curve = Curve(
                label,
                column_range(CURVES, column, _HEAD + 1, last),
                column_range(CURVES, column + 1, _HEAD + 1, last),
            )
            made.caches.ranges[curve.x], made.caches.ranges[curve.y] = x, y
            curves.append(curve)
            column += 2
        ends = (0.0, max(x[-1] for _, x, _ in chart.curves))
        picture = curves_chart(chart.title, X_TITLE, chart.y_title, curves, ends)
        picture.x_axis.majorUnit = ends[1] / 12
        pictures.append(picture)
    hang(drawn, pictures, _HEAD)
    lay(sheet, rows=f"1:{_HEAD}", columns="A:A")
    made.head(sheet, texts)
    sheet.row_dimensions[_HEAD].height = 45
    sheet.freeze_panes = Cell(CURVES, _HEAD + 1, 2).coordinate
