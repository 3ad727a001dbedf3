"""Evaluates the runs of a grid on demand; a run whose cells need each other goes cell by cell."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from reports.recalculation.by_columns.evaluation import At, Evaluation
from reports.recalculation.by_columns.functions import Array, Value, finite, numeric
from reports.recalculation.by_columns.grid import Column, Grid, Run
from reports.recalculation.by_columns.syntax import Name, Range, Ref, UnknownFormula

_Block = tuple[Array, NDArray[np.bool_] | None, dict[int, str]]


class _Again(Exception):  # noqa: N818 - a signal, no error
    """A run needs its own cells."""

    def __init__(self, run: Run) -> None:
        self.run = run
        super().__init__()


@dataclass(frozen=True, slots=True)
class Area:
    """A rectangle of cells that a formula refers to."""

    sheet: str
    first_row: int
    last_row: int
    first_column: int
    last_column: int


class Engine:
    """Values of a grid's cells.

    A formula outside the whitelist raises ``UnknownFormula`` from every method
    that needs its value.
    """

    def __init__(self, grid: Grid) -> None:
        self.grid = grid
        # Typed-in columns as arrays: formulas read the same cells again and again.
        self._typed: dict[tuple[str, int, int, int], _Block] = {}

    def evaluate_all(self) -> None:
        """Evaluate every run."""
        with np.errstate(all="ignore"):
            for columns in self.grid.sheets.values():
                for column in columns.values():
                    for run in column.runs:
                        self.run(run)

    def values(self, sheet: str, column: int, first: int, last: int) -> tuple[Array, str]:
        """Numbers of a column's cells and a letter for the kind of each.

        The letters: ``n`` number, ``b`` blank, ``t`` text, ``e`` error; the number of
        a blank, a text and an error is NaN.
        """
        known = self.grid.column(sheet, column)
        if len(known.runs) == 1 and not known.errors:
            only = known.runs[0]
            if only.first <= first and last <= only.last:
                with np.errstate(all="ignore"):
                    part = self._part(only, first, last)
                if not only.texts:
                    good = np.isfinite(part)
                    if np.logical_and.reduce(good):
                        return part, "n" * len(part)
                    return part, "".join("n" if number else "e" for number in good)
        numbers = np.full(last - first + 1, np.nan)
        kinds = ["b"] * len(numbers)
        for row, constant in known.constants.items():
            if first <= row <= last:
                is_text = isinstance(constant, str)
                numbers[row - first] = np.nan if is_text else float(constant)
                kinds[row - first] = "t" if is_text else "n"
        for row in known.errors:
            if first <= row <= last:
                kinds[row - first] = "e"
        with np.errstate(all="ignore"):
            for run in known.runs:
                low, high = max(first, run.first), min(last, run.last)
                if low <= high:
                    numbers[low - first : high - first + 1] = self._part(run, low, high)
                    for row in range(low, high + 1):
                        good = np.isfinite(numbers[row - first])
                        kinds[row - first] = "t" if row in run.texts else "n" if good else "e"
        return numbers, "".join(kinds)

    def all_of(self, run: Run) -> Array:
        """Numbers of all cells of a run, NaN where there is none."""
        with np.errstate(all="ignore"):
            return self._part(run, run.first, run.last)

    def once(self, run: Run) -> Array:
        """Values that a run's formula would have on this grid, which need not hold the run."""
        if run.formula is None:
            raise UnknownFormula(run.problem)
        tree = run.formula.tree
        values = np.empty(run.count)
        step = run.count if run.formula.at_once else 1
        with np.errstate(all="ignore"):
            for i in range(0, run.count, step):
                at = At(run.sheet, run.first + i, run.column, step)
                found = np.asarray(numeric(Evaluation(self, at).result(tree)), dtype=float)
                values[i : i + step] = found.reshape(-1)
        return np.where(np.isfinite(values), values, np.nan)

    def areas(self, run: Run) -> Iterator[Area]:
        """All rectangles that a run refers to, over all its rows."""
        if run.formula is None:
            return
        for node in run.formula.references:
            match node:
                case Ref():
                    yield self._area(node, node, run)
                case Range(first, last):
                    yield self._area(first, last, run)
                case Name(name):
                    cell = self.grid.names.get(name.casefold())
                    if cell is not None:
                        yield Area(cell[0], cell[1], cell[1], cell[2], cell[2])

    def _area(self, first: Ref, last: Ref, run: Run) -> Area:
        rows = []
        columns = []
        for ref in (first, last):
            if ref.row_fixed:
                rows.append(ref.row)
            else:
                rows += [run.first + ref.row, run.last + ref.row]
            columns.append(ref.column if ref.column_fixed else run.column + ref.column)
        title = self.sheet(first.sheet, run.sheet)
        return Area(title, min(rows), max(rows), min(columns), max(columns))

    def sheet(self, named: str | None, own: str) -> str:
        """Title of the sheet that a reference names.

        Raises:
            UnknownFormula: there is no such sheet.
        """
        if named is None:
            return own
        title = self.grid.title(named)
        if title is None:
            msg = f"no sheet {named}"
            raise UnknownFormula(msg)
        return title

    # --- runs -------------------------------------------------------------------------

    def run(self, run: Run) -> None:
        """Evaluate one run."""
        if run.state == "done":
            return
        if run.state in ("running", "cells"):
            if run.state == "running":
                raise _Again(run)
            self._cells(run, run.first, run.last)
            return
        if run.formula is None or run.state == "unknown":
            raise UnknownFormula(run.problem)
        run.state = "running"
        try:
            result = self._evaluate(run, run.first, run.count)
            self._keep(run, run.first, result, run.count)
            run.state = "done"
        except _Again as again:
            run.state = "new"
            if again.run is not run:
                raise
            self._start_cells(run)
            self._cells(run, run.first, run.last)
            run.state = "done"
        except UnknownFormula:
            run.state = "new"
            raise

    def _start_cells(self, run: Run) -> None:
        run.state = "cells"
        run.values = np.full(run.count, np.nan)
        run.done = np.zeros(run.count, dtype=bool)

    def _evaluate(self, run: Run, row: int, count: int) -> Value:
        assert run.formula is not None
        tree = run.formula.tree
        if count > 1 and not run.formula.at_once:
            self._start_cells(run)
            self._cells(run, run.first, run.last)
            return run.values
        return Evaluation(self, At(run.sheet, row, run.column, count)).result(tree)

    def _keep(self, run: Run, row: int, result: Value, count: int) -> None:
        if run.values is None:
            run.values = np.full(run.count, np.nan)
        flat = np.asarray(result).reshape(-1)
        if flat.size != count:
            flat = np.full(count, flat[0])
        start = row - run.first
        if flat.dtype.kind in "OUS":
            for i, item in enumerate(flat):
                if isinstance(item, str):
                    run.texts[row + i] = str(item)
                else:
                    run.values[start + i] = float(item)
            return
        run.values[start : start + count] = finite(flat)

    def _cells(self, run: Run, first: int, last: int) -> None:
        """One cell after the other; a cell that needs itself is an error."""
        assert run.done is not None
        for row in range(first, last + 1):
            at = row - run.first
            if run.done[at]:
                continue
            run.done[at] = True  # NaN while it runs: a circle is an error
            try:
                result = self._evaluate(run, row, 1)
            except RecursionError:
                msg = "formulas chained too deeply"
                raise UnknownFormula(msg) from None
            self._keep(run, row, result, 1)

    def _part(self, run: Run, first: int, last: int) -> Array:
        if run.state == "cells":
            self._cells(run, first, last)
        elif run.state != "done":
            self.run(run)
        assert run.values is not None
        return run.values[first - run.first : last - run.first + 1]

    # --- reading ----------------------------------------------------------------------

    def block(self, sheet: str, first_row: int, last_row: int, column: int) -> _Block:
        """Numbers of a column's cells (blank 0), where they are numbers, and its texts."""
        key = (sheet, first_row, last_row, column)
        found = self._typed.get(key)
        if found is not None:
            return found
        known = self.grid.column(sheet, column)
        for run in known.runs:
            if run.first <= first_row and last_row <= run.last:
                part = self._part(run, first_row, last_row)
                if not run.texts:
                    return part, None, run.texts
                texts = {r: t for r, t in run.texts.items() if first_row <= r <= last_row}
                return part, None, texts
        found = self._mixed(known, first_row, last_row)
        if not known.runs:
            self._typed[key] = found
        return found

    def _mixed(self, known: Column, first_row: int, last_row: int) -> _Block:
        numbers = np.zeros(last_row - first_row + 1)
        there = np.zeros(len(numbers), dtype=bool)
        texts: dict[int, str] = {}
        rows = known.constants
        inside = (
            [r for r in rows if first_row <= r <= last_row]
            if len(rows) < len(numbers)
            else [r for r in range(first_row, last_row + 1) if r in rows]
        )
        for row in inside:
            constant = rows[row]
            if isinstance(constant, str):
                texts[row] = constant
            else:
                numbers[row - first_row] = float(constant)
                there[row - first_row] = not isinstance(constant, bool)
        for row in known.errors:
            if first_row <= row <= last_row:
                numbers[row - first_row], there[row - first_row] = np.nan, True
        for run in known.runs:
            low, high = max(first_row, run.first), min(last_row, run.last)
            if low <= high:
                numbers[low - first_row : high - first_row + 1] = self._part(run, low, high)
                there[low - first_row : high - first_row + 1] = True
                for row, text in run.texts.items():
                    if low <= row <= high:
                        texts[row] = text
                        there[row - first_row] = False
        return numbers, there, texts
