"""A submitted workbook as numbers: values from the formulas, what they refer to, what was typed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from reports.grading.issuing.assignment import Assignment
from reports.grading.reading.placement import Place, Placement, find_places
from reports.recalculation.evaluate import BLANK, ERROR, Engine
from reports.recalculation.grid import Area, Column, Grid, Run
from reports.recalculation.language import UnknownFormula
from reports.spec.evaluation import Evaluation
from reports.workbook.inputs import shown
from reports.workbook.layout import Layout

Array = NDArray[np.float64]
LOST = "x"  # beside the kinds of ``recalculation.evaluate``


@dataclass(frozen=True, slots=True)
class Answer:
    """What stands in the cells of one node.

    ``kinds`` has a letter for each row: number, blank, text, error value, lost row.
    """

    place: Place | None
    values: Array
    kinds: str
    typed: NDArray[np.bool_]
    problem: str = ""

    @property
    def known(self) -> Array:
        """Values for further calculation: a blank cell counts as zero, as in a sheet."""
        return np.where([kind == BLANK for kind in self.kinds], 0.0, self.values)


@dataclass
class Changed:
    """A protected cell that is no longer as it was issued."""

    where: str
    name: str
    was: float | str
    now: str


@dataclass
class Student:
    """A submitted workbook under its assignment."""

    assignment: Assignment
    layout: Layout
    grid: Grid
    placement: Placement
    expected: Evaluation
    changed: list[Changed] = field(default_factory=list)

    @classmethod
    def of(cls, assignment: Assignment, layout: Layout, grid: Grid) -> Student:
        """Find the tables of a workbook and put the protected cells back as they were issued."""
        placement = find_places(assignment.kept_model, layout, grid)
        made = cls(assignment, layout, grid, placement, Evaluation(assignment.model))
        made._restore()
        return made

    @cached_property
    def engine(self) -> Engine:
        """The formulas, calculated with the issued input data."""
        return Engine(self.grid)

    # --- input data -------------------------------------------------------------------

    def _restore(self) -> None:
        """Input data and given numbers as issued; what was changed is remembered."""
        model = self.assignment.kept_model
        for name, item in model.fields.items():
            place = self.placement.places.get(name)
            if place is not None:
                self._put(place, 0, name, shown(item))
        for node in sorted(self.assignment.given_nodes):
            place = self.placement.places.get(node)
            if place is None:
                continue
            value = self.expected.value(node)
            if isinstance(value, str):
                self._put(place, 0, node, value)
                continue
            values = np.ravel(value)
            if self._as_issued(place, values):
                continue
            for index, given in enumerate(values.tolist()):
                if place.rows[index] is not None:
                    self._put(place, index, node, given)

    def _as_issued(self, place: Place, values: Array) -> bool:
        """Whether these very numbers stand in the cells of a place."""
        column = self.grid.column(place.sheet, place.column)
        if column.runs or column.errors:
            return False
        found = [column.constants.get(row, "") for row in place.rows if row is not None]
        if len(found) < len(values) or any(type(number) is not float for number in found):
            return False
        far = np.abs(np.array(found) - values) > 1e-9 * np.maximum(1, np.abs(values))
        return not far.any()

    def _put(self, place: Place, index: int, name: str, value: float | str) -> None:
        row = place.rows[index]
        column = self.grid.sheets[place.sheet].setdefault(place.column, Column())
        run = next(iter(column.runs_in(row, row)), None) if row is not None else None
        found = column.constants.get(row) if row is not None else None
        if run is None and row not in column.errors and _same(found, value):
            return
        if run is None and found is None and value == "":
            return
        assert row is not None
        text = "формула" if run is not None else "пусто" if found is None else str(found)
        where = f"{place.sheet}!{address(row, place.column)}"
        self.changed.append(Changed(where, name, value, text))
        column.cut({row})
        column.errors.pop(row, None)
        column.constants[row] = value if isinstance(value, str) else float(value)

    # --- answers ----------------------------------------------------------------------

    @cached_property
    def answers(self) -> dict[str, Answer]:
        """Answer of every node to fill in."""
        found = {}
        for block in self.assignment.fill:
            for node in self.assignment.nodes(block):
                found[node] = self._answer(node)
        return found

    def _answer(self, node: str) -> Answer:
        place = self.placement.places.get(node)
        count = self.assignment.length(node)
        if place is None:
            return Answer(None, np.full(count, np.nan), LOST * count, np.zeros(count, dtype=bool))
        column = self.grid.column(place.sheet, place.column)
        span = place.span
        if span is None:
            return Answer(place, np.full(count, np.nan), LOST * count, np.zeros(count, dtype=bool))
        first, last = span.first, span.last
        try:
            numbers, kinds = self.engine.values(place.sheet, place.column, first, last)
        except UnknownFormula as problem:
            blank = np.zeros(count, dtype=bool)
            return Answer(place, np.full(count, np.nan), ERROR * count, blank, str(problem) or "?")
        typed = column.constants
        if span.whole:
            marks = np.zeros(count, dtype=bool)
            if typed:
                marks[:] = [row in typed for row in place.rows]
            return Answer(place, numbers, kinds, marks)
        at = [None if row is None else row - first for row in place.rows]
        values = np.array([np.nan if i is None else numbers[i] for i in at])
        letters = "".join(LOST if i is None else kinds[i] for i in at)
        marks = np.array([row is not None and row in typed for row in place.rows])
        return Answer(place, values, letters, marks)

    def runs(self, node: str) -> list[Run]:
        """Runs of formulas in a node's cells."""
        place = self.placement.places.get(node)
        if place is None:
            return []
        span = place.span
        column = self.grid.column(place.sheet, place.column)
        if span is None:
            return []
        near = column.runs_in(span.first, span.last)
        if span.whole:
            return near
        rows = {row for row in place.rows if row is not None}
        return [run for run in near if not rows.isdisjoint(range(run.first, run.last + 1))]

    # --- what formulas refer to -------------------------------------------------------

    @cached_property
    def _columns_at(self) -> dict[tuple[str, int], list[tuple[str, int, int, Place]]]:
        """Nodes of each column with their first and last row."""
        found: dict[tuple[str, int], list[tuple[str, int, int, Place]]] = {}
        for node, place in self.placement.places.items():
            if place.span is not None:
                entry = (node, place.span.first, place.span.last, place)
                found.setdefault((place.sheet, place.column), []).append(entry)
        return found

    def precedents(self, node: str) -> frozenset[str]:
        """Nodes and inputs that a node's formulas refer to, through own helper cells too."""
        return self._precedents(node, frozenset())

    def refers_to(self, node: str, wanted: frozenset[str]) -> bool:
        """Whether a node's formulas refer to any of some nodes; quicker than all precedents."""
        return not wanted.isdisjoint(self._precedents(node, wanted))

    def _precedents(self, node: str, enough: frozenset[str]) -> frozenset[str]:
        """Precedents of a node, or those found until one of ``enough`` is among them."""
        found: set[str] = set()
        seen: set[Run] = set()
        stack = self.runs(node)
        while stack:
            run = stack.pop()
            if run in seen:
                continue
            seen.add(run)
            for area in self.grid.precedents(run):
                hit, rest = self._nodes_in(area)
                found |= hit
                if not enough.isdisjoint(hit - {node}):
                    return frozenset(found - {node})
                stack += rest
        found.discard(node)
        return frozenset(found)

    def _nodes_in(self, area: Area) -> tuple[set[str], list[Run]]:
        nodes: set[str] = set()
        helpers: list[Run] = []
        taken: dict[int, list[tuple[int, int, Place]]] = {}
        for (sheet, number), entries in self._columns_at.items():
            if sheet != area.sheet or not area.first_column <= number <= area.last_column:
                continue
            for node, first, last, place in entries:
                if first <= area.last_row and last >= area.first_row:
                    nodes.add(node)
                    taken.setdefault(number, []).append((first, last, place))
        for number in self.grid.columns_of(area):
            known = taken.get(number, [])
            if _covered(area.first_row, area.last_row, known):
                continue
            for run in self.grid.column(area.sheet, number).runs_in(area.first_row, area.last_row):
                low, high = max(run.first, area.first_row), min(run.last, area.last_row)
                if not _covered(low, high, known):
                    helpers.append(run)
        return nodes, helpers

    # --- what would have been -----------------------------------------------------------

    def with_right_precedents(self, node: str) -> Array | None:
        """Values that a node's own formulas give from right precedents; None if they cannot."""
        place = self.placement.places.get(node)
        runs = self.runs(node)
        if place is None or not runs:
            return None
        index = {row: i for i, row in enumerate(place.rows) if row is not None}
        values = np.full(len(place.rows), np.nan)
        try:
            for run in runs:
                part = self._pinned.once(run)
                for row in range(run.first, run.last + 1):
                    if row in index:
                        values[index[row]] = part[row - run.first]
        except UnknownFormula:
            return None
        return values

    @cached_property
    def _pinned(self) -> Engine:
        """The workbook with the right values typed into all cells to fill in."""
        sheets = {
            title: {
                number: Column(dict(c.constants), dict(c.errors), list(c.runs))
                for number, c in columns.items()
            }
            for title, columns in self.grid.sheets.items()
        }
        grid = Grid(sheets, self.grid.names, self.grid.areas)
        for node in self.assignment.fill_nodes:
            place = self.placement.places.get(node)
            if place is None:
                continue
            right = self.expected.value(node)
            column = sheets[place.sheet].setdefault(place.column, Column())
            rows = {r for r in place.rows if r is not None}
            column.cut(rows)
            for i, row in enumerate(place.rows):
                if row is not None:
                    column.errors.pop(row, None)
                    value = right if isinstance(right, str) else float(np.ravel(right)[i])
                    column.constants[row] = value
        return Engine(grid)


def _covered(low: int, high: int, taken: list[tuple[int, int, Place]]) -> bool:
    """Whether all rows belong to nodes."""
    for first, last, place in taken:
        if first <= low and high <= last and place.span is not None and place.span.whole:
            return True
    rows = {row for _, _, place in taken for row in place.rows}
    return all(row in rows for row in range(low, high + 1))


def _same(found: float | str | bool | None, wanted: float | str) -> bool:
    if isinstance(wanted, str):
        return isinstance(found, str) and found.strip() == wanted.strip()
    if found is None or isinstance(found, str):
        return False
    return abs(float(found) - float(wanted)) <= 1e-9 * max(1.0, abs(float(wanted)))


def address(row: int, column: int) -> str:
    """Cell address for messages."""
    from reports.workbook.layout import Cell

    return Cell("", row, column).coordinate


def known_values(answers: Mapping[str, Answer], nodes: frozenset[str]) -> dict[str, object]:
    """The student's own values of some nodes, as ``Evaluation`` takes them."""
    return {
        node: answers[node].known if "." in node else float(answers[node].known[0])
        for node in nodes
        if node in answers
    }
