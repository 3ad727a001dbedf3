"""The print-out: few pages, each with its sheet's name below, headers repeated."""

from __future__ import annotations

import io
import re
import subprocess
from itertools import pairwise
from pathlib import Path

import pytest
from openpyxl import Workbook, load_workbook
from openpyxl.worksheet.worksheet import Worksheet

from reports.workbook.course import short_model
from reports.workbook.layout import HEADER_ROW, NUMBER_ROW, WAVES_SHEET
from reports.workbook.places import Box, column_px, extent, top_of
from reports.workbook.print_setup import PAPER, _ends, print_beginning
from reports.workbook.styles import SUBTITLE
from reports.workbook.write import workbook_bytes
from tests.cover import charts, quantities, samples_with
from tests.workbook.made import book, coarse_opened, model
from tests.workbook.test_places import boxes_of
from tools.referees.by_libreoffice import LibreOffice

MAX_PAGES = {"full": 60, "course": 35}


def printed_of(book: Workbook) -> list[Worksheet]:
    """Sheets that are printed: a hidden one has no area."""
    return [sheet for sheet in book.worksheets if sheet.sheet_state == "visible"]


def test_the_textbooks_diesel_takes_few_pages(libreoffice: LibreOffice, tmp_path: Path) -> None:
    short = workbook_bytes(short_model(model()))
    printed = zip(MAX_PAGES.items(), libreoffice.converted([book(), short], "pdf"), strict=True)
    for (kind, most), data in printed:
        path = tmp_path / "book.pdf"
        path.write_bytes(data)
        done = subprocess.run(
            ["pdftotext", str(path), "-"], capture_output=True, text=True, check=True
        )
        pages = done.stdout.split("\f")[:-1]
        assert len(pages) <= most
        assert all(re.search(r". — лист \d+ из \d+", page) for page in pages)
        of_waves = [page for page in pages if f"{WAVES_SHEET} — лист" in page]
        assert len(of_waves) == (kind == "full")  # a page of it is enough, and its rows have waves
        assert all(re.search(r"k\s*φ.*\n.*\d", page, re.DOTALL) for page in of_waves)


@pytest.mark.parametrize(("first", "area"), [(4, "A1:D40"), (60, "A60:D99")])
def test_the_print_of_waves_begins_where_their_rows_do(first: int, area: str) -> None:
    """Of a work-book that has lists only the rows stand far below the title."""
    sheet = Workbook().create_sheet(WAVES_SHEET)
    sheet["A1"] = "Синусы и косинусы порядков"
    for row in range(first, first + 60):
        sheet.cell(row + 1, 1, row)
    sheet.cell(first, 4, "cos kφ")
    print_beginning(sheet)
    assert sheet.print_area.replace("$", "").endswith(area)
    assert sheet.print_title_rows == ("$1:$1" if first > HEADER_ROW else None)
    assert (sheet.page_setup.fitToWidth, sheet.page_setup.fitToHeight) == (1, 1)


@pytest.mark.parametrize("name", ["d-240-bearings", "yamz-238"])
def test_no_list_is_cut_from_its_heading_by_the_end_of_a_page(name: str) -> None:
    """«Плечи колен» went on over the page without the names of its columns."""
    ended = []
    for sheet in printed_of(coarse_opened(name)):
        page = sheet.page_setup
        if sheet.print_title_rows or (page.fitToWidth, page.fitToHeight) == (1, 1):
            continue
        starts = [cell.row for cell in sheet["A"] if cell.style == SUBTITLE]
        breaks = [collected.id for collected in sheet.row_breaks.brk]
        ended += [sheet.title] if starts and breaks else []
        for start, following in pairwise([*starts, sheet.max_row + 2]):
            within = [row for row in breaks if start <= row < following - 2]
            high = top_of(sheet, following - 1) - top_of(sheet, start)
            whole = high * page.scale / 100 <= 0.9 * PAPER[page.orientation][1]
            assert not within or (not whole and within[0] > start + 1), (sheet.title, start)
    assert "Исходные данные" in ended


