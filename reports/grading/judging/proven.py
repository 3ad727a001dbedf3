"""Proven formulas: what need not be tried or calculated anew.

A formula that has followed every trial to the last digit, whose cells hold the right numbers
as the student's own program has calculated them, and that reads nothing but input data and
columns of the same kind, would give the same numbers once more.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from reports.grading.judging.trial_evaluation import Trial, fixed
from reports.grading.reading.placement import Location
from reports.grading.reading.student import StudentBook, covered
from reports.recalculation.grid import Area, Run

_BEYOND = frozenset(("SUMIF", "AVERAGEIF"))  # read as many cells as their first range has
EXACT = 1e-9  # of the largest value of a column


@dataclass(frozen=True)
class Signatures:
    """Signatures of a student's formulas; equal ones do the same in every book."""

    student: StudentBook

    def of(self, node: str) -> tuple[object, ...] | None:
        """Tell what a node's formulas are, None where they may do otherwise in another book.

        All that they name must be found, and be cells that every book of the class holds alike.
        """
        student = self.student
        if not student.as_laid_out or student.placement.places[node].span is None:
            return None
        parts: list[object] = [node]
        for run in student.runs(node):
            areas = self._areas(run)
            if areas is None:
                return None
            parts.append((run.first, run.count, run.formula, areas))
        return tuple(parts)

    def _areas(self, run: Run) -> tuple[Area, ...] | None:
        """Return the cells that a formula names, None where not all are known."""
        formula = run.formula
        if formula is None or run.problem or run.array is not None:
            return None
        areas = tuple(self.student.grid.precedents(run))
        complete = len(areas) == len(formula.references) and all(map(self._is_known, areas))
        return areas if complete and formula.functions.isdisjoint(_BEYOND) else None

    def _is_known(self, area: Area) -> bool:
        """Whether all cells of a rectangle hold what was issued, or answers."""
        columns = range(area.first_column, area.last_column + 1)
        taken = (self._held.get((area.sheet, column), []) for column in columns)
        return all(rows and covered(area.first_row, area.last_row, rows) for rows in taken)

    @cached_property
    def _held(self) -> dict[tuple[str, int], list[tuple[int, int, Location]]]:
        """First and last row of what stands in a column of a sheet and is alike in every book."""
        student, assignment = self.student, self.student.assignment
        issued = assignment.model.fields.keys() | student.rows_as_issued
        issued |= assignment.fill_nodes | assignment.live_nodes | assignment.given_nodes
        held: dict[tuple[str, int], list[tuple[int, int, Location]]] = {}
        for node, location in student.placement.places.items():
            if location.span is not None and node in issued:
                entry = (location.span.first, location.span.last, location)
                held.setdefault((location.sheet, location.column), []).append(entry)
        return held


def settled(student: StudentBook, exact: Mapping[str, bool]) -> frozenset[str]:
    """Nodes that hold what they should; ``exact`` tells whose formulas have followed exactly."""
    assignment = student.assignment
    issued = assignment.model.fields.keys() | assignment.given_nodes | student.rows_as_issued
    candidates = {node for node, follows in exact.items() if follows and _is_right(student, node)}
    candidates |= {node for node in assignment.live_nodes - student.rewritten if student.runs(node)}
    candidates = {node for node in candidates if not isinstance(student.expected.value(node), str)}
    done: set[str] = set()
    known = set(issued)
    while ready := {node for node in candidates - done if student.refers(node) <= known}:
        done |= ready  # from the input data on: a ring of right numbers rests on nothing
        known |= ready
    return frozenset(done)


def _is_right(student: StudentBook, node: str) -> bool:
    """Whether the numbers saved in a node's cells are the right ones."""
    location, right = student.placement.places[node], student.expected.value(node)
    if location.span is None or isinstance(right, str):
        return False
    expected = np.ravel(np.asarray(right, dtype=float))
    column = student.grid.column(location.sheet, location.column)
    if column.saved_rows == list(location.rows):
        saved_numbers = np.array(column.saved)
    else:
        saved = dict(zip(column.saved_rows, column.saved, strict=True))
        saved_numbers = np.array(
            [np.nan if row is None else saved.get(row, np.nan) for row in location.rows]
        )
    largest = float(np.abs(expected).max()) if expected.size else np.nan
    return bool((np.abs(saved_numbers - expected) <= EXACT * largest).all())


@dataclass
class Proofs:
    """Formulas that are right for every trial, and refer to nothing but cells of the work-book.

    Many students write the same formulas: they are tried once for a class.  What else is said of
    a formula may rest on the engine of its student, and is said of nobody else's.
    """

    trials: tuple[Trial, ...]
    known: dict[tuple[object, ...], bool] = field(default_factory=dict)  # to the last digit or not
    _varying: dict[str, bool] = field(default_factory=dict)

    def varies(self, node: str) -> bool:
        """Whether some right value of a node differs between the engines of the trials."""
        if node not in self._varying:
            first, *others = self.trials or (None,)
            self._varying[node] = bool(
                first and others and not fixed(node, first.expected, others).all()
            )
        return self._varying[node]
