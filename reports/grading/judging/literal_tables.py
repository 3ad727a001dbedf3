"""Literal tables: lists of numbers in the guise of formulas, and columns read from them."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Sequence
from decimal import Decimal
from functools import lru_cache
from itertools import pairwise
from math import isfinite, nan

import numpy as np
from numpy.typing import NDArray

from reports.formula.parse import parse
from reports.grading.issuing.assignment import Item
from reports.grading.reading.student import StudentBook
from reports.recalculation.formulas import PLACES, Formula, Token
from reports.recalculation.grid import Run
from reports.recalculation.trial_sheet import full

_ALIKE = 3  # formulas that differ in nothing but their numbers, to be a list of numbers
_MANY = 8  # long numbers in one formula, to be a list of numbers
_CASES = 5  # numbers among which a formula chooses, or cases that it tells apart
_SHORT = 3  # digits of a number that may be chosen so
_DIGITS = 20  # of a text that is a list
_LONG = 5  # digits of a number that nobody knows by heart
_EXACT = 9  # decimals that a calculation keeps
_TYPED = 4  # digits, the comma with them, of a number in a list that is read; angles have fewer
_TURNS, _PARTS, _COUNTS = 15, 1440, 16  # degrees, minutes and days; whole numbers up to
_PLAIN = frozenset((18.0, 24.0, 32.0, 64.0, 9550.0, 9549.0, 3600.0))
_EQUAL = ("op", "=")
_BEFORE = frozenset(("op", sign) for sign in "(,;{")
_AFTER = frozenset(("op", sign) for sign in "),;}")


def reads_a_list(student: StudentBook, node: str) -> bool:
    """Whether a column is made of a column of numbers typed in beside the tables."""
    if listed(student.helpers(node)) or listed(student.runs(node), cells=True):
        return True
    read, length = student.own_numbers(node), student.assignment.length(node)
    long = {v for v in read if _digits(f"{v!r}") + (not v.is_integer()) >= _TYPED}
    if len(long) >= _ALIKE and len(read) >= length // 2:
        return True
    # A long number may be cut up into short ones; angles and counts go by equal steps.
    steps = {float(f"{b - a:.9g}") for a, b in pairwise(read)}
    return 1 < length <= len(read) and len(steps) >= max(_CASES, length // 2)


def is_of_angles(student: StudentBook, node: str) -> bool:
    """Whether the numbers that a column is made of are no more than its angles and their sines.

    Who has looked them up, to whatever digits, has calculated all the same.
    """
    angles = angles_of(student, node)
    runs = (*student.runs(node), *student.helpers(node))
    literals = {*student.own_numbers(node), *_changing(runs)}
    return bool(angles) and all(of_angles(value, angles) is not None for value in literals)


def typed_numbers(student: StudentBook, item: Item) -> frozenset[float]:
    """Numbers in the formulas of an item, and beside the tables where they read, that tell data.

    What everybody writes is none: π, minutes and degrees, powers of ten, small whole numbers, and
    what the textbook's own formula has.
    """
    numbers = {abs(n) for node in item.nodes for n in student.own_numbers(node)}
    numbers |= literals(student, item)
    if not numbers:
        return frozenset()
    texts = (student.assignment.graph.expression(node) or "0" for node in item.nodes)
    theirs = {
        abs(float(part.value))
        for text in texts
        for part in ast.walk(parse(text))
        if isinstance(part, ast.Constant) and isinstance(part.value, (int, float))
    }
    return frozenset(n for n in numbers if not (_is_usual(n) or is_scaled(n, theirs)))


def tells_data(student: StudentBook, item: Item) -> bool:
    """Whether formulas of an item have a number that may stand for some of the data of an engine.

    Few digits tell it where they are what the textbook's formula takes and the student's does not.
    """
    if typed_numbers(student, item):
        return True
    graph = student.assignment.graph
    references = frozenset().union(*(graph.references(node) for node in item.nodes))
    references |= frozenset().union(
        *(graph.references(name) for name in references if "." not in name)
    )
    references -= frozenset().union(*(student.precedents(node) for node in item.nodes))
    values = (student.expected.value(name) for name in references if "." not in name)
    data = {float(v) for v in values if not isinstance(v, str) and np.ndim(v) == 0}
    return any(
        is_scaled(n, data) for n in literals(student, item) if _mantissa(n) != _mantissa(1.0)
    )


def literals(student: StudentBook, item: Item) -> frozenset[float]:
    """All numbers in the formulas of an item and of the cells of one's own that they read."""
    runs = (run for node in item.nodes for run in (*student.runs(node), *student.helpers(node)))
    formulas = (run.formula for run in runs if run.formula is not None)
    return frozenset().union(*map(_literals, formulas))


def is_scaled(value: float, numbers: Iterable[float]) -> bool:
    """Whether a value is one of the numbers but for a power of ten, as units are."""
    return any(_mantissa(value) == _mantissa(number) for number in numbers)


def _mantissa(value: float) -> str:
    return f"{abs(value):.9e}".partition("e")[0]


@lru_cache(maxsize=20_000)
def _literals(formula: Formula) -> set[float]:
    return {float(value) for kind, value in formula.pattern if kind == "number"}


