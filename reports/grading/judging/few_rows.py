"""Rows of a column: few wrong ones in words, rows moved, rows of another table."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from reports.grading.judging.judgement import Array, Judgement
from reports.model.blocks import TableSpec

_MIN_VALUES = 3  # values of an item that one of them is told distance from


def moved(right: Array, values: Array, by: int) -> Array:
    """Right values moved by a row; the row without a right value is the student's own."""
    shifted = np.roll(right, by)
    shifted[0 if by > 0 else -1] = values[0 if by > 0 else -1]
    return shifted


def row_indices(table: TableSpec, other: TableSpec) -> NDArray[np.intp] | None:
    """For each row of a table the row of another table with the same angle."""
    if table.rows == other.rows:
        return np.arange(len(table.rows))
    rows = {angle: i for i, angle in enumerate(other.rows)}
    if any(angle not in rows for angle in table.rows):
        return None
    return np.array([rows[angle] for angle in table.rows])


def slips(judgement: Judgement, good: NDArray[np.bool_]) -> list[int]:
    """Return wrong rows where they are few and all others are right; ``good`` are right numbers."""
    rows = list(judgement.rows)
    ready = set(judgement.typed)
    wrong = [i for i in rows if np.isfinite(judgement.values[i]) and not (i in ready and good[i])]
    few = len(good) >= _MIN_VALUES and 0 < len(rows) <= len(good) / 2
    return rows if few and wrong == rows else []


def rows_text(judgement: Judgement, rows: list[int], cause: str) -> str:
    """Cause of a few wrong rows in words."""
    column, count = judgement.item.is_column, len(judgement.values)
    if len(rows) == 1:
        which = f"неверна одна строка из {count}" if column else f"неверно одно из {count} значений"
    else:
        kind = "строк" if column else "значений"
        which = f"неверно {kind}: {len(rows)} из {count}"
    if not cause:
        ready = set(rows) <= set(judgement.typed)
        cause = "вместо формулы вписано число" if ready else "сравните формулу с соседними"
    return f"{which}, остальные верны: {cause}"
