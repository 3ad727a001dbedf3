"""Lists of numbers in the guise of formulas, and columns that are read from such lists."""

from __future__ import annotations

from collections.abc import Sequence

from reports.grading.reading.student import Student
from reports.recalculation.formulas import Formula
from reports.recalculation.grid import Run

_ALIKE = 3  # formulas that differ in nothing but their numbers, to be a list of numbers
_MANY = 8  # long numbers in one formula, to be a list of numbers
_LONG = 5  # digits of a number that nobody knows by heart
_TYPED = 4  # digits of a number in a list that is read; angles have fewer


def reads_a_list(student: Student, node: str) -> bool:
    """Whether a column is made of a column of numbers typed in beside the tables."""
    if listed(student.helpers(node)):
        return True
    read = student.own_numbers(node)
    long = {abs(value) for value in read if _digits(f"{value!r}") >= _TYPED}
    return len(long) >= _ALIKE and len(read) >= student.assignment.length(node) // 2


def listed(runs: Sequence[Run]) -> set[int]:
    """Runs that are a list of numbers, by ``id``: alike but for them, or full of them."""
    alike: dict[tuple[tuple[str, str], ...], list[Run]] = {}
    found = set()
    for run in runs:
        if run.formula is None:
            continue
        alike.setdefault(_skeleton(run.formula), []).append(run)
        if _long_numbers(run.formula) >= _MANY:
            found.add(id(run))
    for group in alike.values():
        numbers = {
            tuple(v for kind, v in run.formula.pattern if kind == "number")
            for run in group
            if run.formula is not None
        }
        if len(numbers) >= _ALIKE:
            found |= {id(run) for run in group}
    return found


def _skeleton(formula: Formula) -> tuple[tuple[str, str], ...]:
    return tuple((kind, "") if kind == "number" else (kind, v) for kind, v in formula.pattern)


def _long_numbers(formula: Formula) -> int:
    return len(
        {value for kind, value in formula.pattern if kind == "number" and _digits(value) >= _LONG}
    )


def _digits(number: str) -> int:
    """Digits of a number that say anything."""
    return len(number.partition("e")[0].lstrip("-").replace(".", "").strip("0"))
