"""[[checks.accepted]]: what is named there exists and has a reason, and silences its own line."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from typing import Any, TypeVar

from reports.inputs.fields import key_text
from reports.inputs.findings import Finding, Values
from reports.inputs.messages import likely_word, shown
from reports.inputs.meta import hints
from reports.inputs.registry import SECTIONS, records
from reports.inputs.sections.checks import CHECKS, Accepted
from reports.shared.errors import Problem

Keys = frozenset[str]
Entry = TypeVar("Entry", bound=tuple[Any, ...])  # begins with a path
_REGIME = re.compile(r"(?P<check>\w+?)_R[0-9]+")


def accepted_keys(entries: Iterable[Accepted]) -> Keys:
    """What is accepted: checks and keys."""
    return frozenset(entry.what for entry in entries)


def apart(entries: Iterable[Entry], accepted: Keys) -> list[list[Entry]]:
    """Entries by their path in groups of a line each: accepted ones alone, the rest together."""
    groups, rest = list[list[Entry]](), list[Entry]()
    for entry in entries:
        if key_text(entry[0]) in accepted:
            groups.append([entry])
        else:
            rest.append(entry)
    return [rest, *groups] if rest else groups


def explained(
    warnings: Iterable[tuple[str, Problem]], entries: Iterable[Accepted]
) -> tuple[list[Problem], list[tuple[Problem, str]]]:
    """What is odd and what of it has a reason: an entry silences one line of its key."""
    reasons: dict[str, list[str]] = {}
    for entry in entries:
        reasons.setdefault(entry.what, []).append(entry.reason)
    odd, taken = list[Problem](), list[tuple[Problem, str]]()
    for key, problem in warnings:
        if reasons.get(key):
            taken.append((problem, reasons[key].pop(0)))
        else:
            odd.append(problem)
    return odd, taken


def check_accepted(values: Values) -> Iterator[Finding]:
    """Yield what is no check and no key, and what has no reason."""
    entries: Sequence[Accepted] = values.get("checks", "accepted") or ()
    for index, entry in enumerate(entries):
        path = ("checks", "accepted", index)
        if not _known(entry.what):
            what = f"нет проверки или ключа {shown(entry.what)}"
            likely = likely_word(entry.what, (*CHECKS, *_keys()))
            hint = f"возможно, {likely}" if likely else "проверки: " + ", ".join(CHECKS)
            yield Finding((*path, "what"), what, hint)
        if not entry.reason.strip():
            what = "причина не названа"
            yield Finding((*path, "reason"), what, "напишите, почему это верно")


def _known(name: str) -> bool:
    regime = _REGIME.fullmatch(name)
    if (regime["check"] if regime else name) in CHECKS:
        return True
    plain = re.sub(r"\[[0-9]+\]", "", name).removeprefix("regimes.")
    return plain in _keys() or plain in SECTIONS or f"regime.{plain}" in _keys()


def _keys() -> set[str]:
    """Every key of the file, the numbers of lists left out."""
    keys = set()
    for section in SECTIONS.values():
        for model in section.models:
            keys |= {f"{section.name}.{key}" for key in hints(model)}
            for key, inner in records(model):
                keys |= {f"{section.name}.{key}.{name}" for name in hints(inner)}
    return keys
