"""Formulas in words and plain signs, for people who hear the page or copy from it."""

from __future__ import annotations

import functools
import re
from collections.abc import Sequence

from reports.document.text import texcases
from reports.document.text.symbols import SIGNS
from reports.document.text.tex import FRACTIONS, GREEK, Node, tree
from reports.shared.russian import MINUS

_GREEK = {
    "alpha": "альфа", "beta": "бета", "gamma": "гамма", "delta": "дельта", "epsilon": "эпсилон",
    "varepsilon": "эпсилон", "zeta": "дзета", "eta": "эта", "theta": "тета", "vartheta": "тета",
    "iota": "йота", "kappa": "каппа", "lambda": "лямбда", "mu": "мю", "nu": "ню", "xi": "кси",
    "omicron": "омикрон", "pi": "пи", "rho": "ро", "varsigma": "сигма", "sigma": "сигма",
    "tau": "тау", "upsilon": "ипсилон", "varphi": "фи", "phi": "фи", "chi": "хи", "psi": "пси",
    "omega": "омега", "partial": "дэ",
}  # fmt: skip
_LETTERS = {sign: _GREEK[name] for name, sign in GREEK.items() if name in _GREEK}
_FUNCTIONS = {
    "sin": "синус", "cos": "косинус", "tg": "тангенс", "tan": "тангенс", "ctg": "котангенс",
    "arcsin": "арксинус", "arccos": "арккосинус", "arctg": "арктангенс", "arctan": "арктангенс",
    "ln": "натуральный логарифм", "lg": "десятичный логарифм", "exp": "экспонента",
    "sh": "гиперболический синус", "ch": "гиперболический косинус", "sign": "знак", "sgn": "знак",
    "min": "мин", "max": "макс", "lim": "предел", "mod": "остаток",
}  # fmt: skip
_KEPT = ("cdot", "times", "pm", "approx", "leq", "geq", "le", "ge")
_SIGNS = {name: SIGNS[name] for name in _KEPT}
_SIGNS |= {"sum": "сумма", "int": "интеграл", "oint": "интеграл по контуру",
           "infty": "бесконечность", "prod": "произведение", "neq": "≠", "ne": "≠", "equiv": "≡",
           "dots": "…", "ldots": "…", "circ": "°", "degree": "°", "prime": "штрих", "mid": "|",
           "parallel": "∥", "to": "→", "Delta": "дельта", "colon": ":"}  # fmt: skip
_OVER = {
    "bar": "с чертой", "overline": "с чертой", "dot": "с точкой", "ddot": "с двумя точками",
    "hat": "с крышкой", "vec": "вектор",
}  # fmt: skip
_UPRIGHT = {"mathrm", "text", "operatorname", "mathbf"}
_NOT_SAID = {"left", "right", "displaystyle", "hspace", "!"}
_POWERS = {"2": "в квадрате", "3": "в кубе"}
_RAISED = str.maketrans(f"0123456789+-{MINUS}", "⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻⁻")
_INVISIBLE = re.compile(r"\\(?:left|right)\.")
_INSTEAD = (("{,}", ","), (r"\\", ";"), (r"\left|", r"\mathrm{модуль} ("), (r"\right|", ")"))
_ATOM = re.compile(r"[\w,.°′]+")
_WORD = re.compile(r"[a-z]{2,}", re.IGNORECASE)


@functools.lru_cache(maxsize=4096)
def spoken(tex: str) -> str:
    """A formula as a person would read it aloud: «синус в квадрате фи», «бета макс»."""
    if texcases.is_cases(tex):
        tex = texcases.apart(tex)
    for given, said in _INSTEAD:
        tex = tex.replace(given, said)
    tex = _INVISIBLE.sub("", tex)
    return _spaced(_said(tree(tex)))


def _said(nodes: Sequence[Node]) -> str:
    """Words of some nodes, a space between what are no digits of one number."""
    pieces: list[str] = []
    for node, before in zip(nodes, (None, *nodes), strict=False):
        piece = _piece(node)
        alike = before is not None and _in_number(node) and _in_number(before)
        letter = before is not None and before.token.isalpha() and before.token.isascii()
        index = letter and _is_short(node)
        pieces.append(piece if alike or index else f" {piece}")
    return "".join(pieces)


def _is_short(node: Node) -> bool:
    """An index that is written with its letter, not as a word of its own."""
    first = node.parts[0][0] if node.token == "_" and node.parts[0] else None
    return first is not None and (not first.command or first.command in _UPRIGHT)


def _in_number(node: Node) -> bool:
    return node.token.isdigit() or node.token in (",", ".")


def _piece(node: Node) -> str:
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
    if command in _UPRIGHT:
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
    """A command as a word or a sign; a space where it is one."""
    capital = _GREEK.get(command[0].lower() + command[1:])
    return _FUNCTIONS.get(command) or _SIGNS.get(command) or _GREEK.get(command) or capital or " "


def _power(exponent: str) -> str:
    if exponent in ("°", "штрих", "*"):
        return exponent
    return _POWERS.get(exponent) or f"в степени {_bracketed(exponent)}"


def _bracketed(text: str) -> str:
    """A part of several words or signs in brackets."""
    return text if _ATOM.fullmatch(text.removeprefix(MINUS)) else f"({text})"


def _upright(nodes: Sequence[Node]) -> str:
    """An index, a unit or a word, letters together: powers of units stand raised."""
    made = []
    for node in nodes:
        inner = [_upright(part) for part in node.parts]
        if node.token == "^":
            made.append(inner[0].translate(_RAISED))
        elif node.token in ("{", "_") or node.command in _UPRIGHT:
            made.append(inner[0])
        elif node.command == "cdot":
            made.append("·")
        else:
            made.append(_piece(node))
    return _WORD.sub(lambda met: _FUNCTIONS.get(met[0], met[0]), "".join(made))


def _spaced(text: str) -> str:
    """One space between words and round signs, none inside of brackets and before commas."""
    text = re.sub(rf"\s*([=≈≤≥<>≠≡·×±+/{MINUS}])\s*", r" \1 ", text)
    text = re.sub(r"\s*/\s*", "/", re.sub(r"\s+", " ", text))
    # Of a number or a part: no sign between two.
    text = re.sub(rf"(^ ?|[=≈≤≥<>·×,;+/] ?|\( ?|степени ){MINUS} ", rf"\1{MINUS}", text)
    text = re.sub(r"([(\[]) +| +(?=[)\],;:°%′])", r"\1", text)
    return text.replace(" штрих", "′").strip()
