r"""Symbols in running text: simple TeX turned into ``<i>R</i><sub>ш.ш</sub>``.

Cheaper than a picture by far.  Only letters, Greek, indices, primes, ``\mathrm`` and
``\bar`` are understood; anything else is refused, set it with :mod:`mathsvg`.
"""

from __future__ import annotations

import functools
import re
from collections.abc import Sequence

from markupsafe import Markup, escape

from reports.document.text.tex import FRACTIONS, GREEK, TexNode, case_lines, is_cases, tree
from reports.document.text.texts import rich
from reports.formula.tex import input_symbol_tex
from reports.shared.errors import SymbolError, TexError
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
_MARKUP = re.compile(r"(<sub>)|<[^>]+>")
_NO_TEXT = ("<sup>", "<span")  # raised, with a bar
_INDEXED = re.compile(r"_([^\s_·/=,;.()²³⁴]+(?:[.\u00a0][^\s_·/=,;.()²³⁴]+)*(?:\([i\d\s+]+\))?)")
# A symbol as the checks of an input write it, «m_j/F_п», and a unit with a slash.  A key of the
# file has more letters before its «_», or a point.
_INDEX = r"_−?[^\W_]+(?:\.[^\W_]+)*'*(?!\w)"
_GIVEN = rf"(?P<symbol>(?<![\w.'])Δ?[^\W\d_]'?{_INDEX}(?:/[^\W\d_](?:{_INDEX})?(?= = ))?)"
_OF_REMARK = re.compile(rf"{_GIVEN}|(?P<unit>[а-яА-Я·]+/[а-яА-Я·]+[²³]?)")
_GREEK = {
    "alpha": "альфа", "beta": "бета", "gamma": "гамма", "delta": "дельта", "epsilon": "эпсилон",
    "varepsilon": "эпсилон", "zeta": "дзета", "eta": "эта", "theta": "тета", "vartheta": "тета",
    "iota": "йота", "kappa": "каппа", "lambda": "лямбда", "mu": "мю", "nu": "ню", "xi": "кси",
    "omicron": "омикрон", "pi": "пи", "rho": "ро", "varsigma": "сигма", "sigma": "сигма",
    "tau": "тау", "upsilon": "ипсилон", "varphi": "фи", "phi": "фи", "chi": "хи", "psi": "пси",
    "omega": "омега", "partial": "дэ",
}  # fmt: skip
_LETTERS = {sign: _GREEK[name] for name, sign in GREEK.items() if name in _GREEK}
_SPOKEN_FUNCTIONS = {
    "sin": "синус", "cos": "косинус", "tg": "тангенс", "tan": "тангенс", "ctg": "котангенс",
    "arcsin": "арксинус", "arccos": "арккосинус", "arctg": "арктангенс", "arctan": "арктангенс",
    "ln": "натуральный логарифм", "lg": "десятичный логарифм", "exp": "экспонента",
    "sh": "гиперболический синус", "ch": "гиперболический косинус", "sign": "знак", "sgn": "знак",
    "min": "мин", "max": "макс", "lim": "предел", "mod": "остаток",
}  # fmt: skip
_KEPT = ("cdot", "times", "pm", "approx", "leq", "geq", "le", "ge")
_SIGNS = {name: SIGNS[name] for name in _KEPT}
_OVER = {
    "bar": "с чертой", "overline": "с чертой", "dot": "с точкой", "ddot": "с двумя точками",
    "hat": "с крышкой", "vec": "вектор",
}  # fmt: skip
_SPOKEN_UPRIGHT = {"mathrm", "text", "operatorname", "mathbf"}
_NOT_SAID = {"left", "right", "displaystyle", "hspace", "!"}
_POWERS = {"2": "в квадрате", "3": "в кубе"}
_RAISED = str.maketrans(f"0123456789+-{MINUS}", "⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻⁻")
_INVISIBLE = re.compile(r"\\(?:left|right)\.")
_INSTEAD = (("{,}", ","), (r"\\", ";"), (r"\left|", r"\mathrm{модуль} ("), (r"\right|", ")"))
_ATOM = re.compile(r"[\w,.°′]+")
_SPOKEN_WORD = re.compile(r"[a-z]{2,}", re.IGNORECASE)


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


