"""The program's own formulas, as the book is written with them."""

from __future__ import annotations

import io
from dataclasses import replace

import pytest
from openpyxl import load_workbook

from reports.grading.issuing.assignment import Assignment, assignment_of
from reports.grading.issuing.handout import fill_cells
from reports.grading.issuing.rubric import rubric_of
from reports.grading.reading.restoring import _filled_down, own_formulas
from reports.recalculation.formulas import formula_at
from reports.workbook.layout import _ROW, Cell, Layout
from reports.workbook.write import workbook_bytes
from tests.cover import sparse
from tests.workbook.made import coarse_model


def everything(name: str) -> Assignment:
    assignment = assignment_of(coarse_model(name), rubric_of({"work": {"fill": ["*"]}}, "r"))
    return replace(assignment, given=())


@pytest.mark.parametrize("name", sparse(["gots-diesel", "two-stroke", "yamz-238"]))
def test_every_row_has_the_formula_that_the_book_is_written_with(name):
    built = everything(name)
    layout = Layout.of(built.model)
    book = load_workbook(io.BytesIO(workbook_bytes(replace(built.model, charts=()))))
    cells = {n: c for block in built.blocks for n, c in fill_cells(block, layout).items()}
    formulas = own_formulas(built, layout, cells)
    assert len(formulas) > 200
    for node, item in formulas.items():
        for cell, formula in zip(cells[node], item, strict=True):
            text = book[cell.sheet].cell(cell.row, cell.column).value
            text = getattr(text, "text", text)  # of an array formula
            assert formula == formula_at(text.removeprefix("="), cell.row, cell.column), cell


def test_rows_that_are_not_alike_are_read_each():
    cells = [Cell("Л", row, 2) for row in range(5, 10)]
    actual = _filled_down(f"=$A${_ROW}", cells)
    assert actual == tuple(formula_at(f"$A${cell.row}", cell.row, 2) for cell in cells)
