"""Books calculated anew: cells of a grid, values of all samples."""

from __future__ import annotations

import io
import random
import zipfile
from dataclasses import replace
from functools import cache, lru_cache
from unittest import mock

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reports.model.blocks import Model
from reports.recalculation import grid
from reports.recalculation.grid import CellColumn, Run
from reports.tables.registry import build_model
from reports.workbook.caches import sheet_parts
from reports.workbook.write import workbook_bytes
from tests.cover import ALL, engines_with, formulas, operations, quantities, samples_with
from tests.grading.forms import rewritten
from tests.layouts import MAKERS as LAYOUTS
from tests.layouts import layout_input
from tests.referee.changes import Change, changed_everywhere, free_fields, type_into, without_charts
from tests.referee.compare import differences_from_caches, differences_from_solver, errors_in
from tests.workbook.made import book as own_book
from tests.workbook.made import coarse_book, coarse_model
from tests.workbook.made import model as own_model
from tools.referees.by_formualizer import Formualizer
from tools.referees.by_libreoffice import LibreOffice
from tools.referees.cells import formula_cells, stripped

ROWS = st.integers(1, 60)


def run(first: int, count: int) -> Run:
    return Run("Лист", 2, first, count, None, "")


def assert_found(column: CellColumn, first: int, last: int) -> None:
    """As a look at each finds them, in the order of their first rows."""
    each = [run for run in column.runs if run.first <= last and first <= run.last]
    with mock.patch.object(grid, "_FEW", 0):
        assert column.runs_in(first, last) == sorted(each, key=lambda run: run.first)


@given(st.lists(st.builds(run, ROWS, st.integers(1, 30)), max_size=9), ROWS, ROWS)
def test_runs_in_rows_are_those_that_a_look_at_each_finds(runs, one, other) -> None:
    """Runs in any order and over each other, as formulas of arrays lie."""
    assert_found(CellColumn(runs=runs), *sorted((one, other)))


@pytest.mark.parametrize("few", [0, grid._FEW])
def test_a_run_over_others_and_changes_are_seen(few: int) -> None:
    column = CellColumn(runs=[run(1, 50), *(run(row, 1) for row in range(2, 22, 2))])
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


# Both programs open the same changed books: made once.
pytestmark = pytest.mark.xdist_group("recalculation")

# Shares by which all inputs change at once: little, so that nearly all are taken, and much,
# so that choices between branches come out otherwise.
SPREADS = (0.03, 0.2) if ALL else (0.03,)
OWN_GRID = ("gots-diesel",)  # the others on a coarse grid: the same formulas
# What LibreOffice opens with the values that are saved in it, besides engines that are changed.
WHOLE = ("gots-diesel", "offset_articulated", "split") if ALL else OWN_GRID


def coarse_of(name: str) -> tuple[Model, bytes]:
    """A sample or a layout on the coarse grid, and its workbook."""
    if name in LAYOUTS:
        return _layout(name)
    return coarse_model(name), coarse_book(name)


@lru_cache(maxsize=4)
def _layout(name: str) -> tuple[Model, bytes]:
    model = build_model(layout_input(name, step_deg=30))
    return model, workbook_bytes(replace(model, charts=()))  # no formula stands in charts


def whole_of(name: str) -> tuple[Model, bytes]:
    """The first sample on its own grid, the others on the coarse one."""
    return (own_model(name), own_book(name)) if name in OWN_GRID else coarse_of(name)


def check_model(model: Model, book: bytes, recalculated: dict) -> None:
    assert errors_in(recalculated) == []
    assert differences_from_caches(book, recalculated) == []
    compared, wrong = differences_from_solver(model, recalculated)
    assert wrong == []
    assert compared > 1000


@pytest.mark.parametrize("name", engines_with(formulas))
def test_formualizer_agrees(name: str) -> None:
    model, book = whole_of(name)
    check_model(model, book, Formualizer().recalculate([book])[0])