@functools.lru_cache(maxsize=4096)
def indexed(symbol_tex: str, plain: str) -> str:
    """A symbol as text with «_» before its index, «R_ш.ш»; ``plain`` where it is no simple one."""
    try:
        html = inline_html(symbol_tex)
    except SymbolError:
        return plain
    text = Markup(_MARKUP.sub(lambda match: "_" if match[1] else "", html)).unescape()
    return plain if any(each in html for each in _NO_TEXT) else text


@functools.lru_cache(maxsize=4096)
def with_indices(text: str) -> Markup:
    """Return a text with the symbols of ``indexed`` in it, their indices lowered."""
    parts = _INDEXED.split(text)
    lowered = (Markup("<sub>{}</sub>").format(part) for part in parts[1::2])
    return Markup("").join(Markup("{}{}").format(*pair) for pair in zip(parts[::2], [*lowered, ""],
                                                                          strict=True))  # fmt: skip


@functools.lru_cache(maxsize=4096)
def titled_html(title: str) -> Markup:
    """Return a title with its symbols as symbols: «давление pa» gives *p* with the index *a*."""
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
    letter_html = letter if upright else f"<i>{letter}</i>"
    if index is None:
        return letter_html
    small = f"<i>{index}</i>" if index.isascii() and index.isalpha() else index
    return f"{letter_html}<sub>{small}</sub>"


def _html(nodes: Sequence[TexNode], *, upright: bool) -> str:
    pieces: list[str] = []
    tokens = [node for node in nodes if not node.token.isspace()]
    for number, node in enumerate(tokens, 1):
        piece = _piece(node, upright=upright)
        if piece in _SPACED and pieces and number < len(tokens) and not pieces[-1].endswith(NBSP):
            piece = f"{NBSP}{piece}{NBSP}"
        if node.command in _FUNCTIONS and pieces and not pieces[-1].endswith(NBSP):
            piece = f"{NBSP}{piece}{NBSP}"
        pieces.append(piece)
    # Neighbouring slanted letters stand in one element.
    return "".join(pieces).replace("</i><i>", "")


def _piece(node: TexNode, *, upright: bool) -> str:
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


def remark_html(text: str) -> Markup:
    """Return a remark on the input with its symbols as symbols; no line ends within a unit."""
    pieces, end = [], 0
    for match in _OF_REMARK.finditer(text):
        symbol = match["symbol"]
        html = inline_html(input_symbol_tex(symbol)) if symbol else rich(match["unit"])
        whole = Markup('<span class="nb">{}</span>').format(html)
        pieces += [rich(text[end : match.start()]), whole]
        end = match.end()
    return Markup("").join([*pieces, rich(text[end:])])


_SIGNS |= {"sum": "сумма", "int": "интеграл", "oint": "интеграл по контуру",
           "infty": "бесконечность", "prod": "произведение", "neq": "≠", "ne": "≠", "equiv": "≡",
           "dots": "…", "ldots": "…", "circ": "°", "degree": "°", "prime": "штрих", "mid": "|",
           "parallel": "∥", "to": "→", "Delta": "дельта", "colon": ":"}  # fmt: skip


@functools.lru_cache(maxsize=4096)
def spoken(tex: str) -> str:
    """Return a formula as a person would read it aloud: «синус в квадрате фи», «бета макс»."""
    if is_cases(tex):
        tex = case_lines(tex)
    for sign, said in _INSTEAD:
        tex = tex.replace(sign, said)
    tex = _INVISIBLE.sub("", tex)
    return _spaced(_said(tree(tex)))


