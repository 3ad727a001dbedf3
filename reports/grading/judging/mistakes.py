"""Usual mistakes in a formula, as changes of its tree."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator
from functools import partial
from itertools import combinations

from reports.formula.parse import SCALE_FUNCTIONS, SHIFTS, is_known_function, names, parse
from reports.formula.plain import plain
from reports.grading.judging.rewriting import (
    ArcTangent,
    Divided,
    DoubleAngle,
    Exchanged,
    Flipped,
    HalfAngle,
    LowerPower,
    OtherExponent,
    OtherPi,
    OtherRatio,
    Renamed,
    SingleAngle,
    Squared,
    SumOfSizes,
    Swapped,
    WithoutFactor,
    WithoutFunction,
    WithoutNumber,
    WithoutPower,
    WithoutPowers,
    WithoutRoot,
    WithoutSummand,
    brackets,
    exponent_of,
    factors,
    is_power,
    loose,
    numbers,
    otherwise,
    second_operands,
    summands,
    without_radians,
)
from reports.model.blocks import Model, TableSpec, scalars_of
from reports.model.evaluation import node_of
from reports.shared.russian import short, uncapital

# Quantities that are taken for each other.
MIXED = (
    ("r_crank", "S_stroke", "ход поршня S вместо радиуса кривошипа r"),
    ("S_stroke", "r_crank", "радиус кривошипа r вместо хода поршня S"),
    ("r_crank", "L_rod", "длина шатуна L вместо радиуса кривошипа r"),
    ("L_rod", "r_crank", "радиус кривошипа r вместо длины шатуна L"),
    ("omega", "regime_speed_rpm", "частота вращения n в мин⁻¹ вместо угловой скорости ω"),
    ("regime_speed_rpm", "omega", "угловая скорость ω вместо частоты вращения n"),
    ("m_j", "m_2", "масса m2 вместо mj"),
    ("m_2", "m_j", "масса mj вместо m2"),
    ("m_j", "m_r", "масса mr вместо mj"),
    ("m_r", "m_j", "масса mj вместо mr"),
    ("m_1", "m_2", "масса m2 вместо m1"),
    ("m_2", "m_1", "масса m1 вместо m2"),
    ("m_1", "masses_rod_kg", "вся масса шатуна вместо m1"),
    ("m_2", "masses_rod_kg", "вся масса шатуна вместо m2"),
    ("F_piston", "geometry_bore_mm", "диаметр цилиндра вместо площади поршня"),
    ("geometry_bore_mm", "1000*S_stroke", "ход поршня S вместо диаметра цилиндра"),
    ("r_crank", "geometry_bore_mm/2000", "радиус цилиндра D/2 вместо радиуса кривошипа r"),
    ("r_crank", "geometry_bore_mm/1000", "диаметр цилиндра вместо радиуса кривошипа r"),
    ("st_omega_max", "omega", "угловая скорость ω вместо наибольшей ωmax"),
    ("L_rod", "L_rod + r_crank", "r + L вместо длины шатуна L"),
)
# In formulas of other forms than the book's too.
TAKEN_SPEEDS = (("omega", "regime_speed_rpm"), ("regime_speed_rpm", "omega"))
OPPOSITE = "обратный знак"


# --- the mistakes --------------------------------------------------------------------------------

_ROUGH = ((3.14, "3,14"), (3.0, "3"), (22 / 7, "22/7"))
_ARCS = ("asin", "acos", "tan")
# Conversions, not quantities.
_UNSQUARED = ("rad(", "deg(", "to_", "of_", "sqrt(")
_DIVISORS = (2, 4)
_SIGNS, _PRODUCTS = 3, 4  # of a formula, in which it may divide instead
ROOTLESS = "значение под корнем: корень не извлечён"
Mistake = tuple[str, Callable[[ast.expr], ast.AST]]
Changes = Callable[[ast.expr, str, Model], Iterator[Mistake]]
_POWERS = {2.0: "квадрат", 3.0: "куб"}
# How people call the functions of the language; what is not here is called as in Excel.
_CALLED = {"col_max": "max", "col_min": "min", "col_mean": "среднее", "col_sum": "Σ", "total": "Σ",
           "running_sum": "Σ", "sqrt": "√"}  # fmt: skip
_NAMELESS = SCALE_FUNCTIONS | SHIFTS | {"rad", "deg", "element", "col_last", "round"}


def mistakes(tree: ast.expr, block: str, model: Model) -> Iterator[Mistake]:
    """Tell what may have become of the formula of a value of a block, the likeliest first."""
    used = names(ast.unparse(tree))
    texts = frozenset(name for name in used if _is_text(name, block, model))

    def is_number(text: str) -> bool:
        return texts.isdisjoint(names(text))

    yield "градусы вместо радиан в sin, cos", without_radians
    for which in (None, 0, 1, 2):
        yield "sin и cos взяты друг вместо друга", OtherRatio(which).visit
    for taken, words in (("sin", "sin вместо tg"), ("cos", "cos вместо tg")):
        yield words, OtherRatio(None, {"tan": taken}).visit
    yield "угол φ вместо 2φ под знаком sin, cos", SingleAngle().visit
    yield "угол φ/2 вместо φ под знаком sin, cos", HalfAngle().visit
    yield "угол 4φ вместо 2φ под знаком sin, cos", DoubleAngle().visit
    for right, taken in (("asin", "acos"), ("acos", "asin")):
        yield f"{taken.upper()} вместо {right.upper()}", OtherRatio(None, {right: taken}).visit
    yield "ATAN вместо ASIN", ArcTangent().visit
    yield "сложены модули вместо корня из суммы квадратов", SumOfSizes().visit
    for name in _ARCS:
        yield f"взят аргумент вместо {name.upper()}", WithoutFunction(name).visit
    yield from _shorter(tree, block, model)
    yield ROOTLESS, WithoutRoot().visit
    for swapped in (Swapped().visit, lambda tree: Swapped().visit(otherwise(tree))):
        yield "аргументы ATAN2 переставлены: первым пишут x", swapped
    for value, words in _ROUGH:
        yield f"π взято как {words}", OtherPi(value).visit
    for text in factors(tree):
        if not text.startswith(_UNSQUARED) and not is_known_function(text) and is_number(text):
            symbol = _symbols(parse(text), block, model)
            yield f"{symbol} в квадрате, а надо в первой степени", Squared(text).visit
    for wrong_for, taken, words in MIXED:
        others = names(taken)
        if wrong_for in used and all(n in model.scalars or n in model.fields for n in others):
            more = ""
            if {wrong_for, taken} == {"r_crank", "S_stroke"} and numbers(tree):
                more = " или потерянный делитель 2 (вдвое больше или меньше)"
            yield words + more, Renamed(wrong_for, taken).visit
    for by in _DIVISORS if "lam" in used else ():  # λ/2 of the speed and λ/4 of the path
        yield f"λ/{by} вместо λ", Divided("lam", by).visit
    for number, words in enumerate(signs(tree, block, model)):
        yield words, Flipped(number, ast.Add, ast.Sub).visit
    table = model.tables.get(block)
    yield from _columns(table, used) if table is not None else ()
    for number in range(_PRODUCTS):
        yield "деление вместо умножения или наоборот", Flipped(number, ast.Mult, ast.Div).visit
    for number in range(_SIGNS):
        yield "умножение вместо сложения или наоборот", Flipped(number, ast.Add, ast.Mult).visit


def signs(tree: ast.expr, block: str, model: Model) -> list[str]:
    """Words on the sign of each summand of a formula but the first of a sum."""
    terms = second_operands(tree)[:_SIGNS]
    return [f"знак слагаемого {_plain(term, block, model)}" for term in terms]


def exchanges(tree: ast.expr, block: str, model: Model) -> Iterator[Mistake]:
    """Tell two quantities of a unit taken for each other, or one that the list has elsewhere."""
    used = names(ast.unparse(tree))
    units = {name: _unit(name, block, model) for name in sorted(used)}
    measured = [name for name, unit in units.items() if unit]
    for one, other in combinations(measured, 2):
        if units[one] == units[other]:
            symbols = [symbol_of(name, block, model) for name in (one, other)]
            yield f"{symbols[0]} и {symbols[1]} переставлены", Exchanged(one, other).visit
    beside = {name: _unit(name, block, model) for name in sorted(_beside(block, model) - used)}
    for one in measured:
        for other, unit in beside.items():
            if unit == units[one]:
                words = f"{symbol_of(other, block, model)} вместо {symbol_of(one, block, model)}"
                yield words, Renamed(one, other).visit


def _beside(block: str, model: Model) -> frozenset[str]:
    """Return single values that formulas of a list take."""
    scalars = [s for b in model.blocks if b.id == block for s in scalars_of(b)]
    return frozenset().union(*(names(scalar.expr) for scalar in scalars))


def _unit(name: str, block: str, model: Model) -> str:
    """Return the unit of a name of a formula, empty where it is none."""
    node = model.nodes.get(node_of(name, block, model))
    if node is not None:
        return node.quantity.unit_label
    return model.fields[name].unit if name in model.fields else ""


def _is_text(name: str, block: str, model: Model) -> bool:
    """Whether a name of a formula is a choice of the input, or a result in words."""
    node = model.nodes.get(node_of(name, block, model))
    if node is not None:
        return node.quantity.digits.kind == "text"
    return name in model.fields and isinstance(model.fields[name].value, str)


def _columns(table: TableSpec, used: frozenset[str]) -> Iterator[Mistake]:
    """Return a column of the same table and unit taken for one of the formula's."""
    for column in table.columns:
        for other in table.columns if column.key in used else ():
            if other is not column and other.quantity.unit == column.quantity.unit:
                words = f"{other.quantity.symbol} вместо {column.quantity.symbol}"
                yield words, Renamed(column.key, other.key).visit


