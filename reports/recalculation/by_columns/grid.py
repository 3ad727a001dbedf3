"""The cells of a workbook, column by column: what was typed, runs of formulas, saved values."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from reports.recalculation.by_columns.formulas import Formula
from reports.recalculation.by_columns.syntax import Token

MAX_ROW, MAX_COLUMN, MAX_CELLS, MAX_SHEETS = 20_000, 1_000, 400_000, 200

Constant = float | str | bool
Cached = float | str | bool | None

_NO_ROWS = np.zeros(0, dtype=np.intc)
_NO_NUMBERS = np.zeros(0)


class BadBook(ValueError):  # noqa: N818 - an expected find
    """A workbook that cannot be read; the message is Russian."""


@dataclass(slots=True)
class Run:
    """Cells of one column below each other with the same formula."""

    sheet: str
    column: int
    first: int
    count: int
    formula: Formula | None  # None: a formula that cannot be read
    text: str
    problem: str = ""
    values: NDArray[np.float64] | None = None  # filled by the engine, NaN for an error
    texts: dict[int, str] = field(default_factory=dict)  # rows whose value is a text
    state: str = "new"
    done: NDArray[np.bool_] | None = None  # cell by cell, for recurrences

    @property
    def last(self) -> int:
        """Last row."""
        return self.first + self.count - 1

    @property
    def pattern(self) -> tuple[Token, ...] | None:
        """Tokens of the formula; None where it cannot be read."""
        return None if self.formula is None else self.formula.pattern

    def part(self, first: int, count: int) -> Run:
        """The same formula in other rows of the column, not yet evaluated."""
        return Run(self.sheet, self.column, first, count, self.formula, self.text, self.problem)


def _no_rows() -> NDArray[np.intc]:
    return _NO_ROWS


def _no_numbers() -> NDArray[np.float64]:
    return _NO_NUMBERS


@dataclass(slots=True)
class Column:
    """One column of a sheet: typed-in values, runs of formulas, claims of their values."""

    constants: dict[int, Constant] = field(default_factory=dict)
    errors: dict[int, str] = field(default_factory=dict)  # typed-in error values
    runs: list[Run] = field(default_factory=list)
    saved_rows: NDArray[np.intc] = field(default_factory=_no_rows)  # of cells with formulas
    saved: NDArray[np.float64] = field(default_factory=_no_numbers)  # NaN where no number is saved

    def saved_of(self, run: Run) -> NDArray[np.float64]:
        """Numbers saved for the cells of a run; NaN where nothing or something else was saved."""
        if len(self.saved_rows) == run.count and self.saved_rows[0] == run.first:
            return self.saved
        found = np.full(run.count, np.nan)
        inside = (self.saved_rows >= run.first) & (self.saved_rows <= run.last)
        found[self.saved_rows[inside] - run.first] = self.saved[inside]
        return found

    def run_at(self, row: int) -> Run | None:
        """The run that holds a row."""
        for run in self.runs:
            if run.first <= row <= run.last:
                return run
        return None


@dataclass(slots=True)
class Grid:
    """A workbook: sheets by title, columns by number; defined names of single cells."""

    sheets: dict[str, dict[int, Column]] = field(default_factory=dict)
    names: dict[str, tuple[str, int, int]] = field(default_factory=dict)  # casefold → cell
    cells: int = 0

    def column(self, sheet: str, number: int) -> Column:
        """A column, empty where there is none."""
        return self.sheets.get(sheet, {}).get(number) or Column()

    def constant(self, sheet: str, row: int, column: int) -> Constant | None:
        """Typed-in value of a cell."""
        return self.column(sheet, column).constants.get(row)

    def title(self, sheet: str) -> str | None:
        """Title of a sheet as the book writes it; titles do not differ by case."""
        if sheet in self.sheets:
            return sheet
        wanted = sheet.casefold()
        return next((title for title in self.sheets if title.casefold() == wanted), None)
