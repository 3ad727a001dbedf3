"""Canonical trees: formulas that differ in notation alone are equal.

Addresses and names become the nodes that they stand for, helper cells the formulas in them;
RADIANS, ROUND, SQRT, POWER, brackets, the order of summands and factors, 3.1416 for π make no
difference.  What is left is the algebra of the formula.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from math import isfinite
from typing import Any

from reports.recalculation.formulas import Token, ref_of, unquoted
from reports.shared.errors import UnknownFormula

Tree = tuple[Any, ...]  # ("num", 2.0), ("node", "P3_1.s_mm", 0), ("sum", …), ("cos", …)
_DEEP = 8  # helper cells that refer to each other
_PI = 3.141592653589793
# What changes no algebra: the first argument stands for the call.
_WRAPPERS = frozenset(["ROUND", "ROUNDUP", "ROUNDDOWN", "TRUNC", "IFERROR", "IFNA", "N", "VALUE"])
_COMPARED = ("=", "<>", "<", ">", "<=", ">=")


def num(value: float) -> Tree:
    """Return a number to three digits: 57.3 stands for 180/π."""
    return ("num", float(f"{value:.3g}") if isfinite(value) else 0.0)


def add(*terms: Tree) -> Tree:
    """Return a sum without brackets, in the order of the alphabet."""
    flat: list[Tree] = []
    total = 0.0
    for term in terms:
        for part in term[1:] if term[0] == "sum" else (term,):
            if part[0] == "num":
                total += part[1]
            else:
                flat.append(part)
    if total or not flat:
        flat.append(num(total))
    return flat[0] if len(flat) == 1 else ("sum", *sorted(flat, key=repr))


def mul(*factors: Tree) -> Tree:
    """Return a product without brackets: equal factors as one power, numbers as one."""
    powers: dict[Tree, float] = {}
    product = 1.0
    stack = list(factors)
    while stack:
        part = stack.pop()
        if part[0] == "prod":
            stack += part[1:]
        elif part[0] == "num":
            product *= part[1]
        elif part[0] == "pow" and part[2][0] == "num":
            powers[part[1]] = powers.get(part[1], 0.0) + part[2][1]
        else:
            powers[part] = powers.get(part, 0.0) + 1.0
    flat = [base if n == 1 else ("pow", base, num(n)) for base, n in powers.items() if n]
    product = num(product)[1]
    if product != 1 or not flat:
        flat.append(num(product))
    return flat[0] if len(flat) == 1 else ("prod", *sorted(flat, key=repr))


def power(base: Tree, exponent: Tree) -> Tree:
    """Return a power; that of a product is the product of powers."""
    if exponent[0] != "num":
        return ("pow", base, exponent)
    n = exponent[1]
    if base[0] == "num":
        try:
            return num(base[1] ** n) if base[1] > 0 or n == int(n) else ("pow", base, exponent)
        except (ZeroDivisionError, OverflowError):
            return ("pow", base, exponent)
    if base[0] == "prod" and n == int(n):
        return mul(*(power(part, exponent) for part in base[1:]))
    if base[0] == "pow" and base[2][0] == "num":
        return power(base[1], num(base[2][1] * n))
    return base if n == 1 else ("pow", base, exponent)


def _times(value: float) -> Callable[..., Tree]:
    return lambda argument: mul(num(value), argument)


_CALLS: dict[str, Callable[..., Tree]] = {
    "RADIANS": _times(_PI / 180), "DEGREES": _times(180 / _PI), "PI": lambda: num(_PI),
    "SQRT": lambda x: power(x, num(0.5)), "POWER": power, "SUM": add, "PRODUCT": mul,
    "SUMSQ": lambda *xs: add(*(power(x, num(2)) for x in xs)),
    "SQRTPI": lambda x: power(mul(x, num(_PI)), num(0.5)),
    "IMABS": lambda x: ("imabs", x),
}  # fmt: skip


@dataclass
class Reader:
    """Resolve references while a tree is built.

    Attributes:
        node_at: sheet, row and column → node and index of its value, None outside the tables.
        formula_at: sheet, row and column → the tokens of the formula there.
        constant_at: sheet, row and column → what was typed there.
        named: name → the first cell that it stands for.
        title: title of a sheet as the book writes it.
    """

    node_at: Callable[[str, int, int], tuple[str, int, int] | None]
    formula_at: Callable[[str, int, int], tuple[Token, ...] | None]
    constant_at: Callable[[str, int, int], object]
    named: Callable[[str], tuple[str, int, int] | None]
    helped: bool = field(default=False)  # a cell outside the tables was read

    def tree(
        self, tokens: Sequence[Token], at: tuple[str, int, int], index: int, depth: int = 0
    ) -> Tree:
        """Tree of the formula of a cell that is the value ``index`` of its column.

        Raises:
            UnknownFormula: the formula is none of this language.
        """
        parser = _Parser(self, tokens, at, index, depth)
        tree = parser.comparison()
        if parser.at < len(tokens):
            raise UnknownFormula("формула не кончилась")
        return tree

    def cell(
        self, sheet: str, row: int, column: int, index: int, depth: int, *, fixed: bool
    ) -> Tree:
        """Tell what a reference to one cell stands for."""
        key = self.node_at(sheet, row, column)
        if key is not None:
            node, number, count = key
            if count == 1:
                return ("node", node)
            return ("node", node, number if fixed else number - index, fixed)
        self.helped = True
        tokens = self.formula_at(sheet, row, column)
        if tokens is not None and depth < _DEEP:
            return self.tree(tokens, (sheet, row, column), index, depth + 1)
        value = self.constant_at(sheet, row, column)
        if isinstance(value, (int, float)):
            return num(float(value))
        return ("text", str(value).casefold()) if value is not None else ("blank",)


@dataclass
class _Parser:
    """Reads the tokens of one formula, those of other sheets and helper cells through a reader."""

    reader: Reader
    tokens: Sequence[Token]
    place: tuple[str, int, int]
    index: int
    depth: int
    at: int = 0
    names: dict[str, Tree] = field(default_factory=dict)  # of LET

    def _next(self) -> Token:
        return self.tokens[self.at] if self.at < len(self.tokens) else ("end", "")

    def _takes(self, *signs: str) -> str:
        kind, value = self._next()
        if kind == "op" and value in signs:
            self.at += 1
            return value
        return ""

    def comparison(self) -> Tree:
        tree = self._joined()
        while sign := self._takes(*_COMPARED):
            tree = ("compare", sign, tree, self._joined())
        return tree

    def _joined(self) -> Tree:
        tree = self._sum()
        while self._takes("&"):
            tree = ("joined", tree, self._sum())
        return tree

    def _sum(self) -> Tree:
        tree = self._product()
        while sign := self._takes("+", "-"):
            other = self._product()
            tree = add(tree, other if sign == "+" else mul(num(-1), other))
        return tree

    def _product(self) -> Tree:
        tree = self._power()
        while sign := self._takes("*", "/"):
            other = self._power()
            tree = mul(tree, other if sign == "*" else power(other, num(-1)))
        return tree

    def _power(self) -> Tree:
        tree = self._signed()
        while self._takes("^"):
            tree = power(tree, self._signed())
        return tree

    def _signed(self) -> Tree:
        sign = self._takes("+", "-")
        tree = self._signed() if sign else self._atom()
        while self._takes("%"):
            tree = mul(num(0.01), tree)
        return mul(num(-1), tree) if sign == "-" else tree

    def _atom(self) -> Tree:
        kind, value = self._next()
        self.at += 1
        if kind == "number":
            return num(float(value))
        if kind == "text":
            return ("text", value.casefold())
        if (kind, value) == ("op", "("):
            tree = self.comparison()
            self._close()
            return tree
        if kind == "sheet":
            return self._reference(unquoted(value))
        if kind in ("ref", "columns", "rows"):
            self.at -= 1
            return self._reference(self.place[0])
        if kind == "name":
            if self._takes("("):
                return self._call(value.upper().removeprefix("_XLFN.").removeprefix("_XLWS."))
            return self._named(value.casefold().removeprefix("_xlpm."))
        raise UnknownFormula(f"непонятный знак «{value}»")

    def _close(self) -> None:
        if not self._takes(")"):
            raise UnknownFormula("не закрыта скобка")

    def _named(self, name: str) -> Tree:
        if name in self.names:
            return self.names[name]
        cell = self.reader.named(name)
        if cell is None:
            return ("name", name)
        sheet, row, column = cell
        return self.reader.cell(sheet, row, column, self.index, self.depth, fixed=True)

    def _call(self, name: str) -> Tree:
        if name == "LET":
            return self._let()
        arguments: list[Tree] = []
        while not self._takes(")"):
            if self._takes(",", ";"):
                continue
            if self._next()[0] == "end":
                raise UnknownFormula("не закрыта скобка")
            arguments.append(self.comparison())
        flat: list[Tree] = [
            part for one in arguments for part in (one[1:] if one[0] == "list" else (one,))
        ]
        if name in _WRAPPERS and flat:
            return flat[0]
        if name in _CALLS:
            try:
                return _CALLS[name](*flat)
            except TypeError:
                return (name.casefold(), *flat)
        return (name.casefold(), *flat)

    def _let(self) -> Tree:
        while True:
            kind, value = self._next()
            follows = self.tokens[self.at + 1 : self.at + 2] == (("op", ","),)
            if kind != "name" or not follows:
                tree = self.comparison()
                self._close()
                return tree
            self.at += 2
            self.names[value.casefold().removeprefix("_xlpm.")] = self.comparison()
            self._takes(",")

    def _reference(self, sheet: str) -> Tree:
        kind, value = self._next()
        self.at += 1
        if kind != "ref":
            return (kind, sheet, value.upper().replace("$", ""))
        first = ref_of(value)
        _, row, column = self.place
        top = first.row if first.row_fixed else row + first.row
        left = first.column if first.column_fixed else column + first.column
        if self._takes(":"):
            kind, value = self._next()
            self.at += 1
            if kind != "ref":
                raise UnknownFormula("у диапазона одна граница")
            last = ref_of(value)
            bottom = last.row if last.row_fixed else row + last.row
            right = last.column if last.column_fixed else column + last.column
            return self._range(sheet, top, bottom, left, right)
        return self.reader.cell(sheet, top, left, self.index, self.depth, fixed=first.row_fixed)

    def _range(self, sheet: str, top: int, bottom: int, left: int, right: int) -> Tree:
        if top == bottom and right - left < 16:
            cells = range(left, right + 1)
            read = self.reader.cell
            return ("list", *(read(sheet, top, c, self.index, self.depth, fixed=False)
                              for c in cells))  # fmt: skip
        parts = []
        for column in range(left, min(right, left + 16) + 1):
            node = self.reader.node_at(sheet, top, column)
            parts.append(node[0] if node else str(column - self.place[2]))
        return ("range", *parts, bottom - top)


def leaves(tree: Tree) -> Iterator[str]:
    """Nodes, numbers and functions of a tree."""
    head = tree[0]
    if head in ("num", "node", "text", "name", "blank", "range", "columns", "rows"):
        yield repr(tree)
        return
    if head not in ("sum", "prod", "list"):
        yield str(head)
    for part in tree[1:]:
        if isinstance(part, tuple):
            yield from leaves(part)


def subtrees(tree: Tree) -> Iterator[Tree]:
    """Return a tree and all trees in it."""
    yield tree
    for part in tree[1:]:
        if isinstance(part, tuple):
            yield from subtrees(part)
