"""How many digits of a quantity people see."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Literal

_MAX_DIGITS = 5  # significant digits of a printed value: no drawing and no gauge has more
UnitRow = tuple[str, str, float]  # key, label, size in SI


@dataclass(frozen=True, slots=True)
class Digits:
    """Digits of a printed value: ``decimals`` after the comma, or how else it is written.

    ``kind`` is ``scientific`` (decimals of the mantissa before a power of ten) or ``text``;
    ``hides`` tells which values are left blank: zeros, or the marks of a row that does not
    count.  Cells show ``decimals``; print drops those of a number with five digits before them.
    """

    decimals: int = 3
    kind: Literal["fixed", "scientific", "text"] = "fixed"
    hides: Literal["", "zeros", "unused"] = ""

    def within(self, largest: float) -> Digits:
        """As print has values up to ``largest``: five significant digits, or all whole ones."""
        if self.kind != "fixed" or not largest or not math.isfinite(largest):
            return self
        over = int(f"{largest:.{_MAX_DIGITS - 1}e}".partition("e")[2]) - (_MAX_DIGITS - 1)
        return replace(self, decimals=min(self.decimals, max(0, -over)))


TEXT = Digits(0, "text")
UNLESS_UNUSED = Digits(0, hides="unused")

Row = tuple[str, str, str, str, int | Digits]  # key, tex, unit, title, digits


def scientific(decimals: int) -> Digits:
    """Mantissa with so many decimals, times a power of ten."""
    return Digits(decimals, "scientific")
