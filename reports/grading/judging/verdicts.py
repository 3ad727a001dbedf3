"""The verdict on each item, from what its cells hold and how its formulas respond."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from reports.grading.issuing.assignment import Item
from reports.grading.judging import response as say
from reports.grading.judging.errors import shown_errors
from reports.grading.judging.judgement import (
    BROKEN,
    CARRIED,
    EMPTY,
    RIGHT,
    STILL,
    TYPED,
    UNKNOWN,
    WRONG,
    Array,
    Judgement,
)
from reports.grading.judging.response import Response
from reports.grading.judging.resting import backwards, carried, without_ground
from reports.grading.judging.tolerances import close, tolerance
from reports.grading.reading.ground import filled_copy
from reports.grading.reading.student import LOST, Answer, Student, known_values
from reports.grading.reading.typed import TEXT_NUMBER
from reports.recalculation.evaluate import BLANK, ERROR, TEXT
from reports.recalculation.language import UnknownFormula

_PASTED = "верно только при углах своих строк или считает от вписанных чисел: откуда они?"
_IDLE = "одно и то же, какие бы числа ни стояли там, куда ссылается формула: вычислено ли это?"
_OWN = "считает от чисел вне таблиц, одних и тех же у всех: это исходные данные или ответ?"
_ENOUGH = 0.5  # share of right rows from which a column is paid by rows, of formulas among numbers


def judge_all(student: Student, response: Response) -> list[Judgement]:
    """Verdicts on all items, in the order of the book."""
    items = student.assignment.items
    nodes = [node for item in items for node in item.nodes]
    student.assume({n for n in nodes if student.answers[n].problem and response.problem(n)})
    found = {item.id: _judged(item, student, response) for item in items}
    without_ground(found, student, response)
    backwards(found, student, response)
    carried(found, student)
    return [found[item.id] for item in items]


# --- one item by itself ----------------------------------------------------------------------


def _judged(item: Item, student: Student, response: Response) -> Judgement:
    try:
        return _of_cells(item, student, response)
    except UnknownFormula as problem:
        count = sum(student.assignment.length(node) for node in item.nodes)
        nothing = np.full(count, np.nan)
        return Judgement(item, UNKNOWN, nothing, nothing, reason=str(problem))


def _of_cells(item: Item, student: Student, response: Response) -> Judgement:
    answers = [student.answers[node] for node in item.nodes]
    right = [student.expected.value(node) for node in item.nodes]
    if item.quantity.digits.kind == "text":
        return _judge_text(item, student, answers[0])
    expected = np.asarray(np.concatenate([np.ravel(value) for value in right]), dtype=float)
    values = np.concatenate([answer.values for answer in answers])
    kinds = "".join(answer.kinds for answer in answers)
    typed = np.concatenate([answer.typed for answer in answers])
    made = Judgement(item, RIGHT, expected, values, typed=_where(typed))
    letters = response.letters(item)
    if say.UNKNOWN in letters:
        why = next(filter(None, map(response.problem, item.nodes)), "")
        rows, why = tuple(range(len(values))), f"формулу не удалось пересчитать: {why}"
        return replace(made, verdict=UNKNOWN, rows=rows, reason=why)
    if LOST in kinds:
        rows = _where([kind == LOST for kind in kinds])
        return replace(made, verdict=UNKNOWN, rows=rows, reason="ячейки не найдены в книге")
    if set(kinds) == {BLANK}:
        why = filled_copy(student, item.nodes[0])
        return replace(made, verdict=UNKNOWN if why else EMPTY, reason=why)
    odd = _odd(answers)
    good = close(item, values, expected, tolerance(item, expected, student), student.expected)
    unread = [i for i, why in odd.items() if why != TEXT_NUMBER and not good[i]]
    if unread:
        return replace(made, verdict=UNKNOWN, rows=tuple(unread), typed=(), reason=odd[unread[0]])
    if not student.assignment.formulas_demanded(item) and typed.all():
        made = _free(made, student)
    else:
        made = _by_rows(made, student, response, kinds, letters)
    return replace(made, reason=TEXT_NUMBER) if odd and not made.reason else made


def _odd(answers: Sequence[Answer]) -> dict[int, str]:
    """Values of an item that a spreadsheet has taken for something else, and for what."""
    ends = np.cumsum([len(answer.kinds) for answer in answers])
    return {
        int(end) - len(answer.kinds) + i: why
        for end, answer in zip(ends, answers, strict=True)
        for i, why in answer.odd.items()
    }


def _free(made: Judgement, student: Student) -> Judgement:
    """Numbers where no formula is demanded: right, or right for the student's own others."""
    item = made.item
    allowed = tolerance(item, made.expected, student)
    good = close(item, made.values, made.expected, allowed, student.expected)
    if good.all():
        return replace(made, typed=(), paid=1.0)
    own = own_values(item, student, None)
    if close(item, made.values, own, allowed, student.expected).all():
        return replace(made, verdict=CARRIED, rows=_where(~good), typed=(), paid=1.0)
    return replace(made, verdict=WRONG, rows=_where(~good))


# How a cell that is not right is called, the worst first.
_WORST = (STILL, WRONG, BROKEN, EMPTY, TYPED)


