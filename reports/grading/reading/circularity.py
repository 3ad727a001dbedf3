"""Circles and blanks of a book, and what rests on them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np

from reports.grading.reading.student import StudentBook, shown_in
from reports.grading.reading.typed import means_something
from reports.recalculation.evaluate import BLANK, ERROR, TEXT, Evaluator
from reports.recalculation.trial_sheet import Cells, pinned
from reports.shared.errors import UnknownFormula


def circles(student: StudentBook) -> frozenset[str]:
    """Nodes that are calculated through themselves."""
    round_ = {
        node
        for node, answer in student.answers.items()
        if ERROR in answer.kinds
        and answer.location is not None
        and answer.location.span is not None
        and student.engine.is_circular(
            answer.location.sheet, answer.location.column, answer.location.span.first,
            answer.location.span.last,
        )
    }  # fmt: skip
    return _reaching_themselves({node: through(student, node) for node in round_})


def hidden_circles(
    student: StudentBook, nodes: Iterable[str], others: Iterable[Iterable[Cells]]
) -> frozenset[str]:
    """Return the nodes that are circular for the inputs ``others``."""
    suspects = rings(student, nodes)
    if not suspects:
        return frozenset()
    engines = [Evaluator(pinned(student.grid, cells)) for cells in others]
    locations = {node: student.placement.places[node] for node in suspects}
    return frozenset(
        node
        for node, location in locations.items()
        if location.span is not None
        and any(
            engine.is_circular(
                location.sheet, location.column, location.span.first, location.span.last
            )
            for engine in engines
        )
    )


def rings(student: StudentBook, nodes: Iterable[str]) -> frozenset[str]:
    """Return the nodes on a reference cycle."""
    refers = {node: through(student, node) for node in nodes}
    while free := {node for node, names in refers.items() if names.isdisjoint(refers)}:
        refers = {node: names for node, names in refers.items() if node not in free}
    return _reaching_themselves(refers)


def _reaching_themselves(refers: Mapping[str, frozenset[str]]) -> frozenset[str]:
    circular = set()
    for node in refers:
        seen: set[str] = set()
        stack = list(refers[node])
        while stack:
            name = stack.pop()
            if name == node:
                circular.add(node)
                break
            if name not in seen:
                seen.add(name)
                stack += refers.get(name, ())
    return frozenset(circular)


def calculated(student: StudentBook, nodes: frozenset[str]) -> frozenset[str]:
    """Circular nodes whose cached values are right.

    A look-up over a whole column refers to all of it; what it does not take closes no circle there.
    """
    right_nodes = set()
    for node in nodes:
        location, right = student.placement.places[node], student.expected.value(node)
        column = student.grid.column(location.sheet, location.column)
        saved = dict(zip(column.saved_rows, column.saved, strict=True))
        numbers = [saved.get(row or 0, np.nan) for row in location.rows]
        if not isinstance(right, str) and np.allclose(numbers, np.ravel(right), rtol=1e-6):
            right_nodes.add(node)
    return frozenset(right_nodes)


def through(student: StudentBook, node: str) -> frozenset[str]:
    """Asked nodes that a node refers to, through live formulas too, itself among them."""
    reached: set[str] = set()
    seen: set[str] = set()
    stack = [node]
    while stack:
        for name in student.refers(stack.pop()):
            if name in student.answers:
                reached.add(name)
            elif name in student.assignment.live_nodes and name not in seen:
                seen.add(name)
                stack.append(name)
    return frozenset(reached)


def is_void(student: StudentBook, node: str) -> bool:
    """Whether there is no value to go on with: blanks, or a text that is no number."""
    answer = student.answers[node]
    if answer.location is None or answer.problem:
        return False
    nothing = answer.kinds.count(BLANK)
    if TEXT in answer.kinds and answer.typed.any():
        column = student.grid.column(answer.location.sheet, answer.location.column)
        texts = [column.constants.get(row) for row in answer.location.rows if row is not None]
        nothing += sum(isinstance(text, str) and not means_something(text) for text in texts)
    return nothing > len(answer.kinds) / 2


def filled_copy(student: StudentBook, node: str) -> str:
    """Which own copy of its sheet has something in the cells of a node, empty where none has."""
    location = student.placement.places.get(node)
    sheets = {other.sheet for other in student.placement.places.values()}
    if location is None or location.span is None:
        return ""
    heads = _texts(student, location.sheet)
    for sheet in student.grid.sheets:
        column = student.grid.column(sheet, location.column)
        filled = column.runs_in(location.span.first, location.span.last) or any(
            row in column.constants for row in location.rows
        )
        if sheet not in sheets and filled and len(heads & _texts(student, sheet)) > len(heads) / 2:
            return f"не заполнено, но заполнена копия листа: «{sheet}»"
    return ""


def _texts(student: StudentBook, sheet: str) -> set[tuple[int, int, str]]:
    return {
        (number, row, value)
        for number, column in student.grid.sheets[sheet].items()
        for row, value in column.constants.items()
        if isinstance(value, str)
    }


def resting_on(student: StudentBook, nodes: frozenset[str]) -> frozenset[str]:
    """Return the nodes whose value depends on ``nodes``."""
    cells: list[Cells] = []
    for node in sorted(nodes):
        right = student.expected.value(node)
        if not isinstance(right, str):
            cells += student.cells_of(node, right)
    other = Evaluator(pinned(student.known, cells))
    dependent = set(nodes)
    for node, answer in student.answers.items():
        location = answer.location
        if location is None or location.span is None or answer.problem:
            continue
        try:
            values, now = shown_in(other, location)
        except UnknownFormula:
            continue
        was = answer.kinds
        if was != now or not np.allclose(values, answer.values, 1e-9, 1e-12, equal_nan=True):
            dependent.add(node)
    return frozenset(dependent)
