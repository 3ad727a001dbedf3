"""The verdict on each item: right, carried forward, typed in, wrong, empty, error or unknown."""

from __future__ import annotations

import re
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from reports.grading.issuing.assignment import Item
from reports.grading.reading.student import LOST, Answer, Student, known_values
from reports.recalculation.evaluate import BLANK, ERROR, NUMBER, TEXT
from reports.recalculation.language import UnknownFormula

Array = NDArray[np.float64]

RIGHT, CARRIED, TYPED, WRONG, EMPTY, BROKEN, UNKNOWN = (
    "right", "carried", "typed", "wrong", "empty", "error", "unknown",
)  # fmt: skip

WORDS = {
    RIGHT: "верно",
    CARRIED: "верно по вашим предыдущим значениям",
    TYPED: "число вместо формулы",
    WRONG: "неверно",
    EMPTY: "не заполнено",
    BROKEN: "ошибка в ячейке",
    UNKNOWN: "нужна ручная проверка",
}


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
    own: Array | None = None  # right for the student's own earlier values
    path: str = ""  # how a carried verdict was reached: "expression" or "formula"


def tolerance(item: Item, expected: Array, student: Student) -> float:
    """Largest difference that the book's rounding allows.

    Half a unit of the last digit that the book prints, but never more than a small
    share of the column: some quantities are smaller than their printed digits.
    """
    rules = student.assignment.rubric.tolerance
    for pattern, value in rules.items.items():
        if re.fullmatch(pattern.replace(".", r"\.").replace("*", ".*"), item.id):
            return float(value)
    digits = item.quantity.digits
    unit = 10.0**-digits.decimals
    finite = np.abs(expected[np.isfinite(expected)])
    largest = float(finite.max()) if finite.size else 0.0
    # A double carries about sixteen digits: results that differ in the tenth are equal.
    return max(min(rules.units * unit * (1 + 1e-9), rules.share * largest), 1e-10 * largest, 1e-12)


def close(item: Item, values: Array, expected: Array, allowed: float) -> NDArray[np.bool_]:
    """Where two columns agree; directions agree also a full turn apart."""
    difference = np.abs(values - expected)
    if item.quantity.unit == "deg":
        difference = np.minimum(difference, np.abs(360.0 - difference))
    with np.errstate(invalid="ignore"):
        return np.asarray(difference <= allowed)


def judge(item: Item, student: Student) -> Judgement:
    """The verdict on one item."""
    answers = [student.answers[node] for node in item.nodes]
    right = [student.expected.value(node) for node in item.nodes]
    if any(isinstance(value, str) for value in right):
        return _judge_text(item, student, answers)
    expected = np.asarray(np.concatenate([np.ravel(value) for value in right]), dtype=float)
    values = np.concatenate([answer.values for answer in answers])
    kinds = "".join(answer.kinds for answer in answers)
    typed = tuple(np.flatnonzero(np.concatenate([answer.typed for answer in answers])).tolist())

    def verdict(word: str, rows: tuple[int, ...] = (), **more: object) -> Judgement:
        return Judgement(item, word, expected, values, rows, typed, **more)  # type: ignore[arg-type]

    problem = next((answer.problem for answer in answers if answer.problem), "")
    if problem:
        return verdict(UNKNOWN, reason=f"формулу не удалось пересчитать: {problem}")
    if LOST in kinds:
        return verdict(UNKNOWN, _where(kinds, LOST), reason="ячейки не найдены в книге")
    if set(kinds) == {BLANK}:
        return verdict(EMPTY)
    if BLANK in kinds:
        return verdict(EMPTY, _where(kinds, BLANK), reason="заполнены не все строки")
    if TEXT in kinds:
        return verdict(WRONG, _where(kinds, TEXT), reason="вместо числа стоит текст")
    allowed = tolerance(item, expected, student)
    good = close(item, values, expected, allowed)
    demanded = student.assignment.formulas_demanded(item)
    if good.all():
        linked = _is_linked(item, student)
        if demanded and (typed or not linked):
            why = "" if typed else "формула состоит из одних чисел"
            return verdict(TYPED, typed, reason=why)
        return verdict(RIGHT)
    precedents = frozenset().union(*(student.precedents(node) for node in item.nodes))
    linked = _is_linked(item, student)
    rows = tuple(np.flatnonzero(~good).tolist())
    own, path = None, ""
    if linked and not typed:
        own, path = _carried(item, student, values, expected, allowed, precedents)
    elif not demanded:
        own = _own(item, student, None)
        path = "expression" if close(item, values, own, allowed).all() else ""
    if path and _has_wrong(student, item, precedents if precedents else None):
        return verdict(CARRIED, rows, precedents=precedents, own=own, path=path)
    if ERROR in kinds:
        return verdict(BROKEN, _where(kinds, ERROR), precedents=precedents, own=own)
    return verdict(WRONG, rows, precedents=precedents, own=own)


