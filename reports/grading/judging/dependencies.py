"""Dependencies of verdicts: blanks, circles, typed numbers, earlier mistakes."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from reports.grading.judging.judgement import (
    BROKEN,
    CARRIED,
    EMPTY,
    GROUNDLESS,
    RIGHT,
    STILL,
    TYPED,
    UNKNOWN,
    Judgement,
    close,
    tolerance,
)
from reports.grading.judging.response import FormulaResponse
from reports.grading.reading.circularity import (
    calculated,
    circles,
    hidden_circles,
    is_void,
    resting_on,
    rings,
    through,
)
from reports.grading.reading.student import StudentBook

_ROUND = "круговая ссылка: величина считается через саму себя"
_ROUND_HERE = "круговая ссылка, а верные числа сохранены: поиск во всём столбце или вставка?"
_ROUND_ELSEWHERE = "при других исходных данных круговая ссылка: величина считается через себя"
_TAKEN = "взято из готовой таблицы, а не рассчитано"
_ON_CIRCLE, _ON_BLANK = "круговую ссылку", "незаполненное"
_BACK = {
    STILL: "получено из чисел, а не рассчитано",
    UNKNOWN: "получено назад из столбца, который сам не рассчитан верно: есть ли другой путь?",
}


Judgements = dict[str, Judgement]


@dataclass(frozen=True, slots=True)
class Precedents:
    """Circular nodes of a work, and those of them that pass numbers on."""

    student: StudentBook
    response: FormulaResponse
    circular: frozenset[str]
    right: frozenset[str]  # circular cells whose saved numbers are right
    hidden: frozenset[str]  # circular with other input data only

    @classmethod
    def of(
        cls, judgements: Judgements, student: StudentBook, response: FormulaResponse
    ) -> Precedents:
        """Return the grounds of items that are judged by themselves."""
        circular = circles(student)
        hidden = _hidden_circles(judgements, student, response) - circular
        return cls(student, response, circular, calculated(student, circular), hidden)


def on_circles(judgements: Judgements, grounds: Precedents) -> None:
    """Take circles for no result."""
    for id_, judgement in judgements.items():
        at = grounds.circular & set(judgement.item.nodes)
        if at and judgement.verdict != UNKNOWN:
            verdict, reason = (UNKNOWN, _ROUND_HERE) if at <= grounds.right else (BROKEN, _ROUND)
            rows = tuple(range(len(judgement.values)))
            judgements[id_] = replace(judgement, verdict=verdict, rows=rows, paid=0.0,
                                      reason=reason)  # fmt: skip


def on_hidden_circles(judgements: Judgements, grounds: Precedents) -> None:
    """Leave to a person a circle that other input data close."""
    for id_, judgement in judgements.items():
        if judgement.paid > 0 and grounds.hidden & set(judgement.item.nodes):
            judgements[id_] = replace(judgement, verdict=UNKNOWN, paid=0.0, reason=_ROUND_ELSEWHERE)


def without_ground(judgements: Judgements, grounds: Precedents) -> None:
    """Blanks and circles pass nothing on: what rests on them is no result."""
    student, void = grounds.student, set(grounds.circular - grounds.right)
    for judgement in judgements.values():
        void.update(node for node in judgement.item.nodes if is_void(student, node))
    if not void:
        return
    resting = resting_on(student, frozenset(void))
    names = {node: j.item for j in judgements.values() for node in j.item.nodes}
    for id_, judgement in judgements.items():
        nodes = set(judgement.item.nodes)
        if not nodes & resting or nodes & void or judgement.paid <= 0:
            continue
        under = _reached(nodes, void, resting, student) or void
        roots = sorted({names[n].id for n in under if n in names})[:4]
        kinds = {_ON_CIRCLE if n in grounds.circular else _ON_BLANK for n in under}
        why = "опирается на " + " или ".join(sorted(kinds))
        judgements[id_] = replace(judgement, verdict=GROUNDLESS, paid=0.0, origins=tuple(roots),
                                  reason=why)  # fmt: skip


def _hidden_circles(
    judgements: Mapping[str, Judgement], student: StudentBook, response: FormulaResponse
) -> frozenset[str]:
    """Nodes that go round in a circle for other engines, though each alone is right for some.

    A formula that holds for some of them only is not paid, but it may still close a circle:
    which of the engines it fails for is a matter of what was drawn.
    """
    items = {
        node: j.item for j in judgements.values() for node in j.item.nodes if student.runs(node)
    }
    paid = {node for node, item in items.items() if judgements[item.id].paid > 0}
    suspects = rings(student, items)
    if not suspects & paid:
        return frozenset()
    holding = [n for n in suspects if n in paid or response.holds_somewhere(items[n], n)]
    return hidden_circles(student, holding, response.tryout.whole())


def _reached(
    nodes: set[str], void: set[str], resting: frozenset[str], student: StudentBook
) -> set[str]:
    """Return the blanks and circles nearest to some nodes, by way of what rests on them too."""
    nearest: set[str] = set()
    seen = set(nodes)
    stack = list(nodes)
    while stack:
        for name in through(student, stack.pop()) & resting:
            if name in void:
                nearest.add(name)
            elif name not in seen:
                seen.add(name)
                stack.append(name)
    return nearest


def backwards(judgements: Judgements, grounds: Precedents) -> None:
    """Nothing is earned by going back from what was typed in, given or is not calculated.

    A column that the textbook's way leads to must not be where its own values come from,
    unless it is calculated itself.
    """
    student, response = grounds.student, grounds.response
    owner = {node: j.item.id for j in judgements.values() for node in j.item.nodes}
    live = student.assignment.live_nodes
    changed = True
    while changed:
        changed = False
        suspects: dict[tuple[str, str], list[str]] = {}
        for judgement in judgements.values():
            if judgement.paid <= 0:
                continue
            ancestors = student.assignment.ancestors(judgement.item)
            for node in filter(student.runs, judgement.item.nodes):
                for name in student.precedents(node) - ancestors - set(judgement.item.nodes):
                    source = judgements.get(owner.get(name, ""))
                    verdict = STILL if name in live else _going_back(judgement, source, student)
                    if verdict:
                        suspects.setdefault((name, verdict), []).append(node)
        for (name, verdict), nodes in sorted(suspects.items()):
            depends = response.shaking.depending(nodes, name) if response.trials else {}
            for node in nodes:
                judgement = judgements[owner[node]]
                if depends.get(node) and judgement.paid > 0:
                    judgements[judgement.item.id] = replace(
                        judgement, verdict=verdict, paid=0.0, rows=(),
                        origins=(owner[name],) if name in owner else (),
                        reason=_TAKEN if name in live else _BACK[verdict],
                    )  # fmt: skip
                    changed = True


def _going_back(judgement: Judgement, source: Judgement | None, student: StudentBook) -> str:
    """Return the verdict on an item whose formulas take a later column, empty where they may.

    What was not calculated at all gives nothing.  A formula that is wrong may be a mistake of
    one who knew another way: a person sees whether there is one.
    """
    if source is None or source.verdict in (RIGHT, CARRIED):
        return ""
    half = len(source.values) / 2
    numbers = len(source.rows if source.verdict == TYPED else source.typed) >= half
    nothing = source.verdict in (EMPTY, GROUNDLESS) and source.paid <= 0
    if source.verdict == STILL or (numbers and source.verdict != UNKNOWN) or nothing:
        return STILL
    later = student.assignment.ancestors(source.item)
    return "" if later.isdisjoint(judgement.item.nodes) else UNKNOWN


def carried(judgements: Judgements, grounds: Precedents) -> None:
    """Right formulas on earlier values that are wrong name the columns these came from.

    Roundings on the way, and values that are not known, are nobody's mistake.
    """
    student = grounds.student
    owner = {node: j.item.id for j in judgements.values() for node in j.item.nodes}
    wrong: set[str] = set()
    off: dict[str, tuple[int, ...]] = {}
    feeding: dict[str, list[str]] = {}
    for id_, judgement in judgements.items():
        allowed = tolerance(judgement.item, judgement.expected, student)
        good = close(
            judgement.item, judgement.values, judgement.expected, allowed, student.expected
        )
        if good.all() or judgement.verdict == UNKNOWN:
            continue
        if judgement.verdict != RIGHT:
            wrong.add(id_)
        elif not np.isnan(judgement.expected).all():
            off[id_] = tuple(np.flatnonzero(~good).tolist())
            feeding[id_] = _earlier(judgement, owner, student)
    moved: set[str] = set()
    while more := {n for n in off.keys() - moved if not (wrong | moved).isdisjoint(feeding[n])}:
        moved |= more
    for id_ in moved:
        guilty = [n for n in feeding[id_] if n in wrong] or [n for n in feeding[id_] if n in moved]
        judgements[id_] = replace(
            judgements[id_],
            verdict=CARRIED,
            rows=off[id_],
            origins=tuple(guilty[:4]),
            precedents=_names(judgements[id_], student),
        )


def _names(judgement: Judgement, student: StudentBook) -> frozenset[str]:
    return frozenset().union(*(student.precedents(node) for node in judgement.item.nodes))


def _earlier(judgement: Judgement, owner: Mapping[str, str], student: StudentBook) -> list[str]:
    """Items that a formula reads, by way of given formulas too."""
    names, graph = _names(judgement, student), student.assignment.graph
    feeding = sorted({owner[n] for n in names if n in owner} - {judgement.item.id})
    for name in sorted(names & student.assignment.live_nodes):
        feeding += sorted({owner[n] for n in graph.ancestors(name) if n in owner} - set(feeding))
    return feeding


@dataclass(frozen=True, slots=True)
class GroundRule:
    """A change of verdicts by what they rest on."""

    name: str
    apply: Callable[[Judgements, Precedents], None]


GROUND_RULES = (
    GroundRule("circle", on_circles),
    GroundRule("circle with other input data", on_hidden_circles),
    GroundRule("no ground", without_ground),
    GroundRule("backwards", backwards),
    GroundRule("carried", carried),
)
