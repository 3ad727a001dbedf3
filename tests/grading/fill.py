"""Work-books as a student fills them in: the book's formulas, with seeded defects."""

from __future__ import annotations

import io
from collections.abc import Callable, Mapping

from openpyxl import Workbook, load_workbook

from reports.formula.excel import compile_formula
from reports.grading.issuing.assignment import Assignment
from reports.grading.issuing.handout import fill_cells
from reports.spec.blocks import TableSpec
from reports.workbook.layout import FIRST_ROW, Layout, RowReferences, at_row
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
    if isinstance(handout, bytes):
        book = load_workbook(io.BytesIO(handout if charts else without_charts(handout)))
    else:
        book = handout
    formulas = {**solved_formulas(assignment, layout), **(changes or {})}
    for block in assignment.fill:
        sheet = book[block.sheet]
        for node, cells in fill_cells(block, layout).items():
            for cell, text in zip(cells, formulas[node], strict=True):
                sheet.cell(cell.row, cell.column).value = text
    if edit is not None:
        edit(book, layout)
    stream = io.BytesIO()
    book.save(stream)
    return stream.getvalue()


assert FIRST_ROW
