"""Columns that need not be calculated anew: their formulas are proven, and so is all they read.

A formula that has followed every trial to the last digit, whose cells hold the right numbers
as the student's own program has calculated them, and that reads nothing but input data and
columns of the same kind, would give the same numbers once more.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from reports.grading.reading.signatures import rows_as_issued
from reports.grading.reading.student import Student

EXACT = 1e-9  # of the largest value of a column


def settled(student: Student, exact: Mapping[str, bool]) -> frozenset[str]:
    """Nodes that hold what they should; ``exact`` tells whose formulas have followed exactly."""
    assignment = student.assignment
    given = assignment.model.fields.keys() | assignment.given_nodes | rows_as_issued(student)
    found = {node for node, follows in exact.items() if follows and _is_right(student, node)}
    found |= {node for node in assignment.live_nodes - student.rewritten if student.runs(node)}
    found = {node for node in found if not isinstance(student.expected.value(node), str)}
    done: set[str] = set()
    while ready := {node for node in found - done if student.refers(node) <= given | done}:
        done |= ready  # from the input data on: a ring of right numbers rests on nothing
    return frozenset(done)


def _is_right(student: Student, node: str) -> bool:
    """Whether the numbers saved in a node's cells are the right ones."""
    place, right = student.placement.places[node], student.expected.value(node)
    if place.span is None or isinstance(right, str):
        return False
    wanted = np.ravel(np.asarray(right, dtype=float))
    column = student.grid.column(place.sheet, place.column)
    if column.saved_rows == list(place.rows):
        found = np.array(column.saved)
    else:
        saved = dict(zip(column.saved_rows, column.saved, strict=True))
        found = np.array([np.nan if row is None else saved.get(row, np.nan) for row in place.rows])
    largest = float(np.abs(wanted).max()) if wanted.size else np.nan
    return bool((np.abs(found - wanted) <= EXACT * largest).all())
