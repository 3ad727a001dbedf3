"""Works that may have a common origin: for the instructor's eye, never a verdict.

A signal is shown; a suspicion also stops the points until a person has decided.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations
from typing import Any

Results = Sequence[dict[str, Any]]

_COMMON = {"", "kshm", "openpyxl"}
_FEW = 3  # students who share what the others do not have
_SHARED = 3  # formulas, or columns, from which it is no chance
_WRONG = ("wrong", "typed", "still")


def signals(results: Results) -> list[str]:
    """Signals over all results of a batch, in a fixed order."""
    graded = [result for result in results if result["status"] == "graded"]
    return [
        *_same_files(results),
        *_same_values(graded),
        *(text for _, text in _foreign_values(graded)),
        *_same_formulas(graded, odd=False),
        *_same_people(graded),
        *_foreign(results),
    ]


def suspicions(results: Results) -> dict[str, list[str]]:
    """Key of a result → why a person has to decide before it gives points."""
    graded = [result for result in results if result["status"] == "graded"]
    found: dict[str, list[str]] = {r["key"]: list(r["doubts"]) for r in results if r.get("doubts")}
    for group, shared in _sharing(graded, odd=True):
        for result in group:
            others = ", ".join(_who(other) for other in group if other is not result)
            text = f"те же необычные формулы, что у: {others} — {_named(shared, result)}"
            found.setdefault(result["key"], []).append(text)
    for result, text in _foreign_values(graded):
        found.setdefault(result["key"], []).append(text)
    for group in _file_groups(results):
        if len({r.get("number") for r in group}) > 1:
            for result in group:
                others = ", ".join(_who(other) for other in group if other is not result)
                found.setdefault(result["key"], []).append(f"тот же файл сдан: {others}")
    return found


def _who(result: dict[str, Any]) -> str:
    name = result.get("student")
    return f"{name} ({result['file']})" if name else str(result["file"])


def _named(items: Sequence[str], result: dict[str, Any], limit: int = 3) -> str:
    """Items as the student's page calls them."""
    labels = {line["id"]: line.get("label", line["id"]) for line in result["items"]}
    more = f" и ещё {len(items) - limit}" if len(items) > limit else ""
    return ", ".join(labels[item] for item in items[:limit]) + more


def _groups(pairs: list[tuple[str, dict[str, Any]]]) -> dict[str, list[dict[str, Any]]]:
    found: dict[str, list[dict[str, Any]]] = {}
    for key, result in pairs:
        found.setdefault(key, []).append(result)
    return {
        key: group
        for key, group in sorted(found.items())
        if len({result.get("number") or result["key"] for result in group}) > 1
    }


def _file_groups(results: Results) -> list[list[dict[str, Any]]]:
    found: dict[str, list[dict[str, Any]]] = {}
    for result in results:
        if result.get("sha256"):
            found.setdefault(result["sha256"], []).append(result)
    return [group for _, group in sorted(found.items()) if len(group) > 1]


def _same_files(results: Results) -> list[str]:
    return [
        "одинаковые файлы: " + ", ".join(_who(result) for result in group)
        for group in _file_groups(results)
    ]


def _same_values(graded: Results) -> list[str]:
    """The same wrong values where the right ones differ, pair by pair."""
    rights = {line["right_mark"] for r in graded for line in r["items"] if line.get("right_mark")}
    by_mark: dict[tuple[str, str], list[tuple[str, dict[str, Any]]]] = {}
    for result in graded:
        for line in result["items"]:
            mark = line.get("mark")
            if mark and line["of"] > 0 and mark not in rights and _is_wrong(line):
                by_mark.setdefault((line["id"], mark), []).append((line["right_mark"], result))
    pairs: dict[tuple[str, str], list[str]] = {}
    for (item, _), group in sorted(by_mark.items()):
        if len(group) > _FEW:  # a usual mistake
            continue
        for (right, first), (other, second) in combinations(group, 2):
            if right != other and first["number"] != second["number"]:
                names = sorted((_who(first), _who(second)))
                pairs.setdefault((names[0], names[1]), []).append(item)
    return [
        f"одинаковые неверные значения при разных вариантах: {first} и {second} — "
        f"{len(items)} (например, {', '.join(items[:3])})"
        for (first, second), items in sorted(
            pairs.items(), key=lambda pair: (-len(pair[1]), pair[0])
        )
    ][:200]


def _is_wrong(line: dict[str, Any]) -> bool:
    return line.get("verdict", "wrong") in _WRONG


def _foreign_values(graded: Results) -> list[tuple[dict[str, Any], str]]:
    """Wrong values that are the right ones of another's variant; he did nothing."""
    owners: dict[tuple[str, str], list[dict[str, Any]]] = {}
    for result in graded:
        for line in result["items"]:
            if line.get("right_mark"):
                owners.setdefault((line["id"], line["right_mark"]), []).append(result)
    found = []
    for result in graded:
        sources: dict[str, list[str]] = {}
        for line in result["items"]:
            mark = line.get("mark")
            if not mark or mark == line.get("right_mark") or not _is_wrong(line):
                continue
            for owner in owners.get((line["id"], mark), ())[:_FEW]:
                if owner["number"] != result["number"]:
                    sources.setdefault(_who(owner), []).append(line["id"])
        for name, items in sorted(sources.items()):
            if len(items) >= _SHARED:
                text = f"значения верны для чужого варианта: {name} — {_named(items, result)}"
                found.append((result, f"{_who(result)}: {text}"))
    return found


def _sharing(graded: Results, *, odd: bool) -> list[tuple[list[dict[str, Any]], list[str]]]:
    """Few students with the same formulas that no one else has, and these formulas' items."""
    by_mark: dict[tuple[str, str], list[dict[str, Any]]] = {}
    for result in graded:
        for item, (mark, strange) in result.get("formulas", {}).items():
            if strange or not odd:
                by_mark.setdefault((item, mark), []).append(result)
    shared: dict[tuple[str, ...], list[str]] = {}
    known = {result["key"]: result for result in graded}
    for (item, _), group in sorted(by_mark.items()):
        if 1 < len({r["number"] for r in group}) <= _FEW:
            keys = tuple(sorted(result["key"] for result in group))
            shared.setdefault(keys, []).append(item)
    return [
        ([known[key] for key in keys], items)
        for keys, items in sorted(shared.items())
        if len(items) >= _SHARED
    ]


def _same_formulas(graded: Results, *, odd: bool) -> list[str]:
    if len({result["number"] for result in graded}) <= 2 * _FEW:
        return []  # in a small class nothing is rare
    return [
        "те же формулы, каких нет у других: "
        + ", ".join(map(_who, group))
        + f" — {_named(items, group[0])}"
        for group, items in _sharing(graded, odd=odd)
    ]


def _same_people(graded: Results) -> list[str]:
    pairs = []
    for result in graded:
        name = result.get("properties", {}).get("lastModifiedBy", "").strip()
        if name.casefold() not in _COMMON:
            pairs.append((name, result))
    return [
        f"файлы последним сохранил «{name}»: " + ", ".join(_who(result) for result in group)
        for name, group in _groups(pairs).items()
    ]


def _foreign(results: Results) -> list[str]:
    found = []
    for result in results:
        for text in result["manual"]:
            if "идентификатор" in text:
                found.append(f"{_who(result)}: {text}")
    return found
