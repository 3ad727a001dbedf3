r"""TeX of formulas and symbols read once: tokens, tree, places where a line may break.

A node is a token with its arguments: a group ``{…}`` has its contents, ``_`` and ``^`` their
index, ``\dfrac`` two parts; any other token has none.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

_TOKEN = re.compile(r"\\[A-Za-z]+|\\.|.", re.DOTALL)
FRACTIONS = {r"\frac", r"\dfrac", r"\tfrac"}
_TAKES_ONE = {"_", "^", r"\mathrm", r"\mathbf", r"\mathit", r"\text", r"\overline", r"\bar"}
_TAKES_ONE |= {r"\sqrt", r"\vec", r"\dot", r"\ddot", r"\operatorname", r"\hat", r"\hspace"}
_RELATIONS = {"=", r"\approx", r"\leq", r"\geq", r"\le", r"\ge", "<", ">", r"\equiv", r"\neq"}
_SUMS = {"+", "-", r"\pm", r"\mp"}
_PRODUCTS = {r"\cdot", r"\times"}

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


class TexError(ValueError):
    """The TeX is not well formed."""


@dataclass(frozen=True, slots=True)
class Node:
    """A token with its arguments."""

    token: str
    parts: tuple[tuple[Node, ...], ...] = ()

    @property
    def command(self) -> str:
        """Name of a command, empty for anything else."""
        return self.token[1:] if self.token[0] == "\\" else ""

    @property
    def takes_one(self) -> bool:
        """Whether the token is one that has one argument."""
        return self.token in _TAKES_ONE


def tree(tex: str) -> tuple[Node, ...]:
    """Read a formula.

    Raises:
        TexError: braces do not pair up, or an argument is missing.
    """
    tokens = _TOKEN.findall(tex)
    nodes, place = _sequence(tokens, 0)
    if place < len(tokens):
        msg = f"Лишняя скобка в формуле {tex!r}"
        raise TexError(msg)
    return nodes


def _sequence(tokens: Sequence[str], place: int) -> tuple[tuple[Node, ...], int]:
    """Nodes up to the closing brace or the end, and the place there."""
    nodes = []
    while place < len(tokens) and tokens[place] != "}":
        node, place = _node(tokens, place)
        nodes.append(node)
    return tuple(nodes), place


def _node(tokens: Sequence[str], place: int) -> tuple[Node, int]:
    token = tokens[place]
    place += 1
    if token == "{":
        inner, place = _sequence(tokens, place)
        if place == len(tokens):
            msg = "Не закрыта фигурная скобка в формуле"
            raise TexError(msg)
        return Node(token, (inner,)), place + 1
    parts = []
    for _ in range(2 if token in FRACTIONS else 1 if token in _TAKES_ONE else 0):
        while place < len(tokens) and tokens[place].isspace():
            place += 1
        if place == len(tokens) or tokens[place] == "}":
            msg = f"Формула обрывается после {token}"
            raise TexError(msg)
        part, place = _node(tokens, place)
        parts.append(part.parts[0] if part.token == "{" else (part,))
    return Node(token, tuple(parts)), place


@dataclass(frozen=True, slots=True)
class BreakPoint:
    """A place after an operator: ``end`` past it, what the next line begins with, rank 0-3."""

    end: int
    carried: str
    rank: int


def break_points(tex: str) -> list[BreakPoint]:
    r"""Every place where a line may end, in order.

    Only the outermost level of braces and of ``\left … \right`` is looked at; plain round
    brackets count as depth too, but a break inside of them is allowed as a last resort.
    """
    points: list[BreakPoint] = []
    groups = rounds = 0
    previous = ""
    for match in _TOKEN.finditer(tex):
        token = match.group()
        groups += (token in ("{", r"\left")) - (token in ("}", r"\right"))
        rounds += (token in ("(", "[")) - (token in (")", "]"))
        if groups == 0 and previous:
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
