r"""Plain text of a symbol follows from its TeX: ``R'_{\mathrm{ш.ш}\,\max}`` is «R′ш.ш max»."""

from __future__ import annotations

import re
from functools import lru_cache

NBSP = "\u00a0"
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


@lru_cache(maxsize=4096)
def plain_symbol(tex: str) -> str:
    """A symbol as one line of text, for headings, files and comments.

    Indices are written on, numbers raised, other upper indices follow the lower ones after a
    blank; a factor after an index has its point.

    Raises:
        ValueError: a command that no line of text can show.
    """
    return _Reader(tex).line()


class _Reader:
    """Tokens of a TeX symbol, read once from the left."""

    def __init__(self, tex: str) -> None:
        self._tex = tex
        self._tokens: list[str] = _TOKEN.findall(tex.replace(r"\ ", r"\,"))
        self._place = 0

    def line(self, *, index: bool = False) -> str:
        """Text up to the closing brace or the end."""
        text, raised, indexed = "", "", False
        while self._place < len(self._tokens) and self._tokens[self._place] != "}":
            token = self._next()
            if token in ("_", "^"):
                part = self._argument(index=True)
                if token == "_":
                    text, indexed = text + part, True
                elif re.fullmatch(r"−?\d+", part):
                    text += part.replace("−", "-").translate(_RAISED)
                elif part in ("°", "′"):
                    text += part
                else:
                    raised = " " + part
                continue
            piece = self._piece(token, index=index)
            if raised and token[0] != "'":
                text, raised = text + raised, ""
            text += _joint(text, token, piece, index=index, indexed=indexed) + piece
            if token in _RELATIONS and not index and text != piece:
                text += " "
            indexed = indexed and token[0] == "'"
        return text + raised

    def _next(self) -> str:
        self._place += 1
        return self._tokens[self._place - 1]

    def _argument(self, *, index: bool) -> str:
        return self._piece(self._next(), index=index)

    def _piece(self, token: str, *, index: bool) -> str:
        if token == "{":
            text = self.line(index=index)
            self._place += 1  # the closing brace
            return text
        if token[0] == "'":
            return _PRIMES[token]
        if token[0] != "\\":
            return "−" if token == "-" else token
        name = token[1:]
        if name in ("frac", "dfrac", "tfrac"):
            over, under = (self._argument(index=index) for _ in range(2))
            return f"{_bracketed(over)}/{_bracketed(under)}"
        if name == "sqrt":
            return f"√({self._argument(index=index)})"
        if name in _OVER:
            return self._argument(index=index) + _OVER[name]
        if name in _FUNCTIONS:
            return name
        if name in _GREEK or name in _SIGNS:
            return _GREEK.get(name) or _SIGNS[name]
        msg = f"symbol {self._tex!r}: {token} has no plain text"
        raise ValueError(msg)


def _joint(text: str, token: str, piece: str, *, index: bool, indexed: bool) -> str:
    """What stands between a text and its next piece."""
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


def _bracketed(text: str) -> str:
    return f"({text})" if _SUM.search(text) else text
