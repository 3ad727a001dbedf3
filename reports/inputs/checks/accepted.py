"""Checks of [[checks.accepted]]: what is named there exists and has a reason."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from reports.inputs.findings import Finding, Values
from reports.inputs.messages import likely_word, shown
from reports.inputs.meta import hints
from reports.inputs.registry import SECTIONS, records
from reports.inputs.sections.checks import CHECKS, Accepted

_REGIME = re.compile(r"(?P<check>\w+?)_R[0-9]+")


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
