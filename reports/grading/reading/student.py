"""A submitted workbook as numbers: values from the formulas, what they refer to, what was typed."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import chain

import numpy as np
from numpy.typing import NDArray

from reports.grading.issuing.assignment import Assignment
from reports.grading.reading.placement import Place, Placement, find_places
from reports.grading.reading.typed import DATE, as_meant, carried, dates, number_of
from reports.model.evaluation import Evaluation
from reports.recalculation.bench import Cells, needed, pinned
from reports.recalculation.evaluate import BLANK, ERROR, NUMBER, Engine
from reports.recalculation.formulas import is_doubtful
from reports.recalculation.grid import Area, Grid, Run
from reports.recalculation.language import UnknownFormula
from reports.workbook.layout import Cell, Layout
from reports.workbook.package import Package

Array = NDArray[np.float64]
_MANY_AREAS = 100  # rectangles of one column that are looked at one by one
LOST = "x"  # beside the kinds of ``recalculation.evaluate``


@dataclass(frozen=True, slots=True)
class Answer:
    """What stands in the cells of one node.

    ``kinds`` has a letter for each row: number, blank, text, error value, lost row.
    A number that was typed as a text is a number here.
    """

    place: Place | None
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
class Student:
    """A submitted workbook under its assignment."""

    assignment: Assignment
    layout: Layout
    grid: Grid
    placement: Placement
    expected: Evaluation
    changed: list[Changed] = field(default_factory=list)
    rewritten: set[str] = field(default_factory=set)  # given formulas that read otherwise
    package: Package | None = None  # of the grid: how its cells are shown
    _settled: frozenset[str] = frozenset()

    @classmethod
    def of(cls, assignment: Assignment, layout: Layout, grid: Grid) -> Student:
        """Find the tables of a workbook; ``restoring.restore`` puts back what was issued."""
        placement = find_places(assignment.kept_model, layout, grid)
        return cls(assignment, layout, grid, placement, Evaluation(assignment.model))

    @cached_property
    def engine(self) -> Engine:
        """The formulas, calculated with the issued input data."""
        return Engine(self.known)

    @cached_property
    def known(self) -> Grid:
        """The grid that is calculated: what ``settle`` has settled stands in it as numbers."""
        return self.grid

    def settle(self, nodes: frozenset[str]) -> None:
        """Leave out of the calculation what is known to hold the right numbers."""
        self._settled = nodes
        asked = self.assignment.fill_nodes
        if asked <= nodes:
            self.known = Grid({title: {} for title in self.grid.sheets})
        elif nodes:
            right = [self.cells_of(node, self.expected.value(node)) for node in sorted(nodes)]
            spans = ((p, p.span) for p in map(self.placement.places.get, asked) if p is not None)
            areas = [Area(p.sheet, s.first, s.last, p.column, p.column) for p, s in spans if s]
            self.known = needed(pinned(self.grid, chain.from_iterable(right)), areas)

    # --- answers ----------------------------------------------------------------------

    @cached_property
    def answers(self) -> dict[str, Answer]:
        """Answer of every node to fill in."""
        found = {}
        for item in self.assignment.items:
            for node in item.nodes:
                found[node] = self._answer(node)
        return found

    def _answer(self, node: str) -> Answer:
        place = self.placement.places.get(node)
        count = self.assignment.length(node)
        nothing, none = np.full(count, np.nan), np.zeros(count, dtype=bool)
        if place is None or place.span is None:
            return Answer(place, nothing, LOST * count, none)
        if node in self._settled:
            numbers = np.ravel(np.asarray(self.expected.value(node), dtype=float))
            return Answer(place, numbers, NUMBER * count, none)
        try:
            numbers, kinds = shown_in(self.engine, place)
        except UnknownFormula as problem:
            return Answer(place, nothing, ERROR * count, none, str(problem) or "?")
        typed = self.grid.column(place.sheet, place.column).constants
        if not typed:
            return Answer(place, numbers, kinds, none)
        marks = np.array([row in typed for row in place.rows])
        return self._as_meant(Answer(place, numbers, kinds, marks), typed)

    def _as_meant(self, answer: Answer, typed: Mapping[int, object]) -> Answer:
        """An answer with the numbers that were typed as texts, and what else is odd about it."""
        place = answer.place
        assert place is not None
        numbers, odd = as_meant([typed.get(row or 0) for row in place.rows])
        for i, row in enumerate(place.rows):
            if Cell(place.sheet, row or 0, place.column) in self._dates:
                odd[i] = DATE
        if not odd:
            return answer
        values = np.array([numbers.get(i, own) for i, own in enumerate(answer.values)])
        kinds = "".join(NUMBER if i in numbers else own for i, own in enumerate(answer.kinds))
        return replace(answer, values=values, kinds=kinds, odd=dict(sorted(odd.items())))

    @cached_property
    def _dates(self) -> frozenset[Cell]:
        """Cells to fill in that hold dates."""
        places = filter(None, map(self.placement.places.get, self.assignment.fill_nodes))
        return dates(self.package, self.grid, places) if self.package else frozenset()

    def runs(self, node: str) -> list[Run]:
        """Runs of formulas in a node's cells."""
        place = self.placement.places.get(node)
        if place is None or place.span is None:
            return []
        span = place.span
        near = self.grid.column(place.sheet, place.column).runs_in(span.first, span.last)
        if span.whole:
            return near
        rows = {row for row in place.rows if row is not None}
        return [run for run in near if not rows.isdisjoint(range(run.first, run.last + 1))]

    # --- what formulas refer to -------------------------------------------------------

    @cached_property
    def _columns_at(self) -> dict[str, dict[int, list[tuple[str, int, int, Place]]]]:
        """Nodes of each column of a sheet with their first and last row."""
        found: dict[str, dict[int, list[tuple[str, int, int, Place]]]] = {}
        for node, place in self.placement.places.items():
            if place.span is not None:
                entry = (node, place.span.first, place.span.last, place)
                of_sheet = found.setdefault(place.sheet, {})
                of_sheet.setdefault(place.column, []).append(entry)
        return found

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
                stack += rest
        return frozenset(found), frozenset(seen)

    def _nodes_in(self, area: Area) -> tuple[set[str], list[Run]]:
        nodes: set[str] = set()
        helpers: list[Run] = []
        taken: dict[int, list[tuple[int, int, Place]]] = {}
        columns = self._columns_at.get(area.sheet, {})
        inside = range(area.first_column, area.last_column + 1)
        for number in (n for n in columns if n in inside):
            for node, first, last, place in columns.get(number, ()):
                if first <= area.last_row and last >= area.first_row:
                    nodes.add(node)
                    taken.setdefault(number, []).append((first, last, place))
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
            place, right = answer.place, self.expected.value(node)
            if place is None or isinstance(right, str):
                continue
            column = self.grid.column(place.sheet, place.column)
            saved = dict(zip(column.saved_rows, column.saved, strict=True))
            found = {}
            for row, number in zip(place.rows, np.ravel(right).tolist(), strict=True):
                text = column.constants.get(row) if row is not None else None
                if row is not None and node in unknown:
                    claim = saved.get(row, np.nan)
                    found[row] = number if np.isnan(claim) else claim
                elif row is not None and isinstance(text, str) and is_doubtful(text):
                    found[row] = number if (own := number_of(text)) is None else own
            if found:
                rows = tuple(found)
                values = tuple(found.values())
                cells.append(Cells(place.sheet, place.column, rows, values))
        self.engine = Engine(pinned(self.known, cells))
        for node in waiting:
            self.answers[node] = self._answer(node)

    # --- what rests on what -----------------------------------------------------------

    def cells_of(self, node: str, values: object) -> list[Cells]:
        """The cells of a node with values."""
        place = self.placement.places.get(node)
        if place is None:
            return []
        given = [values] if isinstance(values, str) else np.ravel(np.asarray(values)).tolist()
        kept = [(r, v) for r, v in zip(place.rows, given, strict=True) if r is not None]
        if not kept:
            return []
        rows, numbers = zip(*kept, strict=True)
        return [Cells(place.sheet, place.column, rows, numbers)]

    @cached_property
    def own_constants(self) -> list[tuple[str, int, int, float]]:
        """Numbers typed into cells that are none of the work-book's, as texts too."""
        taken: dict[tuple[str, int], set[int | None]] = {}
        for place in self.placement.places.values():
            taken.setdefault((place.sheet, place.column), set()).update(place.rows)
        return [
            (sheet, number, row, value)
            for sheet, columns in self.grid.sheets.items()
            for number, column in columns.items()
            for row, given in column.constants.items()
            if row not in taken.get((sheet, number), ())
            if (value := carried(given)) is not None
        ]

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
            for sheet, number, row, value in self.own_constants
            if any(first <= row <= last for first, last in read.get((sheet, number), ()))
        ]

    def helpers(self, node: str) -> list[Run]:
        """Formulas of one's own, outside the tables, that a node refers to."""
        return [run for run in self._seen_from(node)[1] if run not in self.runs(node)]

    @cached_property
    def as_laid_out(self) -> bool:
        """Whether every cell of the tables stands where it was issued."""
        layout = self.layout
        for name, place in self.placement.places.items():
            if name in layout.cells:
                cell = layout.cells[name]
                if (place.sheet, place.column, place.rows) != (
                    cell.sheet,
                    cell.column,
                    (cell.row,),
                ):
                    return False
            elif name in layout.columns:
                table, column = layout.columns[name]
                if (place.sheet, place.column) != (table.sheet, column):
                    return False
                if place.rows != tuple(layout.rows_of(table)):
                    return False
        return True


def covered(low: int, high: int, taken: list[tuple[int, int, Place]]) -> bool:
    """Whether all rows belong to nodes."""
    for first, last, place in taken:
        if first <= low and high <= last and place.span is not None and place.span.whole:
            return True
    rows = {row for _, _, place in taken for row in place.rows}
    return all(row in rows for row in range(low, high + 1))


def shown_in(engine: Engine, place: Place) -> tuple[Array, str]:
    """Numbers and kinds of a place's rows; lost ones have a letter of their own.

    Raises:
        UnknownFormula: one of its formulas cannot be calculated for certain.
    """
    assert place.span is not None
    first = place.span.first
    numbers, kinds = engine.values(place.sheet, place.column, first, place.span.last)
    if place.span.whole:
        return numbers, kinds
    at = [None if row is None else row - first for row in place.rows]
    values = np.array([np.nan if i is None else numbers[i] for i in at])
    return values, "".join(LOST if i is None else kinds[i] for i in at)


def known_values(answers: Mapping[str, Answer], nodes: frozenset[str]) -> dict[str, object]:
    """The student's own values of some nodes, as ``Evaluation`` takes them."""
    return {
        node: answers[node].known if "." in node else float(answers[node].known[0])
        for node in nodes
        if node in answers
    }
