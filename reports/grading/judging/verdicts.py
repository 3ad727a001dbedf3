"""The verdict on each item, from what its cells hold and how its formulas respond."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from reports.grading.issuing.assignment import Item
from reports.grading.judging import response as say
from reports.grading.judging.errors import shown_errors
from reports.grading.judging.response import Response
from reports.grading.judging.tolerances import close, tolerance
from reports.grading.reading.ground import calculated, circles, filled_copy, is_void, resting_on
from reports.grading.reading.student import LOST, Answer, Student, known_values
from reports.grading.reading.typed import TEXT_NUMBER
from reports.recalculation.bench import rounded_to
from reports.recalculation.evaluate import BLANK, ERROR, TEXT
from reports.recalculation.language import UnknownFormula

Array = NDArray[np.float64]

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
_ROUND = "круговая ссылка: величина считается через саму себя"
_ROUND_HERE = "круговая ссылка, а верные числа сохранены: поиск во всём столбце или вставка?"
_PASTED = "считает от столбца вписанных чисел, и не для всех исходных данных верно: откуда они?"
_ENOUGH = 0.5  # share of right rows from which a column is paid by rows


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

    @property
    def finite(self) -> bool:
        """Whether there is any number."""
        return bool(np.isfinite(self.values).any())


def judge_all(student: Student, response: Response) -> list[Judgement]:
    """Verdicts on all items, in the order of the book."""
    items = student.assignment.items
    nodes = [node for item in items for node in item.nodes]
    student.assume({n for n in nodes if student.answers[n].problem and response.problem(n)})
    found = {item.id: _judged(item, student, response) for item in items}
    _without_ground(found, student)
    _backwards(found, student, response)
    _carried(found, student)
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
    if any(isinstance(value, str) for value in right):
        return _judge_text(item, student, answers)
    expected = np.asarray(np.concatenate([np.ravel(value) for value in right]), dtype=float)
    values = np.concatenate([answer.values for answer in answers])
    kinds = "".join(answer.kinds for answer in answers)
    typed = np.concatenate([answer.typed for answer in answers])
    made = Judgement(item, RIGHT, expected, values, typed=_where(typed))
    letters = response.letters(item)
    if say.UNKNOWN in letters:
        why = next(filter(None, map(response.problem, item.nodes)), "")
        return replace(made, verdict=UNKNOWN, reason=f"формулу не удалось пересчитать: {why}")
    if LOST in kinds:
        rows = _where([kind == LOST for kind in kinds])
        return replace(made, verdict=UNKNOWN, rows=rows, reason="ячейки не найдены в книге")
    if set(kinds) == {BLANK}:
        why = filled_copy(student, item.nodes[0])
        return replace(made, verdict=UNKNOWN if why else EMPTY, reason=why)
    odd = _odd(answers)
    good = close(item, values, expected, tolerance(item, expected, student))
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
    good = close(item, made.values, made.expected, allowed)
    if good.all():
        return replace(made, typed=(), paid=1.0)
    own = own_values(item, student, None)
    if close(item, made.values, own, allowed).all():
        return replace(made, verdict=CARRIED, rows=_where(~good), typed=(), paid=1.0)
    return replace(made, verdict=WRONG, rows=_where(~good))


# How a cell that is not right is called, the worst first.
_WORST = (STILL, WRONG, BROKEN, EMPTY, TYPED)


def _by_rows(
    made: Judgement, student: Student, response: Response, kinds: str, letters: str
) -> Judgement:
    item = made.item
    allowed = tolerance(item, made.expected, student)
    good = close(item, made.values, made.expected, allowed)
    # A nought typed in among formulas is one; a column typed in is numbers throughout.
    still = response.fixed(item)
    fixed = still & any(letter != say.NOTHING for letter in letters)
    words = [_word(kinds[i], letters[i], bool(good[i]), bool(fixed[i])) for i in range(len(kinds))]
    # What has followed other input data refers to them, if only by a copy.
    follows = any(w == RIGHT and not f for w, f in zip(words, still, strict=True))
    unlinked = not follows and not _is_linked(item, student)
    if unlinked:  # nothing to respond to: numbers, or references to pasted ones
        runs = [run for node in item.nodes for run in student.runs(node)]
        plain = not any(True for run in runs for _ in student.grid.located(run))
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
    return replace(made, verdict=verdict, rows=rows, paid=paid, reason=reason,
                   coarse=say.COARSE in letters or _coarse(item, student))  # fmt: skip


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
    if letter in (say.RIGHT, say.ROUNDED):
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
            "значения верны только для вашего варианта: при других исходных данных формула даёт "
            "те же числа"
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


def _coarse(item: Item, student: Student) -> bool:
    """Whether a column is wrong only because it is rounded more than the book prints."""
    digits = [
        rounded_to(run.formula)
        for node in item.nodes
        for run in student.runs(node)
        if run.formula is not None
    ]
    return any(d is not None and d < item.quantity.digits.decimals for d in digits)


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
    return Judgement(item, verdict, nothing, nothing, tuple(empty or wrong),
                     paid=float(verdict == RIGHT))  # fmt: skip


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


# --- what an item rests on -------------------------------------------------------------------


def _without_ground(found: dict[str, Judgement], student: Student) -> None:
    """Blanks and circles pass nothing on: what rests on them is no result."""
    round_ = circles(student)
    held = calculated(student, round_)
    for id_, judgement in found.items():
        at = round_ & set(judgement.item.nodes)
        if at and judgement.verdict != UNKNOWN:
            verdict, reason = (UNKNOWN, _ROUND_HERE) if at <= held else (BROKEN, _ROUND)
            found[id_] = replace(judgement, verdict=verdict, paid=0.0, reason=reason)
    void = set(round_ - held)
    for judgement in found.values():
        for node in judgement.item.nodes:
            if is_void(student, node):
                void.add(node)
    if not void:
        return
    resting = resting_on(student, frozenset(void))
    names = {node: j.item for j in found.values() for node in j.item.nodes}
    for id_, judgement in found.items():
        nodes = set(judgement.item.nodes)
        if not nodes & resting or nodes & void or judgement.paid <= 0:
            continue
        near = frozenset().union(*(student.precedents(node) for node in nodes)) & (void | resting)
        roots = sorted({names[n].id for n in near & void or void if n in names})[:4]
        circle = near and near <= round_
        why = "опирается на круговую ссылку" if circle else "опирается на незаполненное"
        found[id_] = replace(judgement, verdict=GROUNDLESS, paid=0.0, origins=tuple(roots),
                             reason=why)  # fmt: skip


def _backwards(found: dict[str, Judgement], student: Student, response: Response) -> None:
    """Nothing is earned by going back from numbers that were typed in or given.

    A column that the textbook's way leads to must not be where its own values come from,
    unless it is calculated itself.
    """
    owner = {node: j.item.id for j in found.values() for node in j.item.nodes}
    live = student.assignment.live_nodes
    changed = True
    while changed:
        changed = False
        suspects: dict[str, list[str]] = {}
        for judgement in found.values():
            if judgement.verdict != RIGHT or judgement.paid <= 0:
                continue
            ancestors = student.assignment.ancestors(judgement.item)
            for node in judgement.item.nodes:
                if not student.runs(node):
                    continue
                for name in student.precedents(node) - ancestors - set(judgement.item.nodes):
                    bad = name in live or (
                        name in owner and found[owner[name]].verdict in (TYPED, STILL)
                    )
                    if bad:
                        suspects.setdefault(name, []).append(node)
        for name, nodes in sorted(suspects.items()):
            depends = response.depends(nodes, name)
            for node in nodes:
                if depends[node] and found[owner[node]].verdict == RIGHT:
                    why = "взято из готовой таблицы" if name in live else "получено из чисел"
                    origin = (owner[name],) if name in owner else ()
                    found[owner[node]] = replace(
                        found[owner[node]], verdict=STILL, paid=0.0, origins=origin,
                        reason=f"{why}, а не рассчитано",
                    )  # fmt: skip
                    changed = True


def _carried(found: dict[str, Judgement], student: Student) -> None:
    """Right formulas on earlier values that are not right name the columns these came from."""
    owner = {node: j.item.id for j in found.values() for node in j.item.nodes}
    for id_, judgement in found.items():
        if judgement.verdict != RIGHT or np.isnan(judgement.expected).all():
            continue
        allowed = tolerance(judgement.item, judgement.expected, student)
        good = close(judgement.item, judgement.values, judgement.expected, allowed)
        if good.all():
            continue
        names = frozenset().union(*(student.precedents(n) for n in judgement.item.nodes))
        near = sorted({owner[n] for n in names if n in owner} - {id_})
        live = [n for n in names if n in student.assignment.live_nodes]
        through = student.assignment.graph
        for name in live:
            near += sorted({owner[n] for n in through.ancestors(name) if n in owner} - set(near))
        guilty = [
            n
            for n in near
            if found[n].verdict not in (RIGHT, UNKNOWN) or _is_off(found[n], student)
        ]
        if not guilty:
            continue  # roundings on the way, or a value that is not known
        wrong = [n for n in guilty if found[n].verdict not in (RIGHT, CARRIED)]
        found[id_] = replace(judgement, verdict=CARRIED, rows=_where(~good),
                             origins=tuple((wrong or guilty)[:4]), precedents=names)  # fmt: skip


def _is_off(judgement: Judgement, student: Student) -> bool:
    """Whether a right formula's values are not the right ones for more than roundings."""
    if judgement.verdict != RIGHT:
        return judgement.verdict != UNKNOWN
    allowed = 20 * tolerance(judgement.item, judgement.expected, student)
    return not close(judgement.item, judgement.values, judgement.expected, allowed).all()


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
