"""Formulas of people's books: what they refer to, and the whitelist of functions."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from functools import cached_property, lru_cache

from reports.recalculation.language import (
    MAX_COLUMN,
    MAX_ROW,
    Ref,
    Token,
    UnknownFormula,
    column_number,
    pattern,
    ref_of,
    unquoted,
)

# Functions of values only: nothing volatile, nothing that builds an address or leaves the book.
_ALLOWED = """
ABS ACOS ACOSH ACOT AND ASIN ASINH ATAN ATAN2 ATANH AVEDEV AVERAGE AVERAGEA AVERAGEIF AVERAGEIFS
CEILING CEILING.MATH CHOOSE COLUMN COLUMNS COMBIN CONCATENATE CONVERT COS COSH COT COUNT COUNTA
COUNTBLANK COUNTIF COUNTIFS CSC DEGREES DEVSQ EVEN EXP FACT FALSE FLOOR FLOOR.MATH FORECAST
FORECAST.LINEAR GCD GEOMEAN HARMEAN HLOOKUP IF IFERROR IFNA IFS INDEX INT INTERCEPT ISBLANK ISERR
ISERROR ISEVEN ISLOGICAL ISNA ISNONTEXT ISNUMBER ISODD ISTEXT LARGE LCM LEFT LEN LET LN LOG LOG10
LOOKUP MATCH MAX MAXA MAXIFS MEDIAN MID MIN MINA MINIFS MOD MROUND N NA NOT ODD OR PI POWER PRODUCT
QUOTIENT RADIANS RANK RANK.EQ RIGHT ROUND ROUNDDOWN ROUNDUP ROW ROWS SEC SERIESSUM SIGN SIN SINH
SLOPE SMALL SQRT SQRTPI STDEV STDEV.P STDEV.S STDEVP SUBTOTAL SUM SUMIF SUMIFS SUMPRODUCT SUMSQ
SUMX2MY2 SUMX2PY2 SUMXMY2 SWITCH T TAN TANH TRIM TRUE TRUNC VAR VAR.P VAR.S VARP VLOOKUP XLOOKUP
XMATCH XOR
"""
ALLOWED = frozenset(_ALLOWED.split())
# Where a rectangle may stand as a whole: every argument of these, some of the others.
_OF_RECTANGLES = """
AND OR XOR AVEDEV AVERAGE AVERAGEA COUNT COUNTA COUNTBLANK GCD GEOMEAN HARMEAN LCM MAX MEDIAN MIN
PRODUCT ROWS COLUMNS SLOPE INTERCEPT STDEV STDEV.P STDEV.S STDEVP SUM SUMSQ VAR VAR.P VAR.S VARP
SUMIFS AVERAGEIFS COUNTIFS MINIFS MAXIFS
DEVSQ MAXA MINA FORECAST FORECAST.LINEAR SERIESSUM SUBTOTAL
"""
_TAKES_RANGES: dict[str, Collection[int]] = {
    **dict.fromkeys(_OF_RECTANGLES.split(), range(256)),
    "INDEX": (0,), "MATCH": (1,), "VLOOKUP": (1,), "HLOOKUP": (1,), "LOOKUP": (1, 2),
    "XLOOKUP": (1, 2), "XMATCH": (1,), "SUMIF": (0, 2), "AVERAGEIF": (0, 2), "COUNTIF": (0,),
    "RANK": (1,), "RANK.EQ": (1,), "LARGE": (0,), "SMALL": (0,),
}  # fmt: skip
# Inside of these a rectangle is taken value by value.
_TAKES_ARRAYS = frozenset(("SUMPRODUCT", "SUMX2MY2", "SUMX2PY2", "SUMXMY2"))
_UNITS = frozenset(("mm", "cm", "m", "km", "g", "kg"))  # that the engine converts
_TOTALS = frozenset(map(str, range(1, 12)))
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
            return f"функция {foreign[0]}" if foreign[0] != _GOOGLE else GOOGLE_ARRAY
        texts = [value[1:-1] for kind, value in self.pattern if kind == "text"]
        if "CONVERT" in self.functions and not (len(texts) > 1 and set(texts) <= _UNITS):
            return "функция CONVERT, единицы — только длины и массы"
        if "SUBTOTAL" in self.functions and not self._totals_all():
            return "функция SUBTOTAL, которая пропускает скрытые строки"
        return TEXT_NUMBER if any(map(is_doubtful, texts)) else ""

    def _totals_all(self) -> bool:
        """Whether its subtotals count hidden rows, too."""
        found = (*self.pattern, ("", ""), ("", ""))
        return all(
            code[1] in _TOTALS
            for name, code in zip(found, found[2:], strict=False)
            if _PREFIX.sub("", name[1].upper()) == "SUBTOTAL"
        )

    @cached_property
    def takes_arrays(self) -> bool:
        """Whether a part of the formula is calculated value by value."""
        return not self.functions.isdisjoint(_TAKES_ARRAYS)

    @cached_property
    def gives_array(self) -> bool:
        """Whether a list, or a whole row or column of INDEX, stands where one value is wanted."""
        found = (("", ""), *self.pattern, ("op", ")"))
        for place, before, token, after in zip(
            _places(self.pattern), found, found[1:], found[2:], strict=False
        ):
            if token == ("op", "{") and not (place.whole or place.spread):
                return True
            if place.function == "INDEX" and place.argument and not place.spread:
                ends = after in _ENDS and before == ("op", ",")
                if (token[1] == "0" and ends) or (token in _ENDS and before == ("op", ",")):
                    return True
        return False


@dataclass(frozen=True, slots=True)
class _Place:
    """Where a token stands: the function around it, number of the argument, what it takes."""

    function: str
    argument: int
    spread: bool

    @property
    def whole(self) -> bool:
        """Whether the function takes a rectangle here."""
        return self.argument in _TAKES_RANGES.get(self.function, ())


_ENDS = (("op", ","), ("op", ")"))


def _places(found: tuple[Token, ...]) -> list[_Place]:
    """The place of every token."""
    made = [_Place("", 0, False)]
    places = []
    for at, (kind, value) in enumerate(found):
        if (kind, value) == ("op", ")") and len(made) > 1:
            made.pop()
        elif (kind, value) == ("op", ","):
            here = made[-1]
            made[-1] = _Place(here.function, here.argument + 1, here.spread)
        places.append(made[-1])
        if (kind, value) == ("op", "("):
            before = found[at - 1] if at else ("", "")
            name = _PREFIX.sub("", before[1].upper()) if before[0] == "name" else ""
            made.append(_Place(name, 0, made[-1].spread or name in _TAKES_ARRAYS))
    return places


def is_doubtful(text: str, *, in_product: bool = False) -> bool:
    """Whether a text is a number in one language and none, or a date, in another.

    A sum of products takes no text for a number, formualizer every one that it can read.
    """
    return (_NUMBER if in_product else _DOUBTFUL).fullmatch(text) is not None


def formula_at(text: str, row: int, column: int) -> Formula:
    """The formula of a cell.

    Raises:
        UnknownFormula: a sign outside the language, or a formula that is too long.
    """
    return formula_of(pattern(text, row, column))


@lru_cache(maxsize=20_000)
def formula_of(tokens: tuple[Token, ...]) -> Formula:
    """The one formula with these tokens."""
    return Formula(tokens)


def _references(found: tuple[Token, ...]) -> Iterator[Reference]:
    places = _places(found)
    tokens = (*found, ("op", ")"))
    sheet, start, at = None, 0, 0
    while at < len(found):
        kind, value = found[at]
        if kind == "sheet":
            sheet, start, at = unquoted(value), at, at + 1
            continue
        start = start if sheet is not None else at
        ends, name = _ends_of(kind, value), ""
        if kind == "ref" and tokens[at + 1] == ("op", ":"):
            at += 2
            if at >= len(found) or found[at][0] != "ref":
                raise UnknownFormula("у диапазона одна граница")
            ends = (ref_of(value), ref_of(found[at][1]))
        elif kind == "name" and tokens[at + 1] != ("op", "("):
            name = "" if value.upper() in ("TRUE", "FALSE") else value.casefold()
        if ends is not None or name:
            place = places[start]
            before = tokens[start - 1] if start else ("", "")
            alone = before in (("op", "("), ("op", ",")) and tokens[at + 1] in _ENDS
            first, last = ends or (Ref(1, 1), Ref(1, 1))
            yield Reference(sheet, first, last, name, alone and place.whole, place.spread)
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
