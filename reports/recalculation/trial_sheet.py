"""Formulas tried on other values of the cells that they refer to.

The formulas stand on sheets of their own and refer to a grid in which those cells are
numbers; the numbers are changed and everything is calculated anew, in one loaded book.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from reports.recalculation.evaluate import Evaluator
from reports.recalculation.formulas import Formula, quoted
from reports.recalculation.grid import Area, CellColumn, CellGrid, Constant, Run
from reports.shared.errors import UnknownFormula

_SCRATCH = "\N{GREEK SMALL LETTER PHI}"
_COMPARISONS = frozenset(("op", sign) for sign in ("=", "<>", "<", ">", "<=", ">="))
_FINE = 9  # decimals from which nothing that is printed is lost
_ROUNDINGS = frozenset(("ROUND", "ROUNDUP", "ROUNDDOWN"))
# What people type in for π, for degrees in radians, for revolutions in radians, and in
# M = 9550·N/n, kW and rev/min.
_OF_PI = tuple(np.pi * share for share in (1, 2, 1 / 2, 1 / 4, 1 / 30, 1 / 60, 1 / 180, 1 / 360))
_FULL = (*_OF_PI, 30 / np.pi, 60 / np.pi, 180 / np.pi, 3e4 / np.pi)
_NEAR = 2e-4  # 57,3 and 0,01745 are digits enough, 3,14 is a mistake


@dataclass(frozen=True, slots=True)
class Cells:
    """Cells of one column with what is to stand in them."""

    sheet: str
    column: int
    rows: tuple[int, ...]
    values: tuple[Constant, ...]


def by_column(cells: Iterable[Cells]) -> dict[tuple[str, int], list[Cells]]:
    """Cells by the title of their sheet and the number of their column."""
    columns: dict[tuple[str, int], list[Cells]] = {}
    for part in cells:
        columns.setdefault((part.sheet, part.column), []).append(part)
    return columns


def pinned(grid: CellGrid, cells: Iterable[Cells]) -> CellGrid:
    """Return grid with constants in some cells, whatever stood there; other columns are shared."""
    sheets = {title: dict(columns) for title, columns in grid.sheets.items()}
    copied: set[tuple[str, int]] = set()
    for part in cells:
        columns = sheets[part.sheet]
        if (part.sheet, part.column) not in copied:
            copied.add((part.sheet, part.column))
            columns[part.column] = _copied(columns.get(part.column))
        _pin(columns[part.column], part)
    return CellGrid(sheets, grid.names, grid.areas)


def _copied(column: CellColumn | None) -> CellColumn:
    if column is None:
        return CellColumn()
    return CellColumn(dict(column.constants), dict(column.errors), list(column.runs))


def _pin(column: CellColumn, part: Cells) -> None:
    column.cut(set(part.rows))
    for row in column.errors.keys() & set(part.rows):
        del column.errors[row]
    column.constants.update(zip(part.rows, part.values, strict=True))


@dataclass(frozen=True)
class PinnedGrid:
    """A grid with constants in some cells, column by column as they are asked for.

    Args:
        grid: what stands there otherwise.
        cells: the constants of a column, by the title of its sheet and its number.
        rounded: keep the roundings of the formulas.
    """

    grid: CellGrid
    cells: Callable[[str, int], Sequence[Cells]] = lambda _sheet, _column: ()
    rounded: bool = True
    _columns: dict[tuple[str, int], CellColumn] = field(default_factory=dict)

    def column(self, sheet: str, number: int) -> CellColumn:
        """Return a column with its constants."""
        key = (sheet, number)
        column = self._columns.get(key)
        if column is None:
            column = self.grid.sheets[sheet].get(number)
            if cells := self.cells(sheet, number):
                column = _copied(column)
                for part in cells:
                    _pin(column, part)
            column = column or CellColumn()
            column = self._columns[key] = column if self.rounded else _unrounded_column(column)
        return column

    def runs_of(self, area: Area) -> list[Run]:
        """Return the runs with cells in a rectangle."""
        columns = (self.column(area.sheet, n) for n in self.grid.columns_of(area))
        return [run for c in columns for run in c.runs_in(area.first_row, area.last_row)]

    def needed(self, areas: Iterable[Area]) -> dict[str, dict[int, CellColumn]]:
        """Return columns with some cells, and those that their formulas read in turn, by sheets."""
        return _needed(self.grid, areas, self.column)


def needed(grid: CellGrid, areas: Iterable[Area]) -> CellGrid:
    """Return the columns of a grid with some cells, and those that their formulas read in turn."""
    sheets = _needed(grid, areas, lambda sheet, number: grid.sheets[sheet][number])
    return CellGrid(sheets, grid.names, grid.areas)


def _needed(
    grid: CellGrid, areas: Iterable[Area], column_of: Callable[[str, int], CellColumn]
) -> dict[str, dict[int, CellColumn]]:
    """Columns are taken whole: SUMIF may read beyond the cells that it names."""
    sheets: dict[str, dict[int, CellColumn]] = {title: {} for title in grid.sheets}
    stack = list(areas)
    while stack:
        area = stack.pop()
        for number in grid.columns_of(area):
            if number not in sheets[area.sheet]:
                column = sheets[area.sheet][number] = column_of(area.sheet, number)
                for run in column.runs:
                    stack += grid.precedents(run)
                    stack += [run.array] if run.array is not None else []
    return sheets


class Bench:
    """Some formulas on a grid of constants.

    Args:
        pins: the cells that the formulas refer to.
        formulas: the formulas by a key, as runs of the grid that need not be in it.
        rounded: take the roundings out of the formulas.
    """

    def __init__(
        self, pins: PinnedGrid, formulas: Mapping[str, Sequence[Run]], *, rounded: bool = True
    ) -> None:
        grid = pins.grid
        titles = {title: f"{_SCRATCH}{i}" for i, title in enumerate(grid.sheets)}
        scratch: dict[str, dict[int, CellColumn]] = {title: {} for title in titles.values()}
        self._runs: dict[str, list[Run]] = {}
        copies: dict[int, Run] = {}
        for key, runs in formulas.items():
            self._runs[key] = []
            for run in runs:
                moved = copies.get(id(run))
                if moved is None:
                    for part in _whole_array(pins, run):
                        other = _moved(part, titles[run.sheet], rounded=rounded)
                        copies[id(part)] = other
                        columns = scratch[other.sheet]
                        columns.setdefault(other.column, CellColumn()).runs.append(other)
                    moved = copies[id(run)]
                self._runs[key].append(moved)
        read = pins.needed(area for run in copies.values() for area in grid.precedents(run))
        self._engine = Evaluator(CellGrid({**read, **scratch}, grid.names, grid.areas))
        self.columns = [(title, number) for title, columns in read.items() for number in columns]
        self._read = set(self.columns)

    def put(self, cells: Iterable[Cells]) -> None:
        """Change constants; the next values are those of the changed grid."""
        self._engine.put(part for part in cells if (part.sheet, part.column) in self._read)

    def values(self, key: str, rows: Sequence[int | None]) -> NDArray[np.float64]:
        """Numbers that a key's formulas give in some rows, NaN where there is none.

        Raises:
            UnknownFormula: one of them cannot be calculated for certain.
        """
        numbers = np.full(len(rows), np.nan)
        index = {row: i for i, row in enumerate(rows) if row is not None}
        for run in self._runs[key]:
            part = self._engine.all_of(run)
            for offset, value in enumerate(part):
                at = index.get(run.first + offset)
                if at is not None:
                    numbers[at] = value
        return numbers


def _whole_array(pins: PinnedGrid, run: Run) -> list[Run]:
    """All columns of an array formula; other runs alone."""
    if run.array is None:
        return [run]
    area = run.array
    runs = [other for other in pins.runs_of(area) if other.array == area]
    return runs if any(other is run for other in runs) else [run]


def _moved(run: Run, sheet: str, *, rounded: bool) -> Run:
    area = run.array
    if area is not None:
        area = Area(sheet, area.first_row, area.last_row, area.first_column, area.last_column)
    formula = run.formula
    problem = run.problem
    if formula is not None:
        try:
            formula = _qualified(formula, run.sheet)
            formula = formula if rounded else unrounded(formula)
        except UnknownFormula as error:
            problem = str(error)
    return Run(sheet, run.column, run.first, run.count, formula, run.text, problem, area)


@lru_cache(maxsize=20_000)
def _qualified(formula: Formula, sheet: str) -> Formula:
    """Return a formula whose references all name their sheet."""
    token = ("sheet", quoted(sheet))
    pattern = []
    before = ("", "")
    for each in formula.pattern:
        bare = before[0] != "sheet" and before != ("op", ":")
        if each[0] in ("ref", "columns", "rows") and bare:
            pattern.append(token)
        pattern.append(each)
        before = each
    return Formula(tuple(pattern))


@lru_cache(maxsize=20_000)
def rounds(formula: Formula) -> bool:
    """Whether a formula rounds: by a function, or by a typed π of some digits."""
    return cuts(formula) or any(
        kind == "number" and full(float(value)) != float(value) for kind, value in formula.pattern
    )


@lru_cache(maxsize=20_000)
def cuts(formula: Formula) -> bool:
    """Whether a function of a formula takes digits away that tell something."""
    return any(_cut(formula.pattern, at)[0] for at in range(len(formula.pattern)))


def _cut(tokens: Sequence[tuple[str, str]], at: int) -> tuple[int, int]:
    """Where the rounding at a place closes, and its comma; 0 where it only tidies up A − A.

    What is compared stays rounded: it would pick another case by its last digit.
    """
    if tokens[at][0] != "name" or tokens[at][1].upper() not in _ROUNDINGS:
        return 0, 0
    end, comma = _arguments(tokens, at + 1)
    fine = (_digits(tokens, comma, end) or 0) >= _FINE
    return (0, 0) if not comma or fine or _is_compared(tokens, at, end) else (end, comma)


@lru_cache(maxsize=20_000)
def unrounded(formula: Formula) -> Formula:
    """Return a formula without its ROUND, ROUNDUP and ROUNDDOWN, and with all digits of π."""
    if not rounds(formula):
        return formula
    tokens = [
        (kind, repr(full(float(value))) if kind == "number" else value)
        for kind, value in formula.pattern
    ]
    at = 0
    while at < len(tokens) - 1:
        end, comma = _cut(tokens, at)
        if end:
            tokens[at : end + 1] = [*tokens[at + 1 : comma], ("op", ")")]
        else:
            at += 1
    return Formula(tuple(tokens))


def _unrounded_column(column: CellColumn) -> CellColumn:
    """Return a column whose formulas do not round."""
    runs = [replace(r, formula=unrounded(r.formula)) if r.formula else r for r in column.runs]
    return CellColumn(column.constants, column.errors, runs)


def _is_compared(tokens: Sequence[tuple[str, str]], at: int, end: int) -> bool:
    """Whether what stands from ``at`` to ``end`` is compared: its rounding only picks a case."""
    beside = (*tokens[max(at - 1, 0) : at], *tokens[end + 1 : end + 2])
    return any(token in _COMPARISONS for token in beside)


@lru_cache(maxsize=20_000)  # the issued numbers of a class come again in each book
def full(number: float) -> float:
    """Return a number, or what it is the first digits of: π and its usual multiples."""
    return next((x for x in _FULL if 1e-14 < abs(number / x - 1) < _NEAR), number)


def _arguments(tokens: Sequence[tuple[str, str]], start: int) -> tuple[int, int]:
    """Where the parentheses at ``start`` close, and their first comma; 0 where there is none."""
    depth, comma = 0, 0
    for at in range(start, len(tokens)):
        if tokens[at] in (("op", "("), ("op", "{")):
            depth += 1
        elif tokens[at] in (("op", ")"), ("op", "}")):
            depth -= 1
            if depth == 0:
                return at, comma
        elif tokens[at] == ("op", ",") and depth == 1 and not comma:
            comma = at
    return 0, 0


def rounded_to(formula: Formula) -> int | None:
    """Digits that a whole formula is rounded to, None where it is no rounding."""
    tokens = formula.pattern
    if len(tokens) < 4 or tokens[0][0] != "name" or tokens[0][1].upper() not in _ROUNDINGS:
        return None
    end, comma = _arguments(tokens, 1)
    return _digits(tokens, comma, end) if end == len(tokens) - 1 and comma else None


def _digits(tokens: Sequence[tuple[str, str]], comma: int, end: int) -> int | None:
    """Return the number that stands from a comma to an end."""
    try:
        return int("".join(value for _, value in tokens[comma + 1 : end]))
    except ValueError:
        return None