def _judge_text(item: Item, student: Student, answers: list[Answer]) -> Judgement:
    """Results in words are compared as words."""
    nothing = np.full(len(answers), np.nan)
    wrong, empty = [], []
    for i, (node, answer) in enumerate(zip(item.nodes, answers, strict=True)):
        place = answer.place
        if place is None or place.rows[0] is None or answer.problem:
            why = answer.problem or "ячейки не найдены в книге"
            return Judgement(item, UNKNOWN, nothing, nothing, reason=why)
        found = student.engine.shown(place.sheet, place.column, place.rows[0])
        if found is None:
            empty.append(i)
        elif str(found).casefold() != str(student.expected.value(node)).casefold():
            wrong.append(i)
    verdict = EMPTY if empty else WRONG if wrong else RIGHT
    return Judgement(item, verdict, nothing, nothing, tuple(empty or wrong))


def _where(kinds: str, kind: str) -> tuple[int, ...]:
    return tuple(i for i, found in enumerate(kinds) if found == kind)


def _is_linked(item: Item, student: Student) -> bool:
    """Whether the formulas refer to cells on which the result depends.

    Other cells of the work-book do as well: there is more than one right way to a value.
    """
    needed = student.assignment.ancestors(item)
    if not needed or any(student.refers_to(node, needed) for node in item.nodes):
        return True
    names = frozenset().union(*(student.precedents(node) for node in item.nodes))
    return any(not name.startswith("report_") for name in names)


def _has_wrong(student: Student, item: Item, precedents: frozenset[str] | None) -> bool:
    """Whether there is an earlier value of the student's that is not the right one."""
    if precedents is None:
        precedents = student.assignment.ancestors(item)
    for name in precedents:
        answer = student.answers.get(name)
        if answer is None:
            continue
        right = student.expected.value(name)
        if isinstance(right, str):
            continue
        if answer.kinds != NUMBER * len(answer.kinds):
            return True
        scale = max(1e-300, float(np.nanmax(np.abs(right))))
        if not (np.abs(answer.values - np.ravel(right)) <= 1e-9 * scale).all():
            return True
    return False


def _carried(
    item: Item,
    student: Student,
    values: Array,
    expected: Array,
    allowed: float,
    precedents: frozenset[str],
) -> tuple[Array | None, str]:
    """What the student's own earlier values give, and how the column was found to follow them."""
    own = _own(item, student, precedents)
    if own is not None:
        scale = np.abs(own[np.isfinite(own)])
        own_allowed = max(allowed, 1e-10 * float(scale.max())) if scale.size else allowed
        if close(item, values, own, own_allowed).all():
            return own, "expression"
    # The textbook's formula is not the only right one: whatever is written here, does it
    # give the right column from right earlier columns?
    parts = [student.with_right_precedents(node) for node in item.nodes]
    if all(part is not None for part in parts):
        made = np.concatenate([part for part in parts if part is not None])
        if close(item, made, expected, allowed).all():
            return own, "formula"
    return own, ""


def _own(item: Item, student: Student, precedents: frozenset[str] | None) -> Array:
    """The textbook's formula on the student's own values of the cells that are referred to.

    Cells that the formula does not refer to are calculated from those that it does:
    a student may skip a helper column.
    """
    parts = []
    for node in item.nodes:
        used = precedents
        if used is None:  # typed in: the columns that the textbook's formula names
            used = student.assignment.graph.ancestors(node)
        run = student.expected.fork(known_values(student.answers, used - {node}))
        parts.append(np.ravel(np.asarray(run.value(node), dtype=float)))
    return np.concatenate(parts)


def judge_all(student: Student) -> list[Judgement]:
    """Verdicts on all items, in the order of the book."""
    found = []
    for item in student.assignment.items:
        try:
            found.append(judge(item, student))
        except UnknownFormula as problem:
            count = sum(student.assignment.length(node) for node in item.nodes)
            nothing = np.full(count, np.nan)
            found.append(Judgement(item, UNKNOWN, nothing, nothing, reason=str(problem)))
    return found
