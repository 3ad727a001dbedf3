r"""Our TeX in the words of matplotlib's mathtext.

mathtext knows no ``\tg``, sets no space around fractions and before function names, and
puts one after a full stop even inside of an index (``ш.ш``).  All of that is mended here,
so that the formulas can be written as a textbook's author would.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from reports.document.text.tex import FRACTIONS, GREEK, Node, tree

_OPERATORS = {"tg", "ctg", "arctg", "sh", "ch", "sign"}  # unknown to mathtext
_FUNCTIONS = _OPERATORS | {"sin", "cos", "tan", "arcsin", "arccos", "arctan", "ln", "lg", "exp"}
_RENAMED = {r"\le": r"\leq", r"\ge": r"\geq", r"\text": r"\mathrm", r"\ne": r"\neq"}
_RENAMED |= {r"\bar": r"\overline"}  # the accent of mathtext breaks beside a prime
_RENAMED |= {rf"\{name}": rf"\operatorname{{{name}}}" for name in _OPERATORS}
_RENAMED |= {".": r".\hspace{-0.2}"}
_BIG = {r"\sum", r"\int", r"\prod", r"\oint"}
_DEGREE = re.compile(r"\^(?:\{\\circ\}|\\circ(?![A-Za-z]))")
_PRIMES = re.compile("'+")


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


def _words(nodes: Sequence[Node]) -> str:
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


def _word(node: Node) -> str:
    parts = "".join(f"{{{_words(part)}}}" for part in node.parts)
    return parts if node.token == "{" else _RENAMED.get(node.token, node.token) + parts


def _wants_room(node: Node) -> bool:
    return node.token in FRACTIONS or node.token in _BIG or node.command in _FUNCTIONS


def _closes(node: Node) -> bool:
    """Whether the node ends something that takes room: a letter, a group, a bracket."""
    return (
        node.token.isalnum()
        or node.token in ("{", ")", "]", "°")
        or node.takes_one
        or node.command in GREEK
    )


def _opens(node: Node) -> bool:
    """Whether the node begins something that takes room."""
    return (
        node.token.isalnum()
        or node.token in ("{", "(", "[", r"\left")
        or _wants_room(node)
        or (node.takes_one and node.token not in ("_", "^"))
        or node.command in GREEK
    )
