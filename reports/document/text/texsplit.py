r"""Where a TeX formula may be broken into lines.

Only the outermost level of braces and of ``\left … \right`` is looked at; plain round
brackets count as depth too, but a break inside of them is allowed as a last resort.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

_TOKEN = re.compile(r"\\[A-Za-z]+|\\.|.", re.DOTALL)
_RELATIONS = {"=", r"\approx", r"\leq", r"\geq", r"\le", r"\ge", "<", ">", r"\equiv", r"\neq"}
_SUMS = {"+", "-", r"\pm", r"\mp"}
_PRODUCTS = {r"\cdot", r"\times"}


@dataclass(frozen=True, slots=True)
class BreakPoint:
    """A place after an operator: ``end`` past it, what the next line begins with, rank 0-3."""

    end: int
    carried: str
    rank: int


def tokens(tex: str) -> list[str]:
    r"""Split TeX into commands (``\alpha``, ``\,``) and single characters."""
    return _TOKEN.findall(tex)


def balanced(tex: str) -> bool:
    r"""Whether braces pair up, escaped ones (``\{``) left aside."""
    depth = 0
    for match in _TOKEN.finditer(tex):
        depth += {"{": 1, "}": -1}.get(match.group(), 0)
        if depth < 0:
            return False
    return depth == 0


def break_points(tex: str) -> list[BreakPoint]:
    """Every place where a line may end, in order."""
    points: list[BreakPoint] = []
    groups = rounds = 0
    previous = ""
    for match in _TOKEN.finditer(tex):
        token = match.group()
        if token in ("{", r"\left"):
            groups += 1
        elif token in ("}", r"\right"):
            groups -= 1
        elif token in "([":
            rounds += 1
        elif token in ")]":
            rounds -= 1
        elif groups == 0 and previous:
            point = _point(token, match.end(), previous, rounds)
            # Nothing but a carried sign stands before: such a break would repeat for ever.
            if point is not None and tex[: match.start()].strip() != "{}":
                points.append(point)
        if not token.isspace():
            previous = token
    # Nothing may follow the last operator: a line cannot begin with it alone.
    return [point for point in points if tex[point.end :].strip()]


def _point(token: str, end: int, previous: str, rounds: int) -> BreakPoint | None:
    inside = 1 if rounds > 0 else 0
    if token in _RELATIONS:
        return BreakPoint(end, f"{{}}{token} ", inside)
    unary = previous in _RELATIONS | _SUMS | _PRODUCTS or previous in ("(", "[", "{")
    if token in _SUMS and not unary:
        return BreakPoint(end, f"{{}}{token} ", 1 + inside)
    if token in _PRODUCTS:
        return BreakPoint(end, r"{}\times ", 2 + inside)
    return None
