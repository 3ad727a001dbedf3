r"""TeX of formulas and symbols read once: tokens, tree, places where a line may break.

A node is a token with its arguments: a group ``{…}`` has its contents, ``_`` and ``^`` their
index, ``\dfrac`` two parts; any other token has none.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

from reports.shared.errors import TexError

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

_CASES = re.compile(r"(.*?)\\begin\{cases\}(.*)\\end\{cases\}", re.DOTALL)
_OPERATORS = {"tg", "ctg", "arctg", "sh", "ch", "sign"}  # unknown to mathtext
_FUNCTIONS = _OPERATORS | {"sin", "cos", "tan", "arcsin", "arccos", "arctan", "ln", "lg", "exp"}
_RENAMED = {r"\le": r"\leq", r"\ge": r"\geq", r"\text": r"\mathrm", r"\ne": r"\neq"}
_BIG = {r"\sum", r"\int", r"\prod", r"\oint"}
_DEGREE = re.compile(r"\^(?:\{\\circ\}|\\circ(?![A-Za-z]))")
_PRIMES = re.compile("'+")


@dataclass(frozen=True, slots=True)
class TexNode:
    """A token with its arguments."""

    token: str
    parts: tuple[tuple[TexNode, ...], ...] = ()

    @property
    def command(self) -> str:
        """Name of a command, empty for anything else."""
        return self.token[1:] if self.token[0] == "\\" else ""

    @property
    def takes_one(self) -> bool:
        """Whether the token is one that has one argument."""
        return self.token in _TAKES_ONE


def tree(tex: str) -> tuple[TexNode, ...]:
    """Read a formula.

    Raises:
        TexError: braces do not pair up, or an argument is missing.
    """
    tokens = _TOKEN.findall(tex)
    nodes, end = _sequence(tokens, 0)
    if end < len(tokens):
        msg = f"Лишняя скобка в формуле {tex!r}"
        raise TexError(msg)
    return nodes


def _sequence(tokens: Sequence[str], start: int) -> tuple[tuple[TexNode, ...], int]:
    """Nodes up to the closing brace or the end, and the place there."""
    nodes = []
    while start < len(tokens) and tokens[start] != "}":
        node, start = _node(tokens, start)
        nodes.append(node)
    return tuple(nodes), start


def _node(tokens: Sequence[str], start: int) -> tuple[TexNode, int]:
    token = tokens[start]
    start += 1
    if token == "{":
        inner, start = _sequence(tokens, start)
        if start == len(tokens):
            msg = "Не закрыта фигурная скобка в формуле"
            raise TexError(msg)
        return TexNode(token, (inner,)), start + 1
    parts = []
    for _ in range(2 if token in FRACTIONS else 1 if token in _TAKES_ONE else 0):
        while start < len(tokens) and tokens[start].isspace():
            start += 1
        if start == len(tokens) or tokens[start] == "}":
            msg = f"Формула обрывается после {token}"
            raise TexError(msg)
        part, start = _node(tokens, start)
        parts.append(part.parts[0] if part.token == "{" else (part,))
    return TexNode(token, tuple(parts)), start


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
            line_end = _place(token, match, previous)
            # Nothing but a carried sign stands before: such a break would repeat for ever.
            if line_end is not None and not _CARRIED.fullmatch(tex[: match.start()]):
                end, sign, carried, rank = line_end
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


def written(nodes: Sequence[TexNode]) -> str:
    """Return the TeX of some nodes."""
    return _LOOSE.sub(r"\1", "".join(_written(node) for node in nodes))


def _written(node: TexNode) -> str:
    parts = "".join(f"{{{written(part)}}}" for part in node.parts)
    bare = node.command.isalpha() and not node.parts
    return parts if node.token == "{" else node.token + parts + (" " if bare else "")


def steps(tex: str, widest: Callable[[Sequence[TexNode]], bool]) -> list[str]:
    """Return the formula with parts too wide for a line named, then each part by its name.

    Args:
        tex: One line of TeX.
        widest: Whether a numerator, a denominator or a radicand is too wide.

    Returns:
        The formula alone where nothing is too wide.
    """
    named: list[str] = []

    def shortened(node: TexNode) -> TexNode:
        names = _NAMES.get(node.token)
        if names is None:
            return TexNode(node.token, tuple(tuple(map(shortened, part)) for part in node.parts))
        parts = []
        for name, part in zip(names, node.parts, strict=True):
            if not widest(part):
                parts.append(part)
                continue
            count = len(named) + 1
            symbol = rf"\mathrm{{{name}}}" + (f"_{{{count}}}" if count > 1 else "")
            named.append(f"{symbol} = {written(part)}")
            parts.append(tree(symbol))
        return TexNode(node.token, tuple(parts))

    short = written([shortened(node) for node in tree(tex)])
    return [short, *named]


def cases(lead: str, branches: Iterable[tuple[str, str]]) -> str:
    """TeX of a value from its branches, each a formula and the condition of it."""
    body = r" \\ ".join(rf"{formula}, & {condition}" for formula, condition in branches)
    return rf"{lead} \begin{{cases}} {body} \end{{cases}}"


def is_cases(tex: str) -> bool:
    """Return a formula that is a value given by branches."""
    return _CASES.fullmatch(tex) is not None


def case_parts(tex: str) -> tuple[str, list[list[str]]]:
    """Text before the brace and the cells of each branch."""
    match = _CASES.fullmatch(tex)
    if match is None:
        msg = f"no branches in {tex!r}"
        raise ValueError(msg)
    rows = match[2].split(r"\\")
    return match[1].strip(), [[cell.strip() for cell in row.split("&")] for row in rows]


def case_lines(tex: str) -> str:
    """Return the same as lines of their own, without a brace."""
    lead, rows = case_parts(tex)
    return r" \\ ".join(rf"{lead} " + r"\quad ".join(row) for row in rows)


_RENAMED |= {r"\bar": r"\overline"}  # the accent of mathtext breaks beside a prime
_RENAMED |= {rf"\{name}": rf"\operatorname{{{name}}}" for name in _OPERATORS}
_RENAMED |= {".": r".\hspace{-0.2}"}


def for_mathtext(tex: str, *, level_primes: bool = False) -> str:
    """Translate one formula; spaces it out as TeX would.

    Args:
        tex: The formula without dollar signs.
        level_primes: Set primes as letters, for figures: mathtext raises them too high and
            only :mod:`mathsvg` can bring them down again.

    Raises:
        TexError: The TeX is not well formed.
    """
    # mathtext would set an index beside a prime, not below it.
    prime, around = (r"{\prime}", "{}") if level_primes else (r"\prime", "^{{{}}}")
    tex = _PRIMES.sub(lambda match: around.format(prime * len(match.group())), tex)
    return _words(tree(_DEGREE.sub("°", tex)))


def _words(nodes: Sequence[TexNode]) -> str:
    out: list[str] = []
    closed = False  # something that takes room stands before
    pending = False  # a fraction or a big operator does: a thin space if more follows
    for node in nodes:
        if (pending and _opens(node)) or (closed and _wants_room(node)):
            out.append(r"\,")
        if out and out[-1][0] == "\\" and out[-1][-1].isalpha() and node.token.isalpha():
            out.append(" ")
        out.append(_word(node))
        if (
            node.token not in ("_", "^") and not node.token.isspace()
        ):  # an index belongs to its letter
            pending = node.token in FRACTIONS or node.token in _BIG
            closed = _closes(node)
    return "".join(out)


def _word(node: TexNode) -> str:
    parts = "".join(f"{{{_words(part)}}}" for part in node.parts)
    return parts if node.token == "{" else _RENAMED.get(node.token, node.token) + parts


def _wants_room(node: TexNode) -> bool:
    return node.token in FRACTIONS or node.token in _BIG or node.command in _FUNCTIONS


def _closes(node: TexNode) -> bool:
    """Whether the node ends something that takes room: a letter, a group, a bracket."""
    return (
        node.token.isalnum()
        or node.token in ("{", ")", "]", "°")
        or node.takes_one
        or node.command in GREEK
    )


def _opens(node: TexNode) -> bool:
    """Whether the node begins something that takes room."""
    return (
        node.token.isalnum()
        or node.token in ("{", "(", "[", r"\left")
        or _wants_room(node)
        or (node.takes_one and node.token not in ("_", "^"))
        or node.command in GREEK
    )
