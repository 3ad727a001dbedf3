"""One name, symbol, unit and title for every physical quantity.

Sheet headers, legends of figures, messages and documentation come from here.
``quantity(key)`` finds the quantity of a table column or a scalar; a key with
numbers (``M2_Nm``) is an instance of a family (``M#_Nm``).
"""

from __future__ import annotations

import difflib
import math
import re
from dataclasses import dataclass, replace
from functools import lru_cache

from kshm.errors import Problem, UnknownNameError, one_line
from kshm.nomenclature import (
    balance,
    bearings,
    chapters,
    counterweight,
    cycle,
    flywheel,
    inertia,
    layouts,
    series,
    strength,
    textbook,
    torsion,
)
from kshm.nomenclature.digits import Digits
from kshm.nomenclature.symbols import WORDS, plain_symbol

_SUBJECTS = (textbook, series, balance, inertia, cycle, chapters, layouts, torsion,
            bearings, strength, counterweight, flywheel)  # fmt: skip
_ROMAN = ("I", "II", "III", "IV", "V", "VI", "VII", "VIII", "IX", "X", "XI", "XII",
          "XIII", "XIV", "XV", "XVI", "XVII", "XVIII")  # fmt: skip
# How what is printed grows with the length of alike engines: of equal stresses and piston speeds.
_POWERS = {"dm3": 3, "cm3": 3, "Nm": 3, "J": 3, "kN": 2, "N": 2, "kW": 2, "W": 2, "m2": 2,
           "cubic_mm": 3, "quartic_mm": 4, "kg": 3, "kgm": 4, "kgm2": 5, "kg_h": 2, "Nms_rad": 4}  # fmt: skip
_USUAL_BORES_M = (0.06, 0.2)
_FIFTHS = 5


@dataclass(frozen=True, slots=True)
class Unit:
    """A unit of the tables: Russian label and its size in SI."""

    label: str
    si: float = 1.0


UNITS: dict[str, Unit] = {
    key: Unit(label, si)
    for subject in _SUBJECTS
    for key, label, si in getattr(subject, "UNITS", ())
}


@dataclass(frozen=True, slots=True)
class Quantity:
    """A physical quantity as people see it.

    ``tex`` is the formula symbol, ``unit`` a key of ``UNITS`` or, of a department's own quantity,
    a label that has none, ``title`` the Russian name,
    ``digits`` how values are written; number formats of sheets and texts are derived from
    them.  ``word`` stands for the symbol in plain text where the TeX gives none.

    >>> quantity("S_stroke").symbol
    'S'
    """

    key: str
    tex: str
    unit: str
    title: str
    digits: Digits
    word: str = ""

    @property
    def symbol(self) -> str:
        """Symbol in plain text."""
        return self.word or plain_symbol(self.tex)

    @property
    def unit_label(self) -> str:
        """Unit as printed, empty for a pure number."""
        return UNITS[self.unit].label if self.unit in UNITS else self.unit

    @property
    def si(self) -> float:
        """SI value of one unit of the tables."""
        return UNITS[self.unit].si if self.unit in UNITS else 1.0

    @property
    def header(self) -> str:
        """Column header: symbol with unit."""
        return f"{self.symbol}, {self.unit_label}" if self.unit_label else self.symbol


_ALL: dict[str, Quantity] = {
    key: Quantity(
        key, tex, unit, title, digits if isinstance(digits, Digits) else Digits(digits),
        WORDS.get(key, ""),
    )
    for subject in _SUBJECTS
    for key, tex, unit, title, digits in subject.ROWS
}  # fmt: skip


def nomenclature() -> tuple[Quantity, ...]:
    """All quantities; of families, ``#`` stands for the number."""
    return tuple(_ALL.values())


def roman(number: int) -> str:
    """Roman numeral of a ray, 1 to 18."""
    return _ROMAN[number - 1]


def ray_key(number: int) -> str:
    """Column key of a ray, counted from 1."""
    return f"ray_{roman(number)}_MPa"


def smallness(bore_m: float) -> int:
    """How much smaller an engine is than those of the books, in fifths of a power of ten.

    Nothing for bores from 60 to 200 mm, for which the books' own decimals serve; negative for
    larger ones, which have fewer.
    """
    low, high = _USUAL_BORES_M
    smaller = math.ceil(_FIFTHS * math.log10(low / bore_m) - 1e-9)
    larger = math.ceil(_FIFTHS * math.log10(high / bore_m) - 1e-9)
    return max(0, smaller) + min(0, larger)


@lru_cache(maxsize=4096)
def quantity(key: str, small: int = 0) -> Quantity:
    """Quantity of a key; with more decimals for an engine of that smallness.

    Raises:
        UnknownNameError: nobody knows the key.

    >>> quantity("N_MPa").si
    1000000.0
    """
    try:
        base = _quantity(key)
    except (KeyError, TypeError):
        raise _unknown(key) from None
    exact = small * _POWERS.get(base.unit, 0) / _FIFTHS
    more = math.ceil(exact) if small > 0 else round(exact)
    digits = base.digits
    if digits.kind == "fixed":
        digits = replace(digits, decimals=max(0, digits.decimals + more))
    return replace(base, digits=digits)


def _unknown(key: object) -> UnknownNameError:
    if not isinstance(key, str):
        text = one_line(repr(key), 40)
        return UnknownNameError(text, Problem(text, "a key must be a text", "M_mean", value=key))
    close = difflib.get_close_matches(key, _ALL, n=3, cutoff=0.6)
    hint = f"similar: {', '.join(close)}" if close else "docs/nomenclature.md lists the keys"
    return UnknownNameError(key, Problem(one_line(key, 80), "no such quantity", hint))


def _quantity(key: str) -> Quantity:
    if key in _ALL:
        return _ALL[key]
    further = re.fullmatch(r"(\w+)_R(\d+)", key)
    if further is not None:  # the same quantity of a further regime
        base = _quantity(further[1])
        return replace(base, key=key, title=f"{base.title}, режим {further[2]}")
    if key.startswith("throw") and "_" in key:
        return replace(_ALL[key.split("_", 1)[1]], key=key)
    if re.match(r"ray_[IVX]+_MPa", key):
        numeral = key.split("_")[1]
        return Quantity(key, rf"R_{{\mathrm{{{numeral}}}}}", "MPa",
                        f"сила по лучу {numeral}", Digits(2, hides="zeros"), numeral)  # fmt: skip
    match = re.search(r"(?<=[a-zA-Z])\d+", key)
    if match is None:
        raise KeyError(key)
    index = match.group()
    family = _ALL[key[: match.start()] + "#" + key[match.end() :]]
    return replace(
        family,
        key=key,
        tex=family.tex.replace("#", index),
        title=family.title.replace("#", index),
        word=family.word.replace("#", index),
    )
