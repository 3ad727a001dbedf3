"""A submitted workbook as numbers: values from the formulas, what they refer to, what was typed."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import chain

import numpy as np
from numpy.typing import NDArray

from reports.grading.issuing.assignment import Assignment
from reports.grading.reading.placement import Location, Placement, find_places
from reports.grading.reading.typed import DATE, as_meant, carried, dates, number_of
from reports.model.evaluation import Evaluation
from reports.recalculation.evaluate import BLANK, ERROR, NUMBER, Evaluator
from reports.recalculation.formulas import is_doubtful
from reports.recalculation.grid import Area, CellGrid, Run
from reports.recalculation.trial_sheet import Cells, needed, pinned
from reports.shared.errors import UnknownFormula
from reports.workbook.intake import Package
from reports.workbook.layout import Cell, Layout

Array = NDArray[np.float64]
_MANY_AREAS = 100  # rectangles of one column that are looked at one by one
LOST = "x"  # beside the kinds of ``recalculation.evaluate``


@dataclass(frozen=True, slots=True)
class Answer:
    """Contents of the cells of one node.

    ``kinds`` has a letter for each row: number, blank, text, error value, lost row.
    A number that was typed as a text is a number here.
    """

    location: Location | None
    values: Array
    kinds: str
    typed: NDArray[np.bool_]
    problem: str = ""
    odd: Mapping[int, str] = field(default_factory=dict)  # what was typed and taken otherwise

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
class StudentBook:
    """A submitted workbook under its assignment."""

    assignment: Assignment
    layout: Layout
    grid: CellGrid
    placement: Placement
    expected: Evaluation
    changed: list[Changed] = field(default_factory=list)
    rewritten: set[str] = field(default_factory=set)  # given formulas that read otherwise
    package: Package | None = None  # of the grid: how its cells are shown
    _settled: frozenset[str] = frozenset()

    @classmethod
    def of(cls, assignment: Assignment, layout: Layout, grid: CellGrid) -> StudentBook:
        """Find the tables of a workbook; ``restoring.restore`` puts back what was issued."""
        placement = find_places(assignment.kept_model, layout, grid)
        return cls(assignment, layout, grid, placement, Evaluation(assignment.model))

    @cached_property
    def engine(self) -> Evaluator:
        """The formulas, calculated with the issued input data."""
        return Evaluator(self.known)

    @cached_property
    def known(self) -> CellGrid:
        """The grid that is calculated: what ``settle`` has settled stands in it as numbers."""
        return self.grid

    def settle(self, nodes: frozenset[str]) -> None:
        """Replace proven formulas by their values."""
        self._settled = nodes
        to_fill = self.assignment.fill_nodes
        if to_fill <= nodes:
            self.known = CellGrid({title: {} for title in self.grid.sheets})
        elif nodes:
            right = [self.cells_of(node, self.expected.value(node)) for node in sorted(nodes)]
            spans = ((p, p.span) for p in map(self.placement.places.get, to_fill) if p is not None)
            areas = [Area(p.sheet, s.first, s.last, p.column, p.column) for p, s in spans if s]
            self.known = needed(pinned(self.grid, chain.from_iterable(right)), areas)

    def is_settled(self, nodes: Collection[str]) -> bool:
        """Whether the formulas of nodes are all proven: their values are the right ones."""
        return self._settled.issuperset(nodes)

    # --- answers ----------------------------------------------------------------------

    @cached_property
    def answers(self) -> dict[str, Answer]:
        """Answer of every node to fill in."""
        answers = {}
        for item in self.assignment.items:
            for node in item.nodes:
                answers[node] = self._answer(node)
        return answers

    def _answer(self, node: str) -> Answer:
        location = self.placement.places.get(node)
        count = self.assignment.length(node)
        nothing, none = np.full(count, np.nan), np.zeros(count, dtype=bool)
        if location is None or location.span is None:
            return Answer(location, nothing, LOST * count, none)
        if node in self._settled:
            numbers = np.ravel(np.asarray(self.expected.value(node), dtype=float))
            return Answer(location, numbers, NUMBER * count, none)
        try:
            numbers, kinds = shown_in(self.engine, location)
        except UnknownFormula as problem:
            return Answer(location, nothing, ERROR * count, none, str(problem) or "?")
        typed = self.grid.column(location.sheet, location.column).constants
        if typed.keys().isdisjoint(location.rows):
            return Answer(location, numbers, kinds, none)
        marks = np.array([row in typed for row in location.rows])
        return self._as_meant(Answer(location, numbers, kinds, marks), typed)

    def _as_meant(self, answer: Answer, typed: Mapping[int, object]) -> Answer:
        """An answer with the numbers that were typed as texts, and what else is odd about it."""
        location = answer.location
        assert location is not None
        numbers, odd = as_meant([typed.get(row or 0) for row in location.rows])
        for i, row in enumerate(location.rows):
            if Cell(location.sheet, row or 0, location.column) in self._dates:
                odd[i] = DATE
        if not odd:
            return answer
        values = np.array([numbers.get(i, entry) for i, entry in enumerate(answer.values)])
        kinds = "".join(NUMBER if i in numbers else entry for i, entry in enumerate(answer.kinds))
        return replace(answer, values=values, kinds=kinds, odd=dict(sorted(odd.items())))

    @cached_property
    def _dates(self) -> frozenset[Cell]:
        """Cells to fill in that hold dates."""
        locations = filter(None, map(self.placement.places.get, self.assignment.fill_nodes))
        return dates(self.package, self.grid, locations) if self.package else frozenset()

    def runs(self, node: str) -> list[Run]:
        """Return runs of formulas in a node's cells."""
        location = self.placement.places.get(node)
        if location is None or location.span is None:
            return []
        span = location.span
        runs = self.grid.column(location.sheet, location.column).runs_in(span.first, span.last)
        if span.whole:
            return runs
        rows = {row for row in location.rows if row is not None}
        return [run for run in runs if not rows.isdisjoint(range(run.first, run.last + 1))]

    # --- what formulas refer to -------------------------------------------------------

    @cached_property
    def _columns_at(self) -> dict[str, dict[int, list[tuple[str, int, int, Location]]]]:
        """Nodes of each column of a sheet with their first and last row."""
        columns: dict[str, dict[int, list[tuple[str, int, int, Location]]]] = {}
        for node, location in self.placement.places.items():
            if location.span is not None:
                entry = (node, location.span.first, location.span.last, location)
                of_sheet = columns.setdefault(location.sheet, {})
                of_sheet.setdefault(location.column, []).append(entry)
        return columns

    def precedents(self, node: str) -> frozenset[str]:
        """Nodes and inputs that a node's formulas refer to, through own helper cells too."""
        return self.refers(node) - {node}

    def refers(self, node: str) -> frozenset[str]:
        """Precedents of a node, itself among them where it refers to its own column."""
        return self._seen_from(node)[0]

    def _seen_from(self, node: str) -> tuple[frozenset[str], frozenset[Run]]:
        if node not in self._walked:
            self._walked[node] = self._walk(node)
        return self._walked[node]

    @cached_property
    def _walked(self) -> dict[str, tuple[frozenset[str], frozenset[Run]]]:
        return {}

    def _walk(self, node: str) -> tuple[frozenset[str], frozenset[Run]]:
        names: set[str] = set()
        seen: set[Run] = set()
        stack = self.runs(node)
        while stack:
            run = stack.pop()
            if run in seen:
                continue
            seen.add(run)
            for area in self.grid.precedents(run):
                hit, remaining = self._nodes_in(area)
                names |= hit
                stack += remaining
        return frozenset(names), frozenset(seen)

    @cached_property
    def _seen_in(self) -> dict[Area, tuple[set[str], list[Run]]]:
        return {}

    def _nodes_in(self, area: Area) -> tuple[set[str], list[Run]]:
        """Nodes with cells in a rectangle, and the formulas outside of all nodes."""
        seen = self._seen_in.get(area)
        if seen is None:
            seen = self._seen_in[area] = self._looked_up(area)
        return seen

    def _looked_up(self, area: Area) -> tuple[set[str], list[Run]]:
        nodes: set[str] = set()
        helpers: list[Run] = []
        taken: dict[int, list[tuple[int, int, Location]]] = {}
        columns = self._columns_at.get(area.sheet, {})
        inside = range(area.first_column, area.last_column + 1)
        for number in inside if len(inside) < len(columns) else [n for n in columns if n in inside]:
            for node, first, last, location in columns.get(number, ()):
                if first <= area.last_row and last >= area.first_row:
                    nodes.add(node)
                    taken.setdefault(number, []).append((first, last, location))
        for number in self.grid.columns_of(area):
            known = taken.get(number, [])
            if covered(area.first_row, area.last_row, known):
                continue
            for run in self.grid.column(area.sheet, number).runs_in(area.first_row, area.last_row):
                low, high = max(run.first, area.first_row), min(run.last, area.last_row)
                if not covered(low, high, known):
                    helpers.append(run)
        return nodes, helpers

    def assume(self, unknown: Collection[str]) -> None:
        """Go on where a formula cannot be calculated: with its saved numbers, else right ones.

        What cannot be calculated is one person's look; what follows from it is judged.
        """
        waiting = [n for n, a in self.answers.items() if a.problem and n not in unknown]
        if not waiting:
            return
        cells = []
        for node, answer in self.answers.items():
            location, right = answer.location, self.expected.value(node)
            if location is None or isinstance(right, str):
                continue
            column = self.grid.column(location.sheet, location.column)
            saved = dict(zip(column.saved_rows, column.saved, strict=True))
            numbers = {}
            for row, number in zip(location.rows, np.ravel(right).tolist(), strict=True):
                text = column.constants.get(row) if row is not None else None
                if row is not None and node in unknown:
                    claim = saved.get(row, np.nan)
                    numbers[row] = number if np.isnan(claim) else claim
                elif row is not None and isinstance(text, str) and is_doubtful(text):
                    numbers[row] = number if (parsed := number_of(text)) is None else parsed
            if numbers:
                rows = tuple(numbers)
                values = tuple(numbers.values())
                cells.append(Cells(location.sheet, location.column, rows, values))
        self.engine = Evaluator(pinned(self.known, cells))
        for node in waiting:
            self.answers[node] = self._answer(node)

    # --- what rests on what -----------------------------------------------------------

    def cells_of(self, node: str, values: object) -> list[Cells]:
        """Return the cells of a node with values."""
        location = self.placement.places.get(node)
        if location is None:
            return []
        entries = [values] if isinstance(values, str) else np.ravel(np.asarray(values)).tolist()
        cells = [(r, v) for r, v in zip(location.rows, entries, strict=True) if r is not None]
        if not cells:
            return []
        rows, numbers = zip(*cells, strict=True)
        return [Cells(location.sheet, location.column, rows, numbers)]

    @cached_property
    def rows_as_issued(self) -> frozenset[str]:
        """Columns of angles and the like that hold what the tables begin with."""
        tables = set()
        for node, location in self.placement.places.items():
            table = self.assignment.model.tables.get(node.partition(".")[0])
            to_fill = node in self.assignment.fill_nodes
            if table is None or to_fill or node not in self.layout.columns:
                continue
            constants = self.grid.column(location.sheet, location.column).constants
            if [constants.get(row) for row in location.rows if row is not None] == list(table.rows):
                tables.add(node)
        return frozenset(tables)

    @cached_property
    def own_constants(self) -> list[tuple[str, int, int, float]]:
        """Numbers typed into cells that are none of the work-book's, as texts too."""
        taken: dict[tuple[str, int], set[int | None]] = {}
        for location in self.placement.places.values():
            taken.setdefault((location.sheet, location.column), set()).update(location.rows)
        return [
            (sheet, number, row, value)
            for sheet, columns in self.grid.sheets.items()
            for number, column in columns.items()
            for row, constant in column.constants.items()
            if row not in taken.get((sheet, number), ())
            if (value := carried(constant)) is not None
        ]

    @cached_property
    def _own_by_column(self) -> dict[tuple[str, int], list[tuple[int, float]]]:
        columns: dict[tuple[str, int], list[tuple[int, float]]] = {}
        for sheet, number, row, value in self.own_constants:
            columns.setdefault((sheet, number), []).append((row, value))
        return columns

    def own_numbers(self, node: str) -> list[float]:
        """Numbers typed in outside the tables that a node's formulas refer to."""
        read: dict[tuple[str, int], set[tuple[int, int]]] = {}
        for run in self._seen_from(node)[1] if self.own_constants else ():
            for area in self.grid.precedents(run):
                for number in self.grid.columns_of(area):
                    rows = read.setdefault((area.sheet, number), set())
                    rows.add((area.first_row, area.last_row))
                    if len(rows) > _MANY_AREAS:  # what lies between them as well
                        ends = [row for pair in rows for row in pair]
                        read[area.sheet, number] = {(min(ends), max(ends))}
        return [
            value
            for column, cells in self._own_by_column.items()
            if (stretches := read.get(column))
            for row, value in cells
            if any(first <= row <= last for first, last in stretches)
        ]

    def helpers(self, node: str) -> list[Run]:
        """Formulas of one's own, outside the tables, that a node refers to."""
        return [run for run in self._seen_from(node)[1] if run not in self.runs(node)]

    @cached_property
    def as_laid_out(self) -> bool:
        """Whether every cell of the tables stands where it was issued."""
        layout = self.layout
        for name, location in self.placement.places.items():
            if name in layout.cells:
                cell = layout.cells[name]
                if (location.sheet, location.column, location.rows) != (
                    cell.sheet,
                    cell.column,
                    (cell.row,),
                ):
                    return False
            elif name in layout.columns:
                table, column = layout.columns[name]
                if (location.sheet, location.column) != (table.sheet, column):
                    return False
                if location.rows != tuple(layout.rows_of(table)):
                    return False
        return True


