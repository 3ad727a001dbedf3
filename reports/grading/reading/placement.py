"""Cells of an issued book found again: by defined names first, then by headers.

A person may rename and move sheets and insert rows and columns.  Rows of a
table are told by the angles in its first column.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import cached_property

from openpyxl.utils import get_column_letter

from reports.grading.issuing.handout import anchor_name, cell_name
from reports.model.blocks import Model, TableSpec
from reports.recalculation.evaluate import NUMBER, Evaluator
from reports.recalculation.grid import CellGrid
from reports.shared.errors import UnknownFormula
from reports.shared.russian import capital
from reports.workbook.layout import (
    KEY_COLUMN,
    SYMBOL_COLUMN,
    TITLE_COLUMN,
    VALUE_COLUMN,
    Layout,
)

_SEARCH_ROWS = 2000


def stretches(rows: Iterable[int]) -> list[tuple[int, int]]:
    """First and last of the rows that follow each other without a gap."""
    ranges: list[tuple[int, int]] = []
    for row in rows:
        if ranges and ranges[-1][1] == row - 1:
            ranges[-1] = (ranges[-1][0], row)
        else:
            ranges.append((row, row))
    return ranges


def range_text(first: int, last: int, column: int) -> str:
    """Cells of a column below each other, for messages."""
    return address(first, column) + (f":{address(last, column)}" if last > first else "")


def address(row: int, column: int) -> str:
    """Cell address for messages."""
    return f"{get_column_letter(column)}{row}"


@dataclass(frozen=True, slots=True)
class Location:
    """Cells of a node: one column, a row for each value; None where a row is lost."""

    sheet: str
    column: int
    rows: tuple[int | None, ...]
    by: str  # "name" or "header"
    span: Span | None


@dataclass(frozen=True, slots=True)
class Span:
    """First and last row of a place; ``whole`` where all rows between belong to it."""

    first: int
    last: int
    whole: bool


def span_of(rows: tuple[int | None, ...]) -> Span | None:
    """First and last of some rows; None where all are lost."""
    filled = [row for row in rows if row is not None]
    if not filled:
        return None
    first, last = min(filled), max(filled)
    return Span(first, last, len(filled) == len(rows) == last - first + 1)


def _one_cell(at: tuple[str, int, int], by: str) -> Location:
    return Location(at[0], at[2], (at[1],), by, Span(at[1], at[1], True))


@dataclass
class Placement:
    """Places of nodes, angles and inputs; what was found out on the way."""

    places: dict[str, Location] = field(default_factory=dict)
    moved: list[str] = field(default_factory=list)


def find_places(model: Model, layout: Layout, grid: CellGrid) -> Placement:
    """Find the tables and cells of a model in a workbook."""
    search = _Search(grid)
    placement = Placement()
    for table in model.tables.values():
        _find_table(table, layout, search, placement)
    for key in model.scalars:
        cell = layout.cells[key]
        at = grid.names.get((key if key in layout.named else cell_name(key)).casefold())
        by = "name"
        if at is None or at[0] not in grid.sheets:
            at, by = search.scalar(model, key, cell.column), "header"
        if at is None and search.same_headers(model, layout, key):
            at = (cell.sheet, cell.row, cell.column)
        if at is not None:
            placement.places[key] = _one_cell(at, by)
            if by == "header":
                placement.moved.append(f"{key}: найдено по подписи, {at[0]}")
    for name, item in model.fields.items():
        at = grid.names.get(name.casefold())
        by = "name"
        if at is None or at[0] not in grid.sheets:
            key = ".".join(str(p + 1 if isinstance(p, int) else p) for p in item.path)
            at, by = search.beside(key, VALUE_COLUMN - KEY_COLUMN), "header"
        if at is not None:
            placement.places[name] = _one_cell(at, by)
    _report_sheets(model, layout, placement)
    return placement


def _find_table(table: TableSpec, layout: Layout, search: _Search, placement: Placement) -> None:
    heads: dict[int, tuple[str, int, int]] = {}
    by = "name"
    for index in range(len(table.columns)):
        at = search.grid.names.get(anchor_name(table.id, index).casefold())
        if at is not None and at[0] in search.grid.sheets:
            heads[index] = at
    if len(heads) < len(table.columns):
        by = "header"
        missing = {i: c for i, c in search.table(table).items() if i not in heads}
        if missing:
            placement.moved.append(f"таблица {table.number}: столбцы найдены по заголовкам")
        heads.update(missing)
    index_column = next((i for i, c in enumerate(table.columns) if c.expr is None), None)
    if index_column is None or index_column not in heads:
        return
    sheet, row, column = heads[index_column]
    rows = _rows(search, sheet, row, column, table.rows)
    first = layout.rows_of(table)[0]
    if any(r is not None and r != first + i for i, r in enumerate(rows)):
        placement.moved.append(f"таблица {table.number}: строки сдвинуты")
    span = span_of(rows)
    for index, (title, _, at_column) in heads.items():
        if title == sheet:
            key = f"{table.id}.{table.columns[index].key}"
            placement.places[key] = Location(title, at_column, rows, by, span)


def _rows(
    search: _Search, sheet: str, header: int, column: int, angles: tuple[float, ...]
) -> tuple[int | None, ...]:
    """Rows below the header whose index is the wanted one, in order."""
    cells = search.grid.column(sheet, column)
    constants = dict(cells.constants)
    if cells.runs:  # angles calculated from the row above
        constants |= _calculated(search.engine, sheet, header, column)
    expected = tuple(range(header + 2, header + 2 + len(angles)))
    if tuple(map(constants.get, expected)) == angles:
        return expected
    rows = sorted(r for r in constants if header + 1 < r <= header + _SEARCH_ROWS)
    indices: list[int | None] = []
    at = 0
    for value in angles:
        hit = None
        for i in range(at, len(rows)):
            constant = constants[rows[i]]
            if isinstance(constant, float) and abs(constant - value) <= 1e-6 * max(1.0, abs(value)):
                hit = i
                break
        if hit is None:
            indices.append(None)
        else:
            indices.append(rows[hit])
            at = hit + 1
    return tuple(indices)


def _calculated(engine: Evaluator, sheet: str, header: int, column: int) -> dict[int, float]:
    first, last = header + 2, header + _SEARCH_ROWS
    try:
        values, kinds = engine.values(sheet, column, first, last)
    except UnknownFormula:
        return {}
    numbers = zip(values.tolist(), kinds, strict=True)
    return {first + i: value for i, (value, kind) in enumerate(numbers) if kind == NUMBER}


def _report_sheets(model: Model, layout: Layout, placement: Placement) -> None:
    renamed: dict[str, str] = {}
    for table in model.tables.values():
        location = placement.places.get(f"{table.id}.{table.columns[0].key}")
        if location is not None and location.sheet != table.sheet:
            renamed[table.sheet] = location.sheet
    for key in model.scalars:
        location = placement.places.get(key)
        if location is not None and location.sheet != layout.cells[key].sheet:
            renamed.setdefault(layout.cells[key].sheet, location.sheet)
    for old, new in renamed.items():
        placement.moved.append(f"лист «{old}» теперь «{new}»")


class _Search:
    """Texts of a workbook by what they say, and what its formulas give."""

    def __init__(self, grid: CellGrid) -> None:
        self.grid = grid

    @cached_property
    def engine(self) -> Evaluator:
        """The whole book calculated, for all tables whose angles are."""
        return Evaluator(self.grid)

    @cached_property
    def texts(self) -> dict[str, list[tuple[str, int, int]]]:
        """Text → cells; built when first needed."""
        texts: dict[str, list[tuple[str, int, int]]] = {}
        for sheet, columns in self.grid.sheets.items():
            for number, column in columns.items():
                for row, value in column.constants.items():
                    if isinstance(value, str):
                        texts.setdefault(_plain(value), []).append((sheet, row, number))
        return texts

    def beside(self, text: str, distance: int) -> tuple[str, int, int] | None:
        """Return the cell so many columns beside the only cell with a text."""
        hits = self.texts.get(_plain(text), [])
        if len(hits) != 1 or hits[0][2] + distance < 1:
            return None
        return hits[0][0], hits[0][1], hits[0][2] + distance

    def scalar(self, model: Model, key: str, column: int) -> tuple[str, int, int] | None:
        """The value cell of a scalar by its title and symbol, as far from them as in ``column``."""
        scalar = model.scalars[key]
        title = _plain(capital(scalar.label or scalar.quantity.title))
        symbol = _plain(scalar.quantity.symbol)
        step = SYMBOL_COLUMN - TITLE_COLUMN
        hits = [
            (sheet, row, at)
            for sheet, row, at in self.texts.get(title, [])
            if _plain(str(self.grid.constant(sheet, row, at + step) or "")) == symbol
        ]
        if len(hits) != 1:
            return None
        return hits[0][0], hits[0][1], hits[0][2] + column - TITLE_COLUMN

    def same_headers(self, model: Model, layout: Layout, key: str) -> bool:
        """Whether a grid's cell still stands under its own label, in its own row."""
        cell = layout.cells[key]
        quantity = model.scalars[key].quantity
        texts = {_plain(capital(quantity.title)), _plain(quantity.header)}
        return _plain(str(self.grid.constant(cell.sheet, cell.row, 1) or "")) in texts

    def table(self, table: TableSpec) -> dict[int, tuple[str, int, int]]:
        """Header cells of a table by the number of the column, from its caption."""
        captions = self.texts.get(_plain(f"Таблица {table.number} — {table.title}"), [])
        heads: dict[int, tuple[str, int, int]] = {}
        if len(captions) != 1:
            return heads
        sheet, row, column = captions[0]
        for index, item in enumerate(table.columns):
            hits = [
                at
                for at in self.texts.get(_plain(item.quantity.header), [])
                if at[0] == sheet and row < at[1] <= row + 3 and at[2] >= column
            ]
            taken = set(heads.values())
            free = [at for at in sorted(hits, key=lambda at: at[2]) if at not in taken]
            if free:
                heads[index] = free[0]
        return heads


def _plain(text: str) -> str:
    return " ".join(text.split()).casefold()
