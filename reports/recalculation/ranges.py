"""Ranges and the cells that a formula means by them."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple

from reports.recalculation.formulas import (
    MAX_COLUMN,
    MAX_ROW,
    Ref,
    Token,
    column_number,
    formula_of,
    quoted,
    ref_of,
    unquoted,
)
from reports.recalculation.grid import CellGrid, Run

# Functions that take single values alone; in others a range may mean all of its cells.
_OF_SINGLE_VALUES = """
ABS ACOS ACOSH ASIN ASINH ATAN ATAN2 ATANH COS COSH DEGREES EXP INT LN LOG LOG10 MOD POWER QUOTIENT
RADIANS ROUND ROUNDDOWN ROUNDUP SIGN SIN SINH SQRT TAN TANH TRUNC
"""
_SINGLE_VALUES = frozenset(_OF_SINGLE_VALUES.split())
_SINGLE = ("_XLFN.SINGLE", "SINGLE")
_AREAS = ("ref", "columns", "rows", "name")
_OPEN, _COMMA, _CLOSE, _TO = (("op", sign) for sign in "(,):")
_WHOLE = re.compile(r"[1-9][0-9]{0,6}")


class RangeCorners(NamedTuple):
    """The corners of a range and the sheet, which a name tells."""

    first: Ref
    last: Ref
    sheet: tuple[Token, ...] = ()


def area_of(tokens: Sequence[Token], grid: CellGrid) -> RangeCorners | None:
    """Return the range that some tokens without a sheet are, None where they are none."""
    kinds = [kind for kind, _ in tokens]
    value = tokens[0][1] if tokens else ""
    if kinds == ["ref", "op", "ref"] and tokens[1][1] == ":":
        return RangeCorners(ref_of(value), ref_of(tokens[2][1]))
    if kinds == ["columns"]:
        left, right = sorted(map(column_number, value.replace("$", "").split(":")))
        return RangeCorners(Ref(1, left), Ref(MAX_ROW, right))
    if kinds == ["rows"]:
        top, bottom = sorted(map(int, value.replace("$", "").split(":")))
        return RangeCorners(Ref(top, 1), Ref(bottom, MAX_COLUMN))
    area = grid.areas.get(value.casefold()) if kinds == ["name"] else None
    if area is None:
        return None
    corners = Ref(area.first_row, area.first_column), Ref(area.last_row, area.last_column)
    return RangeCorners(*corners, (("sheet", quoted(area.sheet)),))


def cross(grid: CellGrid) -> None:
    """Put the one cell that is meant into the formulas of a grid."""
    for run in grid.runs():
        if run.formula is None or run.array is not None or run.problem:
            continue
        if _has_range(run.formula.pattern, grid):
            pattern = tuple(_crossed(run.formula.pattern, run, grid))
            if pattern != run.formula.pattern:
                run.formula = formula_of(pattern)


def _has_range(tokens: tuple[Token, ...], grid: CellGrid) -> bool:
    return any(
        kind in ("columns", "rows")
        or value == ":"
        or (kind == "name" and (value.casefold() in grid.areas or value.upper() in _SINGLE))
        for kind, value in tokens
    )


def _crossed(tokens: tuple[Token, ...], run: Run, grid: CellGrid) -> list[Token]:
    pattern: list[Token] = []
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
            cell = _crossing_cell(tokens[at : at + width], run, grid)
        if cell is not None:
            pattern += cell
            at += width
            continue
        if not (called and value.upper() in _SINGLE):  # its brackets stay
            pattern.append((kind, value))
        at += 1
    return pattern


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


def _crossing_cell(tokens: tuple[Token, ...], run: Run, grid: CellGrid) -> list[Token] | None:
    """Return cell of a range that a formula means, None where there is none or it is no range."""
    area = area_of(tokens, grid)
    address = _meant(area.first, area.last, run) if area is not None else ""
    return [*area.sheet, ("ref", address)] if area and address else None


def _meant(first: Ref, last: Ref, run: Run) -> str:
    """Return the cell of a range in the row or column of a formula, empty where it is not one."""
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


def pick(grid: CellGrid) -> None:
    """Put the cells that are meant into the formulas of a grid."""
    for run in grid.runs():
        if run.formula is None or run.problem:
            continue
        pattern = run.formula.pattern
        if "ANCHORARRAY" in run.formula.functions:
            pattern = tuple(_spilled(pattern, run, grid))
        if "INDEX" in run.formula.functions:
            pattern = tuple(_picked(pattern, grid))
        if pattern != run.formula.pattern:
            run.formula = formula_of(pattern)


def _spilled(tokens: tuple[Token, ...], run: Run, grid: CellGrid) -> list[Token]:
    """Tokens with the extents of array formulas for ``ANCHORARRAY`` of their first cells."""
    pattern: list[Token] = []
    at = 0
    while at < len(tokens):
        end = tokens.index(_CLOSE, at) if _CLOSE in tokens[at:] else at
        extent: list[Token] = []
        if tokens[at][1].upper().endswith("ANCHORARRAY") and tokens[at + 1 : at + 2] == (_OPEN,):
            extent = _extent(tokens[at + 2 : end], run, grid)
        pattern += extent or [tokens[at]]
        at = end + 1 if extent else at + 1
    return pattern


def _extent(tokens: tuple[Token, ...], run: Run, grid: CellGrid) -> list[Token]:
    """Return cells of the array formula in a cell; nothing where each row has another, or none."""
    sheet = [token for token in tokens[:1] if token[0] == "sheet"]
    if [kind for kind, _ in tokens[len(sheet) :]] != ["ref"]:
        return []
    ref = ref_of(tokens[-1][1])
    if run.first != run.last and run.array is None and not ref.row_fixed:
        return []
    row = ref.row if ref.row_fixed else run.first + ref.row
    column = ref.column if ref.column_fixed else run.column + ref.column
    title = grid.title(unquoted(sheet[0][1])) if sheet else run.sheet
    for other in grid.column(title or "", column).runs_in(row, row):
        area = other.array
        if area is not None and (area.first_row, area.first_column) == (row, column):
            ends = ("ref", f"R{row}C{column}"), ("ref", f"R{area.last_row}C{area.last_column}")
            return [*sheet, ends[0], _TO, ends[1]]
    return []


def _picked(tokens: tuple[Token, ...], grid: CellGrid) -> list[Token]:
    pattern: list[Token] = []
    at = 0
    while at < len(tokens):
        cell: list[Token] = []
        if tokens[at][1].upper() == "INDEX" and tokens[at + 1 : at + 2] == (_OPEN,):
            end = tokens.index(_CLOSE, at) if _CLOSE in tokens[at:] else at
            cell = _indexed(tokens[at + 2 : end], grid)
            of_range = _TO in (*tokens[at - 1 : at], *tokens[end + 1 : end + 2])
            cell = [] if of_range and len(cell) > 1 else cell  # with a sheet it ends no range
        if cell:
            pattern += cell
            at = end + 1
        else:
            pattern.append(tokens[at])
            at += 1
    return pattern


def _indexed(tokens: tuple[Token, ...], grid: CellGrid) -> list[Token]:
    """Return the cell that these arguments of INDEX name; nothing where it takes reckoning."""
    sheet = [token for token in tokens[:1] if token[0] == "sheet"]
    tail = tokens[len(sheet) :]
    if _COMMA not in tail:
        return []
    at = tail.index(_COMMA)
    area, indices = tail[:at], tail[at:]
    numbers = [value for _, value in indices[1::2]]
    if set(indices[::2]) != {_COMMA} or not all(map(_WHOLE.fullmatch, numbers)):
        return []
    named = area_of(area, grid)
    if named is None or (sheet and named.sheet):
        return []
    address = _cell_of_range(named.first, named.last, [int(number) for number in numbers])
    return [*sheet, *named.sheet, ("ref", address)] if address else []


def _cell_of_range(first: Ref, last: Ref, numbers: list[int]) -> str:
    """Return a cell of a range, empty where these numbers name none."""
    if (first.row_fixed, first.column_fixed) != (last.row_fixed, last.column_fixed):
        return ""
    height, width = last.row - first.row + 1, last.column - first.column + 1
    if len(numbers) == 1:
        numbers = [1, *numbers] if height == 1 else [*numbers, 1] if width == 1 else []
    if len(numbers) != 2 or numbers[0] > height or numbers[1] > width:
        return ""
    row, column = first.row + numbers[0] - 1, first.column + numbers[1] - 1
    return (f"R{row}" if first.row_fixed else f"R[{row}]") + (
        f"C{column}" if first.column_fixed else f"C[{column}]"
    )
