"""The print-out: few pages, each with its sheet's name below, headers repeated."""

from __future__ import annotations

import io
import re
import subprocess
from pathlib import Path

from openpyxl import load_workbook

from tests.workbook.made import book
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
