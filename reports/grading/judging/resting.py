"""What the verdict on an item rests on: blanks, circles, typed numbers, earlier mistakes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

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
)
from reports.grading.judging.response import Response
from reports.grading.judging.tolerances import close, tolerance
from reports.grading.reading.ground import (
    calculated,
    circles,
    hidden_circles,
    is_void,
    resting_on,
    rings,
    through,
)
from reports.grading.reading.student import Student

_ROUND = "круговая ссылка: величина считается через саму себя"
_ROUND_HERE = "круговая ссылка, а верные числа сохранены: поиск во всём столбце или вставка?"
_ROUND_ELSEWHERE = "при других исходных данных круговая ссылка: величина считается через себя"
_TAKEN = "взято из готовой таблицы, а не рассчитано"
_ON_CIRCLE, _ON_BLANK = "круговую ссылку", "незаполненное"
_BACK = {
    STILL: "получено из чисел, а не рассчитано",
    UNKNOWN: "получено назад из столбца, который сам не рассчитан верно: есть ли другой путь?",
}


def without_ground(found: dict[str, Judgement], student: Student, response: Response) -> None:
    """Blanks and circles pass nothing on: what rests on them is no result."""
    round_ = circles(student)
    held = calculated(student, round_)
    hidden = _hidden_circles(found, student, response) - round_
    for id_, judgement in found.items():
        at = round_ & set(judgement.item.nodes)
        if at and judgement.verdict != UNKNOWN:
            verdict, reason = (UNKNOWN, _ROUND_HERE) if at <= held else (BROKEN, _ROUND)
            rows = tuple(range(len(judgement.values)))
            found[id_] = replace(judgement, verdict=verdict, rows=rows, paid=0.0, reason=reason)
    for id_, judgement in found.items():
        if judgement.paid > 0 and hidden & set(judgement.item.nodes):
            found[id_] = replace(judgement, verdict=UNKNOWN, paid=0.0, reason=_ROUND_ELSEWHERE)
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
        under = _reached(nodes, void, resting, student) or void
        roots = sorted({names[n].id for n in under if n in names})[:4]
        kinds = {_ON_CIRCLE if n in round_ else _ON_BLANK for n in under}
        why = "опирается на " + " или ".join(sorted(kinds))
        found[id_] = replace(judgement, verdict=GROUNDLESS, paid=0.0, origins=tuple(roots),
                             reason=why)  # fmt: skip


def _hidden_circles(
    found: Mapping[str, Judgement], student: Student, response: Response
) -> frozenset[str]:
    """Nodes that go round in a circle for other engines, though each alone is right for some.

    A formula that holds for some of them only is not paid, but it may still close a circle:
    which of the engines it fails for is a matter of what was drawn.
    """
    items = {node: j.item for j in found.values() for node in j.item.nodes if student.runs(node)}
    paid = {node for node, item in items.items() if found[item.id].paid > 0}
    suspects = rings(student, items)
    if not suspects & paid:
        return frozenset()
    holding = [n for n in suspects if n in paid or response.holds_somewhere(items[n], n)]
    return hidden_circles(student, holding, response.tryout.whole())


def _reached(
    nodes: set[str], void: set[str], resting: frozenset[str], student: Student
) -> set[str]:
    """The blanks and circles nearest to some nodes, by way of what rests on them too."""
    found: set[str] = set()
    seen = set(nodes)
    stack = list(nodes)
    while stack:
        for name in through(student, stack.pop()) & resting:
            if name in void:
                found.add(name)
            elif name not in seen:
                seen.add(name)
                stack.append(name)
    return found


def backwards(found: dict[str, Judgement], student: Student, response: Response) -> None:
    """Nothing is earned by going back from what was typed in, given or is not calculated.

    A column that the textbook's way leads to must not be where its own values come from,
    unless it is calculated itself.
    """
    owner = {node: j.item.id for j in found.values() for node in j.item.nodes}
    live = student.assignment.live_nodes
    changed = True
    while changed:
        changed = False
        suspects: dict[tuple[str, str], list[str]] = {}
        for judgement in found.values():
            if judgement.paid <= 0:
                continue
            ancestors = student.assignment.ancestors(judgement.item)
            for node in filter(student.runs, judgement.item.nodes):
                for name in student.precedents(node) - ancestors - set(judgement.item.nodes):
                    source = found.get(owner.get(name, ""))
                    verdict = STILL if name in live else _going_back(judgement, source, student)
                    if verdict:
                        suspects.setdefault((name, verdict), []).append(node)
        for (name, verdict), nodes in sorted(suspects.items()):
            depends = response.shaking.depending(nodes, name) if response.trials else {}
            for node in nodes:
                judgement = found[owner[node]]
                if depends.get(node) and judgement.paid > 0:
                    found[judgement.item.id] = replace(
                        judgement, verdict=verdict, paid=0.0, rows=(),
                        origins=(owner[name],) if name in owner else (),
                        reason=_TAKEN if name in live else _BACK[verdict],
                    )  # fmt: skip
                    changed = True


def _going_back(judgement: Judgement, source: Judgement | None, student: Student) -> str:
    """The verdict on an item whose formulas take a later column, empty where they may.

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


def carried(found: dict[str, Judgement], student: Student) -> None:
    """Right formulas on earlier values that are wrong name the columns these came from.

    Roundings on the way, and values that are not known, are nobody's mistake.
    """
    owner = {node: j.item.id for j in found.values() for node in j.item.nodes}
    wrong: set[str] = set()
    off: dict[str, tuple[int, ...]] = {}
    near: dict[str, list[str]] = {}
    for id_, judgement in found.items():
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
            near[id_] = _earlier(judgement, owner, student)
    moved: set[str] = set()
    while more := {n for n in off.keys() - moved if not (wrong | moved).isdisjoint(near[n])}:
        moved |= more
    for id_ in moved:
        guilty = [n for n in near[id_] if n in wrong] or [n for n in near[id_] if n in moved]
        found[id_] = replace(found[id_], verdict=CARRIED, rows=off[id_], origins=tuple(guilty[:4]),
                             precedents=_names(found[id_], student))  # fmt: skip


def _names(judgement: Judgement, student: Student) -> frozenset[str]:
    return frozenset().union(*(student.precedents(node) for node in judgement.item.nodes))


def _earlier(judgement: Judgement, owner: Mapping[str, str], student: Student) -> list[str]:
    """Items that a formula reads, by way of given formulas too."""
    names, graph = _names(judgement, student), student.assignment.graph
    near = sorted({owner[n] for n in names if n in owner} - {judgement.item.id})
    for name in sorted(names & student.assignment.live_nodes):
        near += sorted({owner[n] for n in graph.ancestors(name) if n in owner} - set(near))
    return near
