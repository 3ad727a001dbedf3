"""How many digits of a quantity people see."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True, slots=True)
class Digits:
    """Digits of a printed value: ``decimals`` after the comma, or how else it is written.

    ``kind`` is ``scientific`` (decimals of the mantissa before a power of ten) or ``text``;
    ``hides`` tells which values are left blank: zeros, or the marks of a row that does not
    count.
    """

    decimals: int = 3
    kind: Literal["fixed", "scientific", "text"] = "fixed"
    hides: Literal["", "zeros", "unused"] = ""


TEXT = Digits(0, "text")
UNLESS_UNUSED = Digits(0, hides="unused")

Row = tuple[str, str, str, str, str, int | Digits]  # key, symbol, tex, unit, title, digits
UnitRow = tuple[str, str, float]  # key, label, size in SI


def scientific(decimals: int) -> Digits:
    """Mantissa with so many decimals, times a power of ten."""
    return Digits(decimals, "scientific")
