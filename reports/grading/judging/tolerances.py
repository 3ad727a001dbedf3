"""When two numbers are the same: half a unit of the last digit that the book prints."""

from __future__ import annotations

import ast
from collections.abc import Sequence
from fnmatch import fnmatchcase

import numpy as np
from numpy.typing import NDArray

from reports.formula.numeric import evaluate_tree
from reports.formula.parse import parse
from reports.grading.issuing.assignment import Item
from reports.grading.reading.student import Student
from reports.model.evaluation import Evaluation

Array = NDArray[np.float64]


def tolerance(item: Item, expected: Array, student: Student) -> float:
    """Largest difference that the book's rounding allows.

    Half a unit of the last digit that the book prints, but never more than a small
    share of the column: some quantities are smaller than their printed digits.
    """
    rules = student.assignment.rubric.tolerance
    for pattern, value in rules.items.items():
        if fnmatchcase(item.id, pattern):
            return float(value)
    digits = item.quantity.digits
    unit = 10.0**-digits.decimals
    finite = np.abs(expected[np.isfinite(expected)])
    largest = float(finite.max()) if finite.size else 0.0
    # A double carries about sixteen digits: results that differ in the tenth are equal.
    noise = max(1e-10 * largest, 1e-10 * unit, 1e-12)
    return max(min(rules.units * unit * (1 + 1e-9), rules.share * largest), noise)


def close(
    item: Item, values: Array, expected: Array, allowed: float, run: Evaluation
) -> NDArray[np.bool_]:
    """Where two columns of an engine agree."""
    with np.errstate(invalid="ignore"):
        return np.asarray(apart(item.nodes, values, expected, run) <= allowed)


def apart(nodes: Sequence[str], values: Array, expected: Array, run: Evaluation) -> Array:
    """How far the values of nodes are from what an engine has there.

    Directions are the same again after a turn or a part of it, and nothing has any direction.
    """
    with np.errstate(invalid="ignore", divide="ignore"):
        difference = np.abs(values - expected)
        if run.model.nodes[nodes[0]].quantity.unit != "deg":
            return difference
        every, nothing = _turns(nodes, run)
        turns = np.where(every > 0, np.round(difference / every), 0)
        near = np.abs(difference - turns * every)
        return np.where(nothing & np.isfinite(values), 0.0, near)


def _turns(nodes: Sequence[str], run: Evaluation) -> tuple[Array, NDArray[np.bool_]]:
    """After how many degrees each angle is the same, 0: never; where there is none."""
    every: list[Array] = []
    nothing: list[Array] = []
    for node in nodes:
        spec = run.model.nodes[node]
        tree, none = parse(spec.expr or "0"), parse("0")
        if isinstance(tree, ast.IfExp) and isinstance(tree.body, ast.Constant):
            none = tree.test
        shape = np.shape(run.value(node)) or (1,)
        for found, text in ((every, parse(spec.every)), (nothing, none)):
            with np.errstate(all="ignore"):
                value = evaluate_tree(text, run.values_for(node))
            found.append(np.broadcast_to(value, shape))
    return np.concatenate(every).astype(float), np.concatenate(nothing).astype(bool)
