"""Cells and stretches of rows, as messages name them."""

from __future__ import annotations

from collections.abc import Iterable

from reports.workbook.layout import Cell


def stretches(rows: Iterable[int]) -> list[tuple[int, int]]:
    """First and last of the rows that follow each other without a gap."""
    found: list[tuple[int, int]] = []
    for row in rows:
        if found and found[-1][1] == row - 1:
            found[-1] = (found[-1][0], row)
        else:
            found.append((row, row))
    return found


def range_text(first: int, last: int, column: int) -> str:
    """Cells of a column below each other, for messages."""
    return address(first, column) + (f":{address(last, column)}" if last > first else "")


def address(row: int, column: int) -> str:
    """Cell address for messages."""
    return Cell("", row, column).coordinate
