"""Numbers and words as Russian print writes them; the only place of such typography.

Decimal comma, real minus (U+2212), groups of three divided by a no-break space from five
digits on, powers of ten written out.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from decimal import ROUND_HALF_UP, Context, Decimal

from kshm.nomenclature.digits import Digits

MINUS = "\u2212"
NBSP = "\u00a0"
BREAK = "\u200b"  # a line may end here, nothing is seen
_GROUP_FROM = 5
_SPREADSHEET = 15  # significant digits that Excel rounds by
_ROUNDING = Context(prec=400, rounding=ROUND_HALF_UP)
_ALONE = 4  # letters of a word that looks lost in a line of its own
_ZEROS = 6  # of a round number that nobody counts any more
_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_WITH = ("одним", "двумя", "тремя", "четырьмя", "пятью", "шестью", "семью", "восемью", "девятью",
         "десятью", "одиннадцатью", "двенадцатью")  # fmt: skip
_OF = ("одно", "двух", "трёх", "четырёх", "пяти", "шести", "семи", "восьми", "девяти", "десяти",
       "одиннадцати", "двенадцати")  # fmt: skip
_INITIALS = re.compile(r"(?:[А-ЯЁA-Z]\.-?)+")
_PATRONYMIC = re.compile("[А-ЯЁ][а-яё]+(?:ич|вна|чна)")


def comma(text: str) -> str:
    """Return a number that Python wrote, with decimal comma and real minus."""
    return text.replace(".", ",").replace("-", MINUS)


def short(value: float, digits: int = 6) -> str:
    """Return a number of so many significant digits without needless zeros, never as 2e+04."""
    text = f"{value:.{digits}g}"
    if "e" in text:
        text = f"{float(text):.12f}".rstrip("0").rstrip(".")
    return comma(text)


def fixed(value: float, digits: int = 2, *, group: bool = True) -> str:
    """Write a number with a given count of decimals: ``−12 345,60``.

    Halves go up as spreadsheets show them, by fifteen digits: 4.335 is a binary 4.33499…

    Args:
        value: The number; numpy scalars are welcome.
        digits: Decimals after the comma, 0 or more.
        group: Divide the integer part into groups of three from five digits on.

    Raises:
        ValueError: The number is not finite or ``digits`` is negative.
    """
    if not math.isfinite(value):
        raise ValueError(f"Число для печати не конечно: {value!r}")
    if digits < 0:
        raise ValueError(f"Число знаков после запятой отрицательно: {digits}")
    exact = Decimal(f"{abs(value):.{_SPREADSHEET}g}")
    text = f"{exact.quantize(Decimal((0, (1,), -digits)), context=_ROUNDING):f}"
    whole, _, part = text.partition(".")
    negative = value < 0 and text.strip("0.") != ""
    if group:
        whole = grouped(whole)
    return (MINUS if negative else "") + whole + ("," + part if part else "")


def as_printed(value: float, digits: int) -> float:
    """Return the number that ``fixed`` writes."""
    return float(fixed(value, digits, group=False).replace(MINUS, "-").replace(",", "."))


def grouped(text: str) -> str:
    """Return number that Python wrote, its integer part in groups of three from five digits on."""
    whole = re.match(r"-?(\d*)", text)
    digits = whole.group(1) if whole else ""
    if len(digits) < _GROUP_FROM:
        return text
    return text.replace(digits, f"{int(digits):,}".replace(",", NBSP), 1)


def mantissa(value: float, decimals: int) -> tuple[str, int]:
    """Return a number as a mantissa in [1, 10) with so many decimals and an exponent of ten.

    Raises:
        ValueError: The number is not finite.
    """
    if value == 0:
        return fixed(0.0, decimals), 0
    text, _, exponent = f"{value:.{decimals}e}".partition("e")
    return fixed(float(text), decimals), int(exponent)


def written(value: float, digits: Digits, *, more: int | None = None, group: bool = False) -> str:
    """Return a value of a quantity as plain text; ``more`` decimals than cells show it with."""
    if digits.hides == "zeros" and value == 0:
        return ""
    if digits.kind == "scientific":
        text, exponent = mantissa(value, digits.decimals + (more or 0))
        return f"{text}·10{str(exponent).translate(_RAISED)}" if exponent else text
    if more is not None:
        return fixed(value, digits.decimals + more, group=group)
    return fixed(value, digits.within(value).decimals, group=group)


def last_bound(text: str) -> str:
    """Return the text whose last word, where it is short, does not stand alone in a line."""
    before, space, last = text.rpartition(" ")
    return f"{before}{NBSP}{last}" if space and len(last) <= _ALONE else text


def power_of_ten(value: float) -> str:
    """``10¹²`` for a power of ten whose zeros nobody counts; empty for any other number."""
    exponent = round(math.log10(value)) if value > 0 else 0
    exact = exponent >= _ZEROS and value == 10.0**exponent
    return f"10{str(exponent).translate(_RAISED)}" if exact else ""


def capital(text: str) -> str:
    """Return the text with its first letter large; a symbol stays what it is, λ and not Λ."""
    return text[:1].upper() + text[1:] if "а" <= text[:1] <= "ё" else text


def uncapital(text: str) -> str:
    """Start with a small letter, for the middle of a sentence; "КПД" and "λ" stay as they are."""
    word = "А" <= text[:1] <= "Я" and not text[1:2].isupper()
    return text[:1].lower() + text[1:] if word else text


def joined(items: Sequence[object], last_by: str = " и ") -> str:
    """Things as a sentence counts them up: «1, 2 и 4»."""
    *most, last = map(str, items or ("",))
    return f"{', '.join(most)}{last_by}{last}" if most else last


def joined_phrases(items: Sequence[str]) -> str:
    """Phrases as a sentence lists them, some of which have an «и» or a comma of their own."""
    if not items:
        return ""
    if " и " in items[-1]:
        return joined(items, ", а также ")
    # A turn of speech has a comma at its end.
    return joined(items, ", и " if len(items) > 1 and "," in items[-2] else " и ")


def runs(numbers: Sequence[str]) -> list[tuple[int, int]]:
    """Stretches of numbers that follow each other: places of the first and the last of each.

    «4», «5», «6», «9» gives (0, 2), (3, 3); «Б.5» is followed by «Б.6».
    """
    spans: list[tuple[int, int]] = []
    for index, number in enumerate(numbers):
        if spans and _follows(numbers[index - 1], number):
            spans[-1] = (spans[-1][0], index)
        else:
            spans.append((index, index))
    return spans


def _follows(before: str, after: str) -> bool:
    """Whether a number is the next one."""
    (stem, digits), (other, next_digits) = (
        re.split(r"(?=\d*$)", n, maxsplit=1) for n in (before, after)
    )
    return stem == other and digits != "" != next_digits and int(next_digits) == int(digits) + 1


def plural(count: int, one: str, few: str, many: str) -> str:
    """Return a number with its noun: 1 столбец, 2 столбца, 12 столбцов."""
    tens, units = count // 10 % 10, count % 10
    if tens == 1 or units == 0 or units > 4:
        return f"{count} {many}"
    return f"{count} {one if units == 1 else few}"


def instrumental(count: int, one: str, many: str) -> str:
    """Return a count after «с»: «одним коленом», «четырьмя коленами»; digits beyond twelve."""
    return (
        f"{_WITH[count - 1] if count <= len(_WITH) else count}{NBSP}{one if count == 1 else many}"
    )


def cylindered(count: int) -> str:
    """«двухцилиндровый»; digits beyond twelve."""
    return f"{_OF[count - 1] if count <= len(_OF) else f'{count}-'}цилиндровый"


def surname(name: str) -> str:
    """Return the surname of a person's name; the whole name where it is not clear.

    Initials are left out, of three words a patronymic tells the order.
    """
    words = [word for word in name.split() if not _INITIALS.fullmatch(word)]
    if len(words) == 3:
        if _PATRONYMIC.fullmatch(words[1]):
            return words[2]
        if _PATRONYMIC.fullmatch(words[2]):
            return words[0]
    return words[0] if len(words) == 1 else name
