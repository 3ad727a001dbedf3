r"""Symbols in running text: simple TeX turned into ``<i>R</i><sub>ш.ш</sub>``.

Cheaper than a picture by far.  Only letters, Greek, indices, primes, ``\mathrm`` and
``\bar`` are understood; anything else is refused, set it with :mod:`mathsvg`.
"""

from __future__ import annotations

import functools
import re

from markupsafe import Markup, escape

_GREEK_NAMES = (
    "alpha beta gamma delta varepsilon zeta eta theta iota kappa lambda mu nu xi omicron pi rho "
    "varsigma sigma tau upsilon varphi chi psi omega"
)
GREEK: dict[str, str] = {
    name: chr(0x3B1 + index) for index, name in enumerate(_GREEK_NAMES.split())
}
GREEK |= {"epsilon": "ε", "phi": "φ", "vartheta": "ϑ", "partial": "∂"}
GREEK |= {
    name.capitalize(): GREEK[name].upper()
    for name in ("gamma", "delta", "theta", "lambda", "xi", "pi", "sigma", "upsilon", "psi")
}
GREEK |= {"Phi": "Φ", "Omega": "Ω"}

_SIGNS = {
    "cdot": "·",
    "times": "×",
    "circ": "°",
    "prime": "′",
    "infty": "∞",
    "pm": "±",
    "approx": "≈",
    "leq": "≤",
    "geq": "≥",
    "le": "≤",
    "ge": "≥",
    "dots": "…",
    "ldots": "…",
    "degree": "°",
}
_SPACE = "\u00a0"
_SPACED = set("=≈≤≥<>·×±+−") | {"&lt;", "&gt;"}
_FUNCTIONS = {"sin", "cos", "tan", "tg", "ctg", "arcsin", "arccos", "arctg", "max", "min", "ln"}
_TOKEN = re.compile(r"\\[A-Za-z]+|\\[,;: !]|\\.|\{,\}|[0-9]+(?:\{,\}[0-9]+)?|.", re.DOTALL)


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
    tokens = [token for token in _TOKEN.findall(symbol_tex) if not token.isspace()]
    html, rest = _sequence(tokens, upright=False, closing=False)
    if rest:
        msg = f"Лишняя скобка в обозначении {symbol_tex!r}"
        raise SymbolError(msg)
    return Markup(html)


def _sequence(tokens: list[str], *, upright: bool, closing: bool) -> tuple[str, list[str]]:
    """Read up to the closing brace (or the end); give HTML and what is left."""
    pieces: list[str] = []
    while tokens:
        token, tokens = tokens[0], tokens[1:]
        if token == "}":
            if not closing:
                return "".join(pieces), [token, *tokens]
            return _joined(pieces), tokens
        piece, tokens = _item(token, tokens, upright=upright)
        if piece in _SPACED and pieces and tokens and not pieces[-1].endswith(_SPACE):
            piece = f"{_SPACE}{piece}{_SPACE}"
        pieces.append(piece)
    if closing:
        msg = "Не закрыта фигурная скобка в обозначении"
        raise SymbolError(msg)
    return _joined(pieces), tokens


def _item(token: str, tokens: list[str], *, upright: bool) -> tuple[str, list[str]]:
    if token in "_^":
        inner, tokens = _argument(tokens, upright=upright)
        if token == "^" and inner in ("°", "′"):
            return inner, tokens
        tag = "sub" if token == "_" else "sup"
        return f"<{tag}>{inner}</{tag}>", tokens
    if token == "{":
        return _sequence(tokens, upright=upright, closing=True)
    if token in (r"\mathrm", r"\text", r"\operatorname"):
        return _argument(tokens, upright=True)
    if token in (r"\bar", r"\overline", r"\vec"):
        inner, tokens = _argument(tokens, upright=upright)
        return f'<span class="bar">{inner}</span>', tokens
    return _atom(token, upright=upright), tokens


def _argument(tokens: list[str], *, upright: bool) -> tuple[str, list[str]]:
    if not tokens:
        msg = "Обозначение обрывается на индексе"
        raise SymbolError(msg)
    if tokens[0] == "{":
        return _sequence(tokens[1:], upright=upright, closing=True)
    return _item(tokens[0], tokens[1:], upright=upright)


def _atom(token: str, *, upright: bool) -> str:
    if token.startswith("\\"):
        return _command(token[1:])
    if token == "'":
        return "′"
    if token[0].isdigit() or token == "{,}":
        return token.replace("{,}", ",")
    if token.isascii() and token.isalpha() and not upright:
        return f"<i>{token}</i>"
    if token in "}$&#%~\\":
        msg = f"Знак {token!r} в обозначении не понят"
        raise SymbolError(msg)
    return "−" if token == "-" else str(escape(token))


def _command(name: str) -> str:
    if name in GREEK:
        letter = GREEK[name]
        return f"<i>{letter}</i>" if letter.islower() else letter
    if name in _SIGNS:
        return _SIGNS[name]
    if name in _FUNCTIONS:
        return name
    if name in (",", ";", ":", " "):
        return "\u00a0"
    msg = f"Команда \\{name} в обозначении не понята; наберите её формулой"
    raise SymbolError(msg)


def _joined(pieces: list[str]) -> str:
    """Join, putting neighbouring slanted letters into one element."""
    return "".join(pieces).replace("</i><i>", "")
