"""Marks by which the works of a class are compared: the same for what is alike."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from typing import Any

import numpy as np

from reports.grading.issuing.assignment import Item
from reports.grading.reading.student import Student

_TELLING = 6  # tokens of a formula that may tell who wrote it


def formula_marks(student: Student) -> dict[str, list[Any]]:
    """Item → a mark of its formula and whether it has a step that does nothing."""
    found: dict[str, list[Any]] = {}
    for item in student.assignment.items:
        runs = [run for node in item.nodes for run in student.runs(node)]
        if not runs or len(runs) > 2 * len(item.nodes) or any(r.formula is None for r in runs):
            continue
        patterns = [run.formula.pattern for run in runs if run.formula is not None]
        if max(map(len, patterns)) >= _TELLING:
            text = "\n".join("".join(value for _, value in tokens) for tokens in patterns)
            mark = hashlib.sha256(text.encode()).hexdigest()[:12]
            found[item.id] = [mark, any(map(is_odd, patterns))]
    return found


def fingerprint(item: Item, values: np.ndarray[Any, np.dtype[np.float64]]) -> str:
    """The same for values that print alike, whatever the book: for the signals of similarity."""
    finite = values[np.isfinite(values)]
    if not finite.size or (item.is_column and np.unique(finite).size < 4):
        return ""  # zeros and constants are alike by themselves
    printed = np.round(values, item.quantity.digits.decimals) + 0.0
    return hashlib.sha256(printed.tobytes()).hexdigest()[:16]


def is_odd(tokens: Sequence[tuple[str, str]]) -> bool:
    """Whether a formula has a step that does nothing: ``+0``, ``*1``, ``A6-A6``."""
    text = ["" if kind == "space" else value for kind, value in tokens]
    around = [("op", "("), *tokens, ("op", ")")]
    for before, sign, (kind, value), after in zip(
        around, around[1:], around[2:], around[3:], strict=False
    ):
        if kind == "number" and sign[0] == "op":
            nothing = sign[1] in ("+", "-") and float(value) == 0 and before[1] not in "(,"
            same = sign[1] in ("*", "/", "^") and float(value) == 1
            if (nothing or same) and after[1] not in ("^", "*", "/", ":"):
                return True
            if same and after[1] in ("*", "/"):
                return True
    return any(
        text[i + 1] == "-" and text[i] == text[i + 2] and tokens[i][0] in ("ref", "name")
        for i in range(len(text) - 2)
    )
