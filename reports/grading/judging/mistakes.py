"""Usual mistakes in a formula, as changes of its tree."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator
from typing import ClassVar, TypeGuard

from reports.formula.parse import SCALE_FUNCTIONS, SHIFTS, is_known_function, names, parse
from reports.formula.plain import plain
from reports.model.blocks import Model, TableSpec
from reports.model.evaluation import node_of
from reports.shared.russian import short

# Quantities that are taken for each other.
MIXED = (
    ("r_crank", "S_stroke", "ход поршня S вместо радиуса кривошипа r"),
    ("S_stroke", "r_crank", "радиус кривошипа r вместо хода поршня S"),
    ("r_crank", "L_rod", "длина шатуна L вместо радиуса кривошипа r"),
    ("L_rod", "r_crank", "радиус кривошипа r вместо длины шатуна L"),
    ("omega", "regime_speed_rpm", "частота вращения n в мин⁻¹ вместо угловой скорости ω"),
    ("m_j", "m_2", "масса m2 вместо mj"),
    ("m_2", "m_j", "масса mj вместо m2"),
    ("m_1", "m_2", "масса m2 вместо m1"),
    ("m_2", "m_1", "масса m1 вместо m2"),
    ("m_1", "masses_rod_kg", "вся масса шатуна вместо m1"),
    ("m_2", "masses_rod_kg", "вся масса шатуна вместо m2"),
    ("F_piston", "geometry_bore_mm", "диаметр цилиндра вместо площади поршня"),
    ("geometry_bore_mm", "S_stroke", "ход поршня S вместо диаметра цилиндра"),
)


def summands(tree: ast.AST) -> list[ast.expr]:
    """Summands of all sums of a formula but those of its exponents, as they are written."""
    if isinstance(tree, ast.BinOp) and isinstance(tree.op, ast.Pow):
        return summands(tree.left)
    terms: list[ast.expr] = []
    for side in ast.iter_child_nodes(tree):
        if _is_sum(tree) and isinstance(side, ast.expr) and not _is_sum(side):
            terms.append(side)
        terms += summands(side)
    return terms


def _is_power(tree: ast.AST) -> TypeGuard[ast.BinOp]:
    return isinstance(tree, ast.BinOp) and isinstance(tree.op, ast.Pow)


def _is_sum(tree: ast.AST) -> bool:
    return isinstance(tree, ast.BinOp) and isinstance(tree.op, (ast.Add, ast.Sub))


def brackets(tree: ast.expr) -> list[str]:
    """Sums in brackets by which a formula multiplies or divides, with a power or without."""
    bases: dict[str, None] = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.BinOp) and isinstance(node.op, (ast.Mult, ast.Div)):
            for side in (node.left, node.right):
                base = side.left if _is_power(side) else side
                if _is_sum(base):
                    bases[ast.unparse(base)] = None
    return list(bases)


def factors(tree: ast.expr) -> list[str]:
    """Names and functions of a formula; what it multiplies or divides by is among them."""
    nodes = (node for node in ast.walk(tree) if isinstance(node, (ast.Name, ast.Call)))
    return sorted({ast.unparse(node) for node in nodes})


def numbers(tree: ast.expr) -> list[float]:
    """Numbers by which a formula multiplies or divides."""
    literals = []
    for node in ast.walk(tree):
        if isinstance(node, ast.BinOp) and isinstance(node.op, (ast.Mult, ast.Div)):
            for side in (node.left, node.right):
                if isinstance(side, ast.Constant) and isinstance(side.value, (int, float)):
                    literals.append(float(side.value))
    return sorted(set(literals) - {1.0})


class WithoutSummand(ast.NodeTransformer):
    """Leaves one summand out, where there is one: nought stands in its place."""

    def __init__(self, number: int) -> None:
        self.number = number
        self.wanted: ast.AST = ast.Constant(0)

    def changed(self, tree: ast.expr) -> ast.AST:
        """The formula without it."""
        terms = summands(tree)
        self.wanted = terms[self.number] if self.number < len(terms) else self.wanted
        return self.visit(tree)

    def visit(self, node: ast.AST) -> ast.AST:
        """Nought for the summand."""
        return ast.Constant(0) if node is self.wanted else self.generic_visit(node)


class WithoutFactor(ast.NodeTransformer):
    """Leaves a factor or a divisor out, with its power: a name, or a function of something."""

    def __init__(self, text: str) -> None:
        self.text = text

    def _is(self, node: ast.expr) -> bool:
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Pow):
            node = node.left
        return ast.unparse(node) == self.text

    def visit_BinOp(self, node: ast.BinOp) -> ast.AST:
        """The other side of a product, one in the place of what is divided."""
        if isinstance(node.op, (ast.Mult, ast.Div)):
            if self._is(node.right):
                return self.visit(node.left)  # type: ignore[no-any-return]
            if self._is(node.left):
                node.left = ast.Constant(1)
        self.generic_visit(node)
        return node


class WithoutPower(ast.NodeTransformer):
    """Takes the power from a name or a function."""

    def __init__(self, text: str) -> None:
        self.text = text

    def visit_BinOp(self, node: ast.BinOp) -> ast.AST:
        """The name or function alone."""
        self.generic_visit(node)
        named = ast.unparse(node.left) == self.text
        return node.left if isinstance(node.op, ast.Pow) and named else node


class Squared(ast.NodeTransformer):
    """Squares a name or a function that has no power."""

    def __init__(self, text: str) -> None:
        self.text = text

    def visit_BinOp(self, node: ast.BinOp) -> ast.AST:
        """What has a power keeps it."""
        return node if _is_power(node) else self.generic_visit(node)

    def visit_Attribute(self, node: ast.Attribute) -> ast.AST:
        """The name of a table is no quantity."""
        return node

    def visit_Name(self, node: ast.Name) -> ast.AST:
        """The square of a name."""
        return self._squared(node)

    def visit_Call(self, node: ast.Call) -> ast.AST:
        """The square of a function."""
        node.args = [self.visit(argument) for argument in node.args]
        return self._squared(node)

    def _squared(self, node: ast.expr) -> ast.expr:
        is_it = ast.unparse(node) == self.text
        return ast.BinOp(node, ast.Pow(), ast.Constant(2)) if is_it else node


class WithoutRoot(ast.NodeTransformer):
    """Leaves the root out."""

    def visit_Call(self, node: ast.Call) -> ast.AST:
        """What stands under it."""
        self.generic_visit(node)
        rooted = isinstance(node.func, ast.Name) and node.func.id == "sqrt"
        return node.args[0] if rooted else node


class Swapped(ast.NodeTransformer):
    """Swaps the arguments of atan2, whose order a spreadsheet has the other way round."""

    def visit_Call(self, node: ast.Call) -> ast.AST:
        """The function with its arguments in the other order."""
        self.generic_visit(node)
        if isinstance(node.func, ast.Name) and node.func.id == "atan2":
            node.args = node.args[::-1]
        return node


class OtherPi(ast.NodeTransformer):
    """Takes a rough π, in the conversion of angles as well."""

    def __init__(self, value: float) -> None:
        self.value = ast.Constant(value)

    def visit_Name(self, node: ast.Name) -> ast.AST:
        """The rough π."""
        return self.value if node.id == "pi" else node

    def visit_Call(self, node: ast.Call) -> ast.AST:
        """An angle turned into radians or degrees by it."""
        self.generic_visit(node)
        name = node.func.id if isinstance(node.func, ast.Name) else ""
        if name not in ("rad", "deg"):
            return node
        ratio = ast.BinOp(self.value, ast.Div(), ast.Constant(180))
        turn = ast.Mult() if name == "rad" else ast.Div()
        return ast.BinOp(node.args[0], turn, ratio)


class WithoutPowers(ast.NodeTransformer):
    """Takes the power of a number from what stands in brackets."""

    def visit_BinOp(self, node: ast.BinOp) -> ast.AST:
        """The bracket alone."""
        self.generic_visit(node)
        squared = isinstance(node.op, ast.Pow) and isinstance(node.right, ast.Constant)
        return node.left if squared and isinstance(node.left, ast.BinOp) else node


class OtherExponent(ast.NodeTransformer):
    """Takes n for n − 1 in an exponent, or n − 1 for n."""

    def __init__(self, *, more: bool) -> None:
        self.more = more

    def visit_BinOp(self, node: ast.BinOp) -> ast.AST:
        """The other exponent."""
        self.generic_visit(node)
        if not isinstance(node.op, ast.Pow):
            return node
        less_one = isinstance(node.right, ast.BinOp) and ast.unparse(node.right).endswith(" - 1")
        if self.more and less_one and isinstance(node.right, ast.BinOp):
            node.right = node.right.left
        elif not self.more and isinstance(node.right, ast.Name):
            node.right = ast.BinOp(node.right, ast.Sub(), ast.Constant(1))
        return node


class WithoutNumber(ast.NodeTransformer):
    """Leaves a factor or divisor that is a number out."""

    def __init__(self, value: float) -> None:
        self.value = value

    def visit_BinOp(self, node: ast.BinOp) -> ast.AST:
        """The other side."""
        self.generic_visit(node)
        if isinstance(node.op, (ast.Mult, ast.Div)):
            for side, other in ((node.right, node.left), (node.left, node.right)):
                is_factor = side is node.right or isinstance(node.op, ast.Mult)
                same = isinstance(side, ast.Constant) and side.value == self.value
                if is_factor and same:
                    return other
        return node


def without_radians(tree: ast.expr) -> ast.expr:
    """Degrees where radians are wanted."""
    result = NoRadians().visit(tree)
    assert isinstance(result, ast.expr)
    return result


class OtherRatio(ast.NodeTransformer):
    """Takes the sine for the cosine and the cosine for the sine, in one place or in all."""

    _OTHER: ClassVar = {"sin": "cos", "cos": "sin"}

    def __init__(self, number: int | None) -> None:
        self.number, self.seen = number, -1

    def visit_Call(self, node: ast.Call) -> ast.AST:
        """The other ratio of the same angle."""
        self.generic_visit(node)
        if isinstance(node.func, ast.Name) and node.func.id in self._OTHER:
            self.seen += 1
            if self.number in (None, self.seen):
                node.func = ast.Name(self._OTHER[node.func.id], ast.Load())
        return node


class NoRadians(ast.NodeTransformer):
    """Leaves the conversion out."""

    def visit_Call(self, node: ast.Call) -> ast.AST:
        """The angle as it is."""
        self.generic_visit(node)
        if isinstance(node.func, ast.Name) and node.func.id == "rad":
            return node.args[0]
        return node


class Renamed(ast.NodeTransformer):
    """Takes one name for another."""

    def __init__(self, old: str, new: str) -> None:
        self.old, self.new = old, new

    def visit_Name(self, node: ast.Name) -> ast.AST:
        """The other name."""
        return (
            ast.copy_location(ast.Name(self.new, ast.Load()), node) if node.id == self.old else node
        )


SIGNS = tuple((number, f"знак слагаемого {number + 2}") for number in range(3))


class Flipped(ast.NodeTransformer):
    """Turns one operation of the formula round: a sum and a difference, a product and a ratio."""

    def __init__(self, number: int, one: type[ast.operator], other: type[ast.operator]) -> None:
        self.number, self.pair, self.seen = number, {one: other, other: one}, -1

    def visit_BinOp(self, node: ast.BinOp) -> ast.AST:
        """The other operation."""
        self.generic_visit(node)
        other = self.pair.get(type(node.op))
        if other is not None:
            self.seen += 1
            if self.seen == self.number:
                node.op = other()
        return node


# --- the mistakes --------------------------------------------------------------------------------

_ROUGH = ((3.14, "3,14"), (3.0, "3"), (22 / 7, "22/7"))
# Conversions, not quantities.
_UNSQUARED = ("rad(", "deg(", "to_", "of_", "sqrt(")
_PRODUCTS = 4  # of a formula, in which it may divide instead
Mistake = tuple[str, Callable[[ast.expr], ast.AST]]


def mistakes(tree: ast.expr, block: str, model: Model) -> Iterator[Mistake]:
    """What may have become of the formula of a value of a block, the likeliest first."""
    used = names(ast.unparse(tree))
    texts = frozenset(name for name in used if _is_text(name, block, model))

    def is_number(text: str) -> bool:
        return texts.isdisjoint(names(text))

    yield "градусы вместо радиан в sin, cos", without_radians
    for which in (None, 0, 1, 2):
        yield "sin и cos взяты друг вместо друга", OtherRatio(which).visit
    yield from _shorter(tree, block, model)
    yield "значение под корнем: корень не извлечён", WithoutRoot().visit
    yield "аргументы ATAN2 переставлены: первым пишут x", Swapped().visit
    for value, words in _ROUGH:
        yield f"π взято как {words}", OtherPi(value).visit
    for text in factors(tree):
        if not text.startswith(_UNSQUARED) and not is_known_function(text) and is_number(text):
            symbol = _symbols(parse(text), block, model)
            yield f"{symbol} в квадрате, а надо в первой степени", Squared(text).visit
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


def _is_text(name: str, block: str, model: Model) -> bool:
    """Whether a name of a formula is a choice of the input, or a result in words."""
    node = model.nodes.get(node_of(name, block, model))
    if node is not None:
        return node.quantity.digits.kind == "text"
    return name in model.fields and isinstance(model.fields[name].value, str)


def _columns(table: TableSpec, used: frozenset[str]) -> Iterator[Mistake]:
    """A column of the same table and unit taken for one of the formula's."""
    for column in table.columns:
        for other in table.columns if column.key in used else ():
            if other is not column and other.quantity.unit == column.quantity.unit:
                words = f"{other.quantity.symbol} вместо {column.quantity.symbol}"
                yield words, Renamed(column.key, other.key).visit


def _shorter(tree: ast.expr, block: str, model: Model) -> Iterator[Mistake]:
    """Something left out of the formula: a bracket, a summand, a factor, a power, a number."""
    for text in brackets(tree):
        words = plain(text, lambda name: symbol_of(name, block, model))
        yield f"пропущен множитель ({words})", WithoutFactor(text).visit
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
    symbols = "·".join(dict.fromkeys(symbol_of(name, block, model) for name in used))
    if isinstance(tree, ast.Call) and isinstance(tree.func, ast.Name):
        name = tree.func.id
        return symbols if name in _NAMELESS else f"{_CALLED.get(name, name)} {symbols}"
    return symbols or ast.unparse(tree).replace("pi", "π")
