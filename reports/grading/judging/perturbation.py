"""Perturbation of the cells that formulas refer to, each by itself, as no engine changes them."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from zlib import crc32

import numpy as np
from numpy.typing import NDArray

from reports.grading.issuing.assignment import Item
from reports.grading.judging.trial_evaluation import Trial
from reports.grading.reading.student import StudentBook
from reports.model.evaluation import Evaluation
from reports.recalculation.trial_sheet import Bench, PinnedGrid
from reports.shared.errors import UnknownFormula

Array = NDArray[np.float64]
_LEAST, _NOISE = 1e-6, 1e-9  # share of a number, and what is left of A − A
# By what the numbers are multiplied and what is added: noughts move too, roots and arcs have a
# value for some, and what is cut off at a limit is not for all.
FACTORS = ((0.07, 0.0), (1.5, 0.0), (0.8, 1.0), (-1.0, -1.0), (0.1, 0.1), (-0.3, 0.5))


@dataclass(frozen=True)
class Perturbation:
    """A work on the right numbers of an engine; ``pins`` has them in its cells, not rounded."""

    student: StudentBook
    trial: Trial
    pins: PinnedGrid

    def idle(self, nodes: Sequence[str]) -> dict[str, NDArray[np.bool_]]:
        """Mask of formulas that do not react to their precedents.

        A number in the guise of a formula, where no engine gives another one: ``=0+0*B8``.
        """
        shakes = self._shakes(frozenset().union(*map(self.student.precedents, nodes)))
        values = {node: tried for node, tried in self._tried(nodes, shakes).items() if tried}
        for node in [node for node, tried in values.items() if not _moved(tried).any()]:
            steady = self._steadied(self._shakes(self.student.precedents(node)))
            values[node] += self._tried([node], steady)[node] or []
        return {node: ~_moved(tried) for node, tried in values.items()}

    def is_idle_by_nature(self, item: Item) -> bool:
        """Whether the textbook's formulas are no better: which of one bearings is the worst."""
        names = frozenset().union(*map(self.student.assignment.graph.references, item.nodes))
        runs = [self.trial.expected, *map(self._run, self._shakes(names))]
        with np.errstate(all="ignore"):
            return not any(
                _moved([np.ravel(np.asarray(run.value(node), dtype=float)) for run in runs]).any()
                for node in item.nodes
            )

    def depending(self, nodes: Sequence[str], on: str) -> dict[str, bool]:
        """Whether the values of some nodes change with those of another, or may."""
        change = {name: value * 1.37 + 1.0 for name, value in self._values({on}).items()}
        return {
            node: values is None or not np.allclose(values[1], values[0], 1e-12, equal_nan=True)
            for node, values in self._tried(nodes, [change]).items()
        }

    def _shakes(self, names: Collection[str]) -> list[dict[str, Array]]:
        """Each cell otherwise than the one beside it, but the same whoever refers to it."""
        shakes: list[dict[str, Array]] = [{} for _ in FACTORS]
        for name, value in self._values(names).items():
            rng = np.random.default_rng(crc32(name.encode()))
            for shake, (times, more) in zip(shakes, FACTORS, strict=True):
                shake[name] = value * times * rng.uniform(
                    0.8, 1.2, value.size
                ) + more * rng.uniform(1, 2, value.size)
        return shakes

    def _steadied(self, shakes: Sequence[dict[str, Array]]) -> Iterator[dict[str, Array]]:
        """Return the same with the angles and orders of the tables, and what follows as it follows.

        A formula may look the greatest up among the others, or ask for the second order.
        """
        graph = self.student.assignment.graph
        for shake in shakes:
            stays = {name for name in shake if "." in name and graph.expression(name) is None}
            freed = shake.keys() - stays
            follows = {name for name in freed if not graph.ancestors(name).isdisjoint(freed)}
            run = self._run({name: shake[name] for name in freed - follows})
            yield shake | self._numbers(run, stays | follows)

    def _run(self, changes: Mapping[str, Array]) -> Evaluation:
        return self.trial.expected.fork({n: v if "." in n else v[0] for n, v in changes.items()})

    def _values(self, names: Collection[str]) -> dict[str, Array]:
        """Return the right numbers of nodes and inputs."""
        return self._numbers(self.trial.expected, names)

    @staticmethod
    def _numbers(run: Evaluation, names: Collection[str]) -> dict[str, Array]:
        with np.errstate(all="ignore"):
            values = {name: run.value(name) for name in sorted(names)}
        return {
            name: np.ravel(np.asarray(value, dtype=float))
            for name, value in values.items()
            if not isinstance(value, str)
        }

    def _tried(
        self, nodes: Sequence[str], changes: Iterable[Mapping[str, Array]]
    ) -> dict[str, list[Array] | None]:
        """Values of nodes before and after each change of others; None where they are unknown."""
        student = self.student
        bench = Bench(self.pins, {node: student.runs(node) for node in nodes}, rounded=False)
        results: dict[str, list[Array] | None] = {node: [] for node in nodes}
        for change in ({}, *changes):
            bench.put(part for name in change for part in student.cells_of(name, change[name]))
            for node in nodes:
                values = results[node]
                try:
                    if values is not None:
                        values.append(bench.values(node, student.placement.places[node].rows))
                except UnknownFormula:
                    results[node] = None
        return results


def _moved(values: Sequence[Array]) -> NDArray[np.bool_]:
    """Mask of values that differ from the first; errors do not."""
    first, others = values[0], np.array(values[1:])
    moved = np.isfinite(others) & ~np.isclose(others, first, _LEAST, _NOISE)
    return np.asarray(moved.any(axis=0))
