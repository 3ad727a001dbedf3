"""Cells that a formula means and does not name as such.

``INDEX`` of a range at a place that is written out, ``INDEX(B:B,17)``, means one cell: as a look-up
it refers to all of the range, and a book that keeps everything in one column would refer to itself
throughout.  ``B6#`` means all cells of the array formula in ``B6``.
"""

from __future__ import annotations

import re

from reports.recalculation.formulas import formula_of
from reports.recalculation.grid import Grid, Run
from reports.recalculation.language import Ref, Token, ref_of, unquoted
from reports.recalculation.ranges import area_of

_OPEN, _COMMA, _CLOSE, _TO = (("op", sign) for sign in "(,):")
_WHOLE = re.compile(r"[1-9][0-9]{0,6}")


def pick(grid: Grid) -> None:
    """Put the cells that are meant into the formulas of a grid."""
    for run in grid.runs():
        if run.formula is None or run.problem:
            continue
        made = run.formula.pattern
        if "ANCHORARRAY" in run.formula.functions:
            made = tuple(_spilled(made, run, grid))
        if "INDEX" in run.formula.functions:
            made = tuple(_picked(made, grid))
        if made != run.formula.pattern:
            run.formula = formula_of(made)


def _spilled(tokens: tuple[Token, ...], run: Run, grid: Grid) -> list[Token]:
    """Tokens with the extents of array formulas for ``ANCHORARRAY`` of their first cells."""
    made: list[Token] = []
    at = 0
    while at < len(tokens):
        end = tokens.index(_CLOSE, at) if _CLOSE in tokens[at:] else at
        extent: list[Token] = []
        if tokens[at][1].upper().endswith("ANCHORARRAY") and tokens[at + 1 : at + 2] == (_OPEN,):
            extent = _extent(tokens[at + 2 : end], run, grid)
        made += extent or [tokens[at]]
        at = end + 1 if extent else at + 1
    return made


def _extent(tokens: tuple[Token, ...], run: Run, grid: Grid) -> list[Token]:
    """The cells of the array formula in a cell; nothing where each row has another, or none."""
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


def _picked(tokens: tuple[Token, ...], grid: Grid) -> list[Token]:
    made: list[Token] = []
    at = 0
    while at < len(tokens):
        cell: list[Token] = []
        if tokens[at][1].upper() == "INDEX" and tokens[at + 1 : at + 2] == (_OPEN,):
            end = tokens.index(_CLOSE, at) if _CLOSE in tokens[at:] else at
            cell = _cell(tokens[at + 2 : end], grid)
            of_range = _TO in (*tokens[at - 1 : at], *tokens[end + 1 : end + 2])
            cell = [] if of_range and len(cell) > 1 else cell  # with a sheet it ends no range
        if cell:
            made += cell
            at = end + 1
        else:
            made.append(tokens[at])
            at += 1
    return made


def _cell(tokens: tuple[Token, ...], grid: Grid) -> list[Token]:
    """The cell that these arguments of INDEX name; nothing where it takes reckoning."""
    sheet = [token for token in tokens[:1] if token[0] == "sheet"]
    rest = tokens[len(sheet) :]
    if _COMMA not in rest:
        return []
    at = rest.index(_COMMA)
    area, places = rest[:at], rest[at:]
    numbers = [value for _, value in places[1::2]]
    if set(places[::2]) != {_COMMA} or not all(map(_WHOLE.fullmatch, numbers)):
        return []
    named = area_of(area, grid)
    if named is None or (sheet and named.sheet):
        return []
    found = _at(named.first, named.last, [int(number) for number in numbers])
    return [*sheet, *named.sheet, ("ref", found)] if found else []


def _at(first: Ref, last: Ref, numbers: list[int]) -> str:
    """A cell of a range, empty where these numbers name none."""
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
