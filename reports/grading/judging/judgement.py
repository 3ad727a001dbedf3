"""Verdict on an item, its words, and the tolerance of its numbers."""

from __future__ import annotations

import ast
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from fnmatch import fnmatchcase
from typing import Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from reports.formula.numeric import evaluate_tree
from reports.formula.parse import parse
from reports.grading.issuing.assignment import Item
from reports.grading.reading.student import StudentBook
from reports.model.evaluation import Evaluation
from reports.shared.errors import one_line

Array = NDArray[np.float64]
_FAULT = 200  # signs of an error

RIGHT, CARRIED, TYPED, STILL, WRONG, EMPTY, GROUNDLESS, BROKEN, UNKNOWN = (
    "right", "carried", "typed", "still", "wrong", "empty", "groundless", "error", "unknown",
)  # fmt: skip

WORDS = {
    WRONG: "неверно",
    BROKEN: "ошибка в ячейке",
    STILL: "формула не считает",
    GROUNDLESS: "считает по пустым ячейкам",
    EMPTY: "не заполнено",
    TYPED: "число вместо формулы",
    UNKNOWN: "нужна ручная проверка",
    CARRIED: "верно по вашим предыдущим значениям",
    RIGHT: "верно",
}


PART = "part"  # block of the lines that a person marks: note, defence, sheet

E = TypeVar("E")
_MAX_LABELS = 8
_ENOUGH, _SAME = 3, 1e-7  # of fewer wrong rows the values must be the very same
_CLEAR = 50  # tolerances that a number has at least which tells its cause alone


def fault(error: Exception) -> str:
    """Words on an error of the program's own: a person looks, whatever it was.

    Raises:
        MemoryError: it was one, and the next step would meet it too.
    """
    if isinstance(error, MemoryError):
        raise error
    return one_line(f"внутренняя ошибка проверки ({type(error).__name__}: {error})", _FAULT)


def part_remark(names: Sequence[str]) -> str:
    """Return what is said of parts that wait for a person's points."""
    return "ставит преподаватель: " + ", ".join(names)


def unread_remark(labels: Sequence[str]) -> str:
    """Tell what is said of a work some of whose items a person has to look at."""
    return "не удалось проверить: " + ", ".join(labels[:_MAX_LABELS])


@dataclass(frozen=True)
class Rule(Generic[E]):
    """A word for cells, and where the evidence of a column gives it."""

    name: str
    word: str
    holds: Callable[[E], NDArray[np.bool_]]


def decide(rules: Sequence[Rule[E]], evidence: E, count: int) -> list[str]:
    """Word of the first rule that holds, for each of so many cells."""
    words = np.full(count, "", dtype=object)
    for rule in reversed(rules):
        words[rule.holds(evidence)] = rule.word
    return list(words)


@dataclass(frozen=True)
class Judgement:
    """A verdict with its evidence; rows are indices into the item's values."""

    item: Item
    verdict: str
    expected: Array
    values: Array
    rows: tuple[int, ...] = ()  # rows that the verdict is about
    typed: tuple[int, ...] = ()  # rows with numbers instead of formulas
    reason: str = ""
    precedents: frozenset[str] = field(default_factory=frozenset)
    origins: tuple[str, ...] = ()  # items that it is carried from
    paid: float = 0.0  # share of the points, before the rubric's share for the verdict
    coarse: bool = False  # rounded more than the book prints


# --- tolerance -----------------------------------------------------------------------------------


def tolerance(item: Item, expected: Array, student: StudentBook) -> float:
    """Largest difference that the book's rounding allows.

    Half a unit of the last digit that the book prints, but never more than a small
    share of the column: some quantities are smaller than their printed digits.
    """
    rules = student.assignment.rubric.tolerance
    for pattern, value in rules.items.items():
        if fnmatchcase(item.id, pattern):
            return float(value)
    digits = item.quantity.digits
    unit = 10.0**-digits.decimals
    finite = np.abs(expected[np.isfinite(expected)])
    largest = float(finite.max()) if finite.size else 0.0
    # A double carries about sixteen digits: results that differ in the tenth are equal.
    noise = max(1e-10 * largest, 1e-10 * unit, 1e-12)
    return max(min(rules.units * unit * (1 + 1e-9), rules.share * largest), noise)


def close(
    item: Item, values: Array, expected: Array, allowed: float, run: Evaluation
) -> NDArray[np.bool_]:
    """Mask of values that agree between two columns of an engine."""
    with np.errstate(invalid="ignore"):
        return np.asarray(distance(item.nodes, values, expected, run) <= allowed)


def explains(
    item: Item, values: Array, attempt: Array, right: Array, student: StudentBook,
    rows: Sequence[int] = (),
) -> bool:  # fmt: skip
    """Whether an attempt gives the values, or those of some rows, and is not right itself."""
    if attempt.shape != values.shape or not np.isfinite(attempt).any():
        return False
    allowed = tolerance(item, attempt, student)
    at = np.asarray(rows) if rows else np.arange(len(values))
    if rows:
        if (np.abs(values[at]) < _CLEAR * allowed).any():
            return False  # so few digits may come of anything
        if len(rows) < _ENOUGH:  # and among so many columns there is always one that is near
            allowed = min(allowed, _SAME * float(np.abs(values[at]).max()))
    there = np.isfinite(values[at])
    if there.sum() < max(1, len(at) // 2):
        return False
    # Any angle is a hundred times another, but for whole turns.
    if not (np.abs(values - attempt)[at][there] <= allowed).all():
        return False
    return not close(item, attempt, right, allowed, student.expected)[at].all()


def values_of(item: Item, run: Evaluation) -> Array:
    """Values of an item for an engine."""
    parts = [np.ravel(np.asarray(run.value(node), dtype=float)) for node in item.nodes]
    return np.concatenate(parts)


def distance(nodes: Sequence[str], values: Array, expected: Array, run: Evaluation) -> Array:
    """Distance of nodes' values from those of an engine.

    Angles compare modulo their period; a zero vector matches any angle.
    """
    with np.errstate(invalid="ignore", divide="ignore"):
        difference = np.abs(values - expected)
        if run.model.nodes[nodes[0]].quantity.unit != "deg":
            return difference
        every, nothing = _turns(nodes, run)
        turns = np.where(every > 0, np.round(difference / every), 0)
        gaps = np.abs(difference - turns * every)
        return np.where(nothing & np.isfinite(values), 0.0, gaps)


def _turns(nodes: Sequence[str], run: Evaluation) -> tuple[Array, NDArray[np.bool_]]:
    """After how many degrees each angle is the same, 0: never; where there is none."""
    every: list[Array] = []
    nothing: list[Array] = []
    for node in nodes:
        spec = run.model.nodes[node]
        tree, none = parse(spec.expr or "0"), parse("0")
        if isinstance(tree, ast.IfExp) and isinstance(tree.body, ast.Constant):
            none = tree.test
        shape = np.shape(run.value(node)) or (1,)
        for parts, text in ((every, parse(spec.every)), (nothing, none)):
            with np.errstate(all="ignore"):
                value = evaluate_tree(text, run.values_for(node))
            parts.append(np.broadcast_to(value, shape))
    return np.concatenate(every).astype(float), np.concatenate(nothing).astype(bool)