@cache
def changed_books(name: str) -> tuple[tuple[list[Change], Model, bytes], ...]:
    """An engine with everything changed at once, once for each spread."""
    model, book = coarse_of(name)
    data, book = model.input, without_charts(book)
    collected = []
    for spread in SPREADS:
        changes, changed = changed_everywhere(data, random.Random(f"{name} {spread}"), spread)
        collected.append((changes, build_model(changed), type_into(book, data, changes)))
    return tuple(collected)


@pytest.mark.parametrize("name", samples_with(quantities))
def test_formulas_follow_every_input(name: str) -> None:
    """The only test that sees a number of the sample's inside of a formula."""
    assert len(changed_books(name)[0][0]) >= 0.9 * len(free_fields(coarse_model(name).input))
    for changes, model, book in changed_books(name):
        (result,) = Formualizer().recalculate([book])
        assert errors_in(result) == [], changes
        compared, wrong = differences_from_solver(model, result, edited=True)
        assert wrong == [], changes
        assert compared > 1000


def tampered(book: bytes, sheet: str, cell: str) -> bytes:
    """The workbook with one cached value replaced by a lie."""
    stream = io.BytesIO()
    with (
        zipfile.ZipFile(io.BytesIO(book)) as source,
        zipfile.ZipFile(stream, "w") as target,
    ):
        part = sheet_parts(source)[sheet]
        for name in source.namelist():
            data = source.read(name)
            if name == part:
                before, actual, after = data.partition(f'r="{cell}"'.encode())
                start = after.index(b"<v>") + 3
                after = after[:start] + b"123456.5" + after[after.index(b"</v>") :]
                data = before + actual + after
            target.writestr(name, data)
    return stream.getvalue()


@pytest.mark.libreoffice
def test_libreoffice_agrees(libreoffice: LibreOffice) -> None:
    """All operations with all inputs changed, the textbook's whole with a lie in its cache.

    Of all tests this one alone opens what we write in another program, and holds that
    program's values against the solver.
    """
    whole = [whole_of(name) for name in WHOLE]
    changed = [changed_books(name)[0] for name in engines_with(operations)]
    books = [book for _, book in whole]
    books[0] = tampered(books[0], "П4.1", "H20")
    results = libreoffice.recalculate([*books, *(book for _, _, book in changed)])
    (lie,) = differences_from_caches(books[0], results[0])
    assert lie.startswith("П4.1!H20: cached 123456.5")
    for (model, book), result in zip(whole, results, strict=False):
        check_model(model, book, result)
    for (changes, model, _), result in zip(changed, results[len(whole) :], strict=True):
        assert errors_in(result) == [], changes
        assert differences_from_solver(model, result, edited=bool(changes))[1] == [], changes


def test_formualizer_does_not_believe_a_tampered_cache() -> None:
    book = tampered(own_book("gots-diesel"), "П4.1", "H20")
    (result,) = Formualizer().recalculate([book])
    (difference,) = differences_from_caches(book, result)
    assert difference.startswith("П4.1!H20: cached 123456.5")


def test_no_formula_cell_is_passed_over() -> None:
    """Of a cell written in another way the referee would believe the saved value."""
    book = own_book("gots-diesel")
    other = rewritten(book, lambda _, data: data.replace(b'<c r="H20" s=', b'<c s="1" r="H20" s='))
    with pytest.raises(ValueError, match="are not written as"):
        stripped(other)


def test_size_of_the_textbook_diesel() -> None:
    """At least 8,000 formula cells and 25 charts at 10°."""
    book = own_book("gots-diesel")
    assert sum(len(cells) for cells in formula_cells(book).values()) >= 8000
    with zipfile.ZipFile(io.BytesIO(book)) as archive:
        charts = [name for name in archive.namelist() if name.startswith("xl/charts/chart")]
    assert len(charts) >= 25
