"""Whether a student's formulas follow what they refer to, cell by cell.

Every formula is tried alone: the cells that it refers to hold the right values of another
engine, whatever the student has in them.  So a column is judged by itself: an error before
it costs it nothing, and a number in the guise of a formula does not follow.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reports.grading.issuing.assignment import Item
from reports.grading.judging.judgement import Rule, close, decide, distance, tolerance
from reports.grading.judging.literal_tables import is_of_angles, listed, reads_a_list
from reports.grading.judging.perturbation import Perturbation
from reports.grading.judging.proven import EXACT, Proofs, Signatures, settled
from reports.grading.judging.trial_evaluation import Trial, Tryout, fixed, turned
from reports.grading.reading.student import StudentBook
from reports.recalculation.trial_sheet import cuts, rounded_to

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

# What is said of a cell.
RIGHT, ROUNDED, COARSE, PARTLY, STILL, WRONG, NOTHING, UNKNOWN, PASTED, IDLE = "prctsw-uli"
_FEW = 2  # wrong rows of a formula that is right in the others
_MAX_SHARE = 0.5  # share of a column from which it is a list, or none
_NEARLY = 0.1  # of a change: digits that are left out do not make a list of a formula
_INSIDE = 2e-3  # share of a column that roundings inside a formula may cost


@dataclass(frozen=True, slots=True)
class ResponseEvidence:
    """Evidence of the trials of a node's formulas, for each cell."""

    formula: Mask
    number: Mask  # a number on the right values of the first trial
    right: Mask  # its run is right for every trial that decides
    rounded: Mask  # its run is, but for roundings that a person may make
    few: Mask  # right in a run with one or two wrong rows
    coarse: Mask  # its run is right but for its roundings
    stands: Mask  # one value for all trials and all angles
    listed: Mask  # its run is a list of numbers that the angles do not explain
    others: Mask  # right where all input data change
    same: Mask  # right value alike for every engine
    idle: Mask  # one number whatever stands in the cells that it refers to
    reads: bool  # numbers typed in beside the tables are read
    made_up: bool  # these, or those of a list, are not explained by the angles
    own_rows: bool = False  # wrong between the angles of the rows

    @property
    def follows(self) -> Mask:
        """Mask of formulas that follow their precedents."""
        return self.right | self.rounded | self.few

    @property
    def unsure(self) -> Mask:
        """Where it does not, or only while the same input data change as for the class."""
        return ~(self.follows & self.others)

    @property
    def numbers(self) -> Mask:
        """Where a formula may be numbers: what all variants have in common is none otherwise.

        Such a number is one only where nothing follows from anything.
        """
        return ~self.follows | ~(self.others | self.same)


RESPONSE_RULES = (
    Rule[ResponseEvidence]("no formula", NOTHING, lambda e: ~e.formula),
    Rule[ResponseEvidence]("no number", WRONG, lambda e: ~e.follows & ~e.number),
    Rule[ResponseEvidence]("stands still", STILL, lambda e: e.stands & e.numbers),
    Rule[ResponseEvidence]("list of numbers", STILL, lambda e: e.listed & e.numbers),
    Rule[ResponseEvidence]("right at its own rows", PASTED,
                           lambda e: (e.unsure | (e.follows & e.made_up)) & e.own_rows),
    Rule[ResponseEvidence]("reads a list", PASTED, lambda e: e.unsure & e.reads),
    Rule[ResponseEvidence]("idle", IDLE, lambda e: e.follows & e.idle),
    Rule[ResponseEvidence]("right", RIGHT, lambda e: e.right),
    Rule[ResponseEvidence]("rounded", ROUNDED, lambda e: e.rounded),
    Rule[ResponseEvidence]("one or two rows wrong", RIGHT, lambda e: e.few),
    Rule[ResponseEvidence]("coarse", COARSE, lambda e: e.coarse),
    Rule[ResponseEvidence]("partly", PARTLY, lambda e: e.formula | True),
)  # fmt: skip


