"""Formulas of a workbook: relative references made explicit, then parsed into a tree."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache

MAX_LENGTH = 8192
MAX_DEPTH = 64
MAX_ROW, MAX_COLUMN = 1_048_576, 16_384


class UnknownFormula(ValueError):  # noqa: N818 - it is no mistake of the writer's
    """A formula outside the whitelist: a stronger referee or a person must look."""


@dataclass(frozen=True, slots=True)
class Number:
    """A literal number."""

    value: float


@dataclass(frozen=True, slots=True)
class Text:
    """A literal text."""

    value: str


@dataclass(frozen=True, slots=True)
class Name:
    """A defined name."""

    name: str


@dataclass(frozen=True, slots=True)
class Ref:
    """One cell; a relative coordinate is the distance from the cell of the formula."""

    sheet: str | None
    row: int
    column: int
    row_fixed: bool
    column_fixed: bool


@dataclass(frozen=True, slots=True)
class Range:
    """A rectangle between two cells of one sheet."""

    first: Ref
    last: Ref


@dataclass(frozen=True, slots=True)
class Unary:
    """A sign, or percent behind its operand."""

    op: str
    operand: Node


@dataclass(frozen=True, slots=True)
class Binary:
    """An operator between two operands."""

    op: str
    left: Node
    right: Node


@dataclass(frozen=True, slots=True)
class Call:
    """A function with its arguments."""

    name: str
    args: tuple[Node, ...]


Node = Number | Text | Name | Ref | Range | Unary | Binary | Call

_TOKEN = re.compile(
    r"""(?P<space>\s+)
    |(?P<text>"(?:[^"]|"")*")
    |(?P<sheet>(?:'(?:[^']|'')+'|[^\W\d][\w.]*)!)
    |(?P<cell>\$?[A-Za-z]{1,3}\$?[1-9][0-9]{0,6}(?![\w.(!]))
    |(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)
    |(?P<name>[^\W\d][\w.]*)
    |(?P<op><=|>=|<>|[-+*/^&=<>%(),:])""",
    re.VERBOSE,
)
_CELL = re.compile(r"(\$?)([A-Za-z]{1,3})(\$?)([0-9]+)")

Token = tuple[str, str]


@lru_cache(maxsize=1024)
def column_number(letters: str) -> int:
    """Number of a column from 1."""
    number = 0
    for letter in letters.upper():
        number = number * 26 + ord(letter) - 64
    return number


def tokens(text: str) -> list[Token]:
    """Kind and text of every token of a formula without its ``=``.

    Raises:
        UnknownFormula: a sign outside the language, or a formula that is too long.
    """
    if len(text) > MAX_LENGTH:
        msg = "formula too long"
        raise UnknownFormula(msg)
    found: list[Token] = []
    at = 0
    while at < len(text):
        match = _TOKEN.match(text, at)
        if match is None:
            msg = f"unexpected {text[at]!r}"
            raise UnknownFormula(msg)
        if match.lastgroup != "space":
            found.append((str(match.lastgroup), match.group()))
        at = match.end()
    return found


def pattern(text: str, row: int, column: int) -> tuple[Token, ...]:
    """Tokens with cells as distances, equal for a formula that was filled down or across."""
    return tuple(
        ("ref", _distance(value, row, column)) if kind == "cell" else (kind, value)
        for kind, value in tokens(text)
    )


def _distance(cell: str, row: int, column: int) -> str:
    match = _CELL.fullmatch(cell)
    assert match is not None
    column_fixed, letters, row_fixed, digits = match.groups()
    at_row, at_column = int(digits), column_number(letters)
    if at_row > MAX_ROW or at_column > MAX_COLUMN:
        msg = f"no such cell: {cell}"
        raise UnknownFormula(msg)
    first = f"R{at_row}" if row_fixed else f"R[{at_row - row}]"
    return first + (f"C{at_column}" if column_fixed else f"C[{at_column - column}]")


_SPLIT = re.compile(
    r"""("(?:[^"]|"")*"|'(?:[^']|'')+'!)|(\$?[A-Za-z]{1,3})([1-9][0-9]{0,6})(?![\w.(!])"""
)


# A template holds the row number as \0; a formula with other rows in it holds distances.
HERE = "\0"


def row_template(text: str, row: int) -> str | list[str | int]:
    """A formula whose rows move when it is filled down, for ``filled``."""
    pieces: list[str | int] = []
    at = 0
    for match in _SPLIT.finditer(text):
        before = text[match.start() - 1] if match.start() else ""
        if match.group(1) or before.isalnum() or before in ("_", "."):
            continue
        pieces += [text[at : match.start(3)], int(match.group(3)) - row]
        at = match.end()
    pieces.append(text[at:])
    if all(isinstance(piece, str) or piece == 0 for piece in pieces):
        return "".join(piece if isinstance(piece, str) else HERE for piece in pieces)
    return pieces


def filled(template: str | list[str | int], row: int) -> str:
    """The formula that filling down would put into a row."""
    if isinstance(template, str):
        return template.replace(HERE, str(row))
    return "".join([piece if isinstance(piece, str) else str(row + piece) for piece in template])


