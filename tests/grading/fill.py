"""Work-books as a student fills them in: the book's formulas, with seeded defects."""

from __future__ import annotations

import io
from collections.abc import Callable, Iterable, Mapping
from functools import lru_cache

from openpyxl import Workbook, load_workbook

from reports.formula.excel import compile_formula
from reports.grading.issuing.assignment import Assignment
from reports.grading.issuing.handout import fill_cells
from reports.spec.blocks import TableSpec
from reports.workbook.layout import Cell, Layout, RowReferences, at_row
from tests.referee.changes import without_charts

Formula = str | float | None


def solved_formulas(assignment: Assignment, layout: Layout) -> dict[str, list[Formula]]:
    """Node → what the solved book has in its cells."""
    model = assignment.model
    found: dict[str, list[Formula]] = {}
    for block in assignment.fill:
        if isinstance(block, TableSpec):
            rows = layout.rows_of(block)
            for column in block.columns:
                if column.expr is not None:
                    text = compile_formula(column.expr, RowReferences(layout, block))
                    found[f"{block.id}.{column.key}"] = [
                        at_row(text, row, last=row == rows[-1]) for row in rows
                    ]
        else:
            for node in fill_cells(block, layout):
                expr = model.scalars[node].expr
                found[node] = [compile_formula(expr, RowReferences(layout, None))]
    return found


def filled_book(
    handout: bytes | Workbook,
    assignment: Assignment,
    changes: Mapping[str, list[Formula]] | None = None,
    edit: Callable[[Workbook, Layout], None] | None = None,
    *,
    charts: bool = False,
) -> bytes:
    """A work-book with formulas in every cell to fill in; ``changes`` replace whole nodes.

    The charts of the handout are half of the time; with them it is as a student's program has it.
    """
    layout = Layout.of(assignment.model)
    formulas = {**solved_formulas(assignment, layout), **(changes or {})}
    texts = tuple(
        ((cell.sheet, cell.row, cell.column), text)
        for cell, text in filled_cells(assignment, layout, formulas).items()
    )
    if isinstance(handout, bytes) and edit is None and not charts:
        return _saved_with(handout, texts)
    book = handout
    if isinstance(book, bytes):
        book = load_workbook(io.BytesIO(book if charts else without_charts(book)))
    _write(book, texts)
    if edit is not None:
        edit(book, layout)
    return _saved(book)


def filled_cells(
    assignment: Assignment, layout: Layout, formulas: Mapping[str, list[Formula]]
) -> dict[Cell, Formula]:
    """The formulas of the nodes in their cells."""
    return {
        cell: text
        for block in assignment.fill
        for node, cells in fill_cells(block, layout).items()
        for cell, text in zip(cells, formulas[node], strict=True)
    }


def _write(book: Workbook, texts: Iterable[tuple[tuple[str, int, int], Formula]]) -> None:
    for (sheet, row, column), text in texts:
        book[sheet].cell(row, column).value = text


def _saved(book: Workbook) -> bytes:
    stream = io.BytesIO()
    book.save(stream)
    return stream.getvalue()


# Many tests fill the same work-book, many of them in the same way.
@lru_cache(maxsize=8)
def _saved_with(handout: bytes, texts: tuple[tuple[tuple[str, int, int], Formula], ...]) -> bytes:
    book = _opened(handout)
    _write(book, texts)  # every cell to fill in, so that nothing of the last filling is left
    return _saved(book)


@lru_cache(maxsize=2)
def _opened(handout: bytes) -> Workbook:
    return load_workbook(io.BytesIO(without_charts(handout)))
