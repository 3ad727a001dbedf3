"""Numbers of the report for HTML and for TeX; how they are written is ``shared.russian``'s.

STIX has neither U+202F nor U+2009, hence U+00A0 between groups; the style sheet cannot
narrow it, four digits stay together.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from decimal import ROUND_HALF_EVEN, Decimal

from markupsafe import Markup

from kshm.nomenclature.digits import Digits
from reports.shared.russian import MINUS, NBSP, fixed, written

TIMES = "\u00d7"


def of_digits(value: float, digits: Digits) -> str:
    """A value with the digits of its quantity, a power of ten as HTML."""
    if digits.kind == "scientific":
        return power_html(value, digits.decimals + 1)
    return fixed(value, digits.decimals) if digits.hides == "" else written(value, digits)


def of_digits_tex(value: float, digits: Digits) -> str:
    """TeX of :func:`of_digits`."""
    if digits.kind == "scientific":
        return power_tex(value, digits.decimals + 1)
    return to_tex(of_digits(value, digits))


def decimals_for(value: float, significant: int) -> int:
    """Decimals needed to show so many significant digits (0 for large numbers)."""
    if not math.isfinite(value):
        msg = f"Число для печати не конечно: {value!r}"
        raise ValueError(msg)
    if value == 0:
        return max(0, significant - 1)
    exponent = int(f"{abs(value):.{significant - 1}e}".partition("e")[2])
    return max(0, significant - 1 - exponent)


def significant(value: float, digits: int = 4, *, group: bool = True) -> str:
    """Write a number with so many significant digits, never in exponent form."""
    return fixed(value, decimals_for(value, digits), group=group)


def split_power(value: float, digits: int, *, step: int = 1) -> tuple[str, int]:
    """Split a number into a written mantissa of so many significant digits and an exponent.

    Args:
        value: The number.
        digits: Significant digits of the mantissa.
        step: 1 for a mantissa in [1, 10), 3 for engineering notation.

    Returns:
        Mantissa with comma and minus, and the exponent of ten.
    """
    if value == 0:
        return fixed(0.0, digits - 1), 0
    if not math.isfinite(value):
        msg = f"Число для печати не конечно: {value!r}"
        raise ValueError(msg)
    exponent = int(f"{abs(value):.{digits - 1}e}".partition("e")[2])
    exponent = step * math.floor(exponent / step)
    mantissa = Decimal(repr(float(value))).scaleb(-exponent)
    places = max(0, digits - 1 - mantissa.adjusted())
    rounded = mantissa.quantize(Decimal(1).scaleb(-places), rounding=ROUND_HALF_EVEN)
    if rounded.adjusted() > mantissa.adjusted() and places > 0:
        rounded = rounded.quantize(Decimal(1).scaleb(1 - places))
    text = f"{abs(rounded):f}".replace(".", ",")
    return (MINUS if value < 0 else "") + text, exponent


def power_html(value: float, digits: int = 3, *, step: int = 1) -> Markup:
    """Write a number as mantissa times a power of ten for HTML: ``1,25×10<sup>−6</sup>``."""
    mantissa, exponent = split_power(value, digits, step=step)
    if exponent == 0:
        return Markup(mantissa)
    return Markup(f"{mantissa}{TIMES}10<sup>{fixed(exponent, 0)}</sup>")


def power_tex(value: float, digits: int = 3, *, step: int = 1) -> str:
    r"""Write a number as mantissa times a power of ten for TeX: ``1{,}25\times 10^{-6}``."""
    mantissa, exponent = split_power(value, digits, step=step)
    if exponent == 0:
        return to_tex(mantissa)
    return rf"{to_tex(mantissa)}\times 10^{{{exponent}}}"


def to_tex(text: str) -> str:
    r"""Turn a written number into TeX: ``{,}`` for the comma, ``-``, thin space in groups."""
    return text.replace(",", "{,}").replace(MINUS, "-").replace(NBSP, r"\,")


def fixed_tex(value: float, digits: int = 2, *, group: bool = True) -> str:
    """TeX of :func:`fixed`."""
    return to_tex(fixed(value, digits, group=group))


def significant_tex(value: float, digits: int = 4, *, group: bool = True) -> str:
    """TeX of :func:`significant`."""
    return to_tex(significant(value, digits, group=group))


def auto_html(value: float, digits: int = 4) -> Markup:
    """Significant digits for handy magnitudes, a power of ten for the rest."""
    if value == 0 or 1e-3 <= abs(value) < 1e6:
        return Markup(significant(value, digits))
    return power_html(value, digits)


def auto_tex(value: float, digits: int = 4) -> str:
    """TeX of :func:`auto_html`."""
    if value == 0 or 1e-3 <= abs(value) < 1e6:
        return significant_tex(value, digits)
    return power_tex(value, digits)


def in_parentheses(tex: str) -> str:
    """Put a negative number of a substitution into parentheses, leave others alone."""
    return rf"\left({tex}\right)" if tex.startswith("-") else tex


def column(values: Iterable[float], digits: int, *, group: bool = True) -> list[str]:
    """Write a column of a table, one text per value; see :func:`fixed`."""
    return [fixed(float(value), digits, group=group) for value in values]


# Widths of STIX in quarters of an em; a digit has two, the minus really 2.74.
_QUARTERS = {",": 1, NBSP: 1, MINUS: 3, "+": 3} | dict.fromkeys("0123456789", 2)


def aligned(texts: Iterable[str]) -> list[str]:
    """Fill numbers up on the left so that, set centred, their last digits stand in line.

    No-break spaces do it (a quarter of an em in STIX, half a digit): decimals line up while
    the column stays centred under its heading, without a style on every cell.
    """
    column_texts = list(texts)
    widths = [quarters(text) for text in column_texts]
    widest = max(widths, default=0)
    return [
        NBSP * (widest - width) + text for text, width in zip(column_texts, widths, strict=True)
    ]


def quarters(text: str) -> int:
    """Width of a written number in quarters of an em of STIX."""
    return sum(_QUARTERS.get(char, 2) for char in text)


def is_number(text: str) -> bool:
    """Whether a text consists of signs of numbers only, whose widths are known."""
    return all(char in _QUARTERS for char in text)