def _is_usual(number: float) -> bool:
    """Whether a number may stand in anybody's formula."""
    whole = number.is_integer()
    return (
        len(_mantissa(number).replace(".", "").rstrip("0")) <= 1
        or (whole and (number <= _COUNTS or (number % _TURNS == 0 and number <= _PARTS)))
        or number in _PLAIN
        or full(number) != number
    )


def angles_of(student: StudentBook, node: str) -> tuple[float, ...]:
    """Return angles of a column's rows in degrees, none where it stands beside something else."""
    table = student.assignment.model.tables.get(node.partition(".")[0])
    if table is None or table.columns[0].quantity.unit != "deg":
        return ()
    return tuple(table.rows)


def of_angles(value: float, angles: tuple[float, ...]) -> float | None:
    """Return an angle, its sine or cosine with all digits, of which a number has the first ones."""
    if not isfinite(value):
        return None
    functions = _functions(angles)
    at = int(np.searchsorted(functions, value))
    neighbours = functions[max(at - 1, 0) : at + 1]
    exact = float(neighbours[np.abs(neighbours - value).argmin()])
    half = 0.5000001 * 10.0 ** -min(_decimals(value), _EXACT)
    return exact if abs(exact - value) <= half else None


@lru_cache(maxsize=32)
def _functions(angles: tuple[float, ...]) -> NDArray[np.float64]:
    """Angles, also doubled and in radians, with their sines and cosines, in order."""
    turns = np.radians(np.outer((1, 2), angles)).ravel()
    functions = (np.degrees(turns), turns, np.sin(turns), np.cos(turns), 1 - np.cos(turns))
    return np.unique(np.concatenate([np.array([0.0, 1.0, 2.0]), *functions]))


def _decimals(value: float) -> int:
    return max(0, -int(Decimal(repr(value)).as_tuple().exponent))


def _changing(runs: Sequence[Run]) -> set[float]:
    """Numbers by which formulas differ that are alike but for them, and all those of a list."""
    changing: set[float] = set()
    alike: dict[tuple[str, ...], list[tuple[str, ...]]] = {}
    for run in runs:
        if run.formula is None:
            continue
        skeleton, numbers = _parts(run.formula, cells=False)
        alike.setdefault(skeleton, []).append(numbers)
        if _long_numbers(run.formula) >= _MANY or _chooses(run.formula):
            changing.update(map(_number, numbers))
    for group in alike.values():
        for column in zip(*group, strict=True):
            if len(set(column)) > 1:
                changing.update(map(_number, column))
    return changing


def _number(text: str) -> float:
    """Return a number as a formula tells it, NaN where it is a text or a cell."""
    try:
        return float(text)
    except ValueError:
        return nan


def listed(runs: Sequence[Run], *, cells: bool = False) -> set[int]:
    """Return runs that are a list of numbers, by ``id``: alike but for them, or full of them.

    With ``cells`` formulas that take other cells each are alike too: one may count by cells.
    """
    alike: dict[tuple[str, ...], list[Run]] = {}
    lists = set()
    for run in runs:
        if run.formula is None:
            continue
        alike.setdefault(_parts(run.formula, cells=cells)[0], []).append(run)
        if _long_numbers(run.formula) >= _MANY or _chooses(run.formula):
            lists.add(id(run))
    for group in alike.values():
        numbers = {_parts(run.formula, cells=cells)[1] for run in group if run.formula is not None}
        if len(numbers) >= _ALIKE:
            lists |= {id(run) for run in group}
    return lists


@lru_cache(maxsize=20_000)
def _parts(formula: Formula, *, cells: bool) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return formula without what tells a number in it, and that: texts too, rows of ROW, cells."""
    tokens: list[Token] = []
    for kind, value in formula.pattern:
        if tokens and tokens[-1][0] == "sheet":
            tokens[-1] = (kind, tokens[-1][1] + value)
        elif kind != "space":
            tokens.append((kind, value))
    skeleton, numbers = [], []
    for before, (kind, value) in zip([("", ""), ("", ""), *tokens], tokens, strict=False):
        counted = kind == "ref" and (cells or before[1].upper() in PLACES)  # ROW, a bracket, a cell
        if counted or kind in ("number", "text"):
            numbers.append(value)
        skeleton.append(kind if counted or kind in ("number", "text") else f"{kind} {value}")
    return tuple(skeleton), tuple(numbers)


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
        or (tokens.count(_EQUAL) >= _CASES and _told(tokens) >= _CASES * _SHORT)
        or any(sum(map(str.isdigit, text)) >= _DIGITS for text in texts)
    )


def _told(tokens: Sequence[Token]) -> int:
    """Digits of the literals, except case selectors."""
    around = zip((("", ""), *tokens), tokens, (*tokens[1:], ("", "")), strict=False)
    return sum(
        map(_digits, {at[1] for before, at, after in around
                      if at[0] == "number" and _EQUAL not in (before, after)})
    )  # fmt: skip


def _digits(number: str) -> int:
    """Digits of a number that say anything."""
    return len(number.partition("e")[0].lstrip("-").replace(".", "").strip("0"))
