"""The fast referee: formualizer, always present."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from tools.referees.cells import (
    Book,
    CellValue,
    row_and_column,
    stripped,
)


class Formualizer:
    """Recalculates in this process; give it only workbooks that passed the intake."""

    name = "formualizer"

    def recalculate(self, books: Sequence[bytes]) -> list[Book]:
        """Values of all formula cells of each workbook."""
        return [self._one(book) for book in books]

    def _one(self, book: bytes) -> Book:
        import formualizer

        bare, formulas = stripped(book)
        engine = formualizer.load_workbook_bytes(bare)
        engine.evaluate_all()
        result: Book = {}
        for sheet, cells in formulas.items():
            values = result.setdefault(sheet, {})
            for cell in cells:
                row, column = row_and_column(cell)
                values[cell] = _plain(engine.get_value(sheet, row, column))
        return result


def _plain(value: Any) -> CellValue:  # noqa: ANN401
    """Numbers as float; an error as its text."""
    if isinstance(value, bool) or value is None or isinstance(value, str):
        return value
    if isinstance(value, (int, float)):
        return float(value)
    if isinstance(value, dict):
        return f"#{str(value.get('kind', 'error')).upper()}!"
    return f"#{value}"
