"""Red where a number is typed over a formula of a table.

Only a colour can know: as a formula of a cell ISFORMULA fails in programs that calculate books.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby

from openpyxl.formatting.rule import FormulaRule
from openpyxl.worksheet.worksheet import Worksheet

from reports.workbook import styles
from reports.workbook.layout import Cell, area
from reports.workbook.sheets import FilledColumn, SharedColumn

_Rows = tuple[int, int]  # first and last


def mark_typed_over(sheet: Worksheet, columns: Sequence[FilledColumn | SharedColumn]) -> None:
    """Mark cells of the tables of a sheet that hold no formula any more."""
    for first, last in _rectangles(columns):
        rule = FormulaRule([f"NOT(_xlfn.ISFORMULA({first.coordinate}))"], **styles.wrong())
        sheet.conditional_formatting.add(area(first, last), rule)


def _rectangles(columns: Sequence[FilledColumn | SharedColumn]) -> Iterator[tuple[Cell, Cell]]:
    """Yield corners of the fields of formulas: neighbours with the same rows together."""
    runs = [(rows, column.index) for column in columns for rows in _runs(column)]
    in_order = enumerate(sorted(runs))
    for (rows, _), run in groupby(in_order, lambda pair: (pair[1][0], pair[1][1] - pair[0])):
        indices = [index for _, (_, index) in run]
        yield Cell("", rows[0], indices[0]), Cell("", rows[1], indices[-1])


def _runs(column: FilledColumn | SharedColumn) -> Iterator[_Rows]:
    """Yield rows of a column that have formulas, without its ends where these may have none."""
    first = column.first_row
    if isinstance(column, SharedColumn):
        yield first - 1, first + len(column.numbers) - 1
        return
    row = first
    for is_formula, cells in groupby(column.cells, lambda cell: bool(cell[0])):
        count = len(list(cells))
        if is_formula:
            yield row, row + count - 1
        row += count