def test_tables_repeat_their_headers_and_nothing_of_the_lists_beside_them() -> None:
    sheets = printed_of(load_workbook(io.BytesIO(book())))
    tables = [
        sheet for sheet in sheets if sheet.freeze_panes and sheet.freeze_panes.startswith("B")
    ]
    assert len(tables) > 20
    assert all(sheet.print_title_rows for sheet in tables)
    for sheet in tables:  # the last of these rows has the numbers of the columns alone
        assert {type(cell.value) for cell in sheet[NUMBER_ROW]} <= {int, type(None)}, sheet.title
    assert all(sheet.oddFooter.center.text for sheet in sheets)


@pytest.mark.parametrize("name", samples_with(charts, quantities))
def test_no_page_begins_within_a_table_beside_others(name: str) -> None:
    """Its rest would stand under the beginning of the first one's title."""
    for sheet in printed_of(coarse_opened(name)):
        starts = [cell.column for cell in sheet[HEADER_ROW - 1] if cell.value]
        if sheet.sheet_properties.pageSetUpPr.fitToPage:
            assert len(starts) < 2 or sheet.page_setup.fitToWidth == 1, sheet.title
            continue
        if sheet.row_breaks.brk:  # one page across all the same
            wide = extent(sheet)[0] * sheet.page_setup.scale / 100
            assert not sheet.col_breaks.brk
            assert wide <= PAPER[sheet.page_setup.orientation][0], sheet.title
            continue
        breaks = [collected.id + 1 for collected in sheet.col_breaks.brk]
        assert breaks == starts[1:]
        assert not sheet.print_title_cols
        assert sheet.page_setup.orientation == "portrait"
        ends = [*breaks, sheet.max_column + 1]
        for start, end in zip([1, *breaks], ends, strict=True):
            width = sum(column_px(sheet, i) for i in range(start, end))
            assert width * sheet.page_setup.scale / 100 <= 690


@pytest.mark.parametrize("name", ["d-240-bearings", "gots-regimes", "mwm-6"])
def test_no_chart_is_cut_by_the_end_of_a_page(name: str) -> None:
    """Where charts take several pages: fitted to pages these would end anywhere."""
    ended = []
    for sheet in coarse_opened(name).worksheets:
        boxes, page = boxes_of(sheet), sheet.page_setup
        if not boxes or (page.fitToWidth, page.fitToHeight) == (1, 1):
            continue
        wide, high = PAPER[page.orientation]
        scale = wide / max(extent(sheet)[0], *(box.right for box in boxes))
        if not sheet.row_breaks.brk:  # then all of them stand on the first page
            fitted = sheet.sheet_properties.pageSetUpPr.fitToPage
            own = min(scale, 1) if fitted else page.scale / 100
            assert max(box.bottom for box in boxes) * own <= high, sheet.title
            continue
        ended.append(sheet.title)
        edges = [0, *(top_of(sheet, collected.id + 1) for collected in sheet.row_breaks.brk)]
        edges.append(max(box.bottom for box in boxes))
        assert not sheet.sheet_properties.pageSetUpPr.fitToPage
        assert page.scale / 100 <= scale
        for top, low in pairwise(edges):
            assert (low - top) * page.scale / 100 <= high, sheet.title
        for box in boxes:
            assert any(top <= box.y and box.bottom <= low for top, low in pairwise(edges)), box
    assert "Диаграммы, шейки и подшипники" in ended


def test_pages_end_though_no_row_ends_between_the_charts() -> None:
    """Charts 8 px apart on rows of 20 px, of which none ends in a gap."""
    charts = [Box(0, 64 + 280 * n, 900, 272) for n in range(8)]
    rows = _ends(charts, [0, *range(28, 2400, 20)], 958.0, 0)
    assert rows == sorted(set(rows)) and len(rows) < 5
