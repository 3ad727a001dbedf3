"""Defined names that stand for a formula, ``k = PI()/180``, put into the formulas that use them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress

from lxml import etree

from reports.recalculation.formulas import formula_of
from reports.recalculation.grid import Grid
from reports.recalculation.language import Token, UnknownFormula, pattern, ref_of, unquoted

_MOST = 60  # tokens of a name: nobody calls more than that by one word

Meanings = Mapping[str, tuple[Token, ...]]
Local = Mapping[str, Meanings]  # of a sheet by its title


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


def local_names(grid: Grid, root: etree._Element) -> Local:
    """Names that a sheet has of its own: there they hide those of the book.

    What stands for something else in every cell, or names a name, is a name that nobody knows.
    """
    titles = [str(sheet.get("name")) for sheet in root.iter("{*}sheet")]
    found: dict[str, dict[str, tuple[Token, ...]]] = {}
    for name in root.iter("{*}definedName"):
        sheet = str(name.get("localSheetId") or "")
        if not (sheet.isdecimal() and int(sheet) < len(titles)):
            continue
        title, own = titles[int(sheet)], str(name.get("name")).casefold()
        tokens: tuple[Token, ...] = ()
        with suppress(UnknownFormula):
            tokens = pattern(str(name.text or "").strip(), 1, 1)
        fixed = 0 < len(tokens) <= _MOST and _is_fixed(tokens, grid) and not _names(tokens)
        found.setdefault(title, {})[own] = tokens if fixed else _unknown(title, own)
    return found


def _unknown(title: str, name: str) -> tuple[Token, ...]:
    return (("name", f"{title}!{name}"),)


def put_local(grid: Grid, local: Local) -> None:
    """The formulas of a grid with the names of single sheets replaced by what they stand for."""
    folded = {title.casefold(): known for title, known in local.items()}
    nobody = {title.casefold(): {name: _unknown(title, name) for name in known}
              for title, known in local.items()}  # fmt: skip
    for run in grid.runs():
        if run.formula is None:
            continue
        made = _localized(run.formula.pattern, run.sheet, folded)
        if made != run.formula.pattern:
            refers = any(formula_of(made).references)
            made = made if refers else _localized(run.formula.pattern, run.sheet, nobody)
            run.formula = formula_of(made)


def _localized(tokens: tuple[Token, ...], sheet: str, local: Local) -> tuple[Token, ...]:
    made: list[Token] = []
    for token, after in zip(tokens, (*tokens[1:], ("", "")), strict=True):
        before = made[-1] if made else ("", "")
        where = unquoted(before[1]) if before[0] == "sheet" else sheet
        known = local.get(where.casefold(), {})
        inner = known.get(token[1].casefold()) if token[0] == "name" else None
        if inner is None or after == ("op", "("):
            made.append(token)
            continue
        if before[0] == "sheet":
            made.pop()
        cells = all(kind in ("sheet", "ref", "name") or value == ":" for kind, value in inner)
        made += inner if cells else [("op", "("), *inner, ("op", ")")]
    return tuple(made)


def put_in(grid: Grid, known: Meanings, local: Local) -> None:
    """The formulas of a grid with names replaced by what they stand for.

    A formula that then refers to no cell is left: a number by a name is for a person to see.
    """
    for run in grid.runs():
        hidden = local.get(run.sheet, {}).keys()
        here = {name: inner for name, inner in known.items() if hidden.isdisjoint(_names(inner))}
        if run.formula is not None and not here.keys().isdisjoint(_names(run.formula.pattern)):
            made = formula_of(_replaced(run.formula.pattern, here))
            if any(made.references):
                run.formula = made


def _names(tokens: tuple[Token, ...]) -> set[str]:
    return {value.casefold() for at, (kind, value) in enumerate(tokens)
            if kind == "name" and not _is_called(tokens, at)}  # fmt: skip


def _is_called(tokens: Sequence[Token], at: int) -> bool:
    return tuple(tokens[at + 1 : at + 2]) == (("op", "("),)


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
