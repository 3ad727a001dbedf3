"""Verdict on each item, from what its cells hold and how its formulas respond."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from reports.grading.issuing.assignment import Item
from reports.grading.judging import response as say
from reports.grading.judging.dependencies import GROUND_RULES, Precedents
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
    Rule,
    close,
    decide,
    fault,
    tolerance,
)
from reports.grading.judging.literal_tables import tells_data
from reports.grading.judging.response import FormulaResponse
from reports.grading.reading.circularity import filled_copy
from reports.grading.reading.student import LOST, Answer, StudentBook, known_values
from reports.grading.reading.typed import TEXT_NUMBER
from reports.recalculation.evaluate import BLANK, ERROR, ERROR_WORDS, TEXT
from reports.shared.errors import UnknownFormula

_PASTED = "верно только при углах своих строк или считает от вписанных чисел: откуда они?"
_IDLE = "одно и то же, какие бы числа ни стояли там, куда ссылается формула: вычислено ли это?"
_OWN = "считает от чисел вне таблиц, одних и тех же у всех: это исходные данные или ответ?"
NUMBERS_ALONE = "формула состоит из одних чисел"
_BY_CHANCE = (
    "числа верны, а при других исходных данных формула даёт не то: совпало у этого варианта?"
)
_ENOUGH = 0.5  # share of right rows from which a column is paid by rows, of formulas among numbers
# How a cell that is not right is called, the worst first.
_WORST = (STILL, WRONG, BROKEN, EMPTY, TYPED)


@dataclass(frozen=True, slots=True)
class Verdicts:
    """Verdicts on all items, in the order of the book; ``faults`` are errors of the program."""

    judgements: list[Judgement]
    faults: tuple[str, ...] = ()


def judge_all(student: StudentBook, response: FormulaResponse) -> Verdicts:
    """Verdicts on all items.

    A rule that fails costs a person's look: an item's own rule at the item, one about what
    items rest on at the work.
    """
    items = student.assignment.items
    nodes = [node for item in items for node in item.nodes]
    student.assume({n for n in nodes if student.answers[n].problem and response.problem(n)})
    judgements = {item.id: _judged(item, student, response) for item in items}
    faults: tuple[str, ...] = ()
    try:
        grounds = Precedents.of(judgements, student, response)
    except Exception as error:
        return Verdicts(list(judgements.values()), (fault(error),))
    for rule in GROUND_RULES:
        before = dict(judgements)
        try:
            rule.apply(judgements, grounds)
        except Exception as error:
            judgements, faults = before, (*faults, fault(error))
    return Verdicts([judgements[item.id] for item in items], faults)


# --- one item by itself ----------------------------------------------------------------------


def _judged(item: Item, student: StudentBook, response: FormulaResponse) -> Judgement:
    try:
        return _of_cells(item, student, response)
    except UnknownFormula as problem:
        reason = str(problem)
    except Exception as error:
        reason = fault(error)
    nothing = np.full(sum(map(student.assignment.length, item.nodes)), np.nan)
    return Judgement(item, UNKNOWN, nothing, nothing, reason=reason)


def _of_cells(item: Item, student: StudentBook, response: FormulaResponse) -> Judgement:
    if item.quantity.digits.kind == "text":
        return _judge_text(item, student, student.answers[item.nodes[0]])
    evidence = ItemEvidence(item, student, response)
    judgement = proven(evidence) or next(
        filter(None, (rule.judge(evidence) for rule in ITEM_RULES))
    )
    return (
        replace(judgement, reason=TEXT_NUMBER)
        if evidence.odd and not judgement.reason
        else judgement
    )


@dataclass
class ItemEvidence:
    """Evidence on an item: contents of its cells, response of its formulas."""

    item: Item
    student: StudentBook
    response: FormulaResponse

    @cached_property
    def answers(self) -> list[Answer]:
        """Contents of the cells of each node."""
        return [self.student.answers[node] for node in self.item.nodes]

    @cached_property
    def judgement(self) -> Judgement:
        """The item with its right and its own values, no verdict found yet."""
        right = [np.ravel(self.student.expected.value(node)) for node in self.item.nodes]
        expected = np.asarray(np.concatenate(right), dtype=float)
        values = np.concatenate([answer.values for answer in self.answers])
        typed = np.concatenate([answer.typed for answer in self.answers])
        return Judgement(self.item, RIGHT, expected, values, typed=_where(typed))

    @cached_property
    def kinds(self) -> str:
        """Number, text, error or blank, a letter a cell."""
        return "".join(answer.kinds for answer in self.answers)

    @cached_property
    def letters(self) -> str:
        """Response of each cell's formula, a letter a cell."""
        return self.response.letters(self.item)

    @cached_property
    def formulas(self) -> list[str]:
        """The same of those cells that have formulas."""
        return [letter for letter in self.letters if letter != say.NOTHING]

    @cached_property
    def odd(self) -> dict[int, str]:
        """Values that a spreadsheet has taken for something else, and for what."""
        return _odd(self.answers)

    def close(self, values: Array) -> NDArray[np.bool_]:
        """Mask of values that print as the right ones."""
        item, expected, student = self.item, self.judgement.expected, self.student
        allowed = tolerance(item, expected, student)
        return close(item, values, expected, allowed, student.expected)

    @cached_property
    def close_values(self) -> NDArray[np.bool_]:
        """Mask of cells with right numbers."""
        return self.close(self.judgement.values)

    @cached_property
    def good(self) -> NDArray[np.bool_]:
        """The same, but for two mistakes that make up for each other."""
        if say.PARTLY not in self.letters:
            return self.close_values
        alone = self.response.tryout.alone(self.item)
        partly = np.array(list(self.letters)) == say.PARTLY
        return (
            self.close_values
            if alone is None
            else (self.close_values & (self.close(alone) | ~partly))
        )

    @cached_property
    def still(self) -> NDArray[np.bool_]:
        """Mask of right values alike for every engine."""
        return self.response.fixed(self.item)

    @cached_property
    def plain(self) -> bool:
        """Whether the formulas refer to no cell at all."""
        runs = [run for node in self.item.nodes for run in self.student.runs(node)]
        return not any(True for run in runs for _ in self.student.grid.located(run))

    @cached_property
    def unlinked(self) -> bool:
        """Whether the formulas refer to nothing that they could respond to.

        What has followed other input data refers to them, if only by a copy.
        """
        if _is_linked(self.item, self.student):
            return False
        words = decide(CELL_RULES, self.cells(unlinked=False), len(self.letters))
        pairs = zip(words, self.still, strict=True)
        return self.plain or not any(w == RIGHT and not fixed for w, fixed in pairs)

    @cached_property
    def words(self) -> list[str]:
        """Word of each cell: right, or the fault."""
        return decide(CELL_RULES, self.cells(unlinked=self.unlinked), len(self.letters))

    def cells(self, *, unlinked: bool) -> CellEvidence:
        """Return the evidence of each cell."""
        # A nought typed in among formulas is one; a column typed in is numbers throughout.
        among = len(self.formulas) >= _ENOUGH * len(self.letters)
        among = among and say.NOTHING in self.letters
        letters = np.array(list(self.letters))
        follows = (letters == say.RIGHT) | (letters == say.ROUNDED) | (letters == say.IDLE)
        return CellEvidence(np.array(list(self.kinds)), letters, letters == say.NOTHING, follows,
                            self.good, self.still if among else letters == "",
                            unlinked, self.plain)  # fmt: skip


