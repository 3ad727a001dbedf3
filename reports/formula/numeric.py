"""Expressions as numpy values."""

from __future__ import annotations

import ast
from collections.abc import Callable
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
    "interpolate": np.interp,
}  # fmt: skip


def _fourier(turn: Callable[[Value], Value]) -> Callable[[Value, Value, Value], Value]:
    """Fourier coefficient of a column over an angle in degrees; one order or one per row."""

    def coefficient(column: Value, degrees: Value, order: Value) -> Value:
        waves = turn(np.multiply.outer(order, np.radians(degrees[:-1])))
        return 2 * (waves @ column[:-1]) / (len(column) - 1)

    return coefficient


def _element(run: Value, number: Value) -> Value:
    values = np.asarray(run, dtype=float)
    rows = np.asarray(number, dtype=float).astype(int) - 1
    return values[np.clip(rows, 0, len(values) - 1)]


def _spline(x: Value, knots: Value, c0: Value, c1: Value, c2: Value, c3: Value) -> Value:
    """Cubic from the last knot at or before ``x``."""
    places = np.asarray(knots, dtype=float)
    row = np.clip(np.searchsorted(places, x, side="right") - 1, 0, len(places) - 2)
    u = np.asarray(x) - places[row]
    first, second, third, fourth = (np.asarray(c, dtype=float)[row] for c in (c0, c1, c2, c3))
    return first + u * (second + u * (third + u * fourth))


_FUNCTIONS |= {"element": _element, "spline": _spline}
_FUNCTIONS |= {"fourier_cos": _fourier(np.cos), "fourier_sin": _fourier(np.sin)}

_OPERATORS: dict[type[ast.AST], Callable[[Value, Value], Value]] = {
    ast.Add: np.add, ast.Sub: np.subtract, ast.Mult: np.multiply, ast.Div: np.divide,
    ast.Pow: np.power, ast.Lt: np.less, ast.LtE: np.less_equal, ast.Gt: np.greater,
    ast.GtE: np.greater_equal, ast.Eq: np.equal, ast.NotEq: np.not_equal,
}  # fmt: skip


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
    return _value(tree, resolve)


def _value(node: ast.expr, resolve: Resolver) -> Value:
    match node:  # the most frequent first
        case ast.BinOp(left=left, op=op, right=right):
            first, second = _value(left, resolve), _value(right, resolve)
            return _OPERATORS[type(op)](first, second)
        case ast.Constant(value=literal):
            return float(literal) if isinstance(literal, (int, float)) else literal
        case ast.Name(id="pi"):
            return np.pi
        case ast.Name(id=name):
            return resolve(name)
        case ast.Attribute(value=ast.Name(id=table), attr=column):
            return resolve(f"{table}.{column}")
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            return -_value(operand, resolve)
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            return np.logical_not(_value(operand, resolve))
        case ast.Compare(left=left, ops=[op], comparators=[right]):
            first, second = _value(left, resolve), _value(right, resolve)
            if isinstance(first, str) or isinstance(second, str):
                return (first == second) == isinstance(op, ast.Eq)
            return _OPERATORS[type(op)](first, second)
        case ast.BoolOp(op=op, values=values):
            join = np.logical_and if isinstance(op, ast.And) else np.logical_or
            result = _value(values[0], resolve)
            for value in values[1:]:
                result = join(result, _value(value, resolve))
            return result
        case ast.IfExp(test=test, body=body, orelse=orelse):
            return _choose(_value(test, resolve), _value(body, resolve), _value(orelse, resolve))
        case ast.Call(func=ast.Name(id=name), args=args):
            return _call(name, [_value(arg, resolve) for arg in args])
    msg = f"unexpected node {ast.dump(node)}"
    raise AssertionError(msg)


def _choose(test: Value, body: Value, orelse: Value) -> Value:
    if isinstance(body, str) or isinstance(orelse, str):
        if np.ndim(test) == 0:
            return body if test else orelse
        return np.where(test, np.asarray(body, dtype=object), np.asarray(orelse, dtype=object))
    chosen: NDArray[np.float64] = np.asarray(np.where(test, body, orelse))
    return chosen if chosen.ndim else float(chosen)


def _call(name: str, args: list[Value]) -> Value:
    if name in SCALE_FUNCTIONS:
        way, unit = name.split("_", 1)
        return args[0] / SCALES[unit] if way == "to" else args[0] * SCALES[unit]
    if name == "following":
        return np.append(args[0][1:], args[0][-1])
    if name == "running_sum":
        return np.cumsum(args[0])
    if name == "round":
        # As a spreadsheet rounds: halves away from zero.
        return np.copysign(np.floor(np.abs(args[0]) + 0.5), args[0])
    if name in AGGREGATES:
        return _aggregate(name, np.asarray(args[0], dtype=float))
    if name in ("min", "max", "total"):
        result = args[0]
        joins = {"min": np.minimum, "max": np.maximum, "total": np.add}
        for value in args[1:]:
            result = joins[name](result, value)
        return result
    return _FUNCTIONS[name](*args)


def _aggregate(name: str, column: NDArray[np.float64]) -> float:
    if name == "col_max":
        return float(column.max())
    if name == "col_min":
        return float(column.min())
    if name == "col_last":
        return float(column[-1])
    body = column[:-1]
    return float(body.mean() if name == "col_mean" else body.sum())
