"""Cells of a workbook by columns: constants, runs of formulas, saved values."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import accumulate

import numpy as np
from numpy.typing import NDArray

from reports.recalculation.formulas import Formula, Reference

MAX_ROW, MAX_COLUMN, MAX_CELLS, MAX_SHEETS = 20_000, 1_000, 400_000, 200

Constant = float | str | bool
_FEW = 8  # runs of a column that are looked through faster than they are put in order


@dataclass(frozen=True, slots=True)
class Area:
    """A rectangle of cells."""

    sheet: str
    first_row: int
    last_row: int
    first_column: int
    last_column: int


@dataclass(slots=True, eq=False)
class Run:
    """Cells of one column below each other with the same formula.

    ``array`` is the extent of an array formula, of which the run is one column.
    """

    sheet: str
    column: int
    first: int
    count: int
    formula: Formula | None  # None: a formula that cannot be read
    text: str
    problem: str = ""
    array: Area | None = None

    @property
    def last(self) -> int:
        """Last row."""
        return self.first + self.count - 1

    def part(self, first: int, count: int) -> Run:
        """Return the same formula in other rows of the column."""
        problem = self.problem or ("часть формулы массива" if self.array else "")
        return Run(self.sheet, self.column, first, count, self.formula, self.text, problem)


@dataclass(frozen=True, slots=True)
class _Order:
    """Runs of a column by their first rows, with the last row reached up to each of them."""

    of: list[Run]
    size: int
    runs: list[Run]
    firsts: list[int]
    reached: list[int]

    @classmethod
    def put(cls, of: list[Run]) -> _Order:
        """Put runs in order; formulas of arrays may lie over others."""
        runs = sorted(of, key=lambda run: run.first)
        reached = list(accumulate((run.last for run in runs), max))
        return cls(of, len(of), runs, [run.first for run in runs], reached)

    def between(self, first: int, last: int) -> list[Run]:
        """Return the only ones that can have cells in some rows."""
        return self.runs[bisect_left(self.reached, first) : bisect_right(self.firsts, last)]


@dataclass(slots=True)
class CellColumn:
    """One column of a sheet: typed-in values, runs of formulas, claims of their values."""

    constants: dict[int, Constant] = field(default_factory=dict)
    errors: dict[int, str] = field(default_factory=dict)  # typed-in error values
    runs: list[Run] = field(default_factory=list)
    saved_rows: list[int] = field(default_factory=list)  # of cells with formulas
    saved: list[float] = field(default_factory=list)  # NaN where no number is saved
    _order: _Order | None = field(default=None, repr=False, compare=False)

    def saved_of(self, run: Run) -> NDArray[np.float64]:
        """Numbers saved for the cells of a run; NaN where nothing or something else was saved."""
        rows = np.array(self.saved_rows, dtype=np.intp)
        saved = np.full(run.count, np.nan)
        inside = (rows >= run.first) & (rows <= run.last)
        saved[rows[inside] - run.first] = np.array(self.saved)[inside]
        return saved

    def runs_in(self, first: int, last: int) -> list[Run]:
        """Return the runs with cells in some rows."""
        runs = self.runs
        if len(runs) > _FEW:
            order = self._order
            if order is None or order.of is not runs or order.size != len(runs):
                order = self._order = _Order.put(runs)
            runs = order.between(first, last)
        return [run for run in runs if run.first <= last and first <= run.last]

    def cut(self, rows: set[int]) -> None:
        """Take the formulas out of some rows."""
        if self.runs:
            self.runs = [part for run in self.runs for part in _without(run, rows)]


@dataclass(slots=True)
class CellGrid:
    """A workbook: sheets by title, columns by number; defined names, folded by case."""

    sheets: dict[str, dict[int, CellColumn]] = field(default_factory=dict)
    names: dict[str, tuple[str, int, int]] = field(default_factory=dict)  # of single cells
    areas: dict[str, Area] = field(default_factory=dict)  # names of more than one cell
    cells: int = 0

    def column(self, sheet: str, number: int) -> CellColumn:
        """Return a column, empty where there is none."""
        return self.sheets.get(sheet, {}).get(number) or CellColumn()

    def constant(self, sheet: str, row: int, column: int) -> Constant | None:
        """Typed-in value of a cell."""
        return self.column(sheet, column).constants.get(row)

    def title(self, sheet: str) -> str | None:
        """Title of a sheet as the book writes it; titles do not differ by case."""
        if sheet in self.sheets:
            return sheet
        folded = sheet.casefold()
        return next((title for title in self.sheets if title.casefold() == folded), None)

    def runs(self) -> Iterator[Run]:
        """All runs."""
        for columns in self.sheets.values():
            for column in columns.values():
                yield from column.runs

    def named(self, name: str) -> Area | None:
        """Return the cells of a defined name."""
        cell = self.names.get(name)
        if cell is not None:
            return Area(cell[0], cell[1], cell[1], cell[2], cell[2])
        return self.areas.get(name)

    def columns_of(self, area: Area) -> list[int]:
        """Numbers of the columns of a rectangle that hold anything."""
        columns = self.sheets.get(area.sheet, {})
        if area.last_column - area.first_column < len(columns):
            return [n for n in range(area.first_column, area.last_column + 1) if n in columns]
        return [n for n in columns if area.first_column <= n <= area.last_column]

    def runs_of(self, area: Area) -> Iterator[Run]:
        """Return the runs with cells in a rectangle."""
        for number in self.columns_of(area):
            yield from self.sheets[area.sheet][number].runs_in(area.first_row, area.last_row)

    def precedents(self, run: Run) -> Iterator[Area]:
        """All rectangles that a run refers to, over all its rows."""
        return (area for _, area in self.located(run))

    def located(self, run: Run) -> Iterator[tuple[Reference, Area]]:
        """Return references of a run with the cells that they name, over all its rows."""
        for reference in run.formula.references if run.formula is not None else ():
            if reference.name:
                area = self.named(reference.name)
                if area is not None:
                    yield reference, area
                continue
            top, bottom = (run.first, run.first) if run.array else (run.first, run.last)
            left = run.array.first_column if run.array else run.column
            ends = (reference.first, reference.last)
            rows = [r.row if r.row_fixed else at + r.row for r in ends for at in (top, bottom)]
            columns = [r.column if r.column_fixed else left + r.column for r in ends]
            sheet = run.sheet if reference.sheet is None else self.title(reference.sheet)
            if sheet is not None:
                yield reference, Area(sheet, min(rows), max(rows), min(columns), max(columns))


def is_backwards(run: Run, reference: Reference) -> bool:
    """Whether a range ends before it begins in some row of a run."""
    first, last = reference.first, reference.last

    def absolute(fixed: bool, at: int, cell: int) -> int:
        return at if fixed else cell + at

    columns = (absolute(ref.column_fixed, ref.column, run.column) for ref in (first, last))
    rows = [
        [absolute(ref.row_fixed, ref.row, row) for ref in (first, last)]
        for row in (run.first, run.last)
    ]
    left, right = columns
    return left > right or any(top > bottom for top, bottom in rows)


def _without(run: Run, rows: set[int]) -> list[Run]:
    """Return the parts of a run outside some rows."""
    span = range(run.first, run.last + 1)
    if rows.isdisjoint(span):
        return [run]
    if rows.issuperset(span):
        return []
    parts: list[Run] = []
    start = None
    for row in range(run.first, run.last + 2):
        outside = row <= run.last and row not in rows
        if outside and start is None:
            start = row
        elif not outside and start is not None:
            parts.append(run.part(start, row - start))
            start = None
    return parts
