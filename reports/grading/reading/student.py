"""A submitted workbook as numbers: values from the formulas, what they refer to, what was typed."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from reports.grading.issuing.assignment import Assignment
from reports.grading.reading.placement import Place, Placement, find_places
from reports.recalculation.bench import Cells, pinned
from reports.recalculation.evaluate import BLANK, ERROR, TEXT, Engine
from reports.recalculation.formulas import Formula, formula_at, is_doubtful
from reports.recalculation.grid import Area, Column, Grid, Run
from reports.recalculation.language import UnknownFormula
from reports.formula.excel import compile_formula
from reports.grading.issuing.handout import fill_cells
from reports.spec.blocks import TableSpec
from reports.spec.evaluation import Evaluation
from reports.workbook.inputs import shown
from reports.workbook.layout import Layout, RowReferences, at_row

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

    replaced: list[str] = field(default_factory=list)  # nodes of which a formula was given

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

        for node, formulas in issued_formulas(self.assignment, self.layout).items():
            place = self.placement.places.get(node)
            if place is not None:
                self._put_formulas(node, place, formulas)

    def _put_formulas(self, node: str, place: Place, formulas: Sequence[Formula]) -> None:
        """Formulas that were given, where something else stands in their place.

        A formula whose cells were moved reads otherwise and is left: its response tells.
        """
        column = self.grid.sheets[place.sheet].setdefault(place.column, Column())
        if place.span is not None and place.span.whole and not column.constants.keys() & set(
            place.rows
        ):
            runs = column.runs_in(place.span.first, place.span.last)
            same = {run.formula for run in runs} <= set(formulas) and not column.errors
            if same and sum(run.count for run in runs) >= len(place.rows):
                return
        moved = not self._as_laid_out
        found = []
        for row, formula in zip(place.rows, formulas, strict=True):
            run = next(iter(column.runs_in(row, row)), None) if row is not None else None
            if row is None or (run is not None and (moved or run.formula is formula)):
                continue
            found.append((row, formula, run))
        for row, formula, run in found:
            text = "другая формула" if run is not None else column.constants.get(row, "пусто")
            where = f"{place.sheet}!{address(row, place.column)}"
            self.changed.append(Changed(where, node, "формула", str(text)))
            column.cut({row})
            column.errors.pop(row, None)
            column.constants.pop(row, None)
            if not moved:
                column.runs.append(Run(place.sheet, place.column, row, 1, formula, ""))
            else:
                right = np.ravel(np.asarray(self.expected.value(node), dtype=object))
                value = right[place.rows.index(row)]
                column.constants[row] = value if isinstance(value, str) else float(value)

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
        for item in self.assignment.items:
            for node in item.nodes:
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

    def _precedents(
        self, node: str, enough: frozenset[str], *, itself: bool = False
    ) -> frozenset[str]:
        """Precedents of a node, or those found until one of ``enough`` is among them."""
        if enough:
            return self._walk(node, enough)[0] - {node}
        found = self._seen_from(node)[0]
        return found if itself else found - {node}

    def _seen_from(self, node: str) -> tuple[frozenset[str], frozenset[Run]]:
        if node not in self._walked:
            self._walked[node] = self._walk(node, frozenset())
        return self._walked[node]

    @cached_property
    def _walked(self) -> dict[str, tuple[frozenset[str], frozenset[Run]]]:
        return {}

    def _walk(self, node: str, enough: frozenset[str]) -> tuple[frozenset[str], frozenset[Run]]:
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
                    return frozenset(found), frozenset(seen)
                stack += rest
        return frozenset(found), frozenset(seen)

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
                    found[row] = _read(text, number)
            if found:
                rows = tuple(found)
                values = tuple(found.values())
                cells.append(Cells(place.sheet, place.column, rows, values))
        self.engine = Engine(pinned(self.grid, cells))
        for node in waiting:
            self.answers[node] = self._answer(node)

    # --- what rests on what -----------------------------------------------------------

    @cached_property
    def circles(self) -> frozenset[str]:
        """Nodes that are calculated through themselves."""
        round_ = {
            node
            for node, answer in self.answers.items()
            if ERROR in answer.kinds
            and answer.place is not None
            and answer.place.span is not None
            and self.engine.is_circular(
                answer.place.sheet, answer.place.column, answer.place.span.first,
                answer.place.span.last,
            )
        }  # fmt: skip
        if not round_:
            return frozenset()
        refers = {node: self._through(node) for node in round_}
        found = set()
        for node in round_:
            seen: set[str] = set()
            stack = list(refers[node])
            while stack:
                name = stack.pop()
                if name == node:
                    found.add(node)
                    break
                if name not in seen:
                    seen.add(name)
                    stack += refers.get(name, ())
        return frozenset(found)

    def _through(self, node: str) -> frozenset[str]:
        """Asked nodes that a node refers to, through live formulas too, itself among them."""
        found: set[str] = set()
        seen: set[str] = set()
        stack = [node]
        while stack:
            for name in self._precedents(stack.pop(), frozenset(), itself=True):
                if name in self.answers:
                    found.add(name)
                elif name in self.assignment.live_nodes and name not in seen:
                    seen.add(name)
                    stack.append(name)
        return frozenset(found)

    def is_void(self, node: str) -> bool:
        """Whether there is no value to go on with: blanks, or a text that is no number."""
        answer = self.answers[node]
        if answer.place is None or answer.problem:
            return False
        nothing = answer.kinds.count(BLANK)
        if TEXT in answer.kinds and answer.typed.any():
            column = self.grid.column(answer.place.sheet, answer.place.column)
            texts = [column.constants.get(row) for row in answer.place.rows if row is not None]
            nothing += sum(isinstance(t, str) and not is_doubtful(t, in_product=True) for t in texts)
        return nothing > len(answer.kinds) / 2

    def resting_on(self, nodes: frozenset[str]) -> frozenset[str]:
        """Nodes whose values would be other ones if some nodes had the right values."""
        cells = []
        for node in sorted(nodes):
            place = self.placement.places.get(node)
            right = self.expected.value(node)
            if place is None or isinstance(right, str):
                continue
            values = np.ravel(np.asarray(right, dtype=float)).tolist()
            kept = [(r, v) for r, v in zip(place.rows, values, strict=True) if r is not None]
            if kept:
                rows, numbers = zip(*kept, strict=True)
                cells.append(Cells(place.sheet, place.column, rows, numbers))
        other = Engine(pinned(self.grid, cells))
        found = set(nodes)
        for node, answer in self.answers.items():
            place = answer.place
            if place is None or place.span is None or answer.problem:
                continue
            try:
                span = place.span
                numbers, kinds = other.values(place.sheet, place.column, span.first, span.last)
            except UnknownFormula:
                continue
            was, now = answer.kinds, _at(place, kinds)
            values = _picked(place, numbers)
            if was != now or not np.allclose(values, answer.values, 1e-9, 1e-12, equal_nan=True):
                found.add(node)
        return frozenset(found)

    def helpers(self, node: str) -> list[Run]:
        """Formulas of one's own, outside the tables, that a node refers to."""
        return [run for run in self._seen_from(node)[1] if run not in self.runs(node)]

    def signature(self, node: str) -> tuple[object, ...] | None:
        """What a node's formulas are, where they refer to nothing but cells as issued."""
        if not self._as_laid_out:
            return None
        place = self.placement.places[node]
        if place.span is None:
            return None
        parts: list[object] = [node]
        for run in self.runs(node):
            if run.formula is None or run.problem or run.array is not None:
                return None
            if not all(self._is_known(area) for area in self.grid.precedents(run)):
                return None
            parts.append((run.first, run.count, run.formula))
        return tuple(parts)

    @cached_property
    def _as_laid_out(self) -> bool:
        """Whether every cell of the tables stands where it was issued."""
        layout = self.layout
        for name, place in self.placement.places.items():
            if name in layout.cells:
                cell = layout.cells[name]
                if (place.sheet, place.column, place.rows) != (cell.sheet, cell.column, (cell.row,)):
                    return False
            elif name in layout.columns:
                table, column = layout.columns[name]
                if (place.sheet, place.column) != (table.sheet, column):
                    return False
                if place.rows != tuple(layout.rows_of(table)):
                    return False
        return True

    def _is_known(self, area: Area) -> bool:
        """Whether all cells of a rectangle belong to the tables or the input."""
        key = (area.sheet, area.first_row, area.last_row, area.first_column, area.last_column)
        found = self._areas_known.get(key)
        if found is None:
            found = self._areas_known[key] = all(
                _covered(
                    area.first_row,
                    area.last_row,
                    [entry[1:] for entry in self._columns_at.get((area.sheet, number), [])],
                )
                for number in range(area.first_column, min(area.last_column, 200) + 1)
            )
        return found

    @cached_property
    def _areas_known(self) -> dict[tuple[object, ...], bool]:
        return {}


