"""Expressions as numpy values."""

from __future__ import annotations

import ast
import operator
from collections.abc import Callable
from functools import reduce
from operator import itemgetter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reports.formula.parse import AGGREGATES, SCALE_FUNCTIONS, SCALES, parse

Value = Any  # float, str or numpy array of one value per row
Resolver = Callable[[str], Value]

_FUNCTIONS: dict[str, Callable[..., Value]] = {
    "sin": np.sin, "cos": np.cos, "tan": np.tan, "asin": np.arcsin, "acos": np.arccos,
    "atan2": np.arctan2, "sqrt": np.sqrt, "exp": np.exp, "ln": np.log, "abs": np.abs,
    "floor": np.floor, "mod": np.mod, "rad": np.radians, "deg": np.degrees,
}  # fmt: skip
_JOINS: dict[str, Callable[[Value, Value], Value]] = {
    "min": np.minimum, "max": np.maximum, "total": np.add,
}  # fmt: skip
_OPERATORS: dict[type[ast.AST], Callable[[Value, Value], Value]] = {
    ast.Add: np.add, ast.Sub: np.subtract, ast.Mult: np.multiply, ast.Div: np.divide,
    ast.Pow: np.power, ast.Lt: np.less, ast.LtE: np.less_equal, ast.Gt: np.greater,
    ast.GtE: np.greater_equal, ast.Eq: np.equal, ast.NotEq: np.not_equal,
}  # fmt: skip
# A part of an expression as a function of what its names are looked up in.
Compiled = Callable[[Any], Value]
# How a name is looked up.
Reading = Callable[[str], Compiled]


def _fourier(turn: Callable[[Value], Value]) -> Callable[[Value, Value, Value], Value]:
    """Fourier coefficient of a column over an angle in degrees; one order or one per row."""

    def coefficient(column: Value, degrees: Value, order: Value) -> Value:
        waves = turn(np.multiply.outer(order, np.radians(degrees[:-1])))
        return 2 * (waves @ column[:-1]) / (len(column) - 1)

    return coefficient


def _wave(turn: Callable[[Value], Value]) -> Callable[..., Value]:
    """Sum of waves, weighted or not, over all of a run; one order or one per row."""

    def total(*arguments: Value) -> Value:
        *weights, degrees, order = arguments
        waves = turn(np.multiply.outer(order, np.radians(degrees)))
        return waves @ np.asarray(weights[0], dtype=float) if weights else waves.sum(axis=-1)

    return total


def _place(x: Value, points: Value) -> Value:
    points_array = np.asarray(points, dtype=float)
    return np.clip(np.searchsorted(points_array, x, side="right"), 1, len(points_array) - 1).astype(
        float
    )


def _element(run: Value, number: Value) -> Value:
    values = np.asarray(run, dtype=float)
    rows = np.asarray(number, dtype=float).astype(int) - 1
    return values[np.clip(rows, 0, len(values) - 1)]


def _rounded(value: Value, decimals: Value = 0.0) -> Value:
    # As a spreadsheet rounds: halves away from zero, and zero has no sign.
    scale = 10.0**decimals
    return np.copysign(np.floor(np.abs(value) * scale + 0.5) / scale, value) + 0.0


def _rounded_up(value: Value) -> Value:
    # As a spreadsheet does: away from zero.
    return np.copysign(np.ceil(np.abs(value)), value) + 0.0


def _following(column: Value) -> Value:
    return np.append(column[1:], column[-1])


def _previous(column: Value) -> Value:
    return np.insert(np.asarray(column, dtype=float)[:-1], 0, 0.0)


_FUNCTIONS |= {"element": _element, "round": _rounded, "round_up": _rounded_up, "place": _place}
_FUNCTIONS |= {"rank": lambda value, run: 1.0 + float(np.sum(np.asarray(run) < value))}
_FUNCTIONS |= {"first_largest": lambda run: float(np.argmax(run) + 1)}
_FUNCTIONS |= {"run_sum": lambda run: float(np.sum(run))}
_FUNCTIONS |= {"following": _following, "previous": _previous, "running_sum": np.cumsum}
_FUNCTIONS |= {"fourier_cos": _fourier(np.cos), "fourier_sin": _fourier(np.sin)}
_FUNCTIONS |= {"wave_cos": _wave(np.cos), "wave_sin": _wave(np.sin)}


