"""What a check allows, in words, from its condition."""

from __future__ import annotations

import ast
import math
from collections.abc import Callable

from reports.formula.numeric import Resolver
from reports.formula.parse import is_condition, parse
from reports.formula.plain import plain
from reports.formula.spans import Interval, spans_of
from reports.shared.russian import short

_DIGITS = 10  # significant digits of a limit
_NOISE = 1e-5  # a limit below it is an error of arithmetic
_MAX_SPANS = 3


def tolerance(verdict: str, value: str, resolve: Resolver, symbol: Callable[[str], str]) -> str:
    """Return what a check allows: «±2», «не более 0,01», «0,2…0,3», «720»; else its formula.

    Args:
        verdict: the formula of its verdict, or its condition.
        value: name of the value in it.
        resolve: gives the values of other names.
        symbol: gives their symbols.
    """
    tree = parse(verdict)
    if isinstance(tree, ast.IfExp) and not is_condition(verdict):
        tree = tree.test
    condition = ast.unparse(tree)
    spans = spans_of(condition, value, resolve)
    if spans and len(spans) <= _MAX_SPANS:
        if len(spans) == 2 and spans[0].high == spans[1].low and _is_all_else(spans):
            return f"не равно {_short(spans[0].high)}"
        words = [_words(span) for span in spans]
        if all(words):
            return " или ".join(words)
    return plain(condition, lambda name: "значение" if name == value else symbol(name))


def _is_all_else(spans: tuple[Interval, ...]) -> bool:
    return spans[0].low == -math.inf and spans[1].high == math.inf


def _words(span: Interval) -> str:
    """Return a span in words; nothing for one without ends."""
    low, high = span.low, span.high
    if math.isfinite(low) and math.isfinite(high):
        if high - low <= _NOISE * abs(low + high):
            return _short((low + high) / 2)
        if not span.above and span.upto:
            return f"±{_short(high)}" if low == -high else f"{_short(low)}…{_short(high)}"
        return f"{_low(span)} и {_high(span)}"
    if math.isfinite(high):
        return "0" if 0 < high < _NOISE else _high(span)
    return _low(span) if math.isfinite(low) else ""


def _low(span: Interval) -> str:
    return f"{'более' if span.above else 'не менее'} {_short(span.low)}"


def _high(span: Interval) -> str:
    return f"{'не более' if span.upto else 'менее'} {_short(span.high)}"


def _short(value: float) -> str:
    return short(value, _DIGITS)
