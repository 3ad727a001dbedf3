"""Runs of a column: those that have cells in some rows, however many there are."""

from __future__ import annotations

from unittest import mock

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reports.recalculation import grid
from reports.recalculation.grid import Column, Run

ROWS = st.integers(1, 60)


def run(first: int, count: int) -> Run:
    return Run("Лист", 2, first, count, None, "")


def assert_found(column: Column, first: int, last: int) -> None:
    """As a look at each finds them, in the order of their first rows."""
    each = [run for run in column.runs if run.first <= last and first <= run.last]
    with mock.patch.object(grid, "_FEW", 0):
        assert column.runs_in(first, last) == sorted(each, key=lambda run: run.first)


@given(st.lists(st.builds(run, ROWS, st.integers(1, 30)), max_size=9), ROWS, ROWS)
def test_runs_in_rows_are_those_that_a_look_at_each_finds(runs, one, other) -> None:
    """Runs in any order and over each other, as formulas of arrays lie."""
    assert_found(Column(runs=runs), *sorted((one, other)))


@pytest.mark.parametrize("few", [0, grid._FEW])
def test_a_run_over_others_and_changes_are_seen(few: int) -> None:
    column = Column(runs=[run(1, 50), *(run(row, 1) for row in range(2, 22, 2))])
    with mock.patch.object(grid, "_FEW", few):
        assert [r.first for r in column.runs_in(40, 45)] == [1]
        column.runs.append(run(43, 3))
        assert [r.first for r in column.runs_in(40, 45)] == [1, 43]
        column.cut({45, 50})
        assert [r.first for r in column.runs_in(45, 45)] == []
        count = len(column.runs)
        column.cut({44})
        assert len(column.runs) == count  # other runs, as many as before
        assert [r.first for r in column.runs_in(44, 44)] == []
