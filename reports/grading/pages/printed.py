"""The gradebook's sheet for the printer: a class of 140 on two landscape pages."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from openpyxl import Workbook
from openpyxl.styles import Alignment, Border, Font, PatternFill, Side

from reports.workbook.styles import as_text

TITLE = "Для печати"
_HEAD = ("№", "Студент", "Группа", "Баллы", "Состояние")
_WIDTHS = (3.2, 20.0, 7.0, 5.0, 11.0)  # in digits of the default font, for letters of _SIZE_PT
_TABLE = 4.2  # width of a table's points
_SIZE_PT, _PAGE = 5.6, 142.0  # size of the letters, width of a page
_HEAD_PT, _PAGE_PT = 56.0, 538.0  # heights: of the titles, of a page without margins
_LEAST_PT, _MOST_PT = 6.8, 13.0  # height of a row
_LARGE = 42  # students on one page; more take two, as many as these hold


def add_printed(
    book: Workbook, rows: Sequence[Mapping[str, Any]], shares: Sequence[Mapping[str, float]],
    blocks: Sequence[str],
) -> None:  # fmt: skip
    """Add the sheet; ``shares`` are the points of each row's tables."""
    sheet = book.create_sheet(TITLE)
    sheet.append([*_HEAD, *(block.removeprefix("Таблица ") for block in blocks)])
    on_page = len(rows) if len(rows) <= _LARGE else -(-len(rows) // 2)
    height = min(_MOST_PT, max(_LEAST_PT, (_PAGE_PT - _HEAD_PT) / max(1, on_page)))
    for row, of in zip(rows, shares, strict=True):
        sheet.append([row["number"], row["student"], row["group"], row["points"], row["status"],
                      *(of.get(block) for block in blocks)])  # fmt: skip
    widths = (*_WIDTHS, *(_TABLE for _ in blocks))
    large = min(height * 0.8 / _SIZE_PT, max(1.0, _PAGE / sum(widths)))
    size = round(_SIZE_PT * large, 1)
    thin = Side(style="hair")
    border, fill = (
        Border(bottom=thin, left=thin, right=thin),
        PatternFill("solid", fgColor="D9E2F3"),
    )
    plain, bold = Font(name="Calibri", size=size), Font(name="Calibri", size=min(6.5, size), b=True)
    inside = Alignment(shrink_to_fit=True, vertical="center")
    upright = Alignment(wrap_text=True, vertical="bottom")
    turned = Alignment(wrap_text=True, vertical="bottom", text_rotation=90)
    for number, line in enumerate(sheet.iter_rows(), 1):
        for cell in line:
            as_text(cell)
            table = cell.column > len(_HEAD)
            cell.font, cell.border = (bold if number == 1 else plain), border
            if number == 1:
                cell.fill, cell.alignment = fill, (turned if table else upright)
            else:
                cell.alignment = inside
                if table or _HEAD[cell.column - 1] == "Баллы":
                    cell.number_format = "0.0#"
        sheet.row_dimensions[number].height = _HEAD_PT if number == 1 else height
    for cell, width in zip(sheet[1], widths, strict=True):
        sheet.column_dimensions[cell.column_letter].width = width * large
    sheet.freeze_panes = sheet.cell(2, 3)
    sheet.page_setup.orientation, sheet.page_setup.paperSize = "landscape", sheet.PAPERSIZE_A4
    sheet.page_setup.fitToWidth = 1
    fits = on_page * _LEAST_PT <= _PAGE_PT - _HEAD_PT
    sheet.page_setup.fitToHeight = (1 if on_page == len(rows) else 2) if fits else 0
    sheet.sheet_properties.pageSetUpPr.fitToPage = True
    sheet.print_title_rows = "1:1"
    margins = sheet.page_margins
    margins.left = margins.right = margins.top = 0.3
    margins.bottom, margins.footer, margins.header = 0.45, 0.2, 0.1
    sheet.oddFooter.center.text, sheet.oddFooter.center.size = "Лист &P из &N", 8
