r"""TeX of formulas and symbols read once: tokens, tree, places where a line may break.

A node is a token with its arguments: a group ``{…}`` has its contents, ``_`` and ``^`` their
index, ``\dfrac`` two parts; any other token has none.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass

_TOKEN = re.compile(r"\\[A-Za-z]+|\\.|.", re.DOTALL)
FRACTIONS = {r"\frac", r"\dfrac", r"\tfrac"}
_TAKES_ONE = {"_", "^", r"\mathrm", r"\mathbf", r"\mathit", r"\text", r"\overline", r"\bar"}
_TAKES_ONE |= {r"\sqrt", r"\vec", r"\dot", r"\ddot", r"\operatorname", r"\hat", r"\hspace"}
_RELATIONS = {"=", r"\approx", r"\leq", r"\geq", r"\le", r"\ge", "<", ">", r"\equiv", r"\neq"}
_SUMS = {"+", "-", r"\pm", r"\mp"}
_PRODUCTS = {r"\cdot", r"\times"}
_LOOSE = re.compile(r"(\\[A-Za-z]+) (?![A-Za-z])")
_CARRIED = re.compile(r"(?:\\left\.)*\s*\{\}\s*")
# Names of parts that are written apart: числитель, знаменатель, подкоренное выражение.
_NAMES = dict.fromkeys(FRACTIONS, ("Ч", "З")) | {r"\sqrt": ("П",)}

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
    """A place where a line may end.

    Attributes:
        end: Where in the TeX the line ends.
        closing: What the line ends with besides: a sign, invisible closing brackets.
        carried: What the next line begins with.
        rank: How bad the place is, from 0 at a relation.
    """

    end: int
    closing: str
    carried: str
    rank: float


def break_points(tex: str) -> list[BreakPoint]:
    r"""Every place where a line may end, in order.

    Only the outermost level of braces is looked at.  Brackets, plain or of ``\left … \right``,
    count as depth, but a break inside of them is allowed as a last resort; the halves of a
    sized pair are closed and opened again invisibly.
    """
    points: list[BreakPoint] = []
    groups = sized = rounds = 0
    previous = ""
    for match in _TOKEN.finditer(tex):
        token = match.group()
        if groups == 0 and previous:
            place = _place(token, match, previous)
            # Nothing but a carried sign stands before: such a break would repeat for ever.
            if place is not None and not _CARRIED.fullmatch(tex[: match.start()]):
                end, sign, carried, rank = place
                shut, opened = r"\right." * sized, r"\left." * sized
                points.append(
                    BreakPoint(
                        end, sign + shut, opened + carried, rank + 1.2 * sized + (rounds > 0)
                    )
                )
        groups += (token == "{") - (token == "}")
        sized += (token == r"\left") - (token == r"\right")
        rounds += (token in ("(", "[")) - (token in (")", "]"))
        if previous in (r"\left", r"\right"):  # its bracket is no round one
            rounds -= (token in ("(", "[")) - (token in (")", "]"))
        if not token.isspace():
            previous = token
    # Nothing may follow the last operator: a line cannot begin with it alone.
    return [point for point in points if tex[point.end :].strip()]


def _place(token: str, match: re.Match[str], previous: str) -> tuple[int, str, str, float] | None:
    """End of the line, sign at the end, sign at the next line's beginning, rank."""
    if token in _RELATIONS:
        return match.end(), "", f"{{}}{token} ", 0
    unary = previous in _RELATIONS | _SUMS | _PRODUCTS or previous in ("(", "[", "{")
    if token in _SUMS and not unary:
        return match.end(), "", f"{{}}{token} ", 1
    if token in _PRODUCTS:
        return match.end(), "", r"{}\times ", 2
    if token == r"\left" and (previous == "}" or previous.isalnum()):  # a product without a sign
        return match.start(), r"\times ", r"{}\times ", 2
    return None


def written(nodes: Sequence[Node]) -> str:
    """The TeX of some nodes."""
    return _LOOSE.sub(r"\1", "".join(_written(node) for node in nodes))


def _written(node: Node) -> str:
    parts = "".join(f"{{{written(part)}}}" for part in node.parts)
    bare = node.command.isalpha() and not node.parts
    return parts if node.token == "{" else node.token + parts + (" " if bare else "")


def steps(tex: str, widest: Callable[[Sequence[Node]], bool]) -> list[str]:
    """The formula with parts too wide for a line named, then each part by its name.

    Args:
        tex: One line of TeX.
        widest: Whether a numerator, a denominator or a radicand is too wide.

    Returns:
        The formula alone where nothing is too wide.
    """
    named: list[str] = []

    def shortened(node: Node) -> Node:
        names = _NAMES.get(node.token)
        if names is None:
            return Node(node.token, tuple(tuple(map(shortened, part)) for part in node.parts))
        parts = []
        for name, part in zip(names, node.parts, strict=True):
            if not widest(part):
                parts.append(part)
                continue
            count = len(named) + 1
            symbol = rf"\mathrm{{{name}}}" + (f"_{{{count}}}" if count > 1 else "")
            named.append(f"{symbol} = {written(part)}")
            parts.append(tree(symbol))
        return Node(node.token, tuple(parts))

    short = written([shortened(node) for node in tree(tex)])
    return [short, *named]
