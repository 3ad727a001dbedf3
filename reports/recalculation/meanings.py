"""Defined names that stand for a formula, ``k = PI()/180``, put into the formulas that use them."""

from __future__ import annotations

from collections.abc import Mapping

from lxml import etree

from reports.recalculation.formulas import Formula, formula_of
from reports.recalculation.grid import Grid
from reports.recalculation.language import Token, UnknownFormula, pattern, ref_of

_MOST = 60  # tokens of a name: nobody calls more than that by one word

Meanings = Mapping[str, tuple[Token, ...]]


def meanings(grid: Grid, root: etree._Element) -> Meanings:
    """Names of the whole book that stand for a formula of constants and fixed cells."""
    found: dict[str, tuple[Token, ...]] = {}
    for name in root.iter("{*}definedName"):
        folded = str(name.get("name")).casefold()
        if name.get("localSheetId") is not None or grid.named(folded) is not None:
            continue
        try:
            tokens = pattern(str(name.text or "").strip(), 1, 1)
        except UnknownFormula:
            continue
        if 0 < len(tokens) <= _MOST and _is_fixed(tokens, grid):
            found[folded] = tokens
    return found


def _is_fixed(tokens: tuple[Token, ...], grid: Grid) -> bool:
    """Whether a name means the same in every cell, and names no other such name."""
    for before, (kind, value), after in zip(
        (("", ""), *tokens), tokens, (*tokens[1:], ("", "")), strict=False
    ):
        if kind == "ref":
            ref = ref_of(value)
            alone = before[0] != "sheet" and before != ("op", ":")
            if alone or not (ref.row_fixed and ref.column_fixed):
                return False
        elif kind in ("columns", "rows", "error"):
            return False
        elif kind == "name" and after != ("op", "("):
            plain = value.upper() in ("TRUE", "FALSE") or grid.named(value.casefold()) is not None
            if not plain or before[0] == "sheet":
                return False
    return True


def put_in(grid: Grid, known: Meanings) -> None:
    """The formulas of a grid with names replaced by what they stand for.

    A formula that then refers to no cell is left: a number by a name is for a person to see.
    """
    for run in grid.runs():
        if run.formula is not None and not known.keys().isdisjoint(_names(run.formula)):
            made = formula_of(_replaced(run.formula.pattern, known))
            if any(made.references):
                run.formula = made


def _names(formula: Formula) -> set[str]:
    return {value.casefold() for kind, value in formula.pattern if kind == "name"}


def _replaced(tokens: tuple[Token, ...], known: Meanings) -> tuple[Token, ...]:
    made: list[Token] = []
    for before, token, after in zip(
        (("", ""), *tokens), tokens, (*tokens[1:], ("", "")), strict=False
    ):
        inner = known.get(token[1].casefold()) if token[0] == "name" else None
        if inner is None or after == ("op", "(") or before[0] == "sheet":
            made.append(token)
        else:
            made += [("op", "("), *inner, ("op", ")")]
    return tuple(made)
