"""The whitelist of functions, on arrays of shape (rows of the run, height, width).

A value that a spreadsheet shows as an error is NaN here.
"""

from __future__ import annotations

from collections.abc import Callable
from math import isfinite
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reports.recalculation.by_columns.syntax import UnknownFormula

Value = Any  # float, bool, str, or an array of one of them
Array = NDArray[np.float64]
Flags = NDArray[np.bool_]


def finite(value: Value) -> Value:
    """Infinities are errors in a spreadsheet."""
    if type(value) is float:
        return value if isfinite(value) else np.nan
    # A sum is finite where all its parts are, but for an overflow of the sum itself.
    if isfinite(np.add.reduce(value, axis=None)) or np.isfinite(value).all():
        return value
    return np.where(np.isfinite(value), value, np.nan)


def numeric(value: Value) -> Value:
    """A value for arithmetic.

    Raises:
        UnknownFormula: text, which a spreadsheet may or may not take for a number.
    """
    if isinstance(value, str) or (isinstance(value, np.ndarray) and value.dtype.kind == "O"):
        msg = "text in arithmetic"
        raise UnknownFormula(msg)
    return value


def _power(base: Value, exponent: Value) -> Value:
    value = np.power(np.asarray(base, dtype=float), exponent)
    zero = (np.asarray(base) == 0) & (np.asarray(exponent) == 0)
    return np.where(zero, np.nan, value) if np.any(zero) else value


def _mod(value: Value, divisor: Value) -> Value:
    return np.mod(np.asarray(value, dtype=float), divisor)


def _round(value: Value, digits: Value = 0.0) -> Value:
    scale = np.power(10.0, digits)
    # A spreadsheet rounds the decimal number that it shows, halves away from zero.
    return np.copysign(np.floor(np.abs(value) * scale * (1 + 4e-16) + 0.5), value) / scale


def _round_up(value: Value, digits: Value = 0.0) -> Value:
    scale = np.power(10.0, digits)
    return np.copysign(np.ceil(np.abs(value) * scale * (1 - 4e-16)), value) / scale


def _round_down(value: Value, digits: Value = 0.0) -> Value:
    scale = np.power(10.0, digits)
    return np.copysign(np.floor(np.abs(value) * scale * (1 + 4e-16)), value) / scale


def _log(value: Value, base: Value = 10.0) -> Value:
    return np.log(value) / np.log(base)


# Functions of single values: name → (function, least and most arguments).
SINGLE: dict[str, tuple[Callable[..., Value], int, int]] = {
    "SIN": (np.sin, 1, 1), "COS": (np.cos, 1, 1), "TAN": (np.tan, 1, 1),
    "ASIN": (np.arcsin, 1, 1), "ACOS": (np.arccos, 1, 1), "ATAN": (np.arctan, 1, 1),
    "ATAN2": (lambda x, y: np.arctan2(y, x), 2, 2),
    "SQRT": (np.sqrt, 1, 1), "EXP": (np.exp, 1, 1), "LN": (np.log, 1, 1),
    "LOG": (_log, 1, 2), "LOG10": (np.log10, 1, 1), "ABS": (np.abs, 1, 1),
    "INT": (np.floor, 1, 1), "TRUNC": (_round_down, 1, 2), "SIGN": (np.sign, 1, 1),
    "ROUND": (_round, 2, 2), "ROUNDUP": (_round_up, 2, 2), "ROUNDDOWN": (_round_down, 2, 2),
    "MOD": (_mod, 2, 2), "POWER": (_power, 2, 2),
    "RADIANS": (np.radians, 1, 1), "DEGREES": (np.degrees, 1, 1),
    "SINH": (np.sinh, 1, 1), "COSH": (np.cosh, 1, 1), "TANH": (np.tanh, 1, 1),
    "PI": (lambda: np.pi, 0, 0),
}  # fmt: skip

BINARY: dict[str, Callable[[Value, Value], Value]] = {
    "+": np.add, "-": np.subtract, "*": np.multiply, "/": np.divide, "^": _power,
    "<": np.less, "<=": np.less_equal, ">": np.greater, ">=": np.greater_equal,
    "=": np.equal, "<>": np.not_equal,
}  # fmt: skip


def rows_of_blocks(values: list[tuple[Array, Flags]]) -> tuple[Array, Flags]:
    """Numbers and their presence, one line a row of the run."""
    if len(values) == 1:
        value, present = values[0]
        return value.reshape(len(value), -1), present.reshape(len(present), -1)
    count = max(len(value) for value, _ in values)
    flat, there = [], []
    for value, present in values:
        shape = (count, *np.broadcast_shapes(value.shape, present.shape)[1:])
        flat.append(np.broadcast_to(value, shape).reshape(count, -1))
        there.append(np.broadcast_to(present, shape).reshape(count, -1))
    return np.concatenate(flat, axis=1), np.concatenate(there, axis=1)


def aggregate(name: str, values: list[tuple[Array, Flags]]) -> Array:
    """SUM, AVERAGE, MIN, MAX, COUNT and their kin; blank cells count for nothing."""
    numbers, there = rows_of_blocks(values)
    count = there.sum(axis=1)
    if name == "COUNT":
        result = count.astype(float)
    elif name == "SUM":
        result = np.where(there, numbers, 0.0).sum(axis=1)
    elif name == "SUMSQ":
        result = np.where(there, numbers**2, 0.0).sum(axis=1)
    elif name == "PRODUCT":
        result = np.where(count > 0, np.where(there, numbers, 1.0).prod(axis=1), 0.0)
    elif name == "AVERAGE":
        result = np.where(there, numbers, 0.0).sum(axis=1) / np.where(count > 0, count, np.nan)
    else:
        ends = {"MIN": (np.inf, np.min), "MAX": (-np.inf, np.max)}[name]
        result = np.where(there, numbers, ends[0])
        result = np.where(count > 0, ends[1](result, axis=1), 0.0)
    return np.asarray(finite(result)).reshape(-1, 1, 1)


AGGREGATES = frozenset({"SUM", "SUMSQ", "PRODUCT", "AVERAGE", "MIN", "MAX", "COUNT"})


def match(value: Array, block: Array, kind: float) -> Array:
    """Position of a value in a column or row; NaN where there is none."""
    places = block.reshape(-1)
    wanted = np.asarray(value, dtype=float)
    if kind == 0:
        hits = wanted.reshape(-1, 1) == places
        result = np.where(hits.any(axis=1), hits.argmax(axis=1) + 1.0, np.nan)
        return result.reshape(-1, 1, 1)
    if kind < 0 or np.any(np.diff(places) < 0):
        msg = "MATCH in a descending order"
        raise UnknownFormula(msg)
    found = np.searchsorted(places, wanted, side="right").astype(float)
    return np.asarray(np.where((found == 0) | np.isnan(wanted), np.nan, found)).reshape(-1, 1, 1)


def index(block: Array, row: Value, column: Value | None) -> Array:
    """Element of a block by its position from 1."""
    _, height, width = block.shape
    if column is None:
        row, column = (1.0, row) if height == 1 and width > 1 else (row, 1.0)
    at_row, at_column = np.broadcast_arrays(
        np.asarray(row, dtype=float).reshape(-1), np.asarray(column, dtype=float).reshape(-1)
    )
    good = (at_row >= 1) & (at_row < height + 1) & (at_column >= 1) & (at_column < width + 1)
    i = np.where(good, at_row, 1).astype(int) - 1
    j = np.where(good, at_column, 1).astype(int) - 1
    return np.where(good, block[0, i, j], np.nan).reshape(-1, 1, 1)
