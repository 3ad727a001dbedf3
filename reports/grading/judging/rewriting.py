"""Formulas rewritten with one mistake in them, as changes of their trees."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from typing import ClassVar, TypeGuard

from reports.formula.parse import SCALE_FUNCTIONS, parse

_MAX_FACTORS = 3  # round a sum, of which each may be on either side
LEAST = 2  # exponent, below which there is no power


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


def is_power(tree: ast.AST) -> TypeGuard[ast.BinOp]:
    """Whether something is raised to a power."""
    return isinstance(tree, ast.BinOp) and isinstance(tree.op, ast.Pow)


def _is_sum(tree: ast.AST) -> TypeGuard[ast.BinOp]:
    return isinstance(tree, ast.BinOp) and isinstance(tree.op, (ast.Add, ast.Sub))


def brackets(tree: ast.expr) -> list[str]:
    """Return sums in brackets by which a formula multiplies or divides, with a power or without."""
    bases: dict[str, None] = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.BinOp) and isinstance(node.op, (ast.Mult, ast.Div)):
            for side in (node.left, node.right):
                base = side.left if is_power(side) else side
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
            for side in (*_picked(node.left), *_picked(node.right)):
                if isinstance(side, ast.Constant) and isinstance(side.value, (int, float)):
                    literals.append(float(side.value))
    return sorted(set(literals) - {1.0})


def _picked(side: ast.expr) -> tuple[ast.expr, ...]:
    """Return what a condition may pick, or the side itself."""
    return (side.body, side.orelse) if isinstance(side, ast.IfExp) else (side,)


def loose(tree: ast.expr, text: str) -> Iterator[ast.expr]:
    """Yield a formula without the brackets round a sum, its factors on either side of it.

    As it stands first; of a product people write the factors in any order.
    """
    yield parse(ast.unparse(tree).replace(f"({text})", text, 1))
    parts = _product(tree)
    others = [part for part in parts if ast.unparse(part) != text]
    if len(others) != len(parts) - 1 or len(others) > _MAX_FACTORS:
        return
    for right in range(2 ** len(others)):
        before = [part for at, part in enumerate(others) if not right >> at & 1]
        after = [part for at, part in enumerate(others) if right >> at & 1]
        yield parse("*".join([*_bracketed(before), text, *_bracketed(after)]))


def _product(tree: ast.expr) -> list[ast.expr]:
    """Return the factors of a formula that is a product."""
    if isinstance(tree, ast.BinOp) and isinstance(tree.op, ast.Mult):
        return [*_product(tree.left), *_product(tree.right)]
    called = tree.func.id if isinstance(tree, ast.Call) and isinstance(tree.func, ast.Name) else ""
    if isinstance(tree, ast.Call) and called in SCALE_FUNCTIONS:
        return [parse(f"{called}(1)"), *_product(tree.args[0])]
    return [tree]


def _bracketed(parts: list[ast.expr]) -> list[str]:
    return [f"({ast.unparse(part)})" for part in parts]


def second_operands(tree: ast.AST) -> list[ast.expr]:
    """Return what sums and differences add or take away, in the order of ``Flipped``."""
    operands = [each for side in ast.iter_child_nodes(tree) for each in second_operands(side)]
    return [*operands, tree.right] if _is_sum(tree) else operands


class WithoutSummand(ast.NodeTransformer):
    """Leaves one summand out, where there is one: nought stands in its place."""

    def __init__(self, number: int) -> None:
        self.number = number
        self.wanted: ast.AST = ast.Constant(0)

    def changed(self, tree: ast.expr) -> ast.AST:
        """Return the formula without it."""
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
        """Return the other side of a product, one in the place of what is divided."""
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
        """Return the name or function alone."""
        self.generic_visit(node)
        named = ast.unparse(node.left) == self.text
        return node.left if isinstance(node.op, ast.Pow) and named else node


class Squared(ast.NodeTransformer):
    """Squares a name, a function or a sum that has no power."""

    def __init__(self, text: str) -> None:
        self.text = text

    def visit_BinOp(self, node: ast.BinOp) -> ast.AST:
        """Keep what has a power as it is, square a sum."""
        if is_power(node):
            return node
        return self._squared(node) if _is_sum(node) else self.generic_visit(node)

    def visit_Attribute(self, node: ast.Attribute) -> ast.AST:
        """Pass by the name of a table: it is no quantity."""
        return node

    def visit_Name(self, node: ast.Name) -> ast.AST:
        """Return the square of a name."""
        return self._squared(node)

    def visit_Call(self, node: ast.Call) -> ast.AST:
        """Return the square of a function."""
        node.args = [self.visit(argument) for argument in node.args]
        return self._squared(node)

    def _squared(self, node: ast.expr) -> ast.AST:
        if ast.unparse(node) == self.text:
            return ast.BinOp(node, ast.Pow(), ast.Constant(2))
        return self.generic_visit(node) if _is_sum(node) else node


class WithoutRoot(ast.NodeTransformer):
    """Leaves the root out."""

    def visit_Call(self, node: ast.Call) -> ast.AST:
        """Tell what stands under it."""
        self.generic_visit(node)
        rooted = isinstance(node.func, ast.Name) and node.func.id == "sqrt"
        return node.args[0] if rooted else node


class SumOfSizes(ast.NodeTransformer):
    """Adds the sizes of two sides instead of the root of the sum of their squares."""

    def visit_Call(self, node: ast.Call) -> ast.AST:
        """Return the sum of the sizes."""
        self.generic_visit(node)
        match node:
            case ast.Call(
                func=ast.Name(id="sqrt"),
                args=[ast.BinOp(op=ast.Add(), left=ast.BinOp() as one, right=ast.BinOp() as other)],
            ) if exponent_of(one) == exponent_of(other) == LEAST:
                return ast.BinOp(_size(one.left), ast.Add(), _size(other.left))
        return node


def _size(tree: ast.expr) -> ast.expr:
    return ast.Call(ast.Name("abs", ast.Load()), [tree], [])


class WithoutFunction(ast.NodeTransformer):
    """Takes the argument of a function for its value."""

    def __init__(self, name: str) -> None:
        self.name = name

    def visit_Call(self, node: ast.Call) -> ast.AST:
        """Tell what stands in its brackets."""
        self.generic_visit(node)
        named = isinstance(node.func, ast.Name) and node.func.id == self.name
        return node.args[0] if named and len(node.args) == 1 else node


class SingleAngle(ast.NodeTransformer):
    """Takes an angle for its double in the sines and cosines."""

    def visit_Call(self, node: ast.Call) -> ast.AST:
        """Return the ratio of the angle itself."""
        self.generic_visit(node)
        if isinstance(node.func, ast.Name) and node.func.id in ("sin", "cos"):
            node.args = [WithoutNumber(2.0).visit(argument) for argument in node.args]
        return node


class HalfAngle(ast.NodeTransformer):
    """Takes the half of an angle in the sines and cosines."""

    def visit_Call(self, node: ast.Call) -> ast.AST:
        """Return the ratio of the half angle."""
        self.generic_visit(node)
        if isinstance(node.func, ast.Name) and node.func.id in ("sin", "cos"):
            node.args = [ast.BinOp(one, ast.Div(), ast.Constant(2.0)) for one in node.args]
        return node


class DoubleAngle(ast.NodeTransformer):
    """Takes the double of an angle that is doubled already: 4φ for 2φ."""

    def visit_Call(self, node: ast.Call) -> ast.AST:
        """Return the ratio of the double angle."""
        self.generic_visit(node)
        if isinstance(node.func, ast.Name) and node.func.id in ("sin", "cos"):
            node.args = [
                ast.BinOp(ast.Constant(2.0), ast.Mult(), one) if 2.0 in numbers(one) else one
                for one in node.args
            ]
        return node


class Divided(ast.NodeTransformer):
    """Divides a name by a number where it stands, whatever else the formula has."""

    def __init__(self, name: str, by: float) -> None:
        self.name, self.by = name, by

    def visit_Name(self, node: ast.Name) -> ast.AST:
        """Return the name divided."""
        if node.id != self.name:
            return node
        return ast.BinOp(node, ast.Div(), ast.Constant(self.by))


class LowerPower(ast.NodeTransformer):
    """Takes the square for the cube, or another power one less."""

    def __init__(self, text: str) -> None:
        self.text = text

    def visit_BinOp(self, node: ast.BinOp) -> ast.AST:
        """Return the lower power."""
        self.generic_visit(node)
        exponent = exponent_of(node)
        if exponent > LEAST and ast.unparse(node.left) == self.text:
            node.right = ast.Constant(exponent - 1)
        return node


def exponent_of(node: ast.AST) -> float:
    """Return the number that something is raised to, 1 where there is no such."""
    if is_power(node) and isinstance(node.right, ast.Constant):
        value = node.right.value
        return float(value) if isinstance(value, (int, float)) else 1.0
    return 1.0


class ArcTangent(ast.NodeTransformer):
    """Takes the angle of a tangent for that of a sine."""

    def visit_Call(self, node: ast.Call) -> ast.AST:
        """Return the arc tangent, which the language has of two numbers."""
        self.generic_visit(node)
        if isinstance(node.func, ast.Name) and node.func.id == "asin":
            node.func = ast.Name("atan2", ast.Load())
            node.args.append(ast.Constant(1.0))
        return node


class Swapped(ast.NodeTransformer):
    """Swaps the arguments of atan2, whose order a spreadsheet has the other way round."""

    def visit_Call(self, node: ast.Call) -> ast.AST:
        """Return the function with its arguments in the other order."""
        self.generic_visit(node)
        if isinstance(node.func, ast.Name) and node.func.id == "atan2":
            node.args = node.args[::-1]
        return node


def otherwise(tree: ast.expr) -> ast.expr:
    """Return the formula of what no condition picks: few tell the vector of nought apart."""
    return otherwise(tree.orelse) if isinstance(tree, ast.IfExp) else tree


class OtherPi(ast.NodeTransformer):
    """Takes a rough π, in the conversion of angles as well."""

    def __init__(self, value: float) -> None:
        self.value = ast.Constant(value)

    def visit_Name(self, node: ast.Name) -> ast.AST:
        """Return the rough π."""
        return self.value if node.id == "pi" else node

    def visit_Call(self, node: ast.Call) -> ast.AST:
        """Return an angle turned into radians or degrees by it."""
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
        """Return the bracket alone."""
        self.generic_visit(node)
        squared = isinstance(node.op, ast.Pow) and isinstance(node.right, ast.Constant)
        return node.left if squared and isinstance(node.left, ast.BinOp) else node


class OtherExponent(ast.NodeTransformer):
    """Takes n for n − 1 in an exponent, or n − 1 for n."""

    def __init__(self, *, more: bool) -> None:
        self.more = more

    def visit_BinOp(self, node: ast.BinOp) -> ast.AST:
        """Return the other exponent."""
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
        """Return the other side."""
        self.generic_visit(node)
        if isinstance(node.op, (ast.Mult, ast.Div)):
            for side, other in ((node.right, node.left), (node.left, node.right)):
                is_factor = side is node.right or isinstance(node.op, ast.Mult)
                same = isinstance(side, ast.Constant) and side.value == self.value
                if is_factor and same:
                    return other
        return node

    def visit_IfExp(self, node: ast.IfExp) -> ast.AST:
        """Pick one for the number."""
        self.generic_visit(node)
        branches = (
            ast.Constant(1) if isinstance(side, ast.Constant) and side.value == self.value else side
            for side in _picked(node)
        )
        return ast.IfExp(node.test, *branches)


def without_radians(tree: ast.expr) -> ast.expr:
    """Degrees where radians are wanted."""
    result = NoRadians().visit(tree)
    assert isinstance(result, ast.expr)
    return result


class OtherRatio(ast.NodeTransformer):
    """Takes the sine for the cosine and the cosine for the sine, in one place or in all."""

    _COS: ClassVar = {"sin": "cos", "cos": "sin"}

    def __init__(self, number: int | None, other: dict[str, str] | None = None) -> None:
        self.number, self.seen, self._OTHER = number, -1, other or self._COS

    def visit_Call(self, node: ast.Call) -> ast.AST:
        """Return the other ratio of the same angle."""
        self.generic_visit(node)
        if isinstance(node.func, ast.Name) and node.func.id in self._OTHER:
            self.seen += 1
            if self.number in (None, self.seen):
                node.func = ast.Name(self._OTHER[node.func.id], ast.Load())
        return node


class NoRadians(ast.NodeTransformer):
    """Leaves the conversion out."""

    def visit_Call(self, node: ast.Call) -> ast.AST:
        """Return the angle as it is."""
        self.generic_visit(node)
        if isinstance(node.func, ast.Name) and node.func.id == "rad":
            return node.args[0]
        return node


class Renamed(ast.NodeTransformer):
    """Takes something else for a name: another name, or an expression."""

    def __init__(self, old: str, new: str) -> None:
        self.old, self.new = old, new

    def visit_Name(self, node: ast.Name) -> ast.AST:
        """Tell what is taken."""
        return parse(self.new) if node.id == self.old else node


class Exchanged(ast.NodeTransformer):
    """Takes two names for each other."""

    def __init__(self, one: str, other: str) -> None:
        self.names = {one: other, other: one}

    def visit_Name(self, node: ast.Name) -> ast.AST:
        """Tell what is taken."""
        return ast.Name(self.names.get(node.id, node.id))


class Flipped(ast.NodeTransformer):
    """Turns one operation of the formula round: a sum and a difference, a product and a ratio."""

    def __init__(self, number: int, one: type[ast.operator], other: type[ast.operator]) -> None:
        self.number, self.pair, self.seen = number, {one: other, other: one}, -1

    def visit_BinOp(self, node: ast.BinOp) -> ast.AST:
        """Return the other operation."""
        self.generic_visit(node)
        other = self.pair.get(type(node.op))
        if other is not None:
            self.seen += 1
            if self.seen == self.number:
                node.op = other()
        return node