def _by_rows(
    made: Judgement, student: Student, response: Response, kinds: str, letters: str
) -> Judgement:
    item = made.item
    allowed = tolerance(item, made.expected, student)
    good = close(item, made.values, made.expected, allowed, student.expected)
    if say.PARTLY in letters and (alone := response.tryout.alone(item)) is not None:
        # Two mistakes that make up for each other are no number in the place of a reference.
        fits = close(item, alone, made.expected, allowed, student.expected)
        good &= fits | (np.array(list(letters)) != say.PARTLY)
    # A nought typed in among formulas is one; a column typed in is numbers throughout.
    still = response.fixed(item)
    formulas = [letter for letter in letters if letter != say.NOTHING]
    fixed = still & (len(formulas) >= _ENOUGH * len(letters))
    words = [_word(kinds[i], letters[i], bool(good[i]), bool(fixed[i])) for i in range(len(kinds))]
    runs = [run for node in item.nodes for run in student.runs(node)]
    plain = not any(True for run in runs for _ in student.grid.located(run))
    # What has followed other input data refers to them, if only by a copy.
    follows = not plain and any(w == RIGHT and not f for w, f in zip(words, still, strict=True))
    unlinked = not follows and not _is_linked(item, student)
    idle = set(formulas) == {say.IDLE} and not plain
    if idle and not response.shaking.is_idle_by_nature(item):
        return replace(made, verdict=UNKNOWN, typed=(), reason=_OWN if unlinked else _IDLE)
    if unlinked:  # nothing to respond to: numbers, or references to pasted ones
        words = [(TYPED if plain else STILL) if w in (RIGHT, STILL) else w for w in words]
    if any(good[i] and not still[i] for i, let in enumerate(letters) if let == say.PASTED):
        return replace(made, verdict=UNKNOWN, typed=(), reason=_PASTED)
    counts = {word: words.count(word) for word in dict.fromkeys(words)}
    if set(words) == {RIGHT}:
        return replace(made, paid=1.0, typed=(), coarse=say.ROUNDED in letters)
    bad = [word for word in _WORST if word in counts]
    verdict = max(bad, key=lambda word: (word == STILL, counts[word] if word != TYPED else 0))
    rows = _where([word != RIGHT for word in words])
    share = (counts.get(RIGHT, 0) + student.assignment.rubric.credit.typed * counts.get(TYPED, 0)
             ) / len(words)  # fmt: skip
    rights = counts.get(RIGHT, 0) + counts.get(TYPED, 0)
    by_rows = STILL not in counts and rights >= _ENOUGH * len(words)
    if verdict == TYPED:
        paid = share
    else:
        paid = share * student.assignment.rubric.credit.rows if by_rows else 0.0
    reason = _reason(verdict, words, kinds, letters, unlinked=unlinked)
    if verdict == BROKEN:
        reason = shown_errors(item, student)
    coarse = any(say.rounds_coarsely(student, item, node) for node in item.nodes)
    return replace(made, verdict=verdict, rows=rows, paid=paid, reason=reason,
                   coarse=say.COARSE in letters or coarse)  # fmt: skip


def _word(kind: str, letter: str, good: bool, fixed: bool) -> str:
    """What a cell is: its formula right, or what is wrong with it."""
    if kind == BLANK:
        return EMPTY
    if letter == say.NOTHING:  # typed in
        if kind == TEXT:
            return WRONG
        if kind == ERROR:
            return BROKEN
        return (RIGHT if fixed else TYPED) if good else WRONG
    if letter in (say.RIGHT, say.ROUNDED, say.IDLE):
        return RIGHT
    if kind == ERROR:
        return BROKEN
    if not good:
        return WRONG
    if letter == say.COARSE:  # here the rounding does not show
        return RIGHT
    return STILL if letter == say.STILL else TYPED


def _reason(verdict: str, words: Sequence[str], kinds: str, letters: str, *, unlinked: bool) -> str:
    if verdict == STILL:
        return (
            "значения верны только для вашего варианта: взяты готовые числа или совпало случайно, "
            "при других исходных данных формула неверна"
        )
    if verdict == EMPTY:
        return "заполнены не все строки"
    if verdict == TYPED:
        if unlinked and set(letters) != {say.NOTHING}:
            return "формула состоит из одних чисел"
        if say.PARTLY in letters:
            return "вместо ссылки в формуле стоит число: при других данных она неверна"
    if verdict == WRONG and TEXT in kinds and set(words) == {WRONG}:
        return "вместо числа стоит текст"
    return ""


def _judge_text(item: Item, student: Student, answer: Answer) -> Judgement:
    """A result in words is compared as words."""
    nothing, place, (node,) = np.full(1, np.nan), answer.place, item.nodes
    made = Judgement(item, WRONG, nothing, nothing, (0,))
    if place is None or place.rows[0] is None or answer.problem:
        why = answer.problem or "ячейки не найдены в книге"
        return replace(made, verdict=UNKNOWN, rows=(), reason=why)
    found = student.engine.shown(place.sheet, place.column, place.rows[0])
    if found is None:
        return replace(made, verdict=EMPTY)
    read = student.precedents(node)
    own = student.expected.fork(known_values(student.answers, read))
    verdicts = {str(own.value(node)).casefold(): CARRIED}
    verdicts[str(student.expected.value(node)).casefold()] = RIGHT
    verdict = verdicts.get(str(found).casefold(), WRONG)
    if verdict == RIGHT and not read and student.assignment.formulas_demanded(item):
        return replace(made, verdict=TYPED, paid=student.assignment.rubric.credit.typed)
    return replace(made, verdict=verdict, rows=(), paid=float(verdict != WRONG))


def _where(flags: Sequence[bool] | NDArray[np.bool_]) -> tuple[int, ...]:
    return tuple(np.flatnonzero(np.asarray(flags)).tolist())


def _is_linked(item: Item, student: Student) -> bool:
    """Whether the formulas refer to any cell of the work-book but titles.

    Which cells does not matter: there is more than one way to a value.
    """
    if not student.assignment.ancestors(item):
        return True
    names = frozenset().union(*(student.precedents(node) for node in item.nodes))
    return any(not name.startswith("report_") for name in names)


def own_values(item: Item, student: Student, precedents: frozenset[str] | None) -> Array:
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
