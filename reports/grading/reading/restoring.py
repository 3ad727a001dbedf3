"""Restoration of issued input data, given numbers and formulas; list of changes."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from reports.formula.excel import compile_formula
from reports.grading.issuing.assignment import Assignment
from reports.grading.issuing.handout import fill_cells
from reports.grading.reading.placement import Location, address
from reports.grading.reading.student import Changed, StudentBook
from reports.model.blocks import TableSpec
from reports.recalculation.formulas import Formula, formula_at, unquoted
from reports.recalculation.grid import CellColumn, Run
from reports.workbook.inputs import shown
from reports.workbook.layout import Cell, Layout, RowReferences, at_row

Array = NDArray[np.float64]


def restore(student: StudentBook) -> None:
    """Input data and given numbers as issued; what was changed is remembered."""
    model = student.assignment.kept_model
    for at in student.placement.places.values():  # a column emptied whole is one still
        student.grid.sheets[at.sheet].setdefault(at.column, CellColumn())
    for name, item in model.fields.items():
        location = student.placement.places.get(name)
        if location is not None:
            _put(student, location, 0, name, shown(item))
    for node in sorted(student.assignment.given_nodes):
        location = student.placement.places.get(node)
        if location is None:
            continue
        value = student.expected.value(node)
        if isinstance(value, str):
            _put(student, location, 0, node, value)
            continue
        values = np.ravel(value)
        if _as_issued(student, location, values):
            continue
        for index, number in enumerate(values.tolist()):
            if location.rows[index] is not None:
                _put(student, location, index, node, number)

    for node, formulas in issued_formulas(student.assignment, student.layout).items():
        location = student.placement.places.get(node)
        if location is not None:
            _put_formulas(student, node, location, formulas)


def leave_out_unused(student: StudentBook) -> None:
    """Take out given formulas that nothing of the student's refers to: nobody asks for them."""
    live = student.assignment.live_nodes
    used: set[str] = set()
    stack = [node for item in student.assignment.items for node in item.nodes]
    seen = set(stack)
    while stack:
        for name in student.refers(stack.pop()):
            if name in live:
                used.add(name)
            if name in live and name not in seen:
                seen.add(name)
                stack.append(name)
    for node in live - used - student.rewritten:
        location = student.placement.places.get(node)
        if location is not None:
            rows = {row for row in location.rows if row is not None}
            student.grid.column(location.sheet, location.column).cut(rows)


def _put_formulas(
    student: StudentBook, node: str, location: Location, formulas: Sequence[Formula]
) -> None:
    """Formulas that were given, where something else stands in their place.

    A formula that reads otherwise is left, for its cells may have been moved: its response
    tells whether it is the one that was given.
    """
    column = student.grid.sheets[location.sheet].setdefault(location.column, CellColumn())
    if (
        location.span is not None
        and location.span.whole
        and not column.constants.keys() & set(location.rows)
    ):
        runs = column.runs_in(location.span.first, location.span.last)
        same = {run.formula for run in runs} <= set(formulas) and not column.errors
        if same and sum(run.count for run in runs) >= len(location.rows):
            return
    moved = not student.as_laid_out
    for row, formula in zip(location.rows, formulas, strict=True):
        run = next(iter(column.runs_in(row, row)), None) if row is not None else None
        if run is not None:
            if run.formula is None or not _alike(run.formula, formula):
                student.rewritten.add(node)
            continue
        if row is None:
            continue
        text = column.constants.get(row, "пусто")
        where = f"{location.sheet}!{address(row, location.column)}"
        student.changed.append(Changed(where, node, "формула", str(text)))
        column.errors.pop(row, None)
        column.constants.pop(row, None)
        if not moved:
            column.runs.append(Run(location.sheet, location.column, row, 1, formula, ""))
        else:
            right = np.ravel(np.asarray(student.expected.value(node), dtype=object))
            value = right[location.rows.index(row)]
            column.constants[row] = value if isinstance(value, str) else float(value)


def _alike(first: Formula, second: Formula) -> bool:
    """Whether two formulas are the same, however a program spells numbers and sheets."""
    return first is second or _plain(first) == _plain(second)


@lru_cache(maxsize=20_000)
def _plain(formula: Formula) -> tuple[object, ...]:
    return tuple(
        float(value)
        if kind == "number"
        else unquoted(value)
        if kind == "sheet"
        else value.casefold()
        for kind, value in formula.pattern
    )


def _as_issued(student: StudentBook, location: Location, values: Array) -> bool:
    """Whether these very numbers stand in the cells of a place."""
    column = student.grid.column(location.sheet, location.column)
    standing = [column.constants.get(row, "") for row in location.rows if row is not None]
    if len(standing) < len(values) or any(type(number) is not float for number in standing):
        return False
    far = np.abs(np.array(standing) - values) > 1e-9 * np.maximum(1, np.abs(values))
    return not far.any()


def _put(
    student: StudentBook, location: Location, index: int, name: str, value: float | str
) -> None:
    row = location.rows[index]
    column = student.grid.sheets[location.sheet].setdefault(location.column, CellColumn())
    run = next(iter(column.runs_in(row, row)), None) if row is not None else None
    value_there = column.constants.get(row) if row is not None else None
    if run is None and row not in column.errors and _same(value_there, value):
        return
    if run is None and value_there is None and value == "":
        return
    assert row is not None
    text = "формула" if run is not None else "пусто" if value_there is None else str(value_there)
    where = f"{location.sheet}!{address(row, location.column)}"
    student.changed.append(Changed(where, name, value, text))
    column.cut({row})
    column.errors.pop(row, None)
    column.constants[row] = value if isinstance(value, str) else float(value)


def issued_formulas(assignment: Assignment, layout: Layout) -> dict[str, tuple[Formula, ...]]:
    """Node → the formulas of its cells, of the nodes that were given as formulas."""
    cached = assignment.__dict__.get("issued_formulas")
    if cached is None:
        live = assignment.live_nodes
        cached = assignment.__dict__["issued_formulas"] = own_formulas(assignment, layout, live)
    return cached


def own_formulas(
    assignment: Assignment, layout: Layout, nodes: Collection[str]
) -> dict[str, tuple[Formula, ...]]:
    """Node → the formulas that the program writes into its cells."""
    formulas: dict[str, tuple[Formula, ...]] = {}
    for block in assignment.blocks:
        table = block if isinstance(block, TableSpec) else None
        for node, cells in fill_cells(block, layout).items():
            expr = assignment.graph.expression(node)
            if node not in nodes or expr is None:
                continue
            text = compile_formula(expr, RowReferences(layout, table, block.sheet))
            formulas[node] = _filled_down(text, cells)
    return formulas


def _filled_down(text: str, cells: Sequence[Cell]) -> tuple[Formula, ...]:
    """Return the formulas of a column's cells, read from the first two rows and the last.

    Distances between cells are the same in two rows and so in all between; else each is read.
    """

    def read(cell: Cell, *, last: bool) -> Formula:
        written = at_row(text, cell.row, last=last).removeprefix("=")
        return formula_at(written, cell.row, cell.column)

    *body, end = cells
    first = [read(cell, last=False) for cell in body[:2]]
    alike = len(set(first)) == 1
    following = [first[0] if alike else read(cell, last=False) for cell in body[2:]]
    return (*first, *following, read(end, last=True))


def _same(value: float | str | bool | None, expected: float | str) -> bool:
    if isinstance(expected, str):
        return isinstance(value, str) and value.strip() == expected.strip()
    if value is None or isinstance(value, str):
        return False
    return abs(float(value) - float(expected)) <= 1e-9 * max(1.0, abs(float(expected)))
