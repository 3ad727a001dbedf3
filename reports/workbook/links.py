"""Links from sheet to sheet."""

from __future__ import annotations

from openpyxl.worksheet.hyperlink import Hyperlink
from openpyxl.worksheet.worksheet import Worksheet

from reports.workbook import styles
from reports.workbook.layout import Cell, quoted


def link(sheet: Worksheet, place: Cell, text: str, target: str) -> None:
    """A link within the book, as a place: an address such as ``#'Лист'!A1`` is a foreign file."""
    cell = sheet.cell(place.row, place.column, text)
    at = place.coordinate
    cell.hyperlink = Hyperlink(ref=at, location=f"{quoted(target)}!A1", display=text)
    cell.style = styles.LINK
