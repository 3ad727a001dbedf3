r"""Symbols in running text: simple TeX turned into ``<i>R</i><sub>ш.ш</sub>``.

Cheaper than a picture by far.  Only letters, Greek, indices, primes, ``\mathrm`` and
``\bar`` are understood; anything else is refused, set it with :mod:`mathsvg`.
"""

from __future__ import annotations

import functools
import re
from collections.abc import Sequence

from markupsafe import Markup, escape

from reports.document.text.tex import GREEK, Node, TexError, tree
from reports.document.text.texts import rich
from reports.formula.tex import input_symbol_tex
from reports.shared.russian import MINUS, NBSP

SIGNS = {
    "cdot": "·", "times": "×", "circ": "°", "prime": "′", "infty": "∞", "pm": "±", "approx": "≈",
    "leq": "≤", "geq": "≥", "le": "≤", "ge": "≥", "dots": "…", "ldots": "…", "degree": "°",
    "sum": "∑", "quad": NBSP, "qquad": NBSP, ",": NBSP, ";": NBSP, ":": NBSP, " ": NBSP,
}  # fmt: skip
_SPACED = set(f"=≈≤≥<>·×±+{MINUS}") | {"&lt;", "&gt;"}
_FUNCTIONS = {"sin", "cos", "tan", "tg", "ctg", "arcsin", "arccos", "arctg", "max", "min", "ln"}
_UPRIGHT = {"mathrm", "text", "operatorname"}
# In a title: a letter and its index, written as one word or with a stroke, or a letter alone.
_WORD = r"0-9A-Za-zА-яёα-ω_′"
_IN_TITLE = re.compile(
    rf"(?<![{_WORD}°])([A-Za-zα-ω]|Δ(?=m))(?:_?(max|min|[a-z]|\d|[а-я][а-я.]{{0,4}}))?(?![{_WORD}°])"
)
_ELEMENTS = "HON"


class SymbolError(ValueError):
    """The TeX is no simple symbol."""


@functools.lru_cache(maxsize=4096)
def inline_html(symbol_tex: str) -> Markup:
    r"""Turn a simple TeX symbol into HTML.

    ``R_{\mathrm{ш.ш}}`` gives ``<i>R</i><sub>ш.ш</sub>``; Latin and small Greek letters are
    slanted, digits, capital Greek and Cyrillic letters upright.

    Raises:
        SymbolError: Something beyond letters, indices, primes and plain signs.
    """
    try:
        return Markup(_html(tree(symbol_tex), upright=False))
    except TexError as error:
        raise SymbolError(str(error)) from error


_MARKUP = re.compile(r"(<sub>)|<[^>]+>")
_NO_TEXT = ("<sup>", "<span")  # raised, with a bar


def indexed(symbol_tex: str, plain: str) -> str:
    """A symbol as text with «_» before its index, «R_ш.ш»; ``plain`` where it is no simple one."""
    try:
        html = inline_html(symbol_tex)
    except SymbolError:
        return plain
    text = Markup(_MARKUP.sub(lambda match: "_" if match[1] else "", html)).unescape()
    return plain if any(each in html for each in _NO_TEXT) else text


@functools.lru_cache(maxsize=4096)
def titled_html(title: str) -> Markup:
    """A title with its symbols as symbols: «давление pa» gives *p* with the index *a*."""
    pieces, end = [], 0
    for match in _IN_TITLE.finditer(title):
        pieces += [rich(title[end : match.start()]), Markup(_in_title(match))]
        end = match.end()
    return Markup("").join([*pieces, rich(title[end:])])


def _in_title(match: re.Match[str]) -> str:
    letter, index = match.groups()
    if letter == "Δ":
        return f"Δ<sub>{index}</sub>"
    if letter + (index or "") == "ωr":  # a product
        return "<i>ωr</i>"
    upright = letter in _ELEMENTS and index is not None and index.isdigit()
    shown = letter if upright else f"<i>{letter}</i>"
    if index is None:
        return shown
    small = f"<i>{index}</i>" if index.isascii() and index.isalpha() else index
    return f"{shown}<sub>{small}</sub>"


def _html(nodes: Sequence[Node], *, upright: bool) -> str:
    pieces: list[str] = []
    wanted = [node for node in nodes if not node.token.isspace()]
    for number, node in enumerate(wanted, 1):
        piece = _piece(node, upright=upright)
        if piece in _SPACED and pieces and number < len(wanted) and not pieces[-1].endswith(NBSP):
            piece = f"{NBSP}{piece}{NBSP}"
        pieces.append(piece)
    # Neighbouring slanted letters stand in one element.
    return "".join(pieces).replace("</i><i>", "")


def _piece(node: Node, *, upright: bool) -> str:
    token, name = node.token, node.command
    inner = "".join(_html(part, upright=upright or name in _UPRIGHT) for part in node.parts)
    if token == "{" or name in _UPRIGHT:
        return inner
    if token in ("_", "^"):
        if token == "^" and inner in ("°", "′"):
            return inner
        return f"<{'sub' if token == '_' else 'sup'}>{inner}</{'sub' if token == '_' else 'sup'}>"
    if name in ("bar", "overline", "vec"):
        return f'<span class="bar">{inner}</span>'
    if name in GREEK:
        return f"<i>{GREEK[name]}</i>" if GREEK[name].islower() else GREEK[name]
    if name in SIGNS:
        return SIGNS[name]
    if name in _FUNCTIONS:
        return name
    if name or token in "$&#%~\\":
        msg = f"Знак {token!r} в обозначении не понят; наберите его формулой"
        raise SymbolError(msg)
    if token.isascii() and token.isalpha() and not upright:
        return f"<i>{token}</i>"
    return {"'": "′", "-": MINUS}.get(token) or str(escape(token))


# A symbol as the checks of an input write it, «m_j/F_п», and a unit with a slash.  A key of the
# file has more letters before its «_», or a point.
_INDEX = r"_−?[^\W_]+(?:\.[^\W_]+)*'*(?!\w)"
_GIVEN = rf"(?P<symbol>(?<![\w.'])Δ?[^\W\d_]'?{_INDEX}(?:/[^\W\d_](?:{_INDEX})?(?= = ))?)"
_OF_REMARK = re.compile(rf"{_GIVEN}|(?P<unit>[а-яА-Я·]+/[а-яА-Я·]+[²³]?)")


def remark_html(text: str) -> Markup:
    """A remark on the input with its symbols as symbols; no line ends within a unit."""
    pieces, end = [], 0
    for match in _OF_REMARK.finditer(text):
        symbol = match["symbol"]
        shown = inline_html(input_symbol_tex(symbol)) if symbol else rich(match["unit"])
        whole = Markup('<span class="nb">{}</span>').format(shown)
        pieces += [rich(text[end : match.start()]), whole]
        end = match.end()
    return Markup("").join([*pieces, rich(text[end:])])
