"""The language of a spreadsheet's formulas: tokens, cells as distances, whitelist of functions."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache

from reports.recalculation.array_functions import UNITS
from reports.recalculation.functions import ALLOWED, BY_PERSON, TAKES_ARRAYS, TAKES_RANGES
from reports.shared.errors import UnknownFormula

MAX_LENGTH = 8192
MAX_ROW, MAX_COLUMN = 1_048_576, 16_384
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
_SPLIT = re.compile(
    r"""("(?:[^"]|"")*"|'(?:[^']|'')+'!)|(\$?[A-Za-z]{1,3})([1-9][0-9]{0,6})(?![\w.(!])"""
)
# A template holds the row number as \0; a formula with other rows in it holds distances.
HERE = "\0"
_REF = re.compile(r"R(\[?)(-?\d+)\]?C(\[?)(-?\d+)\]?")
_TOTALS = frozenset(map(str, range(1, 12)))
_PLAIN_TOTALS = _TOTALS - {"3"} | {"12"}
_PREFIX = re.compile(r"_XL(?:FN|WS|PM)\.")
# Where it stands is all that these tell: in a rectangle that is not one place.
PLACES = frozenset(("ROW", "COLUMN"))
TEXT_NUMBER = "число записано текстом"
# What Google Sheets leaves of its own functions when a book is saved as .xlsx.
_GOOGLE = "__XLUDF.DUMMYFUNCTION"
GOOGLE_ARRAY = "формула Google Таблиц, которой нет в .xlsx: протяните обычную формулу"
# A text that one country's spreadsheet takes for a number and another's for something else.
_DOUBTFUL = re.compile(r"\s*[-+]?(?:\d[\d\s]*[.,][\d.,]*|[.,]\d+)(?:[eE][-+]?\d+)?\s*%?\s*")
_NUMBER = re.compile(r"\s*[-+]?\d[\d\s.,]*(?:[eE][-+]?\d+)?\s*%?\s*|[.,]\d+")
_ENDS = (("op", ","), ("op", ")"))


@dataclass(frozen=True, slots=True)
class Ref:
    """One cell; a relative coordinate is the distance from the cell of the formula."""

    row: int
    column: int
    row_fixed: bool = True
    column_fixed: bool = True


@lru_cache(maxsize=1024)
def column_number(letters: str) -> int:
    """Return number of a column from 1."""
    number = 0
    for letter in letters.upper():
        number = number * 26 + ord(letter) - 64
    return number


@lru_cache(maxsize=1024)
def column_letters(number: int) -> str:
    """Letters of a column; the other way round."""
    letters = ""
    while number > 0:
        number, digit = divmod(number - 1, 26)
        letters = chr(65 + digit) + letters
    return letters


def tokens(text: str) -> list[Token]:
    """Kind and text of every token of a formula without its ``=``.

    Raises:
        UnknownFormula: a sign outside the language, or a formula that is too long.
    """
    if len(text) > MAX_LENGTH:
        raise UnknownFormula("формула слишком длинная")
    parsed: list[Token] = []
    at = 0
    while at < len(text):
        match = _TOKEN.match(text, at)
        if match is None:
            table = text[at] == "["
            raise UnknownFormula(
                "ссылка на умную таблицу" if table else f"непонятный знак «{text[at]}»"
            )
        token = (str(match.lastgroup), match.group())
        at = match.end()
        if token[0] == "sheet" and parsed[-1:] == [("op", ":")]:
            # Лист!A1:Лист!B2 is Лист!A1:B2, which alone is calculated as it is meant.
            if [kind for kind, _ in parsed[-3:-1]] != ["sheet", "cell"] or (
                unquoted(parsed[-3][1]).casefold() != unquoted(token[1]).casefold()
            ):
                raise UnknownFormula("диапазон начинается и кончается на разных листах")
        elif token[0] != "space":
            parsed.append(token)
    return parsed


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


def row_template(text: str, row: int) -> str | list[str | int]:
    """Return a formula whose rows move when it is filled down, for ``filled``."""
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
    """Return the formula that filling down would put into a row."""
    if isinstance(template, str):
        return template.replace(HERE, str(row))
    return "".join([piece if isinstance(piece, str) else str(row + piece) for piece in template])


# --- from distances back --------------------------------------------------------------------


