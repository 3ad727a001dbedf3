r"""Our TeX in the words of matplotlib's mathtext.

mathtext knows no ``\tg``, sets no space around fractions and before function names, and
puts one after a full stop even inside of an index (``ш.ш``).  All of that is mended here,
so that the formulas can be written as a textbook's author would.
"""

from __future__ import annotations

import re

from reports.document.text.symbols import GREEK
from reports.document.text.texsplit import tokens

_OPERATORS = {"tg", "ctg", "arctg", "sh", "ch", "sign"}  # unknown to mathtext
_FUNCTIONS = _OPERATORS | {"sin", "cos", "tan", "arcsin", "arccos", "arctan", "ln", "lg", "exp"}
_RENAMED = {r"\le": r"\leq", r"\ge": r"\geq", r"\text": r"\mathrm", r"\ne": r"\neq"}
_RENAMED |= {r"\bar": r"\overline"}  # the accent of mathtext breaks beside a prime
_FRACTIONS = {r"\frac", r"\dfrac", r"\tfrac"}
_TAKES_ONE = {"_", "^", r"\mathrm", r"\mathbf", r"\mathit", r"\text", r"\overline", r"\bar"}
_TAKES_ONE |= {r"\sqrt", r"\vec", r"\dot", r"\ddot", r"\operatorname", r"\hat", r"\hspace"}
_BIG = {r"\sum", r"\int", r"\prod", r"\oint"}
_THIN = r"\,"
_DEGREE = re.compile(r"\^(?:\{\\circ\}|\\circ(?![A-Za-z]))")
_NO_SPACE_AFTER_DOT = r".\hspace{-0.2}"


def for_mathtext(tex: str, *, level_primes: bool = False) -> str:
    """Translate one formula; spaces it out as TeX would.

    Args:
        tex: The formula without dollar signs.
        level_primes: Set primes as letters, for figures: mathtext raises them too high and
            only :mod:`mathsvg` can bring them down again.
    """
    if level_primes:
        tex = tex.replace("'", r"{\prime}")
    translated, _ = _sequence(tokens(_DEGREE.sub("°", tex)), 0)
    return translated


def _sequence(source: list[str], start: int) -> tuple[str, int]:
    """Translate up to the closing brace; give the text and the place after the brace."""
    out: list[str] = []
    closed = False  # something that takes room stands before
    pending = False  # a fraction or a big operator does: a thin space if more follows
    place = start
    while place < len(source) and source[place] != "}":
        token = source[place]
        if (pending and _opens(token)) or (closed and _wants_room(token)):
            out.append(_THIN)
        text, place = _item(source, place)
        out.append(text)
        if token not in ("_", "^") and not token.isspace():  # an index belongs to its letter
            pending = token in _FRACTIONS or token in _BIG
            closed = _closes(token)
    return "".join(out), place + 1


def _item(source: list[str], place: int) -> tuple[str, int]:
    """One token with its arguments."""
    token = source[place]
    name = token.removeprefix("\\")
    place += 1
    if token == "{":
        inner, place = _sequence(source, place)
        return f"{{{inner}}}", place
    if token == ".":
        return _NO_SPACE_AFTER_DOT, place
    if token == "'":  # mathtext would set an index beside the prime, not below it
        primes = r"\prime"
        while place < len(source) and source[place] == "'":
            primes, place = primes + r"\prime", place + 1
        return f"^{{{primes}}}", place
    word = rf"\operatorname{{{name}}}" if _is_command(token, _OPERATORS) else token
    word = _RENAMED.get(word, word)
    arguments = 2 if token in _FRACTIONS else 1 if token in _TAKES_ONE else 0
    if arguments:
        while arguments and place < len(source):
            argument, place = _item(source, place)
            word += "" if argument.isspace() else _braced(argument)
            arguments -= 0 if argument.isspace() else 1
    elif word[0] == "\\" and word[-1].isalpha() and place < len(source):
        word += " " if source[place].isalpha() else ""
    return word, place


def _braced(argument: str) -> str:
    return argument if argument.startswith("{") else f"{{{argument}}}"


def _is_command(token: str, names: set[str]) -> bool:
    return token.startswith("\\") and token[1:] in names


def _wants_room(token: str) -> bool:
    return token in _FRACTIONS or token in _BIG or _is_command(token, _FUNCTIONS)


def _closes(token: str) -> bool:
    """Whether the token ends something that takes room: a letter, a group, a bracket."""
    return (
        token.isalnum()
        or token in ("{", ")", "]", "'", "°")
        or (token in _TAKES_ONE or _is_command(token, set(GREEK)))
    )


def _opens(token: str) -> bool:
    """Whether the token begins something that takes room."""
    return (
        token.isalnum()
        or token in ("{", "(", "[", r"\left")
        or _wants_room(token)
        or (token in _TAKES_ONE - {"_", "^"} or _is_command(token, set(GREEK)))
    )
