"""Signals that works may have a common origin: for the instructor's eye, never a verdict."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

_COMMON = {"", "kshm", "openpyxl"}


def signals(results: Sequence[dict[str, Any]]) -> list[str]:
    """Signals over all results of a batch, in a fixed order."""
    graded = [result for result in results if result["status"] == "graded"]
    return [
        *_same_files(results),
        *_same_values(graded),
        *_same_people(graded),
        *_foreign(results),
    ]


def _who(result: dict[str, Any]) -> str:
    name = result.get("student")
    return f"{name} ({result['file']})" if name else str(result["file"])


def _groups(pairs: list[tuple[str, dict[str, Any]]]) -> dict[str, list[dict[str, Any]]]:
    found: dict[str, list[dict[str, Any]]] = {}
    for key, result in pairs:
        found.setdefault(key, []).append(result)
    return {
        key: group
        for key, group in sorted(found.items())
        if len({result.get("number") or result["key"] for result in group}) > 1
    }


def _same_files(results: Sequence[dict[str, Any]]) -> list[str]:
    pairs = [(result["sha256"], result) for result in results if result.get("sha256")]
    found: dict[str, list[dict[str, Any]]] = {}
    for key, result in pairs:
        found.setdefault(key, []).append(result)
    return [
        "одинаковые файлы: " + ", ".join(_who(result) for result in group)
        for _, group in sorted(found.items())
        if len(group) > 1
    ]


def _same_values(graded: Sequence[dict[str, Any]]) -> list[str]:
    """The same wrong values where the right ones differ, pair by pair."""
    by_mark: dict[tuple[str, str], list[tuple[str, dict[str, Any]]]] = {}
    for result in graded:
        for line in result["items"]:
            if line.get("mark") and line["of"] > 0:
                key = line["id"], line["mark"]
                by_mark.setdefault(key, []).append((line["right_mark"], result))
    pairs: dict[tuple[str, str], list[str]] = {}
    for (item, _), group in sorted(by_mark.items()):
        for i, (right, first) in enumerate(group):
            for other, second in group[i + 1 :]:
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


def _same_people(graded: Sequence[dict[str, Any]]) -> list[str]:
    pairs = []
    for result in graded:
        name = result.get("properties", {}).get("lastModifiedBy", "").strip()
        if name.casefold() not in _COMMON:
            pairs.append((name, result))
    return [
        f"файлы последним сохранил «{name}»: " + ", ".join(_who(result) for result in group)
        for name, group in _groups(pairs).items()
    ]


def _foreign(results: Sequence[dict[str, Any]]) -> list[str]:
    found = []
    for result in results:
        for text in result["manual"]:
            if "идентификатор" in text:
                found.append(f"{_who(result)}: {text}")
    return found
