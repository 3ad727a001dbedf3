"""Works that may have a common origin: for the instructor's eye, never a verdict.

A signal is shown; a suspicion also stops the points until a person has decided.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

from reports.grading.judging.collusion import Ring, who
from reports.grading.judging.work_digest import Work, is_verbatim

Works = Sequence[Work]

_COMMON = {"", "kshm", "openpyxl"}
_FEW = 3  # owners of a value that are named
_SHARED = 3  # formulas, or columns, from which it is no chance


def signals(results: Works, rings: Sequence[Ring] = ()) -> list[str]:
    """Signals over all results of a batch, in a fixed order."""
    graded = [result for result in results if result.status == "graded"]
    return [
        *_same_files(results),
        *_same_values(graded),
        *(text for _, text in _foreign_values(graded)),
        *(ring.text() for ring in rings if not ring.held),
        *_of_the_program(graded),
        *_same_people(graded),
        *_foreign(results),
    ]


def suspicions(results: Works, rings: Sequence[Ring] = ()) -> dict[str, list[str]]:
    """Key of a result → why a person has to decide before it gives points."""
    graded = [result for result in results if result.status == "graded"]
    reasons: dict[str, list[str]] = {r.key: list(r.doubts) for r in results if r.doubts}
    for ring in rings:
        for result in ring.works if ring.held else ():
            reasons.setdefault(result.key, []).append(ring.text(result))
    for result, text in _foreign_values(graded):
        reasons.setdefault(result.key, []).append(text)
    for group in _file_groups(results):
        if len({r.number for r in group}) > 1:
            for result in group:
                others = ", ".join(who(other) for other in group if other is not result)
                reasons.setdefault(result.key, []).append(f"тот же файл сдан: {others}")
    return reasons


def _named(items: Sequence[str], result: Work, limit: int = 3) -> str:
    """Items as the student's page calls them."""
    labels = {line.id: line.label for line in result.items}
    more = f" и ещё {len(items) - limit}" if len(items) > limit else ""
    return ", ".join(labels[item] for item in items[:limit]) + more


def _groups(pairs: list[tuple[str, Work]]) -> dict[str, list[Work]]:
    groups: dict[str, list[Work]] = {}
    for key, result in pairs:
        groups.setdefault(key, []).append(result)
    return {
        key: group
        for key, group in sorted(groups.items())
        if len({result.number or result.key for result in group}) > 1
    }


def _file_groups(results: Works) -> list[list[Work]]:
    groups: dict[str, list[Work]] = {}
    for result in results:
        if result.sha256:
            groups.setdefault(result.sha256, []).append(result)
    return [group for _, group in sorted(groups.items()) if len(group) > 1]


def _same_files(results: Works) -> list[str]:
    return [
        "одинаковые файлы: " + ", ".join(who(result) for result in group)
        for group in _file_groups(results)
    ]


def _same_values(graded: Works) -> list[str]:
    """Return the same wrong values where the right ones differ, pair by pair."""
    by_mark: dict[tuple[str, str], list[tuple[str, Work]]] = {}
    for result in graded:
        for line, right in result.rights:
            if line.mark and line.of > 0:
                by_mark.setdefault((line.id, line.mark), []).append((right, result))
    marks = {mark for _, mark in by_mark}
    rights = {right for r in graded for _, right in r.rights if right in marks}
    pairs: dict[tuple[str, str], list[str]] = {}
    for (item, mark), group in sorted(by_mark.items()):
        if mark in rights or len(group) > _FEW:  # a usual mistake
            continue
        for (right, first), (other, second) in combinations(group, 2):
            if right != other and first.number != second.number:
                names = sorted((who(first), who(second)))
                pairs.setdefault((names[0], names[1]), []).append(item)
    return [
        f"одинаковые неверные значения при разных вариантах: {first} и {second} — "
        f"{len(items)} (например, {', '.join(items[:3])})"
        for (first, second), items in sorted(
            pairs.items(), key=lambda pair: (-len(pair[1]), pair[0])
        )
    ][:200]


def _foreign_values(graded: Works) -> list[tuple[Work, str]]:
    """Wrong values that are the right ones of another's variant; he did nothing."""
    marks = {(line.id, line.mark) for r in graded for line in r.items if line.mark}
    owners: dict[tuple[str, str], list[Work]] = {}
    for result in graded:
        for line, right in result.rights:
            if (line.id, right) in marks:
                owners.setdefault((line.id, right), []).append(result)
    pairs = []
    for result in graded:
        sources: dict[str, list[str]] = {}
        for line, right in result.rights:
            if not line.mark or line.mark == right:
                continue
            for owner in owners.get((line.id, line.mark), ())[:_FEW]:
                if owner.number != result.number:
                    sources.setdefault(who(owner), []).append(line.id)
        for name, items in sorted(sources.items()):
            if len(items) >= _SHARED:
                text = f"значения верны для чужого варианта: {name} — {_named(items, result)}"
                pairs.append((result, f"{who(result)}: {text}"))
    return pairs


def _of_the_program(graded: Works) -> list[str]:
    """Works with nearly all formulas as the solved book has them."""
    labels = []
    for result in graded:
        formulas = [line.formula[2] for line in result.items if line.formula]
        if is_verbatim(sum(formulas), len(formulas)):
            text = "формулы слово в слово как в книге, решённой программой"
            labels.append(f"{who(result)}: {text} — {sum(formulas)} из {len(formulas)}")
    return labels


def _same_people(graded: Works) -> list[str]:
    pairs = []
    for result in graded:
        if result.saved_by.casefold() not in _COMMON:
            pairs.append((result.saved_by, result))
    return [
        f"файлы последним сохранил «{name}»: " + ", ".join(who(result) for result in group)
        for name, group in _groups(pairs).items()
    ]


def _foreign(results: Works) -> list[str]:
    return [f"{who(result)}: {text}" for result in results for text in result.identity]