def _said(nodes: Sequence[TexNode]) -> str:
    """Words of some nodes, a space between what are no digits of one number."""
    pieces: list[str] = []
    for node, before in zip(nodes, (None, *nodes), strict=False):
        piece = _spoken_piece(node)
        alike = before is not None and _in_number(node) and _in_number(before)
        letter = before is not None and before.token.isalpha() and before.token.isascii()
        index = letter and _is_short(node)
        pieces.append(piece if alike or index else f" {piece}")
    return "".join(pieces)


def _is_short(node: TexNode) -> bool:
    """Return an index that is written with its letter, not as a word of its own."""
    first = node.parts[0][0] if node.token == "_" and node.parts[0] else None
    return first is not None and (not first.command or first.command in _SPOKEN_UPRIGHT)


def _in_number(node: TexNode) -> bool:
    return node.token.isdigit() or node.token in (",", ".")


def _spoken_piece(node: TexNode) -> str:
    parts = [_spaced(_said(part)) for part in node.parts]
    command = node.command
    if node.token in FRACTIONS:
        return f"{_bracketed(parts[0])}/{_bracketed(parts[1])}"
    if command == "sqrt":
        return f"корень из {_bracketed(parts[0])}"
    if node.token == "_":
        return _upright(node.parts[0])
    if node.token == "^":
        return _power(parts[0])
    if command in _SPOKEN_UPRIGHT:
        return _upright(node.parts[0])
    if command in _OVER:
        words = (_OVER[command], parts[0]) if command == "vec" else (parts[0], _OVER[command])
        return " ".join(words)
    if command in _NOT_SAID:
        return ""
    if node.token in ("{", r"\mathit"):
        return parts[0]
    if command:
        return _named(command)
    if node.token == "'":
        return "штрих"
    return {"-": MINUS, "~": " "}.get(node.token) or _LETTERS.get(node.token, node.token)


def _named(command: str) -> str:
    """Return a command as a word or a sign; a space where it is one."""
    capital = _GREEK.get(command[0].lower() + command[1:])
    return (
        _SPOKEN_FUNCTIONS.get(command)
        or _SIGNS.get(command)
        or _GREEK.get(command)
        or capital
        or " "
    )


def _power(exponent: str) -> str:
    if exponent in ("°", "штрих", "*"):
        return exponent
    return _POWERS.get(exponent) or f"в степени {_bracketed(exponent)}"


def _bracketed(text: str) -> str:
    """Return a part of several words or signs in brackets."""
    return text if _ATOM.fullmatch(text.removeprefix(MINUS)) else f"({text})"


def _upright(nodes: Sequence[TexNode]) -> str:
    """Return an index, a unit or a word, letters together: powers of units stand raised."""
    words = []
    for node in nodes:
        inner = [_upright(part) for part in node.parts]
        if node.token == "^":
            words.append(inner[0].translate(_RAISED))
        elif node.token in ("{", "_") or node.command in _SPOKEN_UPRIGHT:
            words.append(inner[0])
        elif node.command == "cdot":
            words.append("·")
        else:
            words.append(_spoken_piece(node))
    return _SPOKEN_WORD.sub(lambda met: _SPOKEN_FUNCTIONS.get(met[0], met[0]), "".join(words))


def _spaced(text: str) -> str:
    """One space between words and round signs, none inside of brackets and before commas."""
    text = re.sub(rf"\s*([=≈≤≥<>≠≡·×±+/{MINUS}])\s*", r" \1 ", text)
    text = re.sub(r"\s*/\s*", "/", re.sub(r"\s+", " ", text))
    # Of a number or a part: no sign between two.
    text = re.sub(rf"(^ ?|[=≈≤≥<>·×,;+/] ?|\( ?|степени ){MINUS} ", rf"\1{MINUS}", text)
    text = re.sub(r"([(\[]) +| +(?=[)\],;:°%′])", r"\1", text)
    return text.replace(" штрих", "′").strip()
