"""Trials: other input data, and the student's formulas evaluated on them.

A formula must give the right column for other engines too.  Two sets change what differs
between the students: values of other variants, and values between them, drawn with a secret
seed when the works are graded.  The third changes every number of the input: it shows
a constant where the students' variants do not, but does not decide, for what is the same
for the whole class may be typed in.  The student's own engine between the angles of the tables
tells what calculates from what only repeats.
"""

from __future__ import annotations

import random
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from math import isclose, nan

import numpy as np
from numpy.typing import NDArray

from reports.grading.issuing.assignment import Assignment, Item
from reports.grading.issuing.register import Issued
from reports.grading.judging.judgement import distance, fault
from reports.grading.judging.literal_tables import angles_of, of_angles
from reports.grading.reading.student import StudentBook
from reports.inputs.fields import Field, cell_name
from reports.inputs.ranges import ParameterRange
from reports.inputs.units import MM, MPA
from reports.model.evaluation import Evaluation
from reports.recalculation.formulas import Formula
from reports.recalculation.trial_sheet import Bench, Cells, PinnedGrid, by_column, full, rounds
from reports.shared.errors import UnknownFormula

_TRIES = 12
_LEAST, _MOST = 0.02, 0.08  # how much the third set changes a number
_GOLDEN = 0.618034  # of three in a row no two come nearer than a quarter
_EDGE, _APART = 0.02, 0.25  # of the range: from its ends, between the first two sets
_TURN = 1.7  # ° or %, which no table has as its step
_NOUGHT = 1e-6  # of the last digit that is printed: what is left of A − A
_NARROW = 0.05  # where all variants have the same value
_METRES = 1e-3
# In what else a student may write the input data down: cm, g, kPa, bar, Pa, thousands of turns and
# turns a second, W.
_OTHER_UNITS = {
    "мм": (_METRES, 0.1),
    "кг": (1e3,),
    MPA.label: (1e3, 10.0, MPA.times),
    "мин⁻¹": (1e-3, 1 / 60),
    "кВт": (1e3,),
}
Array = NDArray[np.float64]
_FOUR = 0.5e-4  # what a table of sines with four digits leaves out


@dataclass(frozen=True)
class Trial:
    """One set of input values; ``decides`` where a formula must be right for it."""

    inputs: Mapping[str, float]
    expected: Evaluation
    decides: bool
    angles: Mapping[str, NDArray[np.float64]] = field(default_factory=dict)  # of tables


def trials_of(assignment: Assignment, books: Sequence[Issued], seed: str) -> tuple[Trial, ...]:
    """Return the sets for a class, the same for the same seed."""
    rng = random.Random(seed)
    values = _varied(assignment, books)
    trials = [_first(assignment, _others(values, rng), decides=True)]
    first = trials[0].inputs if trials[0] is not None else {}
    trials.append(_first(assignment, _between(values, first, rng), decides=True))
    start = trials[-1].inputs if trials[-1] is not None else {}
    trials.append(_first(assignment, _everything(assignment, start, rng), decides=False))
    return tuple(trial for trial in trials if trial is not None)


def turned(evaluation: Evaluation) -> Trial:
    """Return engine itself at angles between those of its tables: a list has no number there."""
    angles = {
        f"{table.id}.{table.columns[0].key}": np.array(table.rows) + _TURN
        for table in evaluation.model.tables.values()
        if table.columns[0].quantity.unit and not table.row_by_row
    }
    return Trial({}, evaluation.fork(angles), decides=False, angles=angles)


def fixed(node: str, evaluation: Evaluation, trials: Sequence[Trial]) -> NDArray[np.bool_]:
    """Mask of right values alike for every engine: 0 at dead centre."""
    right, *others = [
        np.ravel(run.value(node)) for run in (evaluation, *(trial.expected for trial in trials))
    ]
    if not others or right.dtype.kind == "U":
        return np.zeros(len(right), dtype=bool)
    digit = 10.0 ** -evaluation.model.nodes[node].quantity.digits.decimals
    allowed = max(1e-9 * float(np.nanmax(np.abs(right))), _NOUGHT * digit)
    is_close = [distance([node], other, right, evaluation) <= allowed for other in others]
    return np.asarray(np.logical_and.reduce(is_close))


