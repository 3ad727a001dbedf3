"""Lists of numbers in the guise of formulas, and columns that are read from such lists."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

from reports.grading.reading.student import Student
from reports.recalculation.formulas import Formula
from reports.recalculation.grid import Run

_ALIKE = 3  # formulas that differ in nothing but their numbers, to be a list of numbers
_MANY = 8  # long numbers in one formula, to be a list of numbers
_CASES = 5  # numbers among which a formula chooses, or cases that it tells apart
_SHORT = 3  # digits of a number that may be chosen so
_DIGITS = 20  # of a text that is a list
_LONG = 5  # digits of a number that nobody knows by heart
_TYPED = 4  # digits, the comma with them, of a number in a list that is read; angles have fewer


def reads_a_list(student: Student, node: str) -> bool:
    """Whether a column is made of a column of numbers typed in beside the tables."""
    if listed(student.helpers(node)):
        return True
    read = student.own_numbers(node)
    long = {v for v in read if _digits(f"{v!r}") + (not v.is_integer()) >= _TYPED}
    return len(long) >= _ALIKE and len(read) >= student.assignment.length(node) // 2


def listed(runs: Sequence[Run]) -> set[int]:
    """Runs that are a list of numbers, by ``id``: alike but for them, or full of them."""
    alike: dict[tuple[tuple[str, str], ...], list[Run]] = {}
    found = set()
    for run in runs:
        if run.formula is None:
            continue
        alike.setdefault(_skeleton(run.formula), []).append(run)
        if _long_numbers(run.formula) >= _MANY or _chooses(run.formula):
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


@lru_cache(maxsize=20_000)
def _chooses(formula: Formula) -> bool:
    """Whether a formula picks its value out of many, whatever they are called: CHOOSE, IF, {}."""
    tokens = [token for token in formula.pattern if token[0] != "space"]
    signless = [t for i, t in enumerate(tokens)
                if t != ("op", "-") or (i and tokens[i - 1] not in _BEFORE)]  # fmt: skip
    arguments = sum(
        kind == "number" and _digits(value) >= _SHORT and before in _BEFORE and after in _AFTER
        for before, (kind, value), after in zip(signless, signless[1:], signless[2:], strict=False)
    )
    texts = (value for kind, value in tokens if kind == "text")
    return (
        arguments >= _CASES
        or tokens.count(("op", "=")) >= _CASES
        or any(sum(map(str.isdigit, text)) >= _DIGITS for text in texts)
    )


_BEFORE = frozenset(("op", sign) for sign in "(,;{")
_AFTER = frozenset(("op", sign) for sign in "),;}")


def _digits(number: str) -> int:
    """Digits of a number that say anything."""
    return len(number.partition("e")[0].lstrip("-").replace(".", "").strip("0"))
