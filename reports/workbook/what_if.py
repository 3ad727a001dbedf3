"""The sheet of what changes: the data and results as issued beside those of the book now.

The numbers as issued are typed in once, when the book is made; what stands beside them are the
cells of the book.
"""

from __future__ import annotations

from openpyxl.formatting.rule import FormulaRule
from openpyxl.styles import PatternFill
from openpyxl.workbook import Workbook
from openpyxl.worksheet.worksheet import Worksheet

from reports.model.blocks import Model
from reports.workbook import styles
from reports.workbook.cockpit import RESULTS, known
from reports.workbook.layout import HEADER_ROW, NOTE_ROW, Cell
from reports.workbook.places import raise_row, wrap_across
from reports.workbook.sheets import Writer

SHEET = "Что если"
_WIDTHS = {"A": 62, "B": 14, "C": 14, "D": 14, "E": 14, "F": 14}
_HEAD = ("Величина", "Обозначение", "Было", "Стало", "Разница, %", "Единица")
_NOTE = (
    "Измените жёлтую ячейку на листе «Исходные данные»: здесь видно, что от этого изменилось. "
    "Вернуть: впишите на том листе число из столбца «Было»."
)
_NO_PART = "—"


def write_what_if(book: Workbook, model: Model, writer: Writer) -> None:
    """Fill the sheet: results first, then the data that may be changed."""
    sheet = book[SHEET]
    for letter, width in _WIDTHS.items():
        sheet.column_dimensions[letter].width = width
    sheet.cell(NOTE_ROW, 2, _NOTE).style = styles.NOTE
    wrap_across(sheet, NOTE_ROW, 2, len(_HEAD))
    sheet.freeze_panes = Cell(SHEET, HEADER_ROW + 1, 1).coordinate
    for column, text in enumerate(_HEAD, 1):
        sheet.cell(HEADER_ROW, column, text).style = styles.HEADER
    free = [
        item.name
        for item in model.inputs
        if not item.structural and isinstance(item.value, float) and not item.listed
    ]
    row = _part(sheet, writer, HEADER_ROW + 1, "Главные результаты", RESULTS)
    last = _part(sheet, writer, row, "Исходные данные", free)
    changed = FormulaRule(formula=[f"$E{HEADER_ROW + 1}<>0"], fill=PatternFill(bgColor="FFEB9C"))
    sheet.conditional_formatting.add(f"D{HEADER_ROW + 1}:E{last}", changed)


def _part(
    sheet: Worksheet, writer: Writer, row: int, title: str, keys: list[str] | tuple[str, ...]
) -> int:
    """Lines of some values; the row behind them."""
    sheet.cell(row, 1, title).style = styles.SUBTITLE
    for text, symbol, formula, value, unit, look in known(writer, keys):
        if isinstance(value, str):
            continue
        row += 1
        raise_row(sheet, row, {text: _WIDTHS["A"]})
        for column, words in ((1, text), (2, symbol), (6, unit)):
            sheet.cell(row, column, words or None).style = styles.TEXT
        was, now = (Cell(SHEET, row, column).coordinate for column in (3, 4))
        sheet.cell(row, 3, value)
        writer.formula(sheet, row, 4, formula, value)
        # Noise of the last digits is no change; of what was nothing there is no part to tell.
        from_nothing = f'IF(ROUND({now},9)=0,0,"{_NO_PART}")'
        difference = f"=IF({was}=0,{from_nothing},ROUND(({now}/{was}-1)*100,6))"
        writer.formula(sheet, row, 5, difference, 0.0)
        for column, form in ((3, look), (4, look), (5, "0.00")):
            sheet.cell(row, column).style = styles.FORMULA
            sheet.cell(row, column).number_format = form
    return row + 2
