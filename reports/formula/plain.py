"""Expressions as a line of text with the symbols of the book, for the comments of a workbook."""

from __future__ import annotations

import ast
from collections.abc import Callable
from math import log10

from reports.formula.parse import SCALE_FUNCTIONS, SCALES, parse
from reports.shared.russian import short

_SUM, _PRODUCT, _POWER, _ATOM = 2, 3, 4, 9
_SIGNS: dict[type[ast.AST], tuple[str, int]] = {
    ast.Lt: (" < ", 1), ast.LtE: (" ≤ ", 1), ast.Gt: (" > ", 1), ast.GtE: (" ≥ ", 1),
    ast.Eq: (" = ", 1), ast.NotEq: (" ≠ ", 1),
    ast.Add: (" + ", _SUM), ast.Sub: (" − ", _SUM), ast.Mult: ("·", _PRODUCT),
    ast.Div: ("/", _PRODUCT),
}  # fmt: skip
_WORDS = {
    "asin": "arcsin", "acos": "arccos", "total": "Σ", "run_sum": "Σ", "floor": "целая часть",
    "round": "окр", "round_up": "окр вверх",
    "mod": "остаток", "col_max": "max", "col_min": "min", "col_mean": "среднее", "col_sum": "Σ",
    "col_last": "последнее", "element": "из строки", "place": "номер", "following": "следующее",
    "running_sum": "Σ до строки", "first_largest": "номер наибольшего", "rank": "место",
}  # fmt: skip
_TENS = {3.0: "1000", 6.0: "10⁶"}
# What the scale functions multiply or divide by.
_FACTORS = {
    f"{way}_{unit}": ("/" if (times > 1) == (way == "to") else "·") + _TENS[abs(log10(times))]
    for unit, times in SCALES.items()
    for way in ("to", "of")
} | {"deg": "·180/π"}
_SUPERSCRIPT = {"2": "²", "3": "³", "4": "⁴", "5": "⁵"}


def plain(text: str, symbol: Callable[[str], str], *, scaled: bool = False) -> str:
    """Return an expression as people write it in a line; ``symbol`` gives the symbol of a name.

    Factors between units are left out, as the book does, but where they are asked for.
    """
    return _text(parse(text), symbol, scaled=scaled)[0]


def _text(node: ast.expr, symbol: Callable[[str], str], *, scaled: bool) -> tuple[str, int]:
    """Text and the precedence of its outermost operator."""

    def inside(part: ast.expr, least: int) -> str:
        said, level = _text(part, symbol, scaled=scaled)
        return said if level >= least else f"({said})"

    match node:
        case ast.Constant(value=str() as value):
            return f"«{value}»", _ATOM
        case ast.Constant(value=value):
            return short(float(value)), _ATOM  # type: ignore[arg-type]
        case ast.Name(id="pi"):
            return "π", _ATOM
        case ast.Name(id=name):
            return _symbol(symbol(name))
        case ast.Attribute(value=ast.Name(id=table), attr=column):
            return _symbol(symbol(f"{table}.{column}"))
        case ast.BinOp(left=left, op=ast.Pow(), right=right):
            power = inside(right, _ATOM)
            return f"{inside(left, _ATOM)}{_SUPERSCRIPT.get(power, f'^{power}')}", _POWER
        case ast.BinOp(left=left, op=op, right=right):
            sign, level = _SIGNS[type(op)]
            last = inside(right, level + (type(op) in (ast.Sub, ast.Div)))
            # A sign at the beginning takes in all factors.
            first = inside(left, 0 if isinstance(left, ast.UnaryOp) else level)
            return f"{first}{sign}{last}", level
        case ast.Compare(left=left, ops=[op], comparators=[right]):
            sign, level = _SIGNS[type(op)]
            return f"{inside(left, _SUM)}{sign}{inside(right, _SUM)}", level
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            return f"−{inside(operand, _PRODUCT)}", _SUM
        case ast.UnaryOp(operand=operand):
            return f"не {inside(operand, _ATOM)}", 0
        case ast.BoolOp(op=joint, values=values):
            word = " и " if isinstance(joint, ast.And) else " или "
            return word.join(inside(value, 1) for value in values), 0
        case ast.IfExp(test=test, body=body, orelse=orelse):
            said, case, otherwise = inside(body, 1), inside(test, 0), inside(orelse, 0)
            return f"{said} при {case}, иначе {otherwise}", 0
        case ast.Call(func=ast.Name(id="rad"), args=[ast.Constant() as angle]) if scaled:
            return f"{inside(angle, _ATOM)}°", _ATOM
        case ast.Call(func=ast.Name(id=name), args=[arg]) if scaled and name in _FACTORS:
            return f"{inside(arg, _PRODUCT)}{_FACTORS[name]}", _PRODUCT
        case ast.Call(func=ast.Name(id=name), args=args):
            return _call(name, [_text(arg, symbol, scaled=scaled) for arg in args])
    raise AssertionError(f"unexpected node {ast.dump(node)}")


def _symbol(text: str) -> tuple[str, int]:
    """Return a symbol; one that is a sum or a ratio itself wants brackets among others."""
    text = text.rpartition(" = ")[2]
    level = _SUM if " − " in text or " + " in text else _PRODUCT if "/" in text else _ATOM
    return text, level


def _call(name: str, args: list[tuple[str, int]]) -> tuple[str, int]:
    if name in SCALE_FUNCTIONS or name in ("rad", "deg"):
        return args[0]
    if name == "abs":
        return f"|{args[0][0]}|", _ATOM
    if name == "sqrt":
        return f"√({args[0][0]})", _ATOM
    if name.startswith("wave_"):
        *weight, angle, order = (said for said, _ in args)
        return f"Σ {''.join(weight)} {name[-3:]}({order}·{angle})".replace("  ", " "), _PRODUCT
    if name.startswith("fourier_"):
        return f"2/m·Σ {args[0][0]}·{name[-3:]}({args[2][0]}·{args[1][0]})", _PRODUCT
    if name == "atan2":
        return f"arctg({args[0][0]} : {args[1][0]})", _ATOM
    return f"{_WORDS.get(name, name)}({'; '.join(said for said, _ in args)})", _ATOM