def _read(text: str, otherwise: float) -> float:
    """A number written as a text."""
    try:
        return float(re.sub(r"\s", "", text).replace(",", "."))
    except ValueError:
        return otherwise


def _picked(place: Place, numbers: Array) -> Array:
    assert place.span is not None
    first = place.span.first
    return np.array([np.nan if row is None else numbers[row - first] for row in place.rows])


def _at(place: Place, kinds: str) -> str:
    assert place.span is not None
    return "".join(LOST if row is None else kinds[row - place.span.first] for row in place.rows)


def _covered(low: int, high: int, taken: list[tuple[int, int, Place]]) -> bool:
    """Whether all rows belong to nodes."""
    for first, last, place in taken:
        if first <= low and high <= last and place.span is not None and place.span.whole:
            return True
    rows = {row for _, _, place in taken for row in place.rows}
    return all(row in rows for row in range(low, high + 1))


def issued_formulas(assignment: Assignment, layout: Layout) -> dict[str, tuple[Formula, ...]]:
    """Node → the formulas of its cells, of the nodes that were given as formulas."""
    known = assignment.__dict__.get("issued_formulas")
    if known is None:
        known = assignment.__dict__["issued_formulas"] = _issued(assignment, layout)
    return known  # type: ignore[no-any-return]


def _issued(assignment: Assignment, layout: Layout) -> dict[str, tuple[Formula, ...]]:
    made: dict[str, tuple[Formula, ...]] = {}
    live = assignment.live_nodes
    for block in assignment.blocks:
        table = block if isinstance(block, TableSpec) else None
        for node, cells in fill_cells(block, layout).items():
            expr = assignment.graph.expression(node)
            if node not in live or expr is None:
                continue
            text = compile_formula(expr, RowReferences(layout, table))
            made[node] = tuple(
                formula_at(
                    at_row(text, cell.row, last=cell.row == cells[-1].row).removeprefix("="),
                    cell.row,
                    cell.column,
                )
                for cell in cells
            )
    return made


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