@dataclass
class FormulaResponse:
    """Response of one student's formulas to the trials."""

    student: StudentBook
    proofs: Proofs

    @property
    def trials(self) -> tuple[Trial, ...]:
        """The sets of inputs."""
        return self.proofs.trials

    @cached_property
    def tryout(self) -> Tryout:
        """The work with other numbers in its cells."""
        return Tryout(self.student, self.trials)

    @cached_property
    def _nodes(self) -> list[str]:
        """Nodes with formulas."""
        return [n for n in sorted(self.student.assignment.fill_nodes) if self.student.runs(n)]

    @cached_property
    def _keys(self) -> dict[str, tuple[object, ...]]:
        """Keys of nodes whose response may be proven by another book."""
        signatures = Signatures(self.student)
        return {
            node: (*key, *self._not_tried(node))
            for node in self._nodes
            if (key := signatures.of(node)) is not None
        }

    def _not_tried(self, node: str) -> Iterator[tuple[str, object]]:
        """Yield input data that a node refers to and that the trials leave as its student has them.

        Among them is the number of the variant.
        """
        fields = self.student.assignment.model.fields
        for name in sorted(self.student.refers(node) & fields.keys()):
            if not all(name in trial.inputs for trial in self.trials):
                yield name, fields[name].value

    @cached_property
    def _tried(self) -> list[str]:
        return [node for node in self._nodes if self._keys.get(node) not in self.proofs.known]

    @cached_property
    def _values(self) -> dict[str, list[Array] | str]:
        """Values of the tried nodes for every trial, or why they are unknown.

        What others may rely on is tried apart from what only this student has.
        """
        shared = [node for node in self._tried if node in self._keys]
        unkeyed = [node for node in self._tried if node not in self._keys]
        return self.tryout.run(shared, self.trials) | self.tryout.run(unkeyed, self.trials)

    @cached_property
    def _unrounded(self) -> dict[str, list[Array] | str]:
        rounded = [node for node in self._tried if self.tryout.rounds(node)]
        return self.tryout.run(rounded, self.trials, rounded=False)

    # --- what it says -----------------------------------------------------------------

    def letters(self, item: Item) -> str:
        """Return letter for each value of an item: how its formula responds, whatever its value."""
        return "".join(self._of_node(replace(item, nodes=(n,)), n) for n in item.nodes)

    def fixed(self, item: Item) -> NDArray[np.bool_]:
        """Mask of right values alike for every engine: 0 at dead centre."""
        return np.concatenate([self._fixed(node) for node in item.nodes])

    def _fixed(self, node: str, *, alike: bool = False) -> NDArray[np.bool_]:
        """Return the same of a node, or where it is the same for the class alone."""
        trials = [trial for trial in self.trials if trial.decides or not alike]
        return fixed(node, self.student.expected, trials)

    @cached_property
    def _idle(self) -> dict[str, NDArray[np.bool_]]:
        """Masks of idle formulas, by tried nodes alike for all variants."""
        nodes = [n for n, values in self._values.items() if not isinstance(values, str)]
        nodes = [node for node in nodes if self._fixed(node, alike=True).all()]
        return self.shaking.idle(nodes) if nodes else {}

    def holds_somewhere(self, item: Item, node: str) -> bool:
        """Whether a node's formulas are right for an engine that has other values there."""
        values = self.tried(node)
        if isinstance(values, str):
            return False
        expected = np.ravel(np.asarray(self.student.expected.value(node), dtype=float))
        item = replace(item, nodes=(node,))
        return any(
            not np.allclose(right, expected, rtol=1e-9, atol=0, equal_nan=True)
            and bool(self._close(item, trial_values, right, trial).all())
            for trial_values, right, trial in zip(
                values, _right(node, self.trials), self.trials, strict=True
            )
        )

    @cached_property
    def shaking(self) -> Perturbation:
        """The work on nobody's variant: what tells its own from others is not seen."""
        pins = self.tryout.pins(self.trials[-1], rounded=False)  # small changes show
        return Perturbation(self.student, self.trials[-1], pins)

    def _close(self, item: Item, values: Array, right: Array, trial: Trial) -> NDArray[np.bool_]:
        allowed = tolerance(item, right, self.student)
        return close(item, values, right, allowed, trial.expected)

    def tried(self, node: str) -> list[Array] | str:
        """Values of a node's formulas for every trial, or why they are unknown."""
        values = self._values.get(node)
        return self.tryout.run([node], self.trials)[node] if values is None else values

    def problem(self, node: str) -> str:
        """Why a node's formulas cannot be tried, empty where they can."""
        values = self._values.get(node, "")
        return values if isinstance(values, str) else ""

    def _turned(self, item: Item, node: str) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        """Where formulas are right at the angles of their rows alone, and where they follow these.

        The first are lists of numbers, whatever they are made of; the second calculate.
        """
        trials = (self.tryout.own, self._between_rows)
        if node not in self._turned_values:
            calculated = (n for n in self._tried if not isinstance(self._values[n], str))
            nodes = dict.fromkeys((node, *calculated))
            self._turned_values.update(self.tryout.run(list(nodes), trials, rounded=False))
        turned_values = self._turned_values[node]
        if isinstance(turned_values, str):
            nowhere = np.zeros(self.student.assignment.length(node), dtype=bool)
            return ~nowhere, nowhere
        right = _right(node, trials)
        here, between = map(self._close, (item, item), turned_values, right, trials)
        allowed = tolerance(item, right[1], self.student)
        change, expected = turned_values[1] - turned_values[0], right[1] - right[0]
        is_close = np.abs(change - expected) <= allowed + _NEARLY * np.abs(expected)
        return here & ~between, is_close & _differ(*turned_values)

    @cached_property
    def _turned_values(self) -> dict[str, list[Array] | str]:
        """Values at the angles of the rows and between them, of all nodes once one is asked for."""
        return {}

    @cached_property
    def _between_rows(self) -> Trial:
        return turned(self.student.expected)

    def _of_node(self, item: Item, node: str) -> str:
        count = self.student.assignment.length(node)
        if node not in self._nodes:
            return NOTHING * count
        if node not in self._tried:
            return RIGHT * count
        letters = self._judged(item, node, count)
        key = self._keys.get(node)
        if key is not None and set(letters) == {RIGHT}:
            self._exact[node] = self._is_exact(node)
            if self._is_proven(item, node):
                self.proofs.known[key] = self._exact[node]
        return letters

    @cached_property
    def _exact(self) -> dict[str, bool]:
        """Whether right formulas follow to the last digit, of those that are tried."""
        return {}

    @cached_property
    def settled(self) -> frozenset[str]:
        """Nodes that need not be calculated anew."""
        for item in self.student.assignment.items:
            if not self._keys.keys().isdisjoint(item.nodes) and item.quantity.digits.kind != "text":
                with suppress(Exception):  # said where the item is judged
                    self.letters(item)  # nobody before must have shown that they are right
        proven = {node: self.proofs.known.get(key, False) for node, key in self._keys.items()}
        return settled(self.student, proven | self._exact)

    def _is_proven(self, item: Item, node: str) -> bool:
        """Whether a node's formulas are right for every trial, whoever writes them.

        Where the trials are alike it takes that the formulas react to something.
        """
        values = self._values[node]
        if isinstance(values, str) or not values:
            return False
        first, *others = self.trials
        decide = [trial for trial in others if trial.decides]
        varies = not fixed(node, first.expected, decide).all()
        reacts = node in self._idle and not self._idle[node].any()
        good = self._good(item, values, _right(node, self.trials))
        listless = not listed(self.student.runs(node)) and not reads_a_list(self.student, node)
        return (varies or reacts) and listless and bool(good[0].all() and good[1].all())

    def _is_exact(self, node: str) -> bool:
        """Whether a node's formulas have given the very values of every trial."""
        values = self._values[node]
        if isinstance(values, str):
            return False
        return all(
            bool((np.abs(values_of - right) <= EXACT * np.abs(right).max()).all())
            for values_of, right in zip(values, _right(node, self.trials), strict=True)
        )

    def _judged(self, item: Item, node: str, count: int) -> str:
        if isinstance(self._values[node], str):
            return UNKNOWN * count
        return "".join(decide(RESPONSE_RULES, self._evidence(item, node, count), count))

    def _evidence(self, item: Item, node: str, count: int) -> ResponseEvidence:
        values, right = self._values[node], _right(node, self.trials)
        assert not isinstance(values, str)
        good, others = self._good(item, values, right)
        roughly = self._rounded_good(item, node, values, right)
        exact, fine = (good & False,) * 2 if roughly is None else roughly[:2]
        others = others if roughly is None else others | roughly[2]
        same = self._fixed(node)
        idle = self._idle.get(node, same & False)
        stands = ~np.any([_differ(values[0], other) for other in values], axis=0)
        # What is alike for the class may be typed in, beside something that is referred to.
        stands &= ~(same | (self._fixed(node, alike=True) & ~idle))
        turn = self._turned(item, node) if stands.any() else None
        lists = listed(self.student.runs(node))
        reads = reads_a_list(self.student, node)
        made_up = bool(lists or reads) and not is_of_angles(self.student, node)
        names = ("formula", "right", "rounded", "few", "coarse", "moves", "listed")
        marks: dict[str, Any] = {name: np.zeros(count, dtype=bool) for name in names}
        for at, listed_run in self._runs_at(node, lists):
            whole = bool(good[at].all())
            rounded = not whole and bool(fine[at].all())
            # One or two wrong rows cost their share; what is nought by itself proves nothing.
            few = (~good)[at].sum() <= _FEW and (good & ~same)[at].mean() >= _MAX_SHARE
            marks["formula"][at] = True
            marks["right"][at], marks["rounded"][at] = whole, rounded
            marks["few"][at] = few & good[at]
            marks["coarse"][at] = exact[at].all()
            marks["moves"][at] = turn is not None and turn[1][at].mean() >= _MAX_SHARE
            marks["listed"][at] = listed_run and made_up
        stands &= ~marks.pop("moves")
        # A friend's numbers fit exactly, too; what refers to nothing is numbers anyway.
        made_up = made_up and bool(self.student.refers(node))
        evidence = ResponseEvidence(**marks, stands=stands, others=others, same=same,
                                    number=np.isfinite(values[0]), idle=idle & same, reads=reads,
                                    made_up=made_up)  # fmt: skip
        if (evidence.formula & (evidence.unsure | (evidence.follows & made_up))).any():
            turn = turn or self._turned(item, node)
            return replace(evidence, own_rows=bool(turn[0].mean() >= _MAX_SHARE))
        return evidence

    def _runs_at(self, node: str, lists: set[int]) -> Iterator[tuple[list[int], bool]]:
        """Return indices of the cells of each run, and whether it is one of a list."""
        rows = self.student.placement.places[node].rows
        index = {row: i for i, row in enumerate(rows) if row is not None}
        for run in self.student.runs(node):
            at = [index[row] for row in range(run.first, run.last + 1) if row in index]
            if at:
                yield at, id(run) in lists

    def _good(
        self, item: Item, values: Sequence[Array], right: Sequence[Array]
    ) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        """Masks of agreement with the trials that decide, and with the others."""
        decided = np.ones(len(right[0]), dtype=bool)
        others = decided.copy()
        for trial, actual, expected in zip(self.trials, values, right, strict=True):
            agrees = self._close(item, actual, expected, trial) | (
                np.isnan(actual) & np.isnan(expected)
            )
            if trial.decides:
                decided &= agrees
            else:
                others &= agrees
        return decided, others

    def _rounded_good(
        self, item: Item, node: str, values: Sequence[Array], right: Sequence[Array]
    ) -> tuple[NDArray[np.bool_], NDArray[np.bool_], NDArray[np.bool_]] | None:
        """Where it is right without its roundings, where they are fine, where the others agree."""
        plain = self._unrounded.get(node)
        if not plain or isinstance(plain, str):
            return None
        exact, others = self._good(item, plain, right)
        fine = exact.copy()
        half = self.student.assignment.rubric.tolerance.units * 10.0**-item.quantity.digits.decimals
        coarse = rounds_coarsely(self.student, item, node)
        inside = any(map(cuts, self.tryout.formulas(node)))
        for trial, actual, expected in zip(self.trials, values, right, strict=True):
            if trial.decides and inside:  # digits of π cost what they cost
                largest = float(np.nanmax(np.abs(expected))) if expected.size else 0.0
                allowed = half if coarse else max(half, _INSIDE * largest)
                fine &= close(item, actual, expected, allowed * (1 + 1e-9), trial.expected)
        return exact, fine, others

    @cached_property
    def tampered(self) -> list[str]:
        """Given formulas that were changed and do not calculate what they should."""
        student = self.student
        nodes = [node for node in sorted(student.rewritten) if student.runs(node)]
        if not nodes or not self.trials:
            return []
        values = self.tryout.run(nodes, self.trials)
        return [node for node in nodes if not self._calculates(node, values[node])]

    def _calculates(self, node: str, values: list[Array] | str) -> bool:
        if isinstance(values, str):
            return False
        for trial, actual in zip(self.trials, values, strict=False):
            right = trial.expected.value(node)
            if isinstance(right, str):
                continue
            expected = np.ravel(np.asarray(right, dtype=float))
            scale = float(np.nanmax(np.abs(expected))) if expected.size else 1.0
            is_close = distance([node], actual, expected, trial.expected) <= 1e-6 * max(
                scale, 1e-12
            )
            if not (is_close | (np.isnan(actual) & np.isnan(expected))).all():
                return False
        return True


def rounds_coarsely(student: StudentBook, item: Item, node: str) -> bool:
    """Whether a column is rounded more than the book prints."""
    digits = [rounded_to(run.formula) for run in student.runs(node) if run.formula is not None]
    return any(d is not None and d < item.quantity.digits.decimals for d in digits)


def _right(node: str, trials: Sequence[Trial]) -> list[Array]:
    return [np.ravel(np.asarray(t.expected.value(node), dtype=float)) for t in trials]


def _differ(first: Array, second: Array) -> NDArray[np.bool_]:
    """Mask of numbers that differ between two columns."""
    size = np.maximum(np.abs(first), np.abs(second))
    other = np.abs(first - second) > 1e-9 * size + 1e-12
    return np.asarray(other | (np.isnan(first) != np.isnan(second)))