def evaluate(text: str, resolve: Resolver) -> Value:
    """Value of an expression.

    Args:
        text: the expression.
        resolve: gives the value of a name; columns of other tables come as
            ``table.column``; columns are arrays, scalars floats or texts.
    """
    with np.errstate(all="ignore"):  # branches not taken may divide by zero
        return evaluate_tree(parse(text), resolve)


def evaluate_tree(tree: ast.expr, resolve: Resolver) -> Value:
    """Value of a parsed expression, see ``evaluate``."""
    return _made(tree, lambda name: lambda _: resolve(name))(None)


def compiled(text: str, key_of: Callable[[str], str]) -> Compiled:
    """Return an expression as a function of a dict of values; ``key_of`` gives the key of a name.

    Raises:
        FormulaError: a construct or function outside the language.
    """
    return _made(parse(text), lambda name: itemgetter(key_of(name)))


def _made(node: ast.expr, read: Reading) -> Compiled:
    """Return a part of an expression: its tree is walked once, not for each value."""
    match node:
        case ast.BinOp(left=left, op=op, right=right):
            return _pair(_OPERATORS[type(op)], _made(left, read), _made(right, read))
        case ast.Constant(value=literal):
            constant = float(literal) if isinstance(literal, (int, float)) else literal
            return lambda _: constant
        case ast.Name(id="pi"):
            return lambda _: np.pi
        case ast.Name(id=name):
            return read(name)
        case ast.Attribute(value=ast.Name(id=table), attr=column):
            return read(f"{table}.{column}")
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            return _applied(operator.neg, [_made(operand, read)])
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            return _applied(np.logical_not, [_made(operand, read)])
        case ast.Compare(left=left, ops=[op], comparators=[right]):
            return _comparison(type(op), _made(left, read), _made(right, read))
        case ast.BoolOp(op=op, values=values):
            join = np.logical_and if isinstance(op, ast.And) else np.logical_or
            parts = [_made(value, read) for value in values]
            return _applied(lambda *operands: reduce(join, operands), parts)
        case ast.IfExp(test=test, body=body, orelse=orelse):
            return _applied(_choose, [_made(part, read) for part in (test, body, orelse)])
        case ast.Call(func=ast.Name(id=name), args=args):
            return _applied(_function(name), [_made(arg, read) for arg in args])
    raise AssertionError(f"unexpected node {ast.dump(node)}")


def _pair(act: Callable[[Value, Value], Value], left: Compiled, right: Compiled) -> Compiled:
    return lambda values: act(left(values), right(values))


def _applied(act: Callable[..., Value], parts: list[Compiled]) -> Compiled:
    if len(parts) == 1:
        (only,) = parts
        return lambda values: act(only(values))
    return lambda values: act(*[part(values) for part in parts])


def _comparison(op: type[ast.cmpop], left: Compiled, right: Compiled) -> Compiled:
    act = _OPERATORS[op]

    def compare(first: Value, second: Value) -> Value:
        if isinstance(first, str) or isinstance(second, str):
            return (first == second) == (op is ast.Eq)
        return act(first, second)

    return _pair(compare, left, right)


def _choose(test: Value, body: Value, orelse: Value) -> Value:
    if isinstance(body, str) or isinstance(orelse, str):
        if np.ndim(test) == 0:
            return body if test else orelse
        return np.where(test, np.asarray(body, dtype=object), np.asarray(orelse, dtype=object))
    chosen: NDArray[np.float64] = np.asarray(np.where(test, body, orelse))
    return chosen if chosen.ndim else float(chosen)


def _function(name: str) -> Callable[..., Value]:
    """Return the function of a name of the language."""
    if name in SCALE_FUNCTIONS:
        way, unit = name.split("_", 1)
        scale = SCALES[unit]
        return (lambda value: value / scale) if way == "to" else (lambda value: value * scale)
    if name in AGGREGATES:
        return lambda column: _aggregate(name, np.asarray(column, dtype=float))
    if name in _JOINS:
        join = _JOINS[name]
        return lambda *values: reduce(join, values)
    return _FUNCTIONS[name]


def _aggregate(name: str, column: NDArray[np.float64]) -> float:
    if name == "col_max":
        return float(column.max())
    if name == "col_min":
        return float(column.min())
    if name == "col_last":
        return float(column[-1])
    body = column[:-1]
    return float(body.mean() if name == "col_mean" else body.sum())
