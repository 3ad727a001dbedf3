"""Sheets of studies and comparisons: landscape pages, no chart cut in two.

Fitted to pages a sheet is cut anywhere: Excel then passes over the breaks that are set.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import floor

from openpyxl import Workbook
from openpyxl.cell import Cell as SheetCell
from openpyxl.chart import ScatterChart
from openpyxl.styles import Alignment, Font
from openpyxl.utils import get_column_letter
from openpyxl.worksheet.pagebreak import Break
from openpyxl.worksheet.properties import PageSetupProperties
from openpyxl.worksheet.worksheet import Worksheet

from reports.workbook.charts import STUDY
from reports.workbook.layout import Cell
from reports.workbook.places import COLUMN, DIGIT, ROW
from reports.workbook.print_setup import PAPER, SURE, set_margins
from reports.workbook.styles import FONT

_ACROSS, _DOWN = 2, 3  # charts on a page
_COLUMNS, _ROWS = 10, 15  # that a chart takes
_SMALL = 60  # per cent: of tables that take several pages across
_CM = 96 / 2.54  # px


def new_book(*, rows_only: bool = False) -> Workbook:
    """Return a workbook without sheets; ``rows_only`` writes rows as they come."""
    book = Workbook(write_only=rows_only)
    if not rows_only:
        book.remove(book.active)
    book.properties.creator = "kshm"
    return book


def bold(cell: SheetCell, *, head: bool = False, size: float | None = None) -> SheetCell:
    """Return the cell in bold; the head of a column is centred and wraps."""
    cell.font = Font(name=FONT, bold=True, size=size)
    if head:
        cell.alignment = Alignment(wrap_text=True, vertical="center", horizontal="center")
    return cell


def lay(sheet: Worksheet, *, rows: str = "", columns: str = "") -> None:
    """Lying pages as wide as the sheet, or several across that repeat rows and columns."""
    page = sheet.page_setup
    page.orientation, page.paperSize = "landscape", Worksheet.PAPERSIZE_A4
    if columns:
        page.scale, sheet.print_title_cols = _SMALL, columns
    else:
        page.fitToWidth, page.fitToHeight = 1, 0
        sheet.sheet_properties.pageSetUpPr = PageSetupProperties(fitToPage=True)
    if rows:
        sheet.print_title_rows = rows
    set_margins(sheet)


def hang(sheet: Worksheet, charts: Sequence[ScatterChart], first: int) -> None:
    """Charts side by side from a row on, whole on the pages of the print."""
    for index in range(1, _ACROSS * _COLUMNS + 1):  # programs differ in the width of theirs
        sheet.column_dimensions[get_column_letter(index)].width = COLUMN / DIGIT
    for number, chart in enumerate(charts):
        down, across = divmod(number, _ACROSS)
        cell = Cell(sheet.title, first + _ROWS * down, 1 + _COLUMNS * across)
        sheet.add_chart(chart, cell.coordinate)
    width = COLUMN * _COLUMNS * (_ACROSS - 1) + STUDY[0] * _CM
    height = ROW * (first - 1 + _ROWS * _DOWN)
    wide, high = PAPER["landscape"]
    sheet.page_setup.orientation = "landscape"
    sheet.page_setup.paperSize = Worksheet.PAPERSIZE_A4
    sheet.page_setup.scale = floor(100 * SURE * min(wide / width, high / height))
    on_page = _ACROSS * _DOWN
    for number in range(on_page, len(charts), on_page):
        sheet.row_breaks.append(Break(id=first - 1 + _ROWS * (number // _ACROSS)))
    set_margins(sheet)
