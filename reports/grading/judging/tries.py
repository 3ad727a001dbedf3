"""Tries before the deadline: what a student is told of one, and what the teacher of all of them.

A student reads how many columns are right and on which sheet the first mistake is, no more.  Who
changes numbers one by one to see the count rise learns from it what he has not calculated.
"""

from __future__ import annotations

import hashlib
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from typing import Any

from reports.grading.judging.judgement import EMPTY, PART
from reports.grading.judging.work_digest import Work
from reports.grading.reading.student import StudentBook
from reports.shared.russian import plural

Spelling = tuple[str, str]  # digests of an item's formulas without their numbers, of these numbers
_NO_SPELLING: Spelling = ("", "")
_FEW = 2  # items that change between two tries of one who tries values
_AGAIN, _ALONE = 2, 3  # pairs of tries in which the same item changes, in which only one does
_NAMED = 4
_PAID = 1e-6  # points that a sum in floating point may lose


def spellings(student: StudentBook) -> dict[str, Spelling]:
    """Item → what its formulas are, and the numbers that stand in them or in their place."""
    marks = {}
    for item in student.assignment.items:
        shape, numbers = [], []
        for node in item.nodes:
            for run in student.runs(node):
                tokens = run.formula.pattern if run.formula is not None else (("", run.text),)
                shape += [value for kind, value in tokens if kind != "number"]
                numbers += [value for kind, value in tokens if kind == "number"]
            location = student.placement.places.get(node)
            if location is not None:
                typed = student.grid.column(location.sheet, location.column).constants
                numbers += [str(typed[row]) for row in location.rows if row in typed]
        if shape or numbers:
            marks[item.id] = _digest(shape), _digest(numbers)
    return marks


def _digest(parts: Sequence[str]) -> str:
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()[:12]


# --- for the student -----------------------------------------------------------------------------


def words_of_try(result: Mapping[str, Any]) -> str:
    """Return the answer to a try: columns that are right, and the sheet of the first mistake."""
    lines = [line for line in result["items"] if line["of"] > 0 and line["block"] != PART]
    right = sum(line["points"] >= line["of"] - _PAID for line in lines)
    words = f"верно {plural(right, 'столбец', 'столбца', 'столбцов')} из {len(lines)}"
    wrong = [line for line in lines if line["points"] < line["of"] - _PAID]
    mistaken = next((line for line in wrong if line["verdict"] != EMPTY), None)
    if mistaken is not None:
        return f"{words}; первая ошибка на листе {_sheet(mistaken)}"
    return f"{words}; ошибок нет, остальное не заполнено" if wrong else words


def _sheet(line: Mapping[str, Any]) -> str:
    areas = line["where"] or line.get("at") or ()
    return str(areas[0].rpartition("!")[0] if areas else line["heading"])


# --- for the teacher -----------------------------------------------------------------------------


def in_order(works: Sequence[Work]) -> list[Work]:
    """Return the tries of one student by time; a file that was handed in twice is one."""
    ordered = sorted(works, key=lambda work: (work.time, work.key))
    return list({work.sha256 or work.key: work for work in reversed(ordered)}.values())[::-1]


def words_of_all(tries: Sequence[Work], limit: int) -> str:
    """The tries of one student: how many, how they went, whether values were tried one by one."""
    graded = [work for work in tries if work.status == "graded"]
    if not graded:
        return ""
    rights = ", ".join(str(_right(work)) for work in graded)
    columns = sum(entry.of > 0 and entry.block != PART for entry in graded[-1].items)
    text = f"попыток {len(tries)} из {limit}, верно столбцов: {rights} из {columns}"
    probes = probed(graded)
    return f"{text}; подбор значений: {', '.join(probes[:_NAMED])}" if probes else text


def _right(work: Work) -> int:
    paid = (entry for entry in work.items if entry.of > 0 and entry.block != PART)
    return sum(entry.points >= entry.of - _PAID for entry in paid)


def probed(tries: Sequence[Work]) -> list[str]:
    """Labels of the columns in which numbers alone were changed try by try."""
    changes = [set(_changed(*pair)) for pair in pairwise(tries)]
    few = [changed for changed in changes if 0 < len(changed) <= _FEW]
    numbers = [{id_ for id_, is_number in changed if is_number} for changed in few]
    times = Counter(id_ for ids in numbers for id_ in ids)
    again = {id_ for id_, count in times.items() if count >= _AGAIN}
    alone = [
        ids for changed, ids in zip(few, numbers, strict=True) if len(changed) == len(ids) == 1
    ]
    if len(alone) >= _ALONE:
        again |= frozenset().union(*alone)
    labels = {entry.id: entry.label for work in tries for entry in work.items}
    return [labels[id_] for id_ in labels if id_ in again]


def _changed(before: Work, after: Work) -> Iterator[tuple[str, bool]]:
    """Items that were filled in before and are otherwise now, and whether by numbers alone."""
    earlier = {entry.id: entry.spelling for entry in before.items}
    for entry in after.items:
        was = earlier.get(entry.id, _NO_SPELLING)
        if _NO_SPELLING not in (was, entry.spelling) and was != entry.spelling:
            yield entry.id, was[0] == entry.spelling[0]