def _first(
    assignment: Assignment, draws: Iterator[dict[str, float]], *, decides: bool
) -> Trial | None:
    """Return the first draw for which the engine can be calculated."""
    evaluation = Evaluation(assignment.model)
    nodes = [node for item in assignment.items for node in item.nodes]
    for _, inputs in zip(range(_TRIES), draws, strict=False):
        run = evaluation.fork(inputs)
        try:
            if all(_as_finite(run.value(node), evaluation.value(node)) for node in nodes):
                return Trial(inputs, run, decides)
        except (ArithmeticError, ValueError, IndexError):
            continue
    return None


def _as_finite(value: object, reference: object) -> bool:
    if isinstance(value, str) or isinstance(reference, str):
        return True
    return bool((np.isfinite(value) | ~np.isfinite(reference)).all())  # type: ignore[call-overload]


def _varied(assignment: Assignment, books: Sequence[Issued]) -> dict[str, list[float]]:
    """Values of the numbers that differ between the students, by the name of their cell."""
    drawn: dict[str, list[float]] = {}
    fields = assignment.model.fields
    for book in books:
        for key, value in book.drawn.items():
            name = cell_name(ParameterRange.path_of(key))
            if name in fields and _may_change(fields[name]) and isinstance(value, (int, float)):
                drawn.setdefault(name, []).append(float(value))
    return drawn


def _may_change(field: Field) -> bool:
    """Numbers that do not decide the shape of the tables, nor by how much they are shifted."""
    number = isinstance(field.value, (int, float)) and not isinstance(field.value, bool)
    shifts = field.path[0] == "crankshaft" and field.name.endswith("_deg")
    point = "_point_" in field.name
    return number and not field.structural and not shifts and not point


def _others(values: Mapping[str, list[float]], rng: random.Random) -> Iterator[dict[str, float]]:
    """Values of other variants, each key of a variant of its own."""
    while True:
        yield {name: rng.choice(choices) for name, choices in values.items()}


def _between(
    values: Mapping[str, list[float]], first: Mapping[str, float], rng: random.Random
) -> Iterator[dict[str, float]]:
    """Values in the range of all variants, far from those of the first set.

    What a student has typed in may be near one of the two, but not near both.
    """
    while True:
        inputs = {}
        for name, choices in values.items():
            low, high = min(choices), max(choices)
            if high - low < 1e-9 * max(1.0, abs(high)):
                low, high = low * (1 - _NARROW), high * (1 + _NARROW)
            fraction = (first.get(name, low) - low) / (high - low)
            below, above = (
                max(0.0, fraction - _APART - _EDGE),
                max(0.0, 1 - _EDGE - fraction - _APART),
            )
            share = rng.uniform(0, below + above)
            share += _EDGE if share < below else fraction + _APART - below
            inputs[name] = low + (high - low) * share
        yield inputs


def _everything(
    assignment: Assignment, start: Mapping[str, float], rng: random.Random
) -> Iterator[dict[str, float]]:
    """All numbers changed a little; equal ones stay equal, for a student may use either.

    Those that stand together differ in by how much: no ratio of theirs stays as it was.
    """
    fields = [
        field
        for field in assignment.model.inputs
        if _may_change(field) and not field.name.endswith("_deg") and field.path[0] != "report"
    ]
    most = _MOST
    while True:
        factors: dict[tuple[str, float], float] = {}
        up = rng.choice((-1, 1))  # all the same way, so that no sum stays as it was
        share = rng.random()
        inputs = dict(start)
        for given in fields:
            value = float(given.value)
            key = (given.unit, value)
            if given.name in start or not value:
                continue
            if key not in factors:
                share = (share + _GOLDEN) % 1
                factors[key] = 1 + up * most * (1 + 3 * share) / 4
            inputs[given.name] = value * factors[key]
        yield inputs
        most = max(most / 2, _LEAST / 2)


# --- copied inputs -------------------------------------------------------------------------------


def known_numbers(
    fields: Mapping[str, Field], trials: Sequence[Trial]
) -> dict[float, tuple[str, float]]:
    """Return number → the input that it is, and how many of its units one of the book's has."""
    numbers: dict[float, tuple[str, float]] = {}
    drawn = trials[0].inputs if trials else {}
    names = sorted({name for trial in trials for name in trial.inputs})
    for in_units in (False, True):  # a number is rather an input in the unit of the book
        for name in sorted(names, key=lambda name: name in drawn):  # and one of the variant
            value, unit = float(fields[name].value), fields[name].unit
            for factor in (1.0,) if in_units else _OTHER_UNITS.get(unit, ()):
                number = float(f"{value * factor:.12g}")
                sure = (unit, factor) == (MM.label, _METRES) or (
                    in_units and (bool(unit) or name in drawn)
                )
                if sure or number != float(f"{number:.1g}"):
                    numbers[number] = (name, factor)  # 1 or 100 may be anything
    return numbers


