"""Spans of a value within which a condition holds, from the condition as it is parsed."""

from __future__ import annotations

import ast
import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from reports.formula.numeric import Resolver, evaluate_tree
from reports.formula.parse import parse
from reports.shared.errors import FormulaError

_KEPT_DIGITS = 6
_MIRRORED = {ast.Lt: ast.Gt, ast.LtE: ast.GtE, ast.Gt: ast.Lt, ast.GtE: ast.LtE}


@dataclass(frozen=True, order=True, slots=True)
class Interval:
    """Values between two ends, each of them in or out."""

    low: float
    above: bool  # the lower end is out
    high: float
    upto: bool  # the upper end is in

    @property
    def is_empty(self) -> bool:
        """Whether no value is within."""
        return self.low > self.high or (self.low == self.high and (self.above or not self.upto))


Spans = tuple[Interval, ...]
_ALL = Interval(-math.inf, True, math.inf, False)


def spans_of(condition: str, value: str, resolve: Resolver) -> Spans | None:
    """Spans of a value in which a condition holds, in rising order.

    Args:
        condition: an expression.
        value: name of the value.
        resolve: gives the values of other names.

    Returns:
        The spans, none where the condition never holds; None where it is no matter of spans,
        as of a product of the value with itself.
    """
    expression = parse(condition)
    try:
        with np.errstate(all="ignore"):
            return _holds(expression, value, resolve)
    except FormulaError:
        return None


def _holds(node: ast.expr, value: str, resolve: Resolver) -> Spans:
    match node:
        case ast.BoolOp(op=ast.And(), values=parts):
            spans: Spans = (_ALL,)
            for part in parts:
                spans = _common(spans, _holds(part, value, resolve))
            return spans
        case ast.BoolOp(values=parts):
            return _joined([span for part in parts for span in _holds(part, value, resolve)])
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            return _others(_holds(operand, value, resolve))
        case ast.IfExp(test=test, body=body, orelse=orelse):
            taken = body if _number(test, value, resolve) else orelse
            return _holds(taken, value, resolve)
        case ast.Compare(left=left, ops=[op], comparators=[right]):
            if _names(right, value):
                left, right = right, left
                op = _MIRRORED.get(type(op), type(op))()
            return _solved(left, _within(op, _number(right, value, resolve)), value, resolve)
    raise FormulaError("the condition has no spans")


def _within(op: ast.cmpop, limit: float) -> Spans:
    """Spans of what is compared with a limit."""
    match op:
        case ast.Lt():
            return (Interval(-math.inf, True, limit, False),)
        case ast.LtE():
            return (Interval(-math.inf, True, limit, True),)
        case ast.Gt():
            return (Interval(limit, True, math.inf, False),)
        case ast.GtE():
            return (Interval(limit, False, math.inf, False),)
        case ast.Eq():
            return (Interval(limit, False, limit, True),)
    return _others((Interval(limit, False, limit, True),))


def _solved(node: ast.expr, spans: Spans, value: str, resolve: Resolver) -> Spans:
    """Spans of the value from those of what is made of it."""
    match node:
        case ast.Name(id=name) if name == value:
            return spans
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            return _solved(operand, _scaled(spans, -1.0), value, resolve)
        case ast.Call(func=ast.Name(id="abs"), args=[inner]):
            positive = _common(spans, (Interval(0.0, False, math.inf, False),))
            return _solved(inner, _joined([*positive, *_scaled(positive, -1.0)]), value, resolve)
        # So many digits are kept that rounding drops the noise of arithmetic alone.
        case ast.Call(func=ast.Name(id="round"), args=[inner, ast.Constant(value=int(digits))]) if (
            digits >= _KEPT_DIGITS
        ):
            return _solved(inner, spans, value, resolve)
        case ast.BinOp(left=left, op=op, right=right):
            first = _names(left, value)
            inner, number = (left, right) if first else (right, left)
            spans = _undone(op, _number(number, value, resolve), spans, first=first)
            return _solved(inner, spans, value, resolve)
    raise FormulaError("the condition has no spans")


def _undone(op: ast.operator, number: float, spans: Spans, *, first: bool) -> Spans:
    """Spans of one side of a sum or a product from those of the whole."""
    match op:
        case ast.Add():
            return _moved(spans, -number)
        case ast.Sub():
            return _moved(spans, number) if first else _scaled(_moved(spans, -number), -1.0)
        case ast.Mult() if number:
            return _scaled(spans, 1.0 / number)
        case ast.Div() if number and first:
            return _scaled(spans, number)
    raise FormulaError("the condition has no spans")


def _names(node: ast.expr, value: str) -> bool:
    return any(isinstance(part, ast.Name) and part.id == value for part in ast.walk(node))


def _number(node: ast.expr, value: str, resolve: Resolver) -> float:
    if _names(node, value):
        raise FormulaError("the condition has no spans")
    try:
        number = float(evaluate_tree(node, resolve))
    except (KeyError, TypeError, ValueError, ArithmeticError):  # a text, a column
        raise FormulaError("the condition has no spans") from None
    if not math.isfinite(number):
        raise FormulaError("the condition has no spans")
    return number


def _moved(spans: Spans, by: float) -> Spans:
    return _mapped(spans, lambda end: end + by)


def _scaled(spans: Spans, by: float) -> Spans:
    if by > 0:
        return _mapped(spans, lambda end: end * by)
    turned = (Interval(s.high * by, not s.upto, s.low * by, not s.above) for s in reversed(spans))
    return tuple(turned)


def _mapped(spans: Spans, act: Callable[[float], float]) -> Spans:
    return tuple(Interval(act(s.low), s.above, act(s.high), s.upto) for s in spans)


def _common(some: Spans, others: Spans) -> Spans:
    """Return what lies in both."""
    both = (_cut(one, other) for one in some for other in others)
    return tuple(sorted(span for span in both if not span.is_empty))


def _cut(one: Interval, other: Interval) -> Interval:
    low, above = max((one.low, one.above), (other.low, other.above))
    high, upto = min((one.high, one.upto), (other.high, other.upto))
    return Interval(low, above, high, upto)


def _joined(spans: list[Interval]) -> Spans:
    """Return what lies in any, those that touch made one."""
    whole: list[Interval] = []
    for span in sorted(span for span in spans if not span.is_empty):
        if whole and _touch(whole[-1], span):
            last = whole.pop()
            high, upto = max((last.high, last.upto), (span.high, span.upto))
            whole.append(Interval(last.low, last.above, high, upto))
        else:
            whole.append(span)
    return tuple(whole)


def _touch(one: Interval, later: Interval) -> bool:
    return later.low < one.high or (later.low == one.high and (one.upto or not later.above))


def _others(spans: Spans) -> Spans:
    """Return what lies in none."""
    left: Spans = (_ALL,)
    for span in spans:
        outside = (Interval(-math.inf, True, span.low, span.above),
                   Interval(span.high, span.upto, math.inf, False))  # fmt: skip
        left = _common(left, outside)
    return left
