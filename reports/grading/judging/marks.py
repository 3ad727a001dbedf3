"""Marks by which the works of a class are compared: the same for what is alike."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from itertools import groupby
from typing import Any

import numpy as np

from reports.grading.issuing.assignment import Assignment, Item
from reports.grading.reading.restoring import own_formulas
from reports.grading.reading.student import Student
from reports.workbook.layout import Layout

_TELLING = 6  # tokens of a formula that may tell who wrote it


def formula_marks(student: Student, own: Mapping[str, str]) -> dict[str, list[Any]]:
    """Item → a mark of its formula, whether it has a step that does nothing, whether it is ``own``.

    Args:
        student: the work.
        own: item → the mark of the formula that the program writes there.
    """
    found: dict[str, list[Any]] = {}
    for item in student.assignment.items:
        runs = [run for node in item.nodes for run in student.runs(node)]
        if not runs or len(runs) > 2 * len(item.nodes) or any(r.formula is None for r in runs):
            continue
        patterns = [run.formula.pattern for run in runs if run.formula is not None]
        if max(map(len, patterns)) >= _TELLING:
            mark = _mark(patterns)
            found[item.id] = [mark, any(map(is_odd, patterns)), own.get(item.id) == mark]
    return found


def own_marks(assignment: Assignment, layout: Layout) -> dict[str, str]:
    """Item → the mark of the formulas that the program writes there."""
    formulas = own_formulas(assignment, layout, assignment.fill_nodes)
    return {
        item.id: _mark(
            [tokens for node in item.nodes
             for tokens, _ in groupby(formula.pattern for formula in formulas[node])]
        )
        for item in assignment.items
        if all(node in formulas for node in item.nodes)
    }  # fmt: skip


def _mark(patterns: Sequence[Sequence[tuple[str, str]]]) -> str:
    text = "\n".join("".join(value for _, value in tokens) for tokens in patterns)
    return hashlib.sha256(text.encode()).hexdigest()[:12]


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