def stepping(cells: Mapping[tuple[str, int, int], float]) -> set[tuple[str, int, int]]:
    """Cells of numbers that go down by equal steps: one of many angles is no bore of 90 mm."""
    steps = set()
    for sheet, column, row in cells:
        three = [(sheet, column, row + i) for i in range(3)]
        first, second, third = (cells.get(cell, nan) for cell in three)
        if first != second and isclose(third - second, second - first, rel_tol=1e-9):
            steps.update(three)
    return steps


# --- evaluation ----------------------------------------------------------------------------------


@dataclass(frozen=True)
class Tryout:
    """The cells of a work with other numbers in them."""

    student: StudentBook
    trials: tuple[Trial, ...]
    # By the identities of trials, which live as long as the work is graded.
    _pins: dict[tuple[int, bool], PinnedGrid] = field(default_factory=dict)
    _by_column: dict[tuple[int, str, int], tuple[list[Cells], list[Cells]]] = field(
        default_factory=dict
    )
    _inputs_of: dict[int, dict[tuple[str, int], list[Cells]]] = field(default_factory=dict)

    def run(
        self, nodes: Sequence[str], trials: Sequence[Trial], *, rounded: bool = True
    ) -> dict[str, list[Array] | str]:
        """Values of nodes for every trial, or why they are unknown."""
        if not nodes or not trials:
            return {node: [] for node in nodes}
        try:
            return self._run(nodes, trials, rounded=rounded)
        except Exception as error:
            if len(nodes) == 1:
                return {nodes[0]: fault(error)}
        # An error of the program's in one formula costs that formula alone.
        alone = (self.run([node], trials, rounded=rounded) for node in nodes)
        return {node: values for results in alone for node, values in results.items()}

    def _run(
        self, nodes: Sequence[str], trials: Sequence[Trial], *, rounded: bool
    ) -> dict[str, list[Array] | str]:
        student = self.student
        pins = self.pins(trials[0], rounded=rounded)
        bench = Bench(pins, {node: student.runs(node) for node in nodes}, rounded=rounded)
        results: dict[str, list[Array] | str] = {node: [] for node in nodes}
        for trial in trials:
            if trial is not trials[0]:
                bench.put(self._numbers(trial, bench.columns))
            for node in nodes:
                values = results[node]
                if isinstance(values, str):
                    continue
                try:
                    location = student.placement.places[node]
                    values.append(bench.values(node, location.rows))
                except UnknownFormula as error:
                    results[node] = str(error) or "?"
        return results

    def pins(self, trial: Trial, *, rounded: bool) -> PinnedGrid:
        """Return the work with the right values of a trial in the cells of inputs and nodes."""
        key = (id(trial), rounded)
        if key not in self._pins:
            constants = {} if rounded else self._full_constants

            def cells(sheet: str, column: int) -> list[Cells]:
                numbers, texts = self._cells(trial, sheet, column)
                return [*numbers, *texts, *constants.get((sheet, column), ())]

            self._pins[key] = PinnedGrid(self.student.grid, cells, rounded)
        return self._pins[key]

    def _numbers(self, trial: Trial, columns: Iterable[tuple[str, int]]) -> Iterator[Cells]:
        """Return the cells of some columns with the numbers of a trial."""
        return (part for column in columns for part in self._cells(trial, *column)[0])

    def _cells(self, trial: Trial, sheet: str, column: int) -> tuple[list[Cells], list[Cells]]:
        """Cells of a column with numbers and with texts of a trial."""
        key = (id(trial), sheet, column)
        if key not in self._by_column:
            inputs = self._inputs_by_column(trial).get((sheet, column), ())
            numbers, texts = list(inputs), list[Cells]()
            for node in self._nodes_by_column.get((sheet, column), ()):
                right = trial.expected.value(node)
                (texts if isinstance(right, str) else numbers).extend(
                    self.student.cells_of(node, right)
                )
            self._by_column[key] = numbers, texts
        return self._by_column[key]

    def _inputs_by_column(self, trial: Trial) -> dict[tuple[str, int], list[Cells]]:
        if id(trial) not in self._inputs_of:
            self._inputs_of[id(trial)] = by_column(self._inputs(trial))
        return self._inputs_of[id(trial)]

    @cached_property
    def _nodes_by_column(self) -> dict[tuple[str, int], list[str]]:
        columns: dict[tuple[str, int], list[str]] = {}
        assignment = self.student.assignment
        for node in sorted(assignment.fill_nodes | assignment.live_nodes | assignment.given_nodes):
            location = self.student.placement.places.get(node)
            if location is not None:
                columns.setdefault((location.sheet, location.column), []).append(node)
        return columns

    @cached_property
    def own(self) -> Trial:
        """The student's engine."""
        return Trial({}, self.student.expected, decides=True)

    def alone(self, item: Item) -> Array | None:
        """Tell what the formulas of an item give where all that they refer to is right.

        So a mistake is told apart from those that were made before it.
        """
        if not all(self.student.runs(node) for node in item.nodes):
            return None
        results = self.run(item.nodes, (self.own,))
        parts = [values[0] for values in results.values() if not isinstance(values, str)]
        return np.concatenate(parts) if len(parts) == len(item.nodes) else None

    def whole(self) -> Iterator[list[Cells]]:
        """Input data and given numbers of each trial; the book calculates the rest."""
        student = self.student
        for trial in self.trials:
            cells = self._inputs(trial)
            for node in sorted(student.assignment.given_nodes):
                cells += student.cells_of(node, trial.expected.value(node))
            yield cells

    def _inputs(self, trial: Trial) -> list[Cells]:
        """Return the cells of the input data, and the student's own that repeat them."""
        cells = [c for name, turned in trial.angles.items() for c in self._angles(name, turned)]
        for name, value in trial.inputs.items():
            cells += self.student.cells_of(name, value)
            cells += [
                Cells(sheet, column, (row,), (value * factor,))
                for sheet, column, row, factor in self._copies.get(name, ())
            ]
        return cells

    def _angles(self, name: str, turned: Array) -> list[Cells]:
        """Return cells of a table's angles, and the student's own beside them that repeat them."""
        turned_cells = self.student.cells_of(name, turned)
        entries = self.student.cells_of(name, self.student.expected.value(name))
        angles = {
            (cells.sheet, row, value): other.values[i]
            for cells, other in zip(entries, turned_cells, strict=True)
            for i, (row, value) in enumerate(zip(cells.rows, cells.values, strict=True))
        }
        return turned_cells + [
            Cells(sheet, column, (row,), (angles[sheet, row, value],))
            for sheet, column, row, value in self.student.own_constants
            if (sheet, row, value) in angles
        ]

    @cached_property
    def _copies(self) -> dict[str, list[tuple[str, int, int, float]]]:
        """Cells of the student's own that repeat an input, in its unit or in another.

        Who copies the input data to a sheet of his own and calculates from there has not
        typed in a result.
        """
        numbers = known_numbers(self.student.assignment.model.fields, self.trials)
        copies: dict[str, list[tuple[str, int, int, float]]] = {}
        steps = stepping({(s, c, r): value for s, c, r, value in self.student.own_constants})
        for sheet, number, row, value in self.student.own_constants:
            if (sheet, number, row) in steps:
                continue
            hit = numbers.get(float(f"{value:.12g}"))
            if hit is not None:
                copies.setdefault(hit[0], []).append((sheet, number, row, hit[1]))
        return copies

    def rounds(self, node: str) -> bool:
        """Whether something of a node's formulas is rounded: a result, π, or a sine."""
        constants = self.student.own_numbers(node) if self._full_constants else ()
        return any(map(rounds, self.formulas(node))) or any(
            self._full(value) != value for value in constants
        )

    def formulas(self, node: str) -> list[Formula]:
        """Formulas of a node and of the student's own cells that they refer to."""
        runs = (*self.student.runs(node), *self.student.helpers(node))
        return [run.formula for run in runs if run.formula is not None]

    @cached_property
    def _full_constants(self) -> dict[tuple[str, int], list[Cells]]:
        """Cells of the student's own with some digits of π or of a sine, with all of them."""
        copies = {cell[:3] for cells in self._copies.values() for cell in cells}
        return by_column(
            Cells(sheet, column, (row,), (self._full(value),))
            for sheet, column, row, value in self.student.own_constants
            if self._full(value) != value and (sheet, column, row) not in copies
        )

    def _full(self, value: float) -> float:
        """Return a number with all digits of what it has the first ones of."""
        exact = of_angles(value, self._all_angles)
        is_close = exact is not None and abs(exact - value) <= _FOUR
        return exact if is_close and exact is not None else full(value)

    @cached_property
    def _all_angles(self) -> tuple[float, ...]:
        student = self.student
        nodes = (f"{name}." for name in student.assignment.model.tables)
        return tuple(sorted({angle for node in nodes for angle in angles_of(student, node)}))
