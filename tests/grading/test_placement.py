"""Where the cells of a work-book went, on its grid alone."""

from __future__ import annotations

import pytest

from reports.grading.issuing.handout import anchor_name
from reports.grading.reading.placement import Placement, find_places
from reports.recalculation.grid import CellColumn, CellGrid
from reports.recalculation.read import read_grid
from reports.workbook.layout import FIRST_ROW, Layout
from tests.grading import classroom

TABLE = "P3_1"


@pytest.fixture
def grid() -> CellGrid:
    """The cells of the empty work-book, to be changed."""
    return read_grid(classroom.handout())


def placed(grid: CellGrid) -> Placement:
    assignment = classroom.assignment()
    return find_places(assignment.kept_model, Layout.of(assignment.model), grid)


def sheet_of(table: str) -> str:
    return classroom.assignment().model.tables[table].sheet


def move_down(grid: CellGrid, sheet: str, begin: int) -> None:
    """A row inserted: everything from ``begin`` on is a row further down, names too."""
    for column in grid.sheets[sheet].values():
        column.constants = {r + (r >= begin): v for r, v in column.constants.items()}
        for run in column.runs:
            run.first += run.first >= begin
    for name, (title, row, column) in grid.names.items():
        if title == sheet and row >= begin:
            grid.names[name] = (title, row + 1, column)


def test_every_node_is_found_by_its_name(grid):
    actual = placed(grid)
    assert actual.moved == []
    assignment = classroom.assignment()
    for block in (*assignment.fill, *assignment.given):
        for node in assignment.nodes(block):
            assert actual.places[node].by == "name"
            assert None not in actual.places[node].rows
    assert actual.places[f"{TABLE}.s_mm"].rows[0] == FIRST_ROW


def test_without_names_headers_and_captions_decide(grid):
    before = placed(grid).places
    grid.names = {n: at for n, at in grid.names.items() if not n.startswith(("col_", "cell_"))}
    actual = placed(grid)
    assert set(actual.places) == set(before)
    for node, position in before.items():  # shares of the throws too, cells beside each other
        other = actual.places[node]
        assert (node, other.sheet, other.column) == (node, position.sheet, position.column)
        assert other.rows == position.rows
    assert actual.places[f"{TABLE}.v1_m_s"].by == "header"
    assert any("столбцы найдены по заголовкам" in text for text in actual.moved)


def test_an_inserted_row_and_a_new_title_are_told(grid):
    sheet = sheet_of(TABLE)
    move_down(grid, sheet, FIRST_ROW + 3)
    grid.sheets = {("Моя" if t == sheet else t): c for t, c in grid.sheets.items()}
    grid.names = {n: ("Моя" if at[0] == sheet else at[0], *at[1:]) for n, at in grid.names.items()}
    actual = placed(grid)
    rows = actual.places[f"{TABLE}.s_mm"].rows
    assert rows[2:4] == (FIRST_ROW + 2, FIRST_ROW + 4)
    assert actual.places[f"{TABLE}.s_mm"].sheet == "Моя"
    assert any("строки сдвинуты" in text for text in actual.moved)
    assert f"лист «{sheet}» теперь «Моя»" in actual.moved


def test_a_lost_angle_is_a_lost_row(grid):
    _, _, column = grid.names[anchor_name(TABLE, 0).casefold()]
    del grid.sheets[sheet_of(TABLE)][column].constants[FIRST_ROW + 1]
    rows = placed(grid).places[f"{TABLE}.s_mm"].rows
    assert rows[:3] == (FIRST_ROW, None, FIRST_ROW + 2)
    assert placed(grid).places[f"{TABLE}.s_mm"].span.whole is False


def test_angles_that_are_calculated_are_angles(grid):
    from tests.referee.books import engine_of

    sheet = sheet_of(TABLE)
    _, _, column = grid.names[anchor_name(TABLE, 0).casefold()]
    angles = grid.sheets[sheet][column]
    wanted = classroom.assignment().model.tables[TABLE].rows
    step = wanted[1] - wanted[0]
    built = engine_of({f"A{FIRST_ROW}": 0.0} | {
        f"A{FIRST_ROW + i}": f"=A{FIRST_ROW + i - 1}+{step:g}" for i in range(1, len(wanted))
    }).grid.sheets["Sheet"][1]  # fmt: skip
    for run in built.runs:
        run.sheet, run.column = sheet, column
    kept = {r: v for r, v in angles.constants.items() if r < FIRST_ROW}
    grid.sheets[sheet][column] = CellColumn({**kept, FIRST_ROW: 0.0}, runs=built.runs)
    rows = placed(grid).places[f"{TABLE}.s_mm"].rows
    assert rows == tuple(range(FIRST_ROW, FIRST_ROW + len(wanted)))


def test_two_captions_of_one_table_are_no_place(grid):
    names = [n for n in grid.names if n.startswith(f"col_{TABLE}_".casefold())]
    for name in names:
        del grid.names[name]
    sheet = sheet_of(TABLE)
    grid.sheets["Копия"] = grid.sheets[sheet]
    assert f"{TABLE}.s_mm" not in placed(grid).places
