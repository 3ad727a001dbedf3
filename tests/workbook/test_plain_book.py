"""Charts of studies and comparisons on paper: whole, two to a row; tables repeat their headers."""

from __future__ import annotations

import io
from itertools import pairwise
from pathlib import Path

import openpyxl
from openpyxl.worksheet.worksheet import Worksheet

from reports.studies import workbooks as study
from reports.studies.sweep import sweep
from reports.studies.workbooks import CURVES, FIGURES, INPUTS, RESULTS
from reports.workbook.charts import curves_chart
from reports.workbook.places import top_of
from reports.workbook.print_setup import PAPER
from reports.workbook.simple_workbook import hang
from tests.studies.test_compare import run, sources
from tests.studies.test_sweep import BASE, VARY
from tests.workbook.test_places import boxes_of, problems


def pages_of(sheet: Worksheet) -> list[tuple[int, int]]:
    """Upper and lower edges of the pages that the breaks make [px]; what is cut fails."""
    boxes = boxes_of(sheet)
    assert not [said for said in problems(boxes) if "overlap" in said]
    assert not sheet.sheet_properties.pageSetUpPr.fitToPage  # it would pass over the breaks
    ends = [top_of(sheet, collected.id + 1) for collected in sheet.row_breaks.brk]
    edges = [0, *ends, max(box.bottom for box in boxes)]
    scale = sheet.page_setup.scale / 100
    wide, high = PAPER["landscape"]
    assert max(box.right for box in boxes) * scale <= wide
    assert all((low - top) * scale <= high for top, low in pairwise(edges))
    for box in boxes:
        assert any(top <= box.y and box.bottom <= low for top, low in pairwise(edges)), box
    return list(pairwise(edges))


def test_no_chart_is_cut_by_the_end_of_a_page() -> None:
    book = openpyxl.Workbook()
    for first in (1, 3):
        sheet = book.create_sheet(f"{first}")
        hang(sheet, [curves_chart("", "", "", [], (0.0, 1.0)) for _ in range(23)], first)
    file = io.BytesIO()
    book.save(file)
    for sheet in openpyxl.load_workbook(file).worksheets[1:]:
        assert len(pages_of(sheet)) == 4


def test_a_study_on_paper(tmp_path: Path) -> None:
    target = tmp_path / "a.xlsx"
    sweep(BASE, VARY, target, quantities=())
    book = openpyxl.load_workbook(target)
    assert len(pages_of(book[study.CHARTS])) == 2
    data, summary = book[study.DATA], book[study.SUMMARY]
    assert (data.print_title_cols, data.print_title_rows) == ("$A:$B", "$1:$2")
    assert summary.print_title_rows == "$4:$4"
    assert summary["A4"].value == "Ключ"
    assert all(sheet.oddFooter.center.text for sheet in book.worksheets)


def test_a_comparison_on_paper(tmp_path: Path) -> None:
    target = tmp_path / "a.xlsx"
    assert run(*sources(("d-240", "yamz-236")), "-o", target)[0] == 0
    book = openpyxl.load_workbook(target)
    assert len(pages_of(book[FIGURES])) == 1
    assert {book[name].print_title_rows for name in (INPUTS, RESULTS)} == {"$3:$3"}
    assert book[CURVES].print_title_cols == "$A:$A"
    assert "_" not in "".join(str(row[0].value) for row in book[INPUTS].iter_rows(min_col=2))
