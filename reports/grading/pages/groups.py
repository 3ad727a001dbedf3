"""Works that wait for the same reason, so that one decision serves them all."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from reports.grading.judging.collusion import Ring
from reports.grading.judging.judgement import PART, UNKNOWN, part_remark, unread_remark
from reports.grading.judging.work_digest import Work

_PARTS = part_remark(())  # each student has points of his own
NAME = re.compile(r"Г-[0-9A-F]{6}")
_NUMBERS = re.compile(r"\d+([.,]\d+)?")


@dataclass(frozen=True, slots=True)
class WaitingGroup:
    """Works that one decision can serve; ``item`` is empty where it is about the whole work."""

    name: str
    item: str
    what: str
    why: str
    formula: str
    of: float
    numbers: tuple[int, ...]
    students: tuple[str, ...]
    points: tuple[float | None, ...] = ()  # of each, as the program has them


def groups_of(
    counted: Mapping[int, Work], held: Mapping[str, Sequence[str]], rings: Sequence[Ring],
    maximum: float,
) -> list[WaitingGroup]:  # fmt: skip
    """Groups of the works that count, the largest first; what is decided waits for nobody."""
    members: dict[tuple[str, str], list[Work]] = {}
    labels: dict[tuple[str, str], tuple[str, str, str, float]] = {}
    for _, work in sorted(counted.items()):
        if work.decision is not None:
            continue
        decided = {entry["item"] for entry in work.decisions}
        marks = {trait[1]: trait[2] for trait in work.traits}
        for line in work.items:
            if line.verdict != UNKNOWN or line.id in decided or line.block == PART:
                continue
            spelt = line.formula[0] if line.formula else line.sample
            key = line.id, f"{marks.get(line.id, spelt)} {line.reason}"
            members.setdefault(key, []).append(work)
            labels.setdefault(key, (line.label, line.reason, line.sample, line.of))
        for words, why in _whole(work, held.get(work.key, ()), rings):
            members.setdefault(("", words), []).append(work)
            labels.setdefault(("", words), ("вся работа", why, "", maximum))
    groups = [
        WaitingGroup(_name(key), key[0], *labels[key], tuple(work.number or 0 for work in works),
              tuple(work.student for work in works), tuple(work.points for work in works))
        for key, works in members.items()
    ]  # fmt: skip
    return sorted(groups, key=lambda group: (-len(group.numbers), group.what, group.name))


def _whole(work: Work, doubts: Sequence[str], rings: Sequence[Ring]) -> list[tuple[str, str]]:
    """What a person has to say about a whole work: words that are the same for a group, and why."""
    # Of its items each is asked about for itself.
    unknown = [line for line in work.items if line.verdict == UNKNOWN]
    unread = unread_remark([line.label for line in unknown if line.block != PART])
    reasons = [text for text in work.manual if text != unread and not text.startswith(_PARTS)]
    texts = dict.fromkeys([*doubts, *reasons])
    lines = []
    for ring in rings:
        if ring.held and work in ring.works:
            for text in [text for text in texts if text == ring.text(work)]:
                del texts[text]
            lines.append((" ".join(sorted(one.key for one in ring.works)), ring.text()))
    return [*lines, *((_NUMBERS.sub("#", text), text) for text in texts)]


def _name(key: tuple[str, str]) -> str:
    return f"Г-{hashlib.sha256(repr(key).encode()).hexdigest()[:6].upper()}"
