"""By what a formula is known again in another book: its text, and the cells that it names there."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from reports.grading.reading.placement import Place
from reports.grading.reading.student import Student, covered
from reports.recalculation.grid import Area, Run

_BEYOND = frozenset(("SUMIF", "AVERAGEIF"))  # read as many cells as their first range has


@dataclass(frozen=True)
class Signatures:
    """What the formulas of one student are; equal ones do the same in every book."""

    student: Student

    def of(self, node: str) -> tuple[object, ...] | None:
        """What a node's formulas are, None where they may do otherwise in another book.

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
        """The cells that a formula names, None where not all are known."""
        formula = run.formula
        if formula is None or run.problem or run.array is not None:
            return None
        areas = tuple(self.student.grid.precedents(run))
        found = len(areas) == len(formula.references) and all(map(self._is_known, areas))
        return areas if found and formula.functions.isdisjoint(_BEYOND) else None

    def _is_known(self, area: Area) -> bool:
        """Whether all cells of a rectangle hold what was issued, or answers."""
        found = self._areas_known.get(area)
        if found is None:
            columns = range(area.first_column, area.last_column + 1)
            taken = (self._held.get((area.sheet, column), []) for column in columns)
            known = all(places and covered(area.first_row, area.last_row, places)
                        for places in taken)  # fmt: skip
            found = self._areas_known[area] = known
        return found

    @cached_property
    def _areas_known(self) -> dict[Area, bool]:
        return {}

    @cached_property
    def _held(self) -> dict[tuple[str, int], list[tuple[int, int, Place]]]:
        """First and last row of what stands in a column of a sheet and is alike in every book."""
        student, assignment = self.student, self.student.assignment
        known = assignment.model.fields.keys() | rows_as_issued(student)
        known |= assignment.fill_nodes | assignment.live_nodes | assignment.given_nodes
        found: dict[tuple[str, int], list[tuple[int, int, Place]]] = {}
        for node, place in student.placement.places.items():
            if place.span is not None and node in known:
                entry = (place.span.first, place.span.last, place)
                found.setdefault((place.sheet, place.column), []).append(entry)
        return found


def rows_as_issued(student: Student) -> set[str]:
    """Columns of angles and the like that hold what the tables begin with."""
    found = set()
    for node, place in student.placement.places.items():
        table = student.assignment.model.tables.get(node.partition(".")[0])
        asked = node in student.assignment.fill_nodes
        if table is None or asked or node not in student.layout.columns:
            continue
        constants = student.grid.column(place.sheet, place.column).constants
        if [constants.get(row) for row in place.rows if row is not None] == list(table.rows):
            found.add(node)
    return found
