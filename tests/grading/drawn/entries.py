"""Whatever a hand may leave in the cells of a column: drawn from a seed."""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from tests.grading.fill import Formula

_NUMBERS = (0, 1, -1, 1000, 44.4, 1e-300, 1e300, -273.15, 45123)
_TEXTS = ("не знаю", " ", "12,5 Н", "1.5.", "'", "A6*7+3", "ИСТИНА", "1e999", "да\nнет", "∞", "½")
_ERRORS = ("#DIV/0!", "#N/A", "#VALUE!", "#REF!", "#NUM!", "#NAME?", "#NULL!")
_LOGICAL = (True, False)
_UNARY = ("SQRT", "LN", "EXP", "ABS", "SIN", "COS", "ASIN", "ACOS", "TAN", "RADIANS", "DEGREES",
          "INT", "SIGN", "ROUND0", "NOT", "LEN", "N", "T", "TEXT0", "VALUE", "ISNUMBER",
          "FACT")  # fmt: skip
_BINARY = ("+", "-", "*", "/", "^", "&", "=", "<>", "<", ">=")
_PAIRS = ("ATAN2", "MAX", "MIN", "POWER", "MOD", "SUM", "AND", "OR", "LOG", "CONCATENATE",
          "AVERAGE", "QUOTIENT", "COMBIN")  # fmt: skip
_WHOLE = ("=TRUE", '="12"', '=""', "=NA()", "=1/0", "=NoSuch(1)", "=no_such_name", "={1,2,3}",
          "=#REF!",
          '=INDIRECT("A6")', "=OFFSET(A6,1,0)", "=RAND()", "=TODAY()", "=A6:A9", "=SUM(A:A)",
          "=ROW()", "=LET(x,A6,x*2)", "=SUMPRODUCT(A6:A9,A6:A8)", "=VLOOKUP(1,A6:A9,5)",
          "=CHOOSE(9,A6)", "=INDEX(A6:A9,99)", "=-2^0.5", "=10^400", "=--A6%", "=A6 A7",
          "='нет листа'!A1", "=[книга.xlsx]Лист1!A1", "=((((A6))))", "=MMULT(A6:A7,A6:A7)",
          "=IFERROR(1/0,\"нет\")", "=LAMBDA(x,x+1)(A6)", "=1E5^1E5", "=@A6", "=+")  # fmt: skip


@dataclass(frozen=True)
class Hand:
    """One who fills in a column: the right formulas, their rows, and what may be referred to."""

    chance: random.Random
    right: Sequence[Formula]
    rows: Sequence[int]
    column: str
    names: Sequence[str]

    def entries(self, kind: int) -> list[Formula | bool]:
        """What comes of it; each kind in turn."""
        kinds: tuple[Callable[[], list[Formula | bool]], ...] = (
            self._drawn, self._spoilt, self._alike, self._partly, self._drawn, self._whole,
        )  # fmt: skip
        return kinds[kind % len(kinds)]()

    def _drawn(self) -> list[Formula | bool]:
        text = self._expression(3)
        return ["=" + text.replace("{r}", str(row)) for row in self.rows]

    def _spoilt(self) -> list[Formula | bool]:
        """The right formula with something done to it."""
        more = self._expression(1)
        text = self.chance.choice(
            ("=({f})*7+3", "=-({f})", "=({f})^2", "=({f})+{m}", "=IF({m}>1,{f},0)", "=({f})&\"\"",
             "=SQRT({f})", "=({f})/{m}", "=1/({f})", "=IFERROR({f},0)*1000", "={f}*{c}{r}", "={m}")
        )  # fmt: skip
        return [
            text.replace("{f}", str(own)[1:]).replace("{m}", more).replace("{c}", self.column)
            .replace("{r}", str(row))
            for own, row in zip(self.right, self.rows, strict=True)
        ]  # fmt: skip

    def _one(self) -> Formula | bool:
        pool = self.chance.choice((_NUMBERS, _TEXTS, _ERRORS, _LOGICAL, (None,)))
        return self.chance.choice(pool)

    def _alike(self) -> list[Formula | bool]:
        return [self._one()] * len(self.rows)

    def _partly(self) -> list[Formula | bool]:
        """A formula here, anything there."""
        share = self.chance.random()
        cells = [own if self.chance.random() < share else self._one() for own in self.right]
        cells[self.chance.randrange(len(cells))] = 1000
        return cells

    def _whole(self) -> list[Formula | bool]:
        return [self.chance.choice(_WHOLE)] * len(self.rows)

    def _expression(self, depth: int) -> str:
        choice = self.chance.choice
        if depth == 0 or self.chance.random() < 0.15:
            return choice((choice(self.names), "$A{r}", "A{r}", str(choice(_NUMBERS)), "PI()",
                           "TRUE", '"текст"', '"12"'))  # fmt: skip
        one, other = self._expression(depth - 1), self._expression(depth - 1)
        kind = self.chance.random()
        if kind < 0.5:
            return f"({one}{choice(_BINARY)}{other})"
        if kind < 0.75:
            name = choice(_UNARY)
            calls = {"ROUND0": f"ROUND({one},2)", "TEXT0": f'TEXT({one},"0.00")'}
            return calls.get(name, f"{name}({one})")
        if kind < 0.95:
            return f"{choice(_PAIRS)}({one},{other})"
        return f"IF({one},{other},{self._expression(depth - 1)})"