def _shorter(tree: ast.expr, block: str, model: Model) -> Iterator[Mistake]:
    """Something left out of the formula: a bracket, a summand, a factor, a power, a number."""
    for text in brackets(tree):
        words = _plain(parse(text), block, model)
        yield f"пропущен множитель ({words})", WithoutFactor(text).visit
        yield f"({words}) в квадрате, а надо в первой степени", Squared(text).visit
        for other in loose(tree, text):
            yield f"нет скобок вокруг {words}", partial(_replaced, other)
    for number, dropped in enumerate(summands(tree)):
        words = f"пропущено слагаемое {_plain(dropped, block, model)}"
        yield words, WithoutSummand(number).changed
    for text in factors(tree):
        named = _plain if text.startswith("sqrt(") else _symbols
        symbol = named(parse(text), block, model)
        yield f"пропущен множитель {symbol}", WithoutFactor(text).visit
        for exponent in sorted({exponent_of(n) for n in ast.walk(tree) if _is_raised(n, text)}):
            power = _POWERS.get(exponent, f"степень {short(exponent)}")
            yield f"не возведено в {power}: {symbol}", WithoutPower(text).visit
            if exponent > 2:
                lower = _POWERS.get(exponent - 1, f"степень {short(exponent - 1)}")
                yield f"{symbol} возведено в {lower}, а надо в {power}", LowerPower(text).visit
    for value in numbers(tree):
        words = "взято целое вместо половины" if value == 0.5 else f"потеряно число {short(value)}"
        area = value == 4 and "geometry_bore_mm" in names(ast.unparse(tree))
        words = "π·D² вместо π·D²/4" if area else words
        yield words, WithoutNumber(value).visit
    yield "скобка не возведена в степень", WithoutPowers().visit
    for more, words in ((True, "больше"), (False, "меньше")):
        yield f"показатель степени на единицу {words}", OtherExponent(more=more).visit


def _replaced(other: ast.expr, tree: ast.expr) -> ast.AST:
    return other


def symbol_of(name: str, block: str, model: Model) -> str:
    """Symbol of a name in a formula of a block."""
    key = node_of(name, block, model)
    node = model.nodes.get(model.grid_runs.get(key, (key,))[0])
    if node is not None:
        return node.quantity.symbol
    return uncapital(model.fields[name].title) if name in model.fields else name


def _plain(tree: ast.expr, block: str, model: Model) -> str:
    """Return a part of a formula in a line."""
    return plain(ast.unparse(tree), lambda name: symbol_of(name, block, model))


def _is_raised(node: ast.AST, text: str) -> bool:
    return is_power(node) and ast.unparse(node.left) == text


def _symbols(tree: ast.expr, block: str, model: Model) -> str:
    used = sorted(names(ast.unparse(tree)))
    symbols = "·".join(dict.fromkeys(symbol_of(name, block, model) for name in used))
    if isinstance(tree, ast.Call) and isinstance(tree.func, ast.Name):
        name = tree.func.id
        return symbols if name in _NAMELESS else f"{_CALLED.get(name, name)} {symbols}"
    return symbols or ast.unparse(tree).replace("pi", "π")
