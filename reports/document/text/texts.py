"""Texts and numbers of the report for HTML and TeX; their writing is ``shared.russian``'s."""

from __future__ import annotations

import base64
import functools
import math
import re
from collections.abc import Iterable

from markupsafe import Markup, escape

from kshm.nomenclature.digits import Digits
from reports.shared.font_coverage import boxed, cleaned
from reports.shared.russian import MINUS, NBSP, fixed, mantissa, written

_RAISED = "\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079\u207a\u207b"
_LEVEL = f"0123456789+{MINUS}"
_LOWER = str.maketrans(_RAISED, _LEVEL)
_RUN = re.compile(f"[{_RAISED}]+")
_RELATION = re.compile("(?<=[α-ω]) = (?=[−\\d])")
# A line may end at a hyphen, unlike at a no-break space.
_WHOLE = re.compile(
    r"(?<![\w-])(\d+-[а-яё]{1,3}(?: изд\.)?|[A-ZА-ЯЁ]-[а-яё]+"
    r"|\d*[ДЧ][А-Я]* \d+(?:,\d+)?/\d+(?:,\d+)?)(?![\w-])"
)
FORMULA = "\u2062"  # an invisible sign before the words of a formula tells it from a figure
_OPENING = re.compile(r'<svg class="(\w+)"([^>]*?)style="([^"]*)"([^>]*)>')
_OF_PAGE = re.compile(r' (?:role|xmlns)="[^"]*"')
_SIZE = re.compile(r' data-size="[\d./]+"')
_SVG_NAMESPACE = ' xmlns="http://www.w3.org/2000/svg"'
_SPACE_BEFORE = re.compile('([ \u00a0])(<(?:a(?! class="ref")|i)\\b[^<>]*>)')
_SPACE_BEFORE_UNBROKEN = re.compile('([ \u00a0])(<span class="nb">|<a class="ref")')
# Units as sentences of the templates put them behind a number, and the pages of a book.
_UNIT = r"(?:%|°C|с\.|(?:(?:кН|Н)(?:·м)?|[мМ]?Па|мк?м|кг|к?Дж|к?Вт|мин|рад|Гц|л|м)(?![А-Яа-яё]))"
# Spaces that no line ends at: of initials, «А. Н. Гоц»; before a short reference, «Гоца [1]»,
# or a longer one after «по»; before the number of a thing, «рисунок 1», «шейки 2», «№ 3», and a
# dash, but not the one of a caption after its number; within «а — размеры»; round the sign of
# «φ = 56°»; before a unit.  The space stands first: it is looked for at once.
_UNBROKEN = re.compile(
    r" (?:(?<=[^А-ЯЁа-яёA-Za-z][А-ЯЁ]\. )(?=[А-ЯЁ])"
    r'|(?=\[<a class="ref"[^<>]*>\d+</a>(?:\]|, <a))'
    rf'|(?<=\bпо )(?=\[<a class="ref"[^<>]*>\d+</a>,{NBSP})'
    r"|(?:(?<=шейк[а-я] )|(?<=подшипник )|(?<=подшипник[а-я] )|(?<=цилиндр[а-я] )|(?<=колен[а-я] )"
    r"|(?<=№ ))(?=\d+(?!\d|,\d))"
    r'|(?:(?<=рисун[а-я]{2} )|(?<=рисунках )|(?<=аблиц[а-я] )|(?<=аблицах ))(?=<a class="ref")'
    r"|(?<!\d</span> )(?=— )"
    r"|(?<=[ :;][а-е] — )"
    r"|(?:(?==[ \u00a0])|(?<=[ \u00a0]= )"
    rf"|(?<=\d )(?={_UNIT}))"
    r"(?![^<>]*>))"  # but in words for a reader's ear
)
_SMALL = 1e-4  # a smaller number is written as a power of ten
# Widths of STIX in quarters of an em; a digit has two, the minus really 2.74.
_QUARTERS = {",": 1, NBSP: 1, MINUS: 3, "+": 3} | dict.fromkeys("0123456789", 2)


@functools.lru_cache(maxsize=8192)
def rich(text: str) -> str | Markup:
    """Clean a text; «мин⁻¹» gets a superscript, because STIX has no raised minus.

    No line ends within «φ = 0», «1-го», «2-е изд.», «V-образный» and «6ЧН 11/12,5».  Text
    without any of it and of raised signs stays a plain string, to be escaped by Jinja.
    """
    text = _RELATION.sub(f"{NBSP}={NBSP}", text)
    if not (_RUN.search(text) or _WHOLE.search(text)):
        return cleaned(text)
    pieces = [_unparted(escape(cleaned(piece))) for piece in _RUN.split(text)]
    raised_signs = [run.translate(_LOWER) for run in _RUN.findall(text)]
    powers_html = [Markup("<sup>{}</sup>").format(run) for run in raised_signs]
    return Markup("").join(a + b for a, b in zip(pieces, [*powers_html, ""], strict=True))


