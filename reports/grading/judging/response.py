"""Whether a student's formulas follow what they refer to, cell by cell.

Every formula is tried alone: the cells that it refers to hold the right values of another
engine, whatever the student has in them.  So a column is judged by itself: an error before
it costs it nothing, and a number in the guise of a formula does not follow.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from reports.grading.issuing.assignment import Item
from reports.grading.judging.lists import is_of_angles, listed, reads_a_list
from reports.grading.judging.settled import EXACT, settled
from reports.grading.judging.shaking import Shaking
from reports.grading.judging.tolerances import apart, close, tolerance
from reports.grading.judging.trials import Trial, fixed, turned
from reports.grading.judging.tryout import Tryout
from reports.grading.reading.signatures import Signatures
from reports.grading.reading.student import Student
from reports.recalculation.bench import cuts, pinned, rounded_to, unrounded_grid

Array = NDArray[np.float64]

# What is said of a cell.
RIGHT, ROUNDED, COARSE, PARTLY, STILL, WRONG, NOTHING, UNKNOWN, PASTED, IDLE = "prctsw-uli"
_FEW = 2  # wrong rows of a formula that is right in the others
_MOST = 0.5  # share of a column from which it is a list, or none
_NEARLY = 0.1  # of a change: digits that are left out do not make a list of a formula
_INSIDE = 2e-3  # share of a column that roundings inside a formula may cost


@dataclass
class Proofs:
    """Formulas that are right for every trial, and refer to nothing but cells of the work-book.

    Many students write the same formulas: they are tried once for a class.  What else is said of
    a formula may rest on the engine of its student, and is said of nobody else's.
    """

    trials: tuple[Trial, ...]
    known: dict[tuple[object, ...], bool] = field(default_factory=dict)  # to the last digit or not


@dataclass
class Response:
    """How the formulas of one student respond."""

    student: Student
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
        """What the response of a node follows from, where it may be known of another book."""
        signatures = Signatures(self.student)
        return {
            node: (*key, *self._not_tried(node))
            for node in self._nodes
            if (key := signatures.of(node)) is not None
        }

    def _not_tried(self, node: str) -> Iterator[tuple[str, object]]:
        """The input data that a node refers to and that the trials leave as its student has them.

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
        own = [node for node in self._tried if node not in self._keys]
        return self.tryout.run(shared, self.trials) | self.tryout.run(own, self.trials)

    @cached_property
    def _unrounded(self) -> dict[str, list[Array] | str]:
        wanted = [node for node in self._tried if self.tryout.rounds(node)]
        return self.tryout.run(wanted, self.trials, rounded=False)

    # --- what it says -----------------------------------------------------------------

    def letters(self, item: Item) -> str:
        """A letter for each value of an item: how its formula responds, whatever its value."""
        return "".join(self._of_node(replace(item, nodes=(n,)), n) for n in item.nodes)

    def fixed(self, item: Item) -> NDArray[np.bool_]:
        """Where the right value is the same whatever the engine: 0 at dead centre."""
        return np.concatenate([self._fixed(node) for node in item.nodes])

    def _fixed(self, node: str, *, alike: bool = False) -> NDArray[np.bool_]:
        """The same of a node, or where it is the same for the class alone."""
        trials = [trial for trial in self.trials if trial.decides or not alike]
        return fixed(node, self.student.expected, trials)

    @cached_property
    def _idle(self) -> dict[str, NDArray[np.bool_]]:
        """Where formulas react to nothing, of the tried nodes that no variant tells apart."""
        nodes = [n for n, made in self._values.items() if not isinstance(made, str)]
        nodes = [node for node in nodes if self._fixed(node, alike=True).all()]
        return self.shaking.idle(nodes) if nodes else {}

    def holds_somewhere(self, item: Item, node: str) -> bool:
        """Whether a node's formulas are right for an engine that has other values there."""
        values = self._values.get(node) or self.tryout.run([node], self.trials)[node]
        if isinstance(values, str):
            return False
        own = np.ravel(np.asarray(self.student.expected.value(node), dtype=float))
        item = replace(item, nodes=(node,))
        return any(
            not np.allclose(right, own, rtol=1e-9, atol=0, equal_nan=True)
            and bool(self._close(item, made, right, trial).all())
            for made, right, trial in zip(
                values, _right(node, self.trials), self.trials, strict=True
            )
        )

    @cached_property
    def shaking(self) -> Shaking:
        """The work on nobody's variant: what tells its own from others is not seen."""
        cells = self.tryout.cells(self.trials[-1], everything=True)
        grid = unrounded_grid(pinned(self.student.grid, cells))  # small changes show
        return Shaking(self.student, self.trials[-1], grid)

    def _close(self, item: Item, own: Array, right: Array, trial: Trial) -> NDArray[np.bool_]:
        allowed = tolerance(item, right, self.student)
        return close(item, own, right, allowed, trial.expected)

    def problem(self, node: str) -> str:
        """Why a node's formulas cannot be tried, empty where they can."""
        values = self._values.get(node, "")
        return values if isinstance(values, str) else ""

    def _turned(self, item: Item, node: str) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        """Where formulas are right at the angles of their rows alone, and where they follow these.

        The first are lists of numbers, whatever they are made of; the second calculate.
        """
        trials = (self.tryout.own, turned(self.student.expected))
        made = self.tryout.run([node], trials, rounded=False)[node]
        if isinstance(made, str):
            nowhere = np.zeros(self.student.assignment.length(node), dtype=bool)
            return ~nowhere, nowhere
        right = _right(node, trials)
        own, between = map(self._close, (item, item), made, right, trials)
        allowed = tolerance(item, right[1], self.student)
        change, wanted = made[1] - made[0], right[1] - right[0]
        near = np.abs(change - wanted) <= allowed + _NEARLY * np.abs(wanted)
        return own & ~between, near & _differ(*made)

    def _of_node(self, item: Item, node: str) -> str:
        count = self.student.assignment.length(node)
        if node not in self._nodes:
            return NOTHING * count
        if node not in self._tried:
            return RIGHT * count
        found = self._judged(item, node, count)
        key = self._keys.get(node)
        if key is not None and set(found) == {RIGHT}:
            self._exact[node] = self._is_exact(node)
            if self._is_proven(item, node):
                self.proofs.known[key] = self._exact[node]
        return found

    @cached_property
    def _exact(self) -> dict[str, bool]:
        """Whether right formulas follow to the last digit, of those that are tried."""
        return {}

    @cached_property
    def settled(self) -> frozenset[str]:
        """Nodes that need not be calculated anew."""
        for item in self.student.assignment.items:
            if not self._keys.keys().isdisjoint(item.nodes) and item.quantity.digits.kind != "text":
                self.letters(item)  # nobody before must have shown that they are right
        known = {node: self.proofs.known.get(key, False) for node, key in self._keys.items()}
        return settled(self.student, known | self._exact)

    def _is_proven(self, item: Item, node: str) -> bool:
        """Whether a node's formulas are right for every trial, whoever writes them.

        Where the trials are alike it takes that the formulas react to something.
        """
        values = self._values[node]
        if isinstance(values, str) or not values:
            return False
        first, *others = self.trials
        decide = [trial for trial in others if trial.decides]
        told = not fixed(node, first.expected, decide).all()
        reacts = node in self._idle and not self._idle[node].any()
        good = self._good(item, values, _right(node, self.trials))
        listless = not listed(self.student.runs(node)) and not reads_a_list(self.student, node)
        return (told or reacts) and listless and bool(good[0].all() and good[1].all())

    def _is_exact(self, node: str) -> bool:
        """Whether a node's formulas have given the very values of every trial."""
        values = self._values[node]
        if isinstance(values, str):
            return False
        return all(
            bool((np.abs(own - right) <= EXACT * np.abs(right).max()).all())
            for own, right in zip(values, _right(node, self.trials), strict=True)
        )

    def _judged(self, item: Item, node: str, count: int) -> str:
        values = self._values[node]
        if isinstance(values, str):
            return UNKNOWN * count
        place = self.student.placement.places[node]
        index = {row: i for i, row in enumerate(place.rows) if row is not None}
        letters = [NOTHING] * count
        lists = listed(self.student.runs(node))
        reads = reads_a_list(self.student, node)
        of_angles = bool(lists or reads) and is_of_angles(self.student, node)
        refers = bool(self.student.refers(node))  # to nothing: numbers, whatever they follow
        made_up = bool(lists or reads) and refers and not of_angles  # a friend's fit exactly, too
        right = _right(node, self.trials)
        good = self._good(item, values, right)
        roughly = self._rounded_good(item, node, values, right)
        others = good[1] if roughly is None else good[1] | roughly[2]
        same = self._fixed(node)
        idle = self._idle.get(node, same & False)
        stands = ~np.any([_differ(values[0], other) for other in values], axis=0)
        # What is alike for the class may be typed in, beside something that is referred to.
        stands &= ~(same | (self._fixed(node, alike=True) & ~idle))
        turn = self._turned(item, node) if stands.any() else None
        for run in self.student.runs(node):
            at = [index[row] for row in range(run.first, run.last + 1) if row in index]
            if not at:
                continue
            whole = ""
            if all(good[0][i] for i in at):
                whole = RIGHT
            elif roughly is not None and all(roughly[1][i] for i in at):
                whole = ROUNDED
            coarse = roughly is not None and all(roughly[0][i] for i in at)
            moves = turn is not None and turn[1][at].mean() >= _MOST
            # One or two wrong rows cost their share; what is nought by itself proves nothing.
            few = (~good[0])[at].sum() <= _FEW and (good[0] & ~same)[at].mean() >= _MOST
            for i in at:
                word = whole or (RIGHT if few and good[0][i] else "")
                still = (bool(stands[i]) and not moves) or (id(run) in lists and not of_angles)
                # What all variants have in common is a number or a list of numbers only where
                # nothing follows from anything.
                still &= not word or not (others[i] or same[i])
                letter = STILL if still else word or PARTLY
                letter = letter if word or np.isfinite(values[0][i]) else WRONG
                letter = COARSE if coarse and letter == PARTLY else letter
                unsure = letter in (PARTLY, COARSE) or (letter == word and not others[i])
                if unsure or (made_up and letter == word):
                    turn = turn or self._turned(item, node)
                    pasted = turn[0].mean() >= _MOST or (unsure and reads)
                    letter = PASTED if pasted else letter
                letters[i] = IDLE if idle[i] and same[i] and letter in (RIGHT, ROUNDED) else letter
        return "".join(letters)

    def _good(
        self, item: Item, values: Sequence[Array], right: Sequence[Array]
    ) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        """Where all trials that decide agree, and where the others do."""
        decided = np.ones(len(right[0]), dtype=bool)
        others = decided.copy()
        for trial, own, wanted in zip(self.trials, values, right, strict=True):
            found = self._close(item, own, wanted, trial) | (np.isnan(own) & np.isnan(wanted))
            if trial.decides:
                decided &= found
            else:
                others &= found
        return decided, others

    def _rounded_good(
        self, item: Item, node: str, values: Sequence[Array], right: Sequence[Array]
    ) -> tuple[NDArray[np.bool_], NDArray[np.bool_], NDArray[np.bool_]] | None:
        """Where it is right without its roundings, where they are fine, where the others agree."""
        plain = self._unrounded.get(node)
        if not plain or isinstance(plain, str):
            return None
        exact, others = self._good(item, plain, right)
        found = exact.copy()
        half = self.student.assignment.rubric.tolerance.units * 10.0**-item.quantity.digits.decimals
        coarse = rounds_coarsely(self.student, item, node)
        inside = any(map(cuts, self.tryout.formulas(node)))
        for trial, own, wanted in zip(self.trials, values, right, strict=True):
            if trial.decides and inside:  # digits of π cost what they cost
                largest = float(np.nanmax(np.abs(wanted))) if wanted.size else 0.0
                allowed = half if coarse else max(half, _INSIDE * largest)
                found &= close(item, own, wanted, allowed * (1 + 1e-9), trial.expected)
        return exact, found, others

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
        for trial, own in zip(self.trials, values, strict=False):
            right = trial.expected.value(node)
            if isinstance(right, str):
                continue
            wanted = np.ravel(np.asarray(right, dtype=float))
            scale = float(np.nanmax(np.abs(wanted))) if wanted.size else 1.0
            near = apart([node], own, wanted, trial.expected) <= 1e-6 * max(scale, 1e-12)
            if not (near | (np.isnan(own) & np.isnan(wanted))).all():
                return False
        return True


def rounds_coarsely(student: Student, item: Item, node: str) -> bool:
    """Whether a column is rounded more than the book prints."""
    digits = [rounded_to(run.formula) for run in student.runs(node) if run.formula is not None]
    return any(d is not None and d < item.quantity.digits.decimals for d in digits)


def _right(node: str, trials: Sequence[Trial]) -> list[Array]:
    return [np.ravel(np.asarray(t.expected.value(node), dtype=float)) for t in trials]


def _differ(first: Array, second: Array) -> NDArray[np.bool_]:
    """Where two columns of numbers differ."""
    size = np.maximum(np.abs(first), np.abs(second))
    other = np.abs(first - second) > 1e-9 * size + 1e-12
    return np.asarray(other | (np.isnan(first) != np.isnan(second)))