def ref_of(text: str) -> Ref:
    """Return the cell of a token ``ref``."""
    match = _REF.fullmatch(text)
    assert match is not None
    return Ref(int(match[2]), int(match[4]), not match[1], not match[3])


def render(tokens: Sequence[Token], row: int, column: int, sheet: str = "") -> str:
    """The formula of a pattern in one cell; ``sheet`` is put before references without a sheet."""
    parts = ["="]
    prefix = quoted(sheet) if sheet else ""
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
    """Return a sheet as it stands before a reference."""
    plain = sheet.replace("'", "''")
    return f"'{plain}'!"


def unquoted(token: str) -> str:
    """Return the sheet that such a token names."""
    return token[1:-2].replace("''", "'") if token.startswith("'") else token[:-1]


@dataclass(frozen=True, slots=True)
class Reference:
    """A rectangle that a formula names, or a defined name.

    ``whole`` is a whole argument of a function that takes rectangles there, ``spread`` is
    taken value by value inside of one that does so.
    """

    sheet: str | None
    first: Ref
    last: Ref
    name: str = ""
    whole: bool = False
    spread: bool = False


@dataclass(frozen=True, eq=False)
class Formula:
    """A formula with its cells as distances; books of a class share it."""

    pattern: tuple[Token, ...]

    @cached_property
    def functions(self) -> frozenset[str]:
        """Names of the functions in capitals."""
        after = (*self.pattern[1:], ("end", ""))
        return frozenset(
            _PREFIX.sub("", value.upper())
            for (kind, value), following in zip(self.pattern, after, strict=True)
            if kind == "name" and following == ("op", "(")
        )

    @cached_property
    def references(self) -> tuple[Reference, ...]:
        """Rectangles and defined names in the formula.

        Raises:
            UnknownFormula: a range with one end.
        """
        return tuple(_references(self.pattern))

    @cached_property
    def refusal(self) -> str:
        """Why the formula is never calculated, empty where it may be."""
        foreign = sorted(self.functions - ALLOWED)
        if foreign:
            why = BY_PERSON.get(foreign[0])
            word = f"функция {foreign[0]}: {why}" if why else f"функция {foreign[0]}"
            return word if foreign[0] != _GOOGLE else GOOGLE_ARRAY
        texts = [value[1:-1] for kind, value in self.pattern if kind == "text"]
        if "CONVERT" in self.functions and not self._converts_known_units():
            return "функция CONVERT, единицы — только длины, массы и углы"
        if "AGGREGATE" in self.functions and not self._aggregates_all():
            return "функция AGGREGATE: скрытые строки или место по порядку"
        if "SUBTOTAL" in self.functions and not self._totals_all():
            return "функция SUBTOTAL, которая пропускает скрытые строки"
        return TEXT_NUMBER if any(map(is_doubtful, texts)) else ""

    def _converts_known_units(self) -> bool:
        """Whether each conversion names two units, and such as are calculated."""
        pairs = zip(self.pattern, _places(self.pattern), strict=True)
        units = [token for token, use in pairs if use.function == "CONVERT" and use.argument]
        texts = [value[1:-1] for kind, value in units if kind == "text"]
        calls = sum(kind == "name" and value.upper() == "CONVERT" for kind, value in self.pattern)
        return len(texts) == 2 * calls and set(texts) <= UNITS.keys()

    def _totals_all(self) -> bool:
        """Whether its subtotals count hidden rows, too."""
        padded = (*self.pattern, ("", ""), ("", ""))
        return all(
            code[1] in _TOTALS
            for name, code in zip(padded, padded[2:], strict=False)
            if _PREFIX.sub("", name[1].upper()) == "SUBTOTAL"
        )

    def _aggregates_all(self) -> bool:
        """Whether its totals are plain ones of all rows: code up to 12, option 4 or 6."""
        padded = (*self.pattern, *[("", "")] * 5)
        return all(
            code[1] in _PLAIN_TOTALS and option[1] in ("4", "6") and end == ("op", ",")
            for name, code, option, end in zip(
                padded, padded[2:], padded[4:], padded[5:], strict=False
            )
            if _PREFIX.sub("", name[1].upper()) == "AGGREGATE"
        )

    @cached_property
    def takes_arrays(self) -> bool:
        """Whether a part of the formula is calculated value by value."""
        return not self.functions.isdisjoint(TAKES_ARRAYS)

    @cached_property
    def gives_array(self) -> bool:
        """Whether a list, or a whole row or column of INDEX, stands where one value is wanted."""
        padded = (("", ""), *self.pattern, ("op", ")"))
        for context, before, token, after in zip(
            _places(self.pattern), padded, padded[1:], padded[2:], strict=False
        ):
            if token == ("op", "{") and not (context.whole or context.spread):
                return True
            if context.function == "INDEX" and context.argument and not context.spread:
                ends = after in _ENDS and before == ("op", ",")
                if (token[1] == "0" and ends) or (token in _ENDS and before == ("op", ",")):
                    return True
        return False