_REF = re.compile(r"R(\[?)(-?\d+)\]?C(\[?)(-?\d+)\]?")
_PRECEDENCE = {"=": 1, "<": 1, ">": 1, "<=": 1, ">=": 1, "<>": 1, "&": 2,
               "+": 3, "-": 3, "*": 4, "/": 4, "^": 5}  # fmt: skip
_END: Token = ("end", "")


def parse(pattern: tuple[Token, ...]) -> Node:
    """Tree of a pattern.

    Raises:
        UnknownFormula: no formula of the language.
    """
    parser = _Parser(pattern)
    node = parser.expression(0, 0)
    if parser.token != _END:
        msg = f"unexpected {parser.token[1]!r}"
        raise UnknownFormula(msg)
    return node


class _Parser:
    def __init__(self, pattern: tuple[Token, ...]) -> None:
        self._tokens = iter(pattern)
        self.token = next(self._tokens, _END)

    def _advance(self) -> Token:
        token, self.token = self.token, next(self._tokens, _END)
        return token

    def _expect(self, text: str) -> None:
        kind, value = self._advance()
        if kind != "op" or value != text:
            msg = f"{text!r} expected, {value!r} found"
            raise UnknownFormula(msg)

    def expression(self, least: int, depth: int) -> Node:
        if depth > MAX_DEPTH:
            msg = "formula too deep"
            raise UnknownFormula(msg)
        node = self._prefix(depth + 1)
        while self.token[0] == "op":
            op = self.token[1]
            precedence = _PRECEDENCE.get(op, 0)
            if op == "%":
                self._advance()
                node = Unary("%", node)
            elif precedence > least:
                self._advance()
                node = Binary(op, node, self.expression(precedence, depth + 1))
            else:
                break
        return node

    def _prefix(self, depth: int) -> Node:
        kind, value = self._advance()
        if kind == "op" and value in "+-":
            # The sign binds tighter than ^ in a spreadsheet: -x^2 is (-x)^2.
            return Unary(value, self.expression(6, depth))
        if kind == "op" and value == "(":
            node = self.expression(0, depth)
            self._expect(")")
            return node
        if kind == "number":
            return Number(float(value))
        if kind == "text":
            return Text(value[1:-1].replace('""', '"'))
        if kind == "sheet":
            return self._reference(value[:-1].strip("'").replace("''", "'"))
        if kind == "ref":
            return self._range(_ref(value, None))
        if kind == "name":
            if self.token == ("op", "("):
                return self._call(value.upper(), depth)
            return Name(value)
        msg = f"unexpected {value!r}"
        raise UnknownFormula(msg)

    def _reference(self, sheet: str) -> Node:
        kind, value = self._advance()
        if kind == "ref":
            return self._range(_ref(value, sheet))
        msg = f"unexpected {value!r} behind a sheet"
        raise UnknownFormula(msg)

    def _range(self, first: Ref) -> Node:
        if self.token != ("op", ":"):
            return first
        self._advance()
        kind, value = self._advance()
        if kind == "sheet" and value[:-1].strip("'") == first.sheet:
            kind, value = self._advance()
        if kind != "ref":
            msg = "a range needs two cells"
            raise UnknownFormula(msg)
        return Range(first, _ref(value, first.sheet))

    def _call(self, name: str, depth: int) -> Node:
        self._expect("(")
        args: list[Node] = []
        if self.token != ("op", ")"):
            args.append(self.expression(0, depth))
            while self.token == ("op", ","):
                self._advance()
                args.append(self.expression(0, depth))
        self._expect(")")
        return Call(name, tuple(args))


def _ref(text: str, sheet: str | None) -> Ref:
    match = _REF.fullmatch(text)
    assert match is not None
    return Ref(sheet, int(match[2]), int(match[4]), not match[1], not match[3])


def render(
    tokens: tuple[Token, ...],
    row: int,
    column: int,
    names: Mapping[str, tuple[str, int, int]] | None = None,
) -> str:
    """The formula of a pattern in one cell; defined names become the cells that they stand for."""
    parts = ["="]
    for index, (kind, value) in enumerate(tokens):
        following = tokens[index + 1][1] if index + 1 < len(tokens) else ""
        cell = (names or {}).get(value.casefold()) if kind == "name" and following != "(" else None
        if cell is not None:
            title = cell[0].replace("'", "''")
            parts.append(f"'{title}'!{_address(cell[1], cell[2], True, True)}")
        elif kind == "ref":
            ref = _ref(value, None)
            at_row = ref.row if ref.row_fixed else row + ref.row
            at_column = ref.column if ref.column_fixed else column + ref.column
            parts.append(_address(at_row, at_column, ref.row_fixed, ref.column_fixed))
        else:
            parts.append(value)
    return "".join(parts)


def _address(row: int, column: int, row_fixed: bool, column_fixed: bool) -> str:
    letters = ""
    while column > 0:
        column, rest = divmod(column - 1, 26)
        letters = chr(65 + rest) + letters
    return ("$" if column_fixed else "") + letters + ("$" if row_fixed else "") + str(row)
