"""A student's formulas run on the right numbers of other engines, each column by itself."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from reports.grading.issuing.assignment import Item
from reports.grading.judging.copied import known_numbers, stepping
from reports.grading.judging.lists import angles_of, of_angles
from reports.grading.judging.trials import Trial
from reports.grading.reading.student import Student
from reports.recalculation.bench import Bench, Cells, full, pinned, rounds, unrounded_grid
from reports.recalculation.formulas import Formula
from reports.recalculation.language import UnknownFormula

Array = NDArray[np.float64]
_FOUR = 0.5e-4  # what a table of sines with four digits leaves out


@dataclass(frozen=True)
class Tryout:
    """The cells of a work with other numbers in them."""

    student: Student
    trials: tuple[Trial, ...]

    def run(
        self, nodes: Sequence[str], trials: Sequence[Trial], *, rounded: bool = True
    ) -> dict[str, list[Array] | str]:
        """Values of nodes for every trial, or why they are unknown."""
        if not nodes or not trials:
            return {node: [] for node in nodes}
        student = self.student
        first = pinned(student.grid, self.cells(trials[0], everything=True))
        if not rounded:
            first = unrounded_grid(pinned(first, self._full_constants))
        bench = Bench(first, {node: student.runs(node) for node in nodes}, rounded=rounded)
        found: dict[str, list[Array] | str] = {node: [] for node in nodes}
        for trial in trials:
            if trial is not trials[0]:
                bench.put(self.cells(trial, everything=False))
            for node in nodes:
                values = found[node]
                if isinstance(values, str):
                    continue
                try:
                    place = student.placement.places[node]
                    values.append(bench.values(node, place.rows))
                except UnknownFormula as error:
                    found[node] = str(error) or "?"
        return found

    def cells(self, trial: Trial, *, everything: bool) -> list[Cells]:
        """The cells of inputs and nodes with the right values of a trial."""
        made = self._inputs(trial)
        student, assignment = self.student, self.student.assignment
        for node in sorted(assignment.fill_nodes | assignment.live_nodes | assignment.given_nodes):
            right = trial.expected.value(node)
            if isinstance(right, str) and not everything:
                continue
            made += student.cells_of(node, right)
        return made

    @property
    def own(self) -> Trial:
        """The student's engine."""
        return Trial({}, self.student.expected, decides=True)

    def alone(self, item: Item) -> Array | None:
        """What the formulas of an item give where all that they refer to is right.

        So a mistake is told apart from those that were made before it.
        """
        if not all(self.student.runs(node) for node in item.nodes):
            return None
        made = self.run(item.nodes, (self.own,))
        parts = [values[0] for values in made.values() if not isinstance(values, str)]
        return np.concatenate(parts) if len(parts) == len(item.nodes) else None

    def whole(self) -> Iterator[list[Cells]]:
        """What the book was issued with, of each trial: all else it calculates itself."""
        student = self.student
        for trial in self.trials:
            made = self._inputs(trial)
            for node in sorted(student.assignment.given_nodes):
                made += student.cells_of(node, trial.expected.value(node))
            yield made

    def _inputs(self, trial: Trial) -> list[Cells]:
        """The cells of the input data, and the student's own that repeat them."""
        made = [c for name, turned in trial.angles.items() for c in self._angles(name, turned)]
        for name, value in trial.inputs.items():
            made += self.student.cells_of(name, value)
            made += [
                Cells(sheet, column, (row,), (value * factor,))
                for sheet, column, row, factor in self._copies.get(name, ())
            ]
        return made

    def _angles(self, name: str, turned: Array) -> list[Cells]:
        """The cells of a table's angles, and the student's own beside them that repeat them."""
        made = self.student.cells_of(name, turned)
        own = self.student.cells_of(name, self.student.expected.value(name))
        known = {
            (cells.sheet, row, value): other.values[i]
            for cells, other in zip(own, made, strict=True)
            for i, (row, value) in enumerate(zip(cells.rows, cells.values, strict=True))
        }
        return made + [
            Cells(sheet, column, (row,), (known[sheet, row, value],))
            for sheet, column, row, value in self.student.own_constants
            if (sheet, row, value) in known
        ]

    @cached_property
    def _copies(self) -> dict[str, list[tuple[str, int, int, float]]]:
        """Cells of the student's own that repeat an input, in its unit or in another.

        Who copies the input data to a sheet of his own and calculates from there has not
        typed in a result.
        """
        wanted = known_numbers(self.student.assignment.model.fields, self.trials)
        found: dict[str, list[tuple[str, int, int, float]]] = {}
        steps = stepping({(s, c, r): value for s, c, r, value in self.student.own_constants})
        for sheet, number, row, value in self.student.own_constants:
            if (sheet, number, row) in steps:
                continue
            hit = wanted.get(float(f"{value:.12g}"))
            if hit is not None:
                found.setdefault(hit[0], []).append((sheet, number, row, hit[1]))
        return found

    def rounds(self, node: str) -> bool:
        """Whether something of a node's formulas is rounded: a result, π, or a sine."""
        own = self.student.own_numbers(node) if self._full_constants else ()
        return any(map(rounds, self.formulas(node))) or any(
            self._full(value) != value for value in own
        )

    def formulas(self, node: str) -> list[Formula]:
        """Formulas of a node and of the student's own cells that they refer to."""
        runs = (*self.student.runs(node), *self.student.helpers(node))
        return [run.formula for run in runs if run.formula is not None]

    @cached_property
    def _full_constants(self) -> list[Cells]:
        """Cells of the student's own with some digits of π or of a sine, with all of them."""
        copies = {cell[:3] for cells in self._copies.values() for cell in cells}
        return [
            Cells(sheet, column, (row,), (self._full(value),))
            for sheet, column, row, value in self.student.own_constants
            if self._full(value) != value and (sheet, column, row) not in copies
        ]

    def _full(self, value: float) -> float:
        """A number with all digits of what it has the first ones of."""
        exact = of_angles(value, self._all_angles)
        near = exact is not None and abs(exact - value) <= _FOUR
        return exact if near and exact is not None else full(value)

    @cached_property
    def _all_angles(self) -> tuple[float, ...]:
        student = self.student
        nodes = (f"{name}." for name in student.assignment.model.tables)
        return tuple(sorted({angle for node in nodes for angle in angles_of(student, node)}))
