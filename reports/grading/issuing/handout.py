"""The work-book: headers, input data, units and empty cells, laid out as the solved book."""

from __future__ import annotations

import zlib
from collections.abc import Collection, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from openpyxl.packaging.custom import StringProperty
from openpyxl.styles import Protection
from openpyxl.workbook import Workbook
from openpyxl.workbook.defined_name import DefinedName
from openpyxl.worksheet.worksheet import Worksheet

from kshm.nomenclature.quantity import Quantity
from reports.grading.issuing.assignment import Assignment
from reports.model.blocks import Block, Grid, Model, TableSpec, scalars_of
from reports.model.charts import ChartSpec
from reports.model.evaluation import Evaluation, Values
from reports.workbook import styles
from reports.workbook.inputs import shown
from reports.workbook.layout import CONTENTS_SHEET, INPUT_SHEET, Cell, Layout, check_names
from reports.workbook.sheets import Writer
from reports.workbook.write import assemble, saved

TICKET_NAME = "kshm_ticket"
TICKET_TITLE = "Идентификатор"
INPUT_MARKS = "kshm_marks_"  # properties with two signs for each input, for ``kshm check``
_MARKS_LENGTH = 200  # a property may hold 255

_LEGEND = (
    (styles.ANSWER, "заполните: сюда пишутся формулы, остальные ячейки защищены"),
    (styles.INPUT, "исходные данные вашего варианта"),
    (styles.FORMULA, "дано: числа и формулы от ваших ячеек"),
    (styles.HEADER, "заголовок; в примечании — смысл величины и номер формулы"),
)


class _HandoutWriter(Writer):
    """Writes numbers where the solved book has formulas, formulas of what is asked, or nothing."""

    live: frozenset[Cell] = frozenset()

    def column(
        self,
        sheet: Worksheet,
        index: int,
        texts: Sequence[str | None],
        values: Sequence[float],
        look: tuple[str, str],
    ) -> None:
        """Cell by cell: what is to be filled in gets its own look afterwards."""
        self.cells(sheet, index, dict(enumerate(texts)), values, look)

    def explained(self, quantity: Quantity, text: str | None, table: str = "") -> str:
        """Nothing: the formulas are what a student is asked for."""
        return ""

    def formula(
        self, sheet: Worksheet, row: int, column: int, text: str, value: float | str
    ) -> None:
        """A given number, or a formula without a saved value; a value to be found stays out."""
        if Cell(sheet.title, row, column) in self.live:
            super().formula(sheet, row, column, text, "")
            return
        known = value if isinstance(value, str) else float(value)
        if isinstance(known, str) or np.isfinite(known):
            sheet.cell(row, column, known or None if isinstance(known, str) else known)


def anchor_name(table: str, index: int) -> str:
    """Defined name of a column's header cell, by which the column is found again."""
    return f"col_{table}_{index + 1}"


def cell_name(key: str) -> str:
    """Defined name of a scalar's cell where the solved book has none."""
    return f"cell_{key}"


def handout_bytes(assignment: Assignment, ticket: str) -> bytes:
    """The work-book of one student."""
    full = assignment.model
    layout = Layout.of(full)
    check_names(layout)
    model = replace(full, blocks=assignment.blocks, charts=_charts(assignment))
    writer = _HandoutWriter(layout, _given_values(assignment))
    writer.live = _live_cells(assignment, layout)
    book = assemble(model, writer, _LEGEND)
    for block in assignment.fill:
        _open_cells(book[block.sheet], block, layout, assignment.fill_nodes)
    _anchors(book, model, layout)
    _identify(book, ticket)
    _mark_inputs(book, full)
    _lock(book, layout)
    book.properties.title = f"{full.input.engine.name}: рабочая книга"
    return saved(book, writer.caches)


def _given_values(assignment: Assignment) -> Values:
    """Values that stand in the work-book; what the student finds is not even calculated."""
    run, given = Evaluation(assignment.model), assignment.given_nodes
    scalars: dict[str, float | str] = {}
    columns: dict[str, dict[str, NDArray[np.float64]]] = {}
    for block in assignment.blocks:
        if isinstance(block, TableSpec):
            columns[block.id] = {
                column.key: run.value(f"{block.id}.{column.key}")
                if column.expr is None or f"{block.id}.{column.key}" in given
                else np.full(len(block.rows), np.nan)
                for column in block.columns
            }
        else:
            for scalar in scalars_of(block):
                scalars[scalar.key] = run.value(scalar.key) if scalar.key in given else np.nan
    return Values(scalars, columns)


