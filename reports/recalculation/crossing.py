"""Ranges where one value is wanted: the cell in the formula's own row or column is meant.

So take it LibreOffice, WPS and Excel before 2021; a newer Excel writes it as ``SINGLE``, and what
it spreads over cells as an array formula.
"""

from __future__ import annotations

from reports.recalculation.formulas import formula_of
from reports.recalculation.grid import Grid, Run
from reports.recalculation.language import Ref, Token
from reports.recalculation.ranges import area_of

# Functions that take single values alone; in others a range may mean all of its cells.
_OF_SINGLE_VALUES = """
ABS ACOS ACOSH ASIN ASINH ATAN ATAN2 ATANH COS COSH DEGREES EXP INT LN LOG LOG10 MOD POWER QUOTIENT
RADIANS ROUND ROUNDDOWN ROUNDUP SIGN SIN SINH SQRT TAN TANH TRUNC
"""
_SINGLE_VALUES = frozenset(_OF_SINGLE_VALUES.split())
_SINGLE = ("_XLFN.SINGLE", "SINGLE")
_AREAS = ("ref", "columns", "rows", "name")


def cross(grid: Grid) -> None:
    """Put the one cell that is meant into the formulas of a grid."""
    for run in grid.runs():
        if run.formula is None or run.array is not None or run.problem:
            continue
        if _has_range(run.formula.pattern, grid):
            made = tuple(_crossed(run.formula.pattern, run, grid))
            if made != run.formula.pattern:
                run.formula = formula_of(made)


def _has_range(tokens: tuple[Token, ...], grid: Grid) -> bool:
    return any(
        kind in ("columns", "rows")
        or value == ":"
        or (kind == "name" and (value.casefold() in grid.areas or value.upper() in _SINGLE))
        for kind, value in tokens
    )


def _crossed(tokens: tuple[Token, ...], run: Run, grid: Grid) -> list[Token]:
    made: list[Token] = []
    around: list[str] = []  # functions, the innermost last
    at = 0
    while at < len(tokens):
        kind, value = tokens[at]
        called = kind == "name" and tokens[at + 1 : at + 2] == (("op", "("),)
        if (kind, value) == ("op", "("):
            before = tokens[at - 1] if at else ("", "")
            around.append(before[1].upper() if before[0] == "name" else "")
        elif (kind, value) == ("op", ")") and around:
            around.pop()
        width = 3 if tokens[at + 1 : at + 2] == (("op", ":"),) else 1
        cell = None
        if not called and _takes_one(around) and _stands_alone(tokens, at, width):
            cell = _cell(tokens[at : at + width], run, grid)
        if cell is not None:
            made += cell
            at += width
            continue
        if not (called and value.upper() in _SINGLE):  # its brackets stay
            made.append((kind, value))
        at += 1
    return made


def _takes_one(around: list[str]) -> bool:
    """Whether one value is wanted within these functions."""
    for name in reversed(around):
        if name in _SINGLE:
            return True
        if name and name not in _SINGLE_VALUES:
            return False
    return True


def _stands_alone(tokens: tuple[Token, ...], at: int, width: int) -> bool:
    """Whether a range is no part of a longer one, of an intersection or of a union."""
    before = tokens[at - 1] if at else ("op", "")
    after = tokens[at + width] if at + width < len(tokens) else ("op", "")
    joined = before[0] in _AREAS or after[0] in (*_AREAS, "sheet")
    return not joined and ("op", ":") not in (before, after)


def _cell(tokens: tuple[Token, ...], run: Run, grid: Grid) -> list[Token] | None:
    """The cell of a range that a formula means, None where there is none or it is no range."""
    area = area_of(tokens, grid)
    found = _meant(area.first, area.last, run) if area is not None else ""
    return [*area.sheet, ("ref", found)] if area and found else None


def _meant(first: Ref, last: Ref, run: Run) -> str:
    """The cell of a range in the row or column of a formula, empty where it is not one."""
    left, right = (r.column if r.column_fixed else run.column + r.column for r in (first, last))
    rows = [
        [r.row if r.row_fixed else row + r.row for r in (first, last)]
        for row in (run.first, run.last)
    ]
    inside = all(a <= row <= b for (a, b), row in zip(rows, (run.first, run.last), strict=True))
    if left == right and inside:
        return "R[0]" + (f"C{left}" if first.column_fixed else f"C[{first.column}]")
    if all(a == b for a, b in rows) and left <= run.column <= right:
        return (f"R{first.row}" if first.row_fixed else f"R[{first.row}]") + "C[0]"
    return ""
