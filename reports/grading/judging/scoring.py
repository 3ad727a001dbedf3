"""Points of a work: the sum of its lines, conditions and lateness."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime, timedelta
from fnmatch import fnmatchcase
from typing import Any

from reports.grading.issuing.rubric import Rubric
from reports.grading.judging.judgement import CARRIED, EMPTY, PART, RIGHT
from reports.grading.reading.submissions import CLOCKS, MOODLE
from reports.shared.russian import short

Result = dict[str, Any]


@dataclass(frozen=True, slots=True)
class HandedIn:
    """Time of submission, its clock, the student's own deadline or extension."""

    time: datetime | None = None
    clock: str = MOODLE
    extension: str = ""


def score(result: Result, rubric: Rubric, handed: HandedIn) -> None:
    """Set the points of a result: the sum of its lines less what is withheld."""
    lines = result["items"]
    paid = [line for line in lines if line["of"] > 0 and line.get("block") != PART]
    result["filled"] = _filled(paid)
    result["maximum"] = rubric.maximum
    result["enough"] = result["filled"] >= rubric.minimum.filled
    if not result["enough"]:
        result["notes"].append(
            f"заполнено {result['filled']:.0%} при наименьшем {rubric.minimum.filled:.0%}: 0 баллов"
        )
    _withhold(result, paid, rubric)
    _take_lateness(result, rubric, handed)
    rescored(result)


def _filled(lines: list[dict[str, Any]]) -> float:
    filled = [line for line in lines if line["verdict"] != EMPTY]
    return round(len(filled) / len(lines), 4) if lines else 0.0


def _withhold(result: Result, paid: list[dict[str, Any]], rubric: Rubric) -> None:
    """Withhold the points of tables hardly begun and of items that need others."""
    for table, least in rubric.minimum.tables.items():
        lines_of = [line for line in paid if fnmatchcase(line["block"], table)]
        share = _filled(lines_of)
        if lines_of and share < least:
            name = lines_of[0]["heading"]
            text = f"{name}: заполнено {share:.0%} при наименьшем {least:.0%}, баллов за неё нет"
            result["notes"].append(text)
            for line in lines_of:
                line["points"] = 0.0
    for pattern, needed in rubric.needs.items():
        missing = [
            line["label"]
            for line in result["items"]
            if _is(line, needed) and line["verdict"] not in (RIGHT, CARRIED)
        ]
        for line in paid if missing else ():
            if _is(line, (pattern,)) and line["points"] and not _is(line, needed):
                line["points"] = 0.0
                line["needs"] = missing[:4]


def _is(line: Mapping[str, Any], patterns: tuple[str, ...]) -> bool:
    names = (line["id"], line["block"])
    return any(fnmatchcase(name, pattern) for name in names for pattern in patterns)


def rescored(result: Result) -> None:
    """Sum the points of a result's lines, a person's corrections included."""
    raw = min(sum(line["points"] for line in result["items"]), result["maximum"])
    result["raw"] = round(raw, 2)
    result["points"] = round(raw * result["late"], 2) if result["enough"] else 0.0


# --- lateness ------------------------------------------------------------------------------------


def _take_lateness(result: Result, rubric: Rubric, handed: HandedIn) -> None:
    """Reduce the points for lateness by the learning system's clock; else ask a person."""
    factor = late_factor(rubric, handed.time, handed.extension)
    result["late"] = factor
    if factor == 1:
        return
    when = f"через {_words(hours_late(rubric, handed.time, handed.extension))} после срока"
    clock = CLOCKS[handed.clock]
    if handed.clock == MOODLE:
        text = f"сдано {when} ({clock}): баллы умножены на {short(factor)}"
        result["notes"].append(text)
        return
    result["late"] = 1.0
    text = f"сдано {when}, если верить копии ({clock}): умножить баллы на {short(factor)}?"
    result["manual"].append(text)


def _words(hours: float) -> str:
    return f"{short(hours, 2)} ч" if hours < 10 else f"{hours:.0f} ч"


def hours_late(rubric: Rubric, time: datetime | None, extension: str = "") -> float:
    """Hours after the deadline, the student's own one where it is later; 0 in time."""
    deadline = rubric.late.deadline
    if deadline is None or time is None:
        return 0.0
    # File times carry no zone: they are the clock of the place where the deadline is meant.
    local = deadline.replace(tzinfo=None)
    if extension.startswith("+"):
        local += timedelta(hours=float(extension))
    elif extension:
        local = max(local, datetime.fromisoformat(extension))
    return max(0.0, (time - local).total_seconds() / 3600)


def late_factor(rubric: Rubric, time: datetime | None, extension: str = "") -> float:
    """Factor of the strictest late rule that applies; without a time none does."""
    hours = hours_late(rubric, time, extension)
    if not hours:
        return 1.0
    if rubric.late.per_day:
        days = max(0, math.ceil(hours / 24) - rubric.late.free_days)
        return max(rubric.late.least, 1 - rubric.late.per_day * days)
    return min(
        [rule.factor for rule in rubric.late.rules if hours >= rule.after_hours], default=1.0
    )