def covered(low: int, high: int, taken: list[tuple[int, int, Location]]) -> bool:
    """Whether all rows belong to nodes."""
    for first, last, location in taken:
        if first <= low and high <= last and location.span is not None and location.span.whole:
            return True
    rows = {row for _, _, location in taken for row in location.rows}
    return all(row in rows for row in range(low, high + 1))


def shown_in(engine: Evaluator, location: Location) -> tuple[Array, str]:
    """Numbers and kinds of a place's rows; lost ones have a letter of their own.

    Raises:
        UnknownFormula: one of its formulas cannot be calculated for certain.
    """
    assert location.span is not None
    first = location.span.first
    numbers, kinds = engine.values(location.sheet, location.column, first, location.span.last)
    if location.span.whole:
        return numbers, kinds
    at = [None if row is None else row - first for row in location.rows]
    values = np.array([np.nan if i is None else numbers[i] for i in at])
    return values, "".join(LOST if i is None else kinds[i] for i in at)


def known_values(answers: Mapping[str, Answer], nodes: frozenset[str]) -> dict[str, object]:
    """Return the student's own values of some nodes, as ``Evaluation`` takes them."""
    return {
        node: answers[node].known if "." in node else float(answers[node].known[0])
        for node in nodes
        if node in answers
    }