def _unparted(text: Markup) -> Markup:
    return Markup(_WHOLE.sub(r'<span class="nb">\1</span>', str(text)))


def plain(text: object) -> Markup:
    """Clean and escape a text for an attribute or a title, where no markup can stand."""
    return escape(cleaned(Markup(text).striptags() if isinstance(text, Markup) else str(text)))


def titled(svg: str, title: object) -> Markup:
    """Return an inline SVG with an alternative text: a ``<title>`` as its first child."""
    head, bracket, tail = svg.partition(">")
    return Markup("{}{}<title>{}</title>{}").format(
        Markup(head), Markup(bracket), plain(title), Markup(tail)
    )


def pictured(svg: str, title: object) -> Markup:
    """Return an inline SVG as a picture of its own with an alternative text, for paper.

    The parser of the page and its styles then see one element instead of hundreds.
    """
    match = _OPENING.match(svg)
    if match is None:
        return titled(svg, title)
    kind, before, style, after = match.groups()
    tail = _OF_PAGE.sub("", before + after)
    whole = f"<svg{_SVG_NAMESPACE}{tail}>{boxed(svg[match.end() :])}"
    size = "".join(_SIZE.findall(tail))
    data = base64.b64encode(whole.encode("utf-8")).decode("ascii")
    picture = '<img class="{}" style="{}"{} alt="{}" src="data:image/svg+xml;base64,{}">'
    words = Markup(FORMULA if kind == "tex" else "") + plain(title)
    values = (kind, Markup(style), Markup(size), words, Markup(data))
    return Markup(picture).format(*values)


def unbroken(body: str) -> str:
    """Make the spaces of a text that no line may end at spaces that do not break."""
    return _UNBROKEN.sub(NBSP, body)


def spaces_inside(page: str) -> str:
    """Move a space that ends a text before an inline element into the element.

    A text that fits its line without its last space, but not with it, is taken for one that
    cannot be broken, and the line ends after its first word or within it.  Before an element
    that must not break, the space gets an element of its own.
    """
    page = _SPACE_BEFORE.sub(r"\2\1", page)
    return _SPACE_BEFORE_UNBROKEN.sub(r"<span>\1</span>\2", page)


def powers(text: str, form: str) -> str:
    """Return raised signs as a formatted power in TeX: ``-1`` for «⁻¹»."""
    return _RUN.sub(
        lambda match: form.format(match.group().translate(_LOWER).replace(MINUS, "-")), text
    )


def raised(text: str) -> str:
    """Return the same for labels of figures: raised signs become mathtext (``мин$^{-1}$``)."""
    return powers(text, "$^{{{}}}$")


def of_digits(value: float, digits: Digits) -> str:
    """Return a value with the digits of its quantity, a power of ten as HTML."""
    if digits.kind == "scientific":
        if value == 0:  # the free end of a shaft has no stiffness: no digits are known of it
            return "0"
        text, exponent = mantissa(value, digits.decimals)
        return Markup("{}·10<sup>{}</sup>").format(text, fixed(exponent, 0)) if exponent else text
    small = _small(value, digits)
    if small:
        return Markup("{}·10<sup>{}</sup>").format(small[0], fixed(small[1], 0))
    return written(value, digits, group=digits.hides == "")


def _small(value: float, digits: Digits) -> tuple[str, int] | None:
    """Mantissa and exponent of a number of many zeros, with the digits that it has."""
    if digits.kind != "fixed" or not 0 < abs(value) < _SMALL:
        return None
    plain_text = written(value, digits).lstrip(MINUS).replace(",", "").lstrip("0")
    return mantissa(value, len(plain_text) - 1) if len(plain_text) > 1 else None


def of_digits_tex(value: float, digits: Digits) -> str:
    """TeX of :func:`of_digits`."""
    small = _small(value, digits)
    if small:
        return to_tex(small[0]) + rf"\cdot 10^{{{small[1]}}}"
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


def limits(usual: str) -> str:
    """Usual limits in print: of a span from zero the upper end, of an empty one its value."""
    low, _, high = usual.partition("…")
    if low == high:
        return low
    return f"до {high}" if low == "0" else usual.replace("-", MINUS)