@dataclass(frozen=True, slots=True)
class _TokenPlace:
    """Where a token stands: the function around it, number of the argument, what it takes."""

    function: str
    argument: int
    spread: bool

    @property
    def whole(self) -> bool:
        """Whether the function takes a rectangle here."""
        return self.argument in TAKES_RANGES.get(self.function, ())


def _places(pattern: tuple[Token, ...]) -> list[_TokenPlace]:
    """Return the place of every token."""
    contexts = [_TokenPlace("", 0, False)]
    positions = []
    for at, (kind, value) in enumerate(pattern):
        if (kind, value) == ("op", ")") and len(contexts) > 1:
            contexts.pop()
        elif (kind, value) == ("op", ","):
            here = contexts[-1]
            contexts[-1] = _TokenPlace(here.function, here.argument + 1, here.spread)
        positions.append(contexts[-1])
        if (kind, value) == ("op", "("):
            before = pattern[at - 1] if at else ("", "")
            name = _PREFIX.sub("", before[1].upper()) if before[0] == "name" else ""
            contexts.append(_TokenPlace(name, 0, contexts[-1].spread or name in TAKES_ARRAYS))
    return positions


def is_doubtful(text: str, *, in_product: bool = False) -> bool:
    """Whether a text is a number in one language and none, or a date, in another.

    A sum of products takes no text for a number, formualizer every one that it can read.
    """
    return (_NUMBER if in_product else _DOUBTFUL).fullmatch(text) is not None


def formula_at(text: str, row: int, column: int) -> Formula:
    """Return the formula of a cell.

    Raises:
        UnknownFormula: a sign outside the language, or a formula that is too long.
    """
    return formula_of(pattern(text, row, column))


@lru_cache(maxsize=20_000)
def formula_of(tokens: tuple[Token, ...]) -> Formula:
    """Return the one formula with these tokens."""
    return Formula(tokens)


def _references(pattern: tuple[Token, ...]) -> Iterator[Reference]:
    positions = _places(pattern)
    tokens = (*pattern, ("op", ")"))
    sheet, start, at = None, 0, 0
    while at < len(pattern):
        kind, value = pattern[at]
        if kind == "sheet":
            sheet, start, at = unquoted(value), at, at + 1
            continue
        start = start if sheet is not None else at
        ends, name = _ends_of(kind, value), ""
        if kind == "ref" and tokens[at + 1] == ("op", ":"):
            at += 2
            if at >= len(pattern) or pattern[at][0] != "ref":
                raise UnknownFormula("у диапазона одна граница")
            ends = (ref_of(value), ref_of(pattern[at][1]))
        elif kind == "name" and tokens[at + 1] != ("op", "("):
            name = "" if value.upper() in ("TRUE", "FALSE") else value.casefold()
        if ends is not None or name:
            context = positions[start]
            before = tokens[start - 1] if start else ("", "")
            alone = before in (("op", "("), ("op", ",")) and tokens[at + 1] in _ENDS
            first, last = ends or (Ref(1, 1), Ref(1, 1))
            yield Reference(sheet, first, last, name, alone and context.whole, context.spread)
        sheet = None
        at += 1


def _ends_of(kind: str, value: str) -> tuple[Ref, Ref] | None:
    """First and last cell of what one token names."""
    if kind == "ref":
        return ref_of(value), ref_of(value)
    if kind == "columns":
        left, right = sorted(map(column_number, value.replace("$", "").split(":")))
        return Ref(1, left), Ref(MAX_ROW, right)
    if kind == "rows":
        top, bottom = sorted(map(int, value.replace("$", "").split(":")))
        return Ref(top, 1), Ref(bottom, MAX_COLUMN)
    return None
