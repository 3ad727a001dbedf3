"""Numbers of the report for HTML and for TeX; how they are written is ``shared.russian``'s.

STIX has neither U+202F nor U+2009, hence U+00A0 between groups; the style sheet cannot
narrow it, four digits stay together.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

from markupsafe import Markup

from kshm.nomenclature.digits import Digits
from reports.shared.russian import MINUS, NBSP, fixed, mantissa, written


def of_digits(value: float, digits: Digits) -> str:
    """A value with the digits of its quantity, a power of ten as HTML."""
    if digits.kind == "scientific":
        if value == 0:  # the free end of a shaft has no stiffness: no digits are known of it
            return "0"
        text, exponent = mantissa(value, digits.decimals)
        return Markup("{}·10<sup>{}</sup>").format(text, fixed(exponent, 0)) if exponent else text
    return written(value, digits, group=digits.hides == "")


def of_digits_tex(value: float, digits: Digits) -> str:
    """TeX of :func:`of_digits`."""
    if digits.kind == "scientific" and value:
        text, exponent = mantissa(value, digits.decimals)
        return to_tex(text) + (rf"\cdot 10^{{{exponent}}}" if exponent else "")
    return to_tex(of_digits(value, digits))


def significant(value: float, digits: int) -> str:
    """Write a number with so many significant digits, never in exponent form.

    Raises:
        ValueError: The number is not finite.
    """
    if value == 0 or not math.isfinite(value):
        return fixed(value, digits - 1)
    exponent = int(f"{value:.{digits - 1}e}".partition("e")[2])
    return fixed(value, max(0, digits - 1 - exponent))


def to_tex(text: str) -> str:
    r"""Turn a written number into TeX: ``{,}`` for the comma, ``-``, thin space in groups."""
    return text.replace(",", "{,}").replace(MINUS, "-").replace(NBSP, r"\,")


# Widths of STIX in quarters of an em; a digit has two, the minus really 2.74.
_QUARTERS = {",": 1, NBSP: 1, MINUS: 3, "+": 3} | dict.fromkeys("0123456789", 2)


def aligned(texts: Iterable[str]) -> list[str]:
    """Fill numbers up on the left so that, set centred, their last digits stand in line.

    No-break spaces do it (a quarter of an em in STIX, half a digit): decimals line up while
    the column stays centred under its heading, without a style on every cell.  What is no
    number, a unit, a dash, stays in the middle.
    """
    column = list(texts)
    widths = [quarters(text) if is_number(text) else 0 for text in column]
    widest = max(widths, default=0)
    return [
        NBSP * (widest - width) + text if width else text
        for text, width in zip(column, widths, strict=True)
    ]


def quarters(text: str) -> int:
    """Width of a written number in quarters of an em of STIX."""
    return sum(_QUARTERS.get(char, 2) for char in text)


def is_number(text: str) -> bool:
    """Whether a text consists of signs of numbers only, whose widths are known."""
    return all(char in _QUARTERS for char in text)