def _charts(assignment: Assignment) -> tuple[ChartSpec, ...]:
    """The charts whose tables are all in the work-book."""
    kept = {block.id for block in assignment.blocks}
    sheets = {block.sheet for block in assignment.blocks}
    return tuple(
        chart
        for chart in assignment.model.charts
        if chart.sheet in sheets
        and all(key.split(".")[0] in kept for s in chart.series for key in (s.x, s.y))
    )


def fill_cells(block: Block, layout: Layout) -> dict[str, list[Cell]]:
    """Node → its cells in the book, for a block."""
    if isinstance(block, TableSpec):
        return {
            f"{block.id}.{column.key}": [
                Cell(block.sheet, row, layout.column_of(f"{block.id}.{column.key}"))
                for row in layout.rows_of(block)
            ]
            for column in block.columns
            if column.expr is not None
        }
    rows = [row.cells for row in block.rows] if isinstance(block, Grid) else [block.scalars]
    return {cell.key: [layout.cells[cell.key]] for row in rows for cell in row if cell is not None}


def _live_cells(assignment: Assignment, layout: Layout) -> frozenset[Cell]:
    """Cells that are formulas of the student's own."""
    return frozenset(
        cell
        for block in assignment.blocks
        for node, cells in fill_cells(block, layout).items()
        if node in assignment.live_nodes
        for cell in cells
    )


def _open_cells(sheet: Worksheet, block: Block, layout: Layout, asked: Collection[str]) -> None:
    for node, cells in fill_cells(block, layout).items():
        if node not in asked:
            continue
        for place in cells:
            cell = sheet.cell(place.row, place.column)
            number_format = cell.number_format
            cell.style = styles.ANSWER
            cell.number_format = number_format  # the style brings its own


def _anchors(book: Workbook, model: Model, layout: Layout) -> None:
    for table in model.tables.values():
        for index, column in enumerate(table.columns):
            place = Cell(table.sheet, layout.places[table.id].row,
                         layout.column_of(f"{table.id}.{column.key}"))  # fmt: skip
            name = anchor_name(table.id, index)
            book.defined_names[name] = DefinedName(name, attr_text=place.absolute)
    for key in model.scalars:
        if key not in layout.named:
            name = cell_name(key)
            book.defined_names[name] = DefinedName(name, attr_text=layout.cells[key].absolute)


def _identify(book: Workbook, ticket: str) -> None:
    """The identifier as a cell, a defined name and a property: one of them survives."""
    sheet = book[CONTENTS_SHEET]
    row = sheet.max_row + 2
    sheet.cell(row, 1, TICKET_TITLE).style = styles.TEXT
    sheet.cell(row, 2, ticket).style = styles.TEXT
    sheet.cell(
        row + 1, 2, "не меняйте его: по нему работа связана с вашим вариантом"
    ).style = styles.NOTE
    place = Cell(CONTENTS_SHEET, row, 2)
    book.defined_names[TICKET_NAME] = DefinedName(TICKET_NAME, attr_text=place.absolute)
    book.custom_doc_props.append(StringProperty(name=TICKET_NAME, value=ticket))


def input_mark(value: object) -> str:
    """Two signs by which a value is known again."""
    text = f"{float(value):.12g}" if isinstance(value, (int, float)) else str(value)
    return f"{zlib.crc32(text.encode()) % 256:02x}"


def _mark_inputs(book: Workbook, model: Model) -> None:
    """Marks by which the student is told that input data were changed."""
    texts = [""]
    for name, item in model.fields.items():
        entry = f"{name}={input_mark(shown(item))}"
        if len(texts[-1]) + len(entry) >= _MARKS_LENGTH:
            texts.append("")
        texts[-1] = f"{texts[-1]} {entry}".strip()
    for number, text in enumerate(texts, 1):
        book.custom_doc_props.append(StringProperty(name=f"{INPUT_MARKS}{number:03d}", value=text))


def _lock(book: Workbook, layout: Layout) -> None:
    """Only the cells to fill in can be typed into; widths and formats stay free."""
    sheet = book[INPUT_SHEET]
    for name in layout.model.fields:
        place = layout.cells[name]
        sheet.cell(place.row, place.column).protection = Protection(locked=True)
    sheet.data_validations.dataValidation = []
    for line in book[CONTENTS_SHEET].iter_rows():  # the samples of colours
        for cell in line:
            cell.protection = Protection(locked=True)
    for sheet in book.worksheets:
        sheet.protection.sheet = True
        sheet.protection.formatCells = False
        sheet.protection.formatColumns = False
        sheet.protection.formatRows = False
