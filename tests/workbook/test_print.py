"""The print-out: few pages, each with its sheet's name below, headers repeated."""

from __future__ import annotations

import io
import re
import subprocess
from pathlib import Path

import pytest
from openpyxl import load_workbook

from reports.workbook.layout import HEADER_ROW
from reports.workbook.places import column_px
from tests.conftest import sample_names
from tests.workbook.made import book, coarse_book
from tools.referees.by_libreoffice import LibreOffice

MOST_PAGES = 60


def test_the_textbooks_diesel_takes_few_pages(libreoffice: LibreOffice, tmp_path: Path) -> None:
    path = tmp_path / "book.pdf"
    path.write_bytes(libreoffice.converted([book()], "pdf")[0])
    done = subprocess.run(["pdftotext", str(path), "-"], capture_output=True, text=True, check=True)
    pages = done.stdout.split("\f")[:-1]
    assert len(pages) <= MOST_PAGES
    assert all(re.search(r". — лист \d+ из \d+", page) for page in pages)


def test_tables_repeat_their_headers() -> None:
    sheets = load_workbook(io.BytesIO(book())).worksheets
    tables = [
        sheet for sheet in sheets if sheet.freeze_panes and sheet.freeze_panes.startswith("B")
    ]
    assert len(tables) > 20
    assert all(sheet.print_title_rows for sheet in tables)
    assert all(sheet.oddFooter.center.text for sheet in sheets)


@pytest.mark.parametrize("name", sample_names())
def test_no_page_begins_within_a_table_beside_others(name: str) -> None:
    """Its rest would stand under the beginning of the first one's title."""
    for sheet in load_workbook(io.BytesIO(coarse_book(name))).worksheets:
        starts = [cell.column for cell in sheet[HEADER_ROW - 1] if cell.value]
        if sheet.sheet_properties.pageSetUpPr.fitToPage:
            assert len(starts) < 2 or sheet.page_setup.fitToWidth == 1, sheet.title
            continue
        breaks = [found.id + 1 for found in sheet.col_breaks.brk]
        assert breaks == starts[1:]
        assert not sheet.print_title_cols
        assert sheet.page_setup.orientation == "portrait"
        ends = [*breaks, sheet.max_column + 1]
        for start, end in zip([1, *breaks], ends, strict=True):
            width = sum(column_px(sheet, i) for i in range(start, end))
            assert width * sheet.page_setup.scale / 100 <= 690
