"""The language of a spreadsheet's formulas: tokens, cells as distances, filling down."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

MAX_LENGTH = 8192
MAX_ROW, MAX_COLUMN = 1_048_576, 16_384


class UnknownFormula(ValueError):  # noqa: N818 - it is no mistake of the writer's
    """A formula that the referee cannot calculate for certain: a person must look."""


Token = tuple[str, str]

_TOKEN = re.compile(
    r"""(?P<space>\s+)
    |(?P<text>"(?:[^"]|"")*")
    |(?P<sheet>(?:'(?:[^']|'')+'|[^\W\d][\w.]*)!)
    |(?P<columns>\$?[A-Za-z]{1,3}:\$?[A-Za-z]{1,3}(?![\w.(!]))
    |(?P<rows>\$?[1-9][0-9]{0,6}:\$?[1-9][0-9]{0,6}(?![\w.(!]))
    |(?P<cell>\$?[A-Za-z]{1,3}\$?[1-9][0-9]{0,6}(?![\w.(!]))
    |(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)
    |(?P<name>[^\W\d][\w.]*)
    |(?P<error>\#(?:N/A|(?:REF|VALUE|NUM|NULL|DIV/0)!|NAME\?))
    |(?P<op><=|>=|<>|[-+*/^&=<>%(),:;{}])""",
    re.VERBOSE,
)
_CELL = re.compile(r"(\$?)([A-Za-z]{1,3})(\$?)([0-9]+)")


@dataclass(frozen=True, slots=True)
class Ref:
    """One cell; a relative coordinate is the distance from the cell of the formula."""

    row: int
    column: int
    row_fixed: bool = True
    column_fixed: bool = True


@lru_cache(maxsize=1024)
def column_number(letters: str) -> int:
    """Number of a column from 1."""
    number = 0
    for letter in letters.upper():
        number = number * 26 + ord(letter) - 64
    return number


@lru_cache(maxsize=1024)
def column_letters(number: int) -> str:
    """Letters of a column; the other way round."""
    letters = ""
    while number > 0:
        number, rest = divmod(number - 1, 26)
        letters = chr(65 + rest) + letters
    return letters


def tokens(text: str) -> list[Token]:
    """Kind and text of every token of a formula without its ``=``.

    Raises:
        UnknownFormula: a sign outside the language, or a formula that is too long.
    """
    if len(text) > MAX_LENGTH:
        raise UnknownFormula("формула слишком длинная")
    found: list[Token] = []
    at = 0
    while at < len(text):
        match = _TOKEN.match(text, at)
        if match is None:
            raise UnknownFormula(f"непонятный знак «{text[at]}»")
        token = (str(match.lastgroup), match.group())
        at = match.end()
        if token[0] == "sheet" and found[-1:] == [("op", ":")]:
            # Лист!A1:Лист!B2 is Лист!A1:B2, which alone is calculated as it is meant.
            if [kind for kind, _ in found[-3:-1]] != ["sheet", "cell"] or (
                unquoted(found[-3][1]).casefold() != unquoted(token[1]).casefold()
            ):
                raise UnknownFormula("диапазон начинается и кончается на разных листах")
        elif token[0] != "space":
            found.append(token)
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
        raise UnknownFormula(f"нет такой ячейки: {cell}")
    first = f"R{at_row}" if row_fixed else f"R[{at_row - row}]"
    return first + (f"C{at_column}" if column_fixed else f"C[{at_column - column}]")


# --- filled down ----------------------------------------------------------------------------

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


# --- from distances back --------------------------------------------------------------------

_REF = re.compile(r"R(\[?)(-?\d+)\]?C(\[?)(-?\d+)\]?")


def ref_of(text: str) -> Ref:
    """The cell of a token ``ref``."""
    match = _REF.fullmatch(text)
    assert match is not None
    return Ref(int(match[2]), int(match[4]), not match[1], not match[3])


def render(tokens: Sequence[Token], row: int, column: int, own: str = "") -> str:
    """The formula of a pattern in one cell; ``own`` is put before references without a sheet."""
    parts = ["="]
    prefix = quoted(own) if own else ""
    for (kind, value), before in zip(tokens, (("", ""), *tokens), strict=False):
        if kind in ("ref", "columns", "rows") and before[0] != "sheet" and before != ("op", ":"):
            parts.append(prefix)
        if kind == "ref":
            ref = ref_of(value)
            at_row = ref.row if ref.row_fixed else row + ref.row
            letters = column_letters(ref.column if ref.column_fixed else column + ref.column)
            fixed = "$" * ref.column_fixed, "$" * ref.row_fixed
            parts.append(f"{fixed[0]}{letters}{fixed[1]}{at_row}")
        else:
            parts.append(value)
    return "".join(parts)


def quoted(sheet: str) -> str:
    """A sheet as it stands before a reference."""
    plain = sheet.replace("'", "''")
    return f"'{plain}'!"


def unquoted(token: str) -> str:
    """The sheet that such a token names."""
    return token[1:-2].replace("''", "'") if token.startswith("'") else token[:-1]
