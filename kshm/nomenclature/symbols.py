r"""Plain text of a symbol follows from its TeX: ``R'_{\mathrm{ш.ш}\,\max}`` is «R′ш.ш max»."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import lru_cache
from itertools import groupby

NBSP = "\u00a0"
BASE, LOWER, UPPER = "", "_", "^"  # levels of the letters of a symbol
_ON_LINE = " "  # BASE, a letter of its own
_TOKEN = re.compile(r"\\[A-Za-z]+|\\.|'+|\S")
_GREEK_NAMES = (
    "alpha beta gamma delta varepsilon zeta eta theta iota kappa lambda mu nu xi pi rho sigma tau "
    "varphi chi psi omega Gamma Delta Theta Lambda Xi Pi Sigma Phi Psi Omega"
)
_GREEK = dict(zip(_GREEK_NAMES.split(), "αβγδεζηθικλμνξπρστφχψωΓΔΘΛΞΠΣΦΨΩ", strict=True))
_SIGNS = {"cdot": "·", "times": "×", "pm": "±", "neq": "≠", "approx": "≈", "circ": "°",
          "parallel": "∥", "perp": "⊥", "prime": "′", "infty": "∞", ",": NBSP, ";": NBSP,
          "left": "", "right": "", "mathrm": ""}  # fmt: skip
_OVER = {"bar": "\u0304", "dot": "\u0307", "vec": "\u20d7"}
_FUNCTIONS = {"sin", "cos", "tan", "tg", "ctg", "arcsin", "arccos", "arctg", "ln", "max", "min"}
_PRIMES = {"'": "′", "''": "″", "'''": "‴"}
_RAISED = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")
WORDS: dict[str, str] = {
    # No symbol in the report either: texts, choices, marks.
    "check": "итог", "check_value": "значение", "verdict": "вывод", "governs": "режим",
    "oil_picked": "выбран", "mat_picked": "выбран", "oil_open": "невязка",
    # Numbers of rows: the first column of a list is headed as lists are.
    "variant": "№", "order_code": "порядок", "point": "№", "tor_mass": "№", "oil_case": "№",
    # Compared by the program, in no formula.
    "oil_mark": "метка", "tor_mark": "метка", "place#": "разряд #",
}  # fmt: skip
_RELATIONS = {"=", "+", "-", "≈", "≠"}  # with blanks between what they join, tight in an index
_SUM = re.compile(r" [+−] ")


@dataclass(frozen=True, slots=True)
class _Line:
    """Text with the level of each letter."""

    text: str = ""
    levels: str = ""

    def __add__(self, other: _Line) -> _Line:
        return _Line(self.text + other.text, self.levels + other.levels)


def _set(text: str, level: str) -> _Line:
    return _Line(text, level * len(text))


def plain_symbol(tex: str) -> str:
    """Return a symbol as one line of text, for headings, files and comments.

    Indices are written on, numbers raised, other upper indices follow the lower ones after a
    blank; a factor after an index has its point.

    Raises:
        ValueError: a command that no line of text can show.
    """
    return _read(tex).text


@lru_cache(maxsize=4096)
def symbol_runs(tex: str) -> tuple[tuple[str, str], ...]:
    r"""Pieces of the plain text, each with its level: ``BASE``, ``LOWER`` or ``UPPER`` index.

    Raises:
        ValueError: a command that no line of text can show.

    >>> symbol_runs(r"R'_{\mathrm{ш.ш}}")
    (('R′', ''), ('ш.ш', '_'))
    """
    line = _read(tex)
    pairs = zip(line.text, line.levels, strict=True)
    pieces = (
        (level, "".join(letter for letter, _ in run)) for level, run in groupby(pairs, _level)
    )
    return tuple((text, level.strip()) for level, text in pieces)


def _level(pair: tuple[str, str]) -> str:
    return pair[1]


@lru_cache(maxsize=4096)
def _read(tex: str) -> _Line:
    if tex.count("{") != tex.count("}"):
        raise ValueError(f"symbol {tex!r}: braces do not pair up")
    return _Reader(tex).line(_ON_LINE)


class _Reader:
    """Tokens of a TeX symbol, read once from the left."""

    def __init__(self, tex: str) -> None:
        self._tex = tex
        self._tokens: list[str] = _TOKEN.findall(tex.replace(r"\ ", r"\,"))
        self._place = 0

    def line(self, level: str) -> _Line:
        """Text up to the closing brace or the end; within an index all is on its level."""
        index = level != _ON_LINE
        line, raised, indexed = _Line(), _Line(), False
        while self._place < len(self._tokens) and self._tokens[self._place] != "}":
            token = self._next()
            if token in (LOWER, UPPER):
                part = self._argument(level if index else token)
                if token == LOWER:
                    line, indexed = line + part, True
                elif re.fullmatch(r"−?\d+", part.text):
                    line += _set(part.text.replace("−", "-").translate(_RAISED), level)
                elif part.text in ("°", "′"):
                    line += _set(part.text, level)
                else:
                    raised = _set(" ", token) + part
                continue
            piece = self._piece(token, level)
            if raised.text and token[0] != "'":
                line, raised = line + raised, _Line()
            joint = _joint(line.text, token, piece.text, index=index, indexed=indexed)
            spaced = token in _RELATIONS and not index and bool(line.text)
            line += _set(joint, level) + piece + _set(" " if spaced else "", level)
            indexed = indexed and token[0] == "'"
        return line + raised

    def _next(self) -> str:
        self._place += 1
        return self._tokens[self._place - 1]

    def _argument(self, level: str) -> _Line:
        return self._piece(self._next(), level)

    def _piece(self, token: str, level: str) -> _Line:
        if token == "{":
            line = self.line(level)
            self._place += 1  # the closing brace
            return line
        name = token[1:] if token[0] == "\\" else ""
        if name in ("frac", "dfrac", "tfrac"):
            over, under = (_bracketed(self._argument(level), level) for _ in range(2))
            return over + _set("/", level) + under
        if name == "sqrt":
            return _set("√(", level) + self._argument(level) + _set(")", level)
        if name in _OVER:
            under = self._argument(level)
            return under + _set(_OVER[name], under.levels[-1:])
        return _set(self._sign(token, name), level)

    def _sign(self, token: str, name: str) -> str:
        if token[0] == "'":
            return _PRIMES[token]
        if token[0] != "\\":
            return "−" if token == "-" else token
        if name in _FUNCTIONS:
            return name
        if name in _GREEK or name in _SIGNS:
            return _GREEK.get(name) or _SIGNS[name]
        msg = f"symbol {self._tex!r}: {token} has no plain text"
        raise ValueError(msg)


def _joint(text: str, token: str, piece: str, *, index: bool, indexed: bool) -> str:
    """Return what stands between a text and its next piece."""
    if not text or not piece or text[-1] in f" {NBSP}(":
        return ""
    if token in _RELATIONS or piece in _RELATIONS:
        return "" if index else " "
    if token[1:] in ("max", "min"):
        return "" if text[-1].isdigit() else NBSP
    if token[1:] in _FUNCTIONS and (text[-1].isalnum() or text[-1] == ")"):
        return " "  # a factor, where a heading may break
    if re.search(r"(?:sin|cos|tg|ln)$", text) and piece[0].isalnum():
        return NBSP
    return "·" if indexed and not index and piece[0].isalpha() else ""


def _bracketed(line: _Line, level: str) -> _Line:
    return _set("(", level) + line + _set(")", level) if _SUM.search(line.text) else line