@dataclass(frozen=True, slots=True)
class CellEvidence:
    """Evidence on the cells of an item, a value for each.

    ``typed`` are cells without a formula, ``follows`` formulas that follow their precedents.
    """

    kind: NDArray[np.str_]
    letter: NDArray[np.str_]
    typed: NDArray[np.bool_]
    follows: NDArray[np.bool_]
    good: NDArray[np.bool_]
    fixed: NDArray[np.bool_]
    unlinked: bool
    plain: bool

    @property
    def rounds(self) -> NDArray[np.bool_]:
        """Mask of formulas that round too much, visibly or not."""
        return np.asarray(self.letter == say.COARSE)


CELL_RULES = (
    Rule[CellEvidence]("blank", EMPTY, lambda e: e.kind == BLANK),
    Rule[CellEvidence]("typed error", BROKEN, lambda e: e.typed & (e.kind == ERROR)),
    Rule[CellEvidence]("wrong number", WRONG, lambda e: e.typed & ~e.good),
    Rule[CellEvidence]("typed number", TYPED, lambda e: e.typed & ~e.fixed),
    Rule[CellEvidence]("error", BROKEN, lambda e: ~e.typed & ~e.follows & (e.kind == ERROR)),
    Rule[CellEvidence]("wrong formula", WRONG, lambda e: ~e.typed & ~e.follows & ~e.good),
    Rule[CellEvidence]("number in a formula", TYPED, lambda e: ~(
        e.typed | e.follows | e.rounds | (e.letter == say.STILL))),
    Rule[CellEvidence]("numbers alone", TYPED, lambda e: (e.letter != "") & e.unlinked & e.plain),
    Rule[CellEvidence]("not linked", STILL, lambda e: (e.letter != "") & e.unlinked),
    Rule[CellEvidence]("formula of numbers", STILL, lambda e: e.letter == say.STILL),
    Rule[CellEvidence]("right", RIGHT, lambda e: e.letter != ""),
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class ItemRule:
    """A verdict on an item by itself, None where the rule does not hold."""

    name: str
    judge: Callable[[ItemEvidence], Judgement | None]


def proven(e: ItemEvidence) -> Judgement | None:
    """Right without a look at each cell: what the rules say of settled formulas that respond."""
    nodes = e.item.nodes
    varies = e.student.is_settled(nodes) and all(map(e.response.proofs.varies, nodes))
    if not varies or e.plain or set(e.letters) != {say.RIGHT}:
        return None
    return replace(e.judgement, paid=1.0)


def _not_calculated(e: ItemEvidence) -> Judgement | None:
    if say.UNKNOWN not in e.letters:
        return None
    why = next(filter(None, map(e.response.problem, e.item.nodes)), "")
    rows, why = tuple(range(len(e.judgement.values))), f"формулу не удалось пересчитать: {why}"
    return replace(e.judgement, verdict=UNKNOWN, rows=rows, reason=why)


def _lost(e: ItemEvidence) -> Judgement | None:
    if LOST not in e.kinds:
        return None
    rows = _where([kind == LOST for kind in e.kinds])
    return replace(e.judgement, verdict=UNKNOWN, rows=rows, reason="ячейки не найдены в книге")


def _filled_copy(e: ItemEvidence) -> Judgement | None:
    why = filled_copy(e.student, e.item.nodes[0]) if set(e.kinds) == {BLANK} else ""
    return replace(e.judgement, verdict=UNKNOWN, reason=why) if why else None


def _blank(e: ItemEvidence) -> Judgement | None:
    return replace(e.judgement, verdict=EMPTY) if set(e.kinds) == {BLANK} else None


def _unread(e: ItemEvidence) -> Judgement | None:
    rows = [i for i, why in e.odd.items() if why != TEXT_NUMBER and not e.close_values[i]]
    if not rows:
        return None
    return replace(e.judgement, verdict=UNKNOWN, rows=tuple(rows), typed=(), reason=e.odd[rows[0]])


def _free(e: ItemEvidence) -> Judgement | None:
    """Numbers where no formula is demanded: right, or right for the student's own others."""
    item, judgement, student, good = e.item, e.judgement, e.student, e.close_values
    if student.assignment.formulas_demanded(item) or len(judgement.typed) < len(good):
        return None
    if good.all():
        return replace(judgement, typed=(), paid=1.0)
    values_of = own_values(item, student, None)
    allowed = tolerance(item, judgement.expected, student)
    if close(item, judgement.values, values_of, allowed, student.expected).all():
        return replace(judgement, verdict=CARRIED, rows=_where(~good), typed=(), paid=1.0)
    return replace(judgement, verdict=WRONG, rows=_where(~good))


def _idle(e: ItemEvidence) -> Judgement | None:
    idle = set(e.formulas) == {say.IDLE} and not e.plain
    if not idle or e.response.shaking.is_idle_by_nature(e.item):
        return None
    why = _OWN if e.unlinked else _IDLE
    return replace(e.judgement, verdict=UNKNOWN, typed=(), reason=why)


def _pasted(e: ItemEvidence) -> Judgement | None:
    if say.PASTED not in e.letters:
        return None
    cells = zip(e.letters, e.good, e.still, strict=True)
    if not any(good and not still for letter, good, still in cells if letter == say.PASTED):
        return None
    return replace(e.judgement, verdict=UNKNOWN, typed=(), reason=_PASTED)


def _by_chance(e: ItemEvidence) -> Judgement | None:
    """Right for the student's engine alone, with no number in the formula that tells data of it.

    Where the bore is twice the radius, one may stand for the other by mistake.
    """
    words = Counter(e.words)
    partly = say.PARTLY in e.letters and say.NOTHING not in e.letters and not e.plain
    if not partly or words.keys() - {RIGHT, TYPED} or tells_data(e.student, e.item):
        return None
    rows = _where([word == TYPED for word in e.words])
    return replace(e.judgement, verdict=UNKNOWN, rows=rows, typed=(), reason=_BY_CHANCE)


def _by_cells(e: ItemEvidence) -> Judgement:
    """Return the verdict that most cells have, but numbers in disguise before all others."""
    counts, total = Counter(e.words), len(e.words)
    if counts.keys() == {RIGHT}:
        return replace(e.judgement, paid=1.0, typed=(), coarse=say.ROUNDED in e.letters)
    bad = [word for word in _WORST if word in counts]
    verdict = max(bad, key=lambda word: (word == STILL, counts[word] if word != TYPED else 0))
    credit = e.student.assignment.rubric.credit
    paid = (counts[RIGHT] + credit.typed * counts[TYPED]) / total
    if verdict != TYPED:
        by_rows = STILL not in counts and counts[RIGHT] + counts[TYPED] >= _ENOUGH * total
        paid = paid * credit.rows if by_rows else 0.0
    reason = _reason(verdict, e.words, e.kinds, e.letters, unlinked=e.unlinked)
    if verdict == BROKEN:
        reason = shown_errors(e.item, e.student)
    coarse = any(say.rounds_coarsely(e.student, e.item, node) for node in e.item.nodes)
    return replace(e.judgement, verdict=verdict, paid=paid, reason=reason,
                   rows=_where([word != RIGHT for word in e.words]),
                   coarse=say.COARSE in e.letters or coarse)  # fmt: skip


ITEM_RULES = (
    ItemRule("not calculated", _not_calculated),
    ItemRule("lost", _lost),
    ItemRule("copy of the sheet filled", _filled_copy),
    ItemRule("blank", _blank),
    ItemRule("taken for another", _unread),
    ItemRule("numbers allowed", _free),
    ItemRule("idle", _idle),
    ItemRule("pasted", _pasted),
    ItemRule("by chance", _by_chance),
    ItemRule("by its cells", _by_cells),
)


def _odd(answers: Sequence[Answer]) -> dict[int, str]:
    """Values of an item that a spreadsheet has taken for something else, and for what."""
    ends = np.cumsum([len(answer.kinds) for answer in answers])
    return {
        int(end) - len(answer.kinds) + i: why
        for end, answer in zip(ends, answers, strict=True)
        for i, why in answer.odd.items()
    }


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
            return NUMBERS_ALONE
        if say.PARTLY in letters:
            return "вместо ссылки в формуле стоит число: при других данных она неверна"
    if verdict == WRONG and TEXT in kinds and set(words) == {WRONG}:
        return "вместо числа стоит текст"
    return ""


def _judge_text(item: Item, student: StudentBook, answer: Answer) -> Judgement:
    """Compare a result in words as words."""
    nothing, location, (node,) = np.full(1, np.nan), answer.location, item.nodes
    judgement = Judgement(item, WRONG, nothing, nothing, (0,))
    if location is None or location.rows[0] is None or answer.problem:
        why = answer.problem or "ячейки не найдены в книге"
        return replace(judgement, verdict=UNKNOWN, rows=(), reason=why)
    text = student.engine.shown(location.sheet, location.column, location.rows[0])
    if text is None:
        return replace(judgement, verdict=EMPTY)
    read = student.precedents(node)
    evaluation = student.expected.fork(known_values(student.answers, read))
    verdicts = {str(evaluation.value(node)).casefold(): CARRIED}
    verdicts[str(student.expected.value(node)).casefold()] = RIGHT
    verdict = verdicts.get(str(text).casefold(), WRONG)
    if verdict == RIGHT and not read and student.assignment.formulas_demanded(item):
        return replace(judgement, verdict=TYPED, paid=student.assignment.rubric.credit.typed)
    return replace(judgement, verdict=verdict, rows=(), paid=float(verdict != WRONG))


def _where(flags: Sequence[bool] | NDArray[np.bool_]) -> tuple[int, ...]:
    return tuple(np.flatnonzero(np.asarray(flags)).tolist())


def _is_linked(item: Item, student: StudentBook) -> bool:
    """Whether the formulas refer to any cell of the work-book but titles.

    Which cells does not matter: there is more than one way to a value.
    """
    if not student.assignment.ancestors(item):
        return True
    names = frozenset().union(*(student.precedents(node) for node in item.nodes))
    return any(not name.startswith("report_") for name in names)


def own_values(item: Item, student: StudentBook, precedents: frozenset[str] | None) -> Array:
    """Return the textbook's formula on the student's own values of the cells that are referred to.

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


def shown_errors(item: Item, student: StudentBook) -> str:
    """Error values of the cells, in Russian."""
    errors: dict[str, None] = {}
    for node in item.nodes:
        location = student.placement.places.get(node)
        for row in location.rows if location is not None else ():
            if location is not None and row is not None:
                text = student.engine.shown(location.sheet, location.column, row)
                if isinstance(text, str) and text.startswith("#"):
                    errors.setdefault(ERROR_WORDS.get(text, text))
    return ", ".join(errors)
