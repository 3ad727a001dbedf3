"""The usual mistakes in a formula: in words, and as what they make of it."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator

from reports.formula.parse import SCALE_FUNCTIONS, SHIFTS, names, parse
from reports.grading.judging.rewriting import (
    MIXED,
    SIGNS,
    Flipped,
    OtherExponent,
    OtherRatio,
    Renamed,
    WithoutFactor,
    WithoutNumber,
    WithoutPower,
    WithoutPowers,
    WithoutSummand,
    factors,
    numbers,
    summands,
    without_radians,
)
from reports.model.blocks import Model, TableSpec
from reports.model.evaluation import node_of
from reports.shared.russian import short

_PRODUCTS = 4  # of a formula, in which it may divide instead
Mistake = tuple[str, Callable[[ast.expr], ast.AST]]


def mistakes(tree: ast.expr, block: str, model: Model) -> Iterator[Mistake]:
    """What may have become of the formula of a value of a block, the likeliest first."""
    used = names(ast.unparse(tree))
    yield "градусы вместо радиан в sin, cos", without_radians
    for place in (None, 0, 1, 2):
        yield "sin и cos взяты друг вместо друга", OtherRatio(place).visit
    yield from _shorter(tree, block, model)
    for wrong_for, taken, words in MIXED:
        if wrong_for in used and (taken in model.scalars or taken in model.fields):
            more = ""
            if {wrong_for, taken} == {"r_crank", "S_stroke"} and numbers(tree):
                more = " или потерянный делитель 2 (вдвое больше или меньше)"
            yield words + more, Renamed(wrong_for, taken).visit
    for number, words in SIGNS:
        yield words, Flipped(number, ast.Add, ast.Sub).visit
    table = model.tables.get(block)
    yield from _columns(table, used) if table is not None else ()
    for number in range(_PRODUCTS):
        yield "деление вместо умножения или наоборот", Flipped(number, ast.Mult, ast.Div).visit


def _columns(table: TableSpec, used: frozenset[str]) -> Iterator[Mistake]:
    """A column of the same table and unit taken for one of the formula's."""
    for column in table.columns:
        for other in table.columns if column.key in used else ():
            if other is not column and other.quantity.unit == column.quantity.unit:
                words = f"{other.quantity.symbol} вместо {column.quantity.symbol}"
                yield words, Renamed(column.key, other.key).visit


def _shorter(tree: ast.expr, block: str, model: Model) -> Iterator[Mistake]:
    """Something left out of the formula: a summand, a factor, a power, a number."""
    for number, dropped in enumerate(summands(tree)):
        words = f"пропущено слагаемое {_symbols(dropped, block, model)}"
        yield words, WithoutSummand(number).changed
    for text in factors(tree):
        symbol = _symbols(parse(text), block, model)
        yield f"пропущен множитель {symbol}", WithoutFactor(text).visit
        yield f"{symbol} не возведено в квадрат", WithoutPower(text).visit
    for value in numbers(tree):
        words = "взято целое вместо половины" if value == 0.5 else f"потеряно число {short(value)}"
        area = value == 4 and "geometry_bore_mm" in names(ast.unparse(tree))
        words = "π·D² вместо π·D²/4" if area else words
        yield words, WithoutNumber(value).visit
    yield "скобка не возведена в степень", WithoutPowers().visit
    for more, words in ((True, "больше"), (False, "меньше")):
        yield f"показатель степени на единицу {words}", OtherExponent(more=more).visit


# How people call the functions of the language; what is not here is called as in Excel.
_CALLED = {"col_max": "max", "col_min": "min", "col_mean": "среднее", "col_sum": "Σ", "total": "Σ",
           "running_sum": "Σ", "sqrt": "√"}  # fmt: skip
_NAMELESS = SCALE_FUNCTIONS | SHIFTS | {"rad", "deg", "element", "col_last", "round"}


def symbol_of(name: str, block: str, model: Model) -> str:
    """Symbol of a name in a formula of a block."""
    key = node_of(name, block, model)
    node = model.nodes.get(model.grid_runs.get(key, (key,))[0])
    if node is not None:
        return node.quantity.symbol
    return model.fields[name].title if name in model.fields else name


def _symbols(tree: ast.expr, block: str, model: Model) -> str:
    used = sorted(names(ast.unparse(tree)))
    found = "·".join(dict.fromkeys(symbol_of(name, block, model) for name in used))
    if isinstance(tree, ast.Call) and isinstance(tree.func, ast.Name):
        name = tree.func.id
        return found if name in _NAMELESS else f"{_CALLED.get(name, name)} {found}"
    return found or ast.unparse(tree).replace("pi", "π")
