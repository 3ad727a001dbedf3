"""Small workbooks as bytes, and parts of their sheets."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Mapping

from openpyxl import Workbook
from openpyxl.worksheet.formula import ArrayFormula

from reports.recalculation.evaluate import Evaluator
from reports.recalculation.grid import CellGrid
from reports.recalculation.read import read_grid
from reports.recalculation.sheets import read_sheet

SHEET = (
    '<worksheet xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main"><sheetData>'
    '<row r="1">{}</row></sheetData></worksheet>'
)


def book_of(
    cells: Mapping[str, object], arrays: Mapping[str, str] | None = None, title: str = "Sheet"
) -> bytes:
    """A book of one sheet; ``arrays`` are array formulas by their extent."""
    book = Workbook()
    book.active.title = title
    for at, value in cells.items():
        book.active[at] = value
    for extent, text in (arrays or {}).items():
        book.active[extent.partition(":")[0]] = ArrayFormula(extent, text)
    stream = io.BytesIO()
    book.save(stream)
    return stream.getvalue()


def engine_of(
    cells: Mapping[str, object], arrays: Mapping[str, str] | None = None, title: str = "Sheet"
) -> Evaluator:
    """The engine of such a book."""
    return Evaluator(read_grid(book_of(cells, arrays, title)))


def grid_of(cells: str, strings: list[str] | None = None) -> CellGrid:
    """A grid of one row of cells in XML."""
    grid = CellGrid(sheets={"A": {}})
    read_sheet(grid, "A", SHEET.format(cells).encode(), strings or [])
    return grid


def sheets_of(book: bytes) -> list[bytes]:
    """Parts of the sheets."""
    with zipfile.ZipFile(io.BytesIO(book)) as archive:
        return [archive.read(n) for n in archive.namelist() if n.startswith("xl/worksheets/s")]
