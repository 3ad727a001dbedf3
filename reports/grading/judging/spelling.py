"""Mistakes that the text of a formula tells better than its numbers."""

from __future__ import annotations

from functools import lru_cache

from reports.recalculation.formulas import Formula, Token

_MINUS, _POWER, _OPEN, _CLOSE = ("op", "-"), ("op", "^"), ("op", "("), ("op", ")")
_COSINE = ("name", "COS")
_CHOICES = frozenset(("IF", "IFERROR", "IFNA", "IFS", "SWITCH", "CHOOSE"))


@lru_cache(maxsize=20_000)
def squares_a_minus(formula: Formula) -> bool:
    """Whether a unary minus precedes a power: a spreadsheet raises the minus too."""
    tokens = _tokens(formula)
    return any(
        _begins(tokens, at) and _is_raised(tokens, at + 1)
        for at, token in enumerate(tokens)
        if token == _MINUS
    )


@lru_cache(maxsize=20_000)
def squares_a_cosine(formula: Formula) -> bool:
    """Whether a cosine is raised to a power."""
    tokens = _tokens(formula)
    cosines = (at for at, (kind, text) in enumerate(tokens) if (kind, text.upper()) == _COSINE)
    return any(_is_raised(tokens, at) for at in cosines)


def chooses_a_number(formula: Formula) -> bool:
    """Whether a choice between cases only formats a number."""
    return not formula.functions.isdisjoint(_CHOICES)


def _tokens(formula: Formula) -> list[Token]:
    return [token for token in formula.pattern if token[0] not in ("space", "sheet")]


def _begins(tokens: list[Token], at: int) -> bool:
    """Whether a minus is unary."""
    kind, text = tokens[at - 1] if at else _OPEN
    return kind == "op" and text not in (")", "%", "}")


def _is_raised(tokens: list[Token], at: int) -> bool:
    """Whether the operand at an index is raised to a power."""
    if at < len(tokens) - 1 and tokens[at][0] == "name" and tokens[at + 1] == _OPEN:
        at += 1  # a function
    depth = 0
    for end in range(at, len(tokens)):
        depth += (tokens[end] == _OPEN) - (tokens[end] == _CLOSE)
        if depth <= 0:
            return end + 1 < len(tokens) and tokens[end + 1] == _POWER
    return False
