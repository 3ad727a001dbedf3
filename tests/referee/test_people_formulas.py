"""What formulas refer to, and formulas as they are filled down."""

from __future__ import annotations

import pytest

from reports.recalculation.formulas import filled, formula_at, pattern, render, row_template
from reports.recalculation.grid import Area
from reports.shared.errors import UnknownFormula
from tests.referee.books import engine_of


def test_a_pattern_gives_its_formula_back():
    text = 'SUM($A$1:A7)+\'П4.1\'!B7*IF(C$2>0,"a""b",-D7^2)+SUM(A:B)+#N/A'
    actual = pattern(text, 7, 5)
    assert render(actual, 7, 5) == "=" + text
    assert pattern(render(actual, 9, 6)[1:], 9, 6) == actual
    assert formula_at(text, 7, 5) is formula_at(render(actual, 9, 6)[1:], 9, 6)
    assert render(pattern("A1+Б!A1+SUM(A1:B2)", 1, 1), 1, 1, "Я") == "='Я'!A1+Б!A1+SUM('Я'!A1:B2)"


@pytest.mark.parametrize(
    "text", ["A7*2", "A6+$B$1", "SUM(A$1:A7)", '"A7"&A7', "'A7'!A7", "LOG10(A7)", "x7*A7"]
)
def test_filling_down_moves_rows_as_a_spreadsheet_does(text):
    template = row_template(text, 7)
    assert filled(template, 7) == text
    assert pattern(filled(template, 12), 12, 5) == pattern(text, 7, 5)


def test_equal_formulas_below_each_other_are_one_run():
    engine = engine_of(
        {f"B{row}": f"=A{row}*2" for row in range(1, 6)} | {"B6": "=A5*2", "B7": "=A7*2"}
    )
    runs = engine.grid.sheets["Sheet"][2].runs
    assert [(run.first, run.count) for run in runs] == [(1, 5), (6, 1), (7, 1)]


def test_references_of_a_run_over_all_its_rows():
    grid = engine_of({f"D{r}": f"=A{r}+SUM($B$1:B{r})+SUM(C:C)+Sheet!$A$9" for r in (3, 4, 5)}).grid
    (run,) = grid.sheets["Sheet"][4].runs
    assert set(grid.precedents(run)) == {
        Area("Sheet", 3, 5, 1, 1), Area("Sheet", 1, 5, 2, 2), Area("Sheet", 1, 1_048_576, 3, 3),
        Area("Sheet", 9, 9, 1, 1),
    }  # fmt: skip


@pytest.mark.parametrize(("text", "whole", "spread"), [
    ("SUM(A1:A3)", True, False), ("SUM(A1:A3,1)", True, False), ("SUM(A1:A3*2)", False, False),
    ("MATCH(1,A1:A3,0)", True, False), ("MATCH(A1:A3,B1)", False, False),
    ("SUMPRODUCT(A1:A3*2)", False, True), ("SUMPRODUCT(SIN(A1:A3))", False, True),
    ("VLOOKUP(1,Л!A1:A3,2)", True, False),
])  # fmt: skip
def test_where_a_rectangle_stands(text, whole, spread):
    actual = formula_at(text, 9, 9).references[0]
    assert (actual.whole, actual.spread) == (whole, spread)


@pytest.mark.parametrize("text", ["A1{", "A1]", "x?", "A1048577", "ZZZ1", "1" * 9000])
def test_what_is_no_formula_is_said_so(text):
    with pytest.raises(UnknownFormula):
        actual = formula_at(text, 1, 1)
        if actual.refusal or actual.gives_array:
            raise UnknownFormula(actual.refusal)
