"""Blocks of a model written to the sheets of a workbook, with the values for the caches."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from copy import copy
from dataclasses import dataclass, field
from math import ceil, floor, log10
from typing import ClassVar

from openpyxl.comments import Comment
from openpyxl.worksheet.hyperlink import Hyperlink
from openpyxl.worksheet.worksheet import Worksheet

from kshm.nomenclature.quantity import Quantity
from kshm.nomenclature.symbols import plain_symbol, symbol_runs
from reports.formula.excel import compile_formula
from reports.formula.plain import plain
from reports.formula.tex import input_symbol_tex
from reports.inputs.fields import Field
from reports.model.blocks import Column, Grid, Scalar, ScalarTable, TableSpec, scalars_of
from reports.model.evaluation import Values
from reports.shared.russian import capital
from reports.workbook import styles
from reports.workbook.layout import (
    FIRST_ROW,
    HEADER_ROW,
    NUMBER_ROW,
    SOURCE_COLUMN,
    SYMBOL_COLUMN,
    TITLE_COLUMN,
    UNIT_COLUMN,
    VALUE_COLUMN,
    Cell,
    Layout,
    RowReferences,
    at_row,
    can_share,
    quoted,
)
from reports.workbook.places import raise_row

# Widths of the columns of titles, symbols and sources in a list.
TITLE_WIDTH, SYMBOL_WIDTH, SOURCE_WIDTH = 60, 14, 26
NARROW = 9.5  # of a column of a table
_NOTE_CHARS, _LONGEST_NOTE = 38, 240  # of a line of a comment, of a formula in it
_DIGITS = ".14g"  # nobody is shown more; what follows takes room
_SHORTER = ".12g"  # of values that are small in their column
_ZERO_NOISE = 1e-13  # what is left of a zero
# Steps of a saved value from nothing to the largest: a picture needs no more, a column that only
# serves others none at all.
_CURVE_STEPS, _HELPER_STEPS = 900, 25
# Names of a chart's series are read as they are seen.
_NAMES_OF_SERIES, _DEGREES = {"mark_label", "arrow_deg"}, '0"°"'
Runs = tuple[tuple[str, str], ...]  # of a text: pieces and their levels


def link(
    sheet: Worksheet, cell_of_link: Cell, text: str, target: str, target_cell: str = "A1"
) -> None:
    """A link within the book, as a place: an address such as ``#'Лист'!A1`` is a foreign file."""
    cell = sheet.cell(cell_of_link.row, cell_of_link.column, text)
    at = cell_of_link.coordinate
    cell.hyperlink = Hyperlink(ref=at, location=f"{quoted(target)}!{target_cell}", display=text)
    cell.style = styles.LINK


@dataclass(frozen=True, slots=True)
class FilledColumn:
    """Formula cells below one written by openpyxl, which they look like."""

    index: int
    first_row: int
    cells: Sequence[tuple[str, float]]  # formula with its =, empty for a number; value

    @property
    def formula_rows(self) -> Sequence[int]:
        """Rows of the formulas."""
        return [row for row, (formula, _) in enumerate(self.cells, self.first_row) if formula]


@dataclass(frozen=True, slots=True)
class SharedColumn:
    """Formula cells below one written by openpyxl, all by the formula of the first.

    Their values are text, those of curves of as many digits as a picture needs.
    """

    index: int
    first_row: int
    formula: str
    numbers: Sequence[str]
    is_plain: bool = False  # without a look of its own

    @property
    def formula_rows(self) -> Sequence[int]:
        """Rows of the formulas."""
        return range(self.first_row, self.first_row + len(self.numbers))


@dataclass(frozen=True, slots=True)
class BareCell:
    """A cell without a look of its own, on a sheet that nobody looks at."""

    row: int
    column: int
    formula: str  # with its =, empty for a text or a number
    value: float | str


@dataclass
class CacheValues:
    """What the finishing pass adds to each sheet."""

    values: dict[str, dict[str, float | str]] = field(default_factory=dict)  # by coordinate
    columns: dict[str, list[FilledColumn | SharedColumn]] = field(default_factory=dict)
    bare: dict[str, list[BareCell]] = field(default_factory=dict)
    ranges: dict[str, list[float]] = field(default_factory=dict)  # of charts, by their formula
    names: dict[str, str] = field(default_factory=dict)  # of their series, by the cell
    symbols: dict[str, dict[str, tuple[Runs, bool]]] = field(default_factory=dict)  # and if bold

    def formulas_of(self, title: str) -> Iterator[tuple[int, int]]:
        """Yield rows and columns of the formulas that the finishing pass writes."""
        for column in self.columns.get(title, ()):
            yield from ((row, column.index) for row in column.formula_rows)
        yield from ((each.row, each.column) for each in self.bare.get(title, ()) if each.formula)


@dataclass
class BlockWriter:
    """Writes blocks; collects what openpyxl does not write: values, cells inside columns."""

    layout: Layout
    values: Values
    caches: CacheValues = field(default_factory=CacheValues)
    tells: ClassVar[bool] = True  # formulas in words: not where they are what is asked
    shares: ClassVar[bool] = True  # one formula to a column where a spreadsheet program would

    def formula(
        self, sheet: Worksheet, row: int, column: int, text: str, value: float | str
    ) -> None:
        """Write a formula cell with its value for the cache."""
        cell = sheet.cell(row, column, text)
        self.caches.values.setdefault(sheet.title, {})[cell.coordinate] = value

    def bare(self, title: str, at: tuple[int, int], value: float | str, formula: str = "") -> None:
        """Write a cell without a look; by row and column."""
        self.caches.bare.setdefault(title, []).append(BareCell(*at, formula, value))

    def symbol(
        self, sheet: Worksheet, row: int, column: int, named: Quantity | Field,
        look: str = styles.TEXT, *, unit: bool = False,
    ) -> None:  # fmt: skip
        """Write a symbol as the report has it, from the same TeX; with its unit as a heading."""
        if isinstance(named, Quantity):
            text, tex, label = named.symbol, "" if named.word else named.tex, named.unit_label
        else:
            text, tex, label = field_symbol(named), input_symbol_tex(named.symbol), named.unit
        after = f", {label}" if unit and label else ""
        cell = sheet.cell(row, column, text + after or None)
        cell.style = look
        runs = symbol_runs(tex) if tex else ()
        if any(level for _, level in runs):
            about_cell = (*runs, (after, "")) if after else runs, look == styles.HEADER
            self.caches.symbols.setdefault(sheet.title, {})[cell.coordinate] = about_cell

    def table(self, sheet: Worksheet, table: TableSpec) -> None:
        """Write an angle table: titles, headers with comments, formulas row by row."""
        first_cell = self.layout.places[table.id]
        sheet.cell(HEADER_ROW - 1, first_cell.column, f"Таблица {table.number} — {table.title}")
        sheet.cell(HEADER_ROW - 1, first_cell.column).style = styles.SUBTITLE
        rows = self.layout.rows_of(table)
        last = rows[-1]
        shown = {key.rpartition(".")[2] for _, key in table.draws}
        for number, column in enumerate(table.columns, 1):
            index = first_cell.column + number - 1
            self.symbol(sheet, HEADER_ROW, index, column.quantity, styles.HEADER, unit=True)
            sheet.cell(NUMBER_ROW, index, number).style = styles.NUMBER
            if table.draws:
                self._curve(sheet, table, column, index, is_shown=column.key in shown)
                continue
            header = sheet.cell(HEADER_ROW, index)
            formula = self.explained(column.quantity, column.expr, table.id)
            header.comment = note(column.quantity, column.source, formula)
            values = self.values.columns[table.id][column.key]
            style = styles.HELPER if column.helper or table.helper else styles.FORMULA
            template = (
                compile_formula(column.expr, RowReferences(self.layout, table))
                if column.expr is not None
                else None
            )
            look = (style, styles.excel_format(column.quantity))
            numbers = values.astype(float).tolist()
            if self.shares and template is not None and can_share(template):
                self.shared(sheet, index, template, numbers, look)
                continue
            texts: list[str | None] = [
                at_row(template, row, last=row == last)
                if template is not None
                else self.layout.step_formula(table, row, index)
                if row > FIRST_ROW and not table.is_computed(column)
                else None
                for row in rows
            ]
            self.column(sheet, index, texts, numbers, look)

    def _curve(
        self, sheet: Worksheet, table: TableSpec, column: Column, index: int, *, is_shown: bool
    ) -> None:
        """A column that charts alone are drawn from: the same formula in all rows, short values."""
        values = self.values.columns[table.id][column.key].astype(float).tolist()
        look = (styles.HELPER, styles.excel_format(column.quantity))
        second = FIRST_ROW + 1
        if column.expr is None:
            first, text, template = None, "", self.layout.step_formula(table, second, index)
        else:
            text = compile_formula(column.expr, RowReferences(self.layout, table))
            first, template = at_row(text, FIRST_ROW), at_row(text, second)
        if not can_share(text):
            texts = [at_row(text, row) for row in self.layout.rows_of(table)]
            self.column(sheet, index, texts, values, look)
            return
        self.cells(sheet, index, {0: first}, values, look)
        unit = _step_of(values, _CURVE_STEPS if is_shown else _HELPER_STEPS)
        numbers = [f"{round(value / unit) * unit:.12g}" for value in values[1:]]
        shared = SharedColumn(index, second, template, numbers, is_plain=True)
        self.caches.columns.setdefault(sheet.title, []).append(shared)

    def explained(self, quantity: Quantity, text: str | None, table: str = "") -> str:
        """A quantity's formula in the symbols of the book; nothing of a copy or a very long one."""
        if text is None:
            return ""
        said = plain(text, lambda name: self.symbol_of(name, table))
        equation = f"{quantity.symbol} = {said}"
        return "" if said == quantity.symbol or len(equation) > _LONGEST_NOTE else equation

    def symbol_of(self, name: str, table: str = "") -> str:
        """Symbol of a name in a formula of a table."""
        model = self.layout.model
        field = model.fields.get(name)
        if field is not None:
            return field_symbol(field) or f"[{field.title}]"
        node = model.nodes.get(f"{table}.{name}") or model.nodes.get(name)
        if node is not None:
            return node.quantity.symbol
        run = model.grid_runs.get(name) or model.input_runs[name]
        return self.symbol_of(run[0])

    def column(
        self,
        sheet: Worksheet,
        index: int,
        texts: Sequence[str | None],
        values: Sequence[float],
        look: tuple[str, str],
    ) -> None:
        """Cells of a column from ``FIRST_ROW`` down; a cell without a text is a number.

        Only the ends are cells of openpyxl, which takes most of its time for cells; the
        finishing pass fills in those between, alike but for formula and value.
        """
        last = len(texts) - 1
        self.cells(sheet, index, {0: texts[0], last: texts[last]}, values, look)
        between = [(text or "", value) for text, value in zip(texts, values, strict=True)][1:-1]
        filled = FilledColumn(index, FIRST_ROW + 1, between)
        self.caches.columns.setdefault(sheet.title, []).append(filled)

    def shared(
        self, sheet: Worksheet, index: int, template: str, values: Sequence[float],
        look: tuple[str, str],
    ) -> None:  # fmt: skip
        """Cells of a column whose rows have one formula: a program reads it once."""
        self.cells(sheet, index, {0: at_row(template, FIRST_ROW)}, values, look)
        second = FIRST_ROW + 1
        numbers = column_texts(values)[1:]
        column = SharedColumn(index, second, at_row(template, second), numbers)
        self.caches.columns.setdefault(sheet.title, []).append(column)

    def cells(
        self,
        sheet: Worksheet,
        index: int,
        texts: Mapping[int, str | None],
        values: Sequence[float],
        look: tuple[str, str],
    ) -> None:
        """Write some cells of a column by their offsets from ``FIRST_ROW``."""
        styled = None  # openpyxl takes a fifth of its time to look a style up by its name
        for offset, text in texts.items():
            row = FIRST_ROW + offset
            if text is None:
                sheet.cell(row, index, values[offset])
            else:
                self.formula(sheet, row, index, text, values[offset])
            cell = sheet.cell(row, index)
            if styled is None:
                cell.style, cell.number_format = look
                styled = cell._style
            else:
                cell._style = copy(styled)

    def scalar(self, sheet: Worksheet, scalar: Scalar, decimals: int) -> None:
        """Write the value cell of a scalar, its point below that of others."""
        at = self.layout.cells[scalar.key]
        text = compile_formula(scalar.expr, RowReferences(self.layout, None, sheet.title))
        value, is_name = self.values.scalars[scalar.key], scalar.of in _NAMES_OF_SERIES
        if sheet.title in self.layout.model.drawn and not is_name:
            self.bare(sheet.title, (at.row, at.column), value, text)
            return
        self.formula(sheet, at.row, at.column, text, value)
        cell = sheet.cell(at.row, at.column)
        cell.style = styles.CHECK if scalar.of == "check" else styles.FORMULA
        cell.number_format = _DEGREES if is_name else styles.excel_format(scalar.quantity, decimals)

    def list(self, sheet: Worksheet, block: ScalarTable) -> None:
        """Write a list of scalars: title, symbol, value, unit, source."""
        first_cell = self.layout.places[block.id]
        shift = first_cell.column - 1
        sheet.cell(first_cell.row, first_cell.column, block.title).style = styles.SUBTITLE
        decimals = decimals_in(block)
        for scalar in block.scalars:
            row = self.layout.cells[scalar.key].row
            quantity = scalar.quantity
            if scalar.of != "check":
                texts = {
                    TITLE_COLUMN: capital(scalar.label or quantity.title),
                    SYMBOL_COLUMN: "" if scalar.of == "check_value" else quantity.symbol,
                    UNIT_COLUMN: quantity.unit_label,
                    SOURCE_COLUMN: scalar.source,
                }
                for column, text in texts.items():
                    look = styles.UNIT if column == UNIT_COLUMN else styles.TEXT
                    if column == SYMBOL_COLUMN and text:
                        self.symbol(sheet, row, shift + column, quantity)
                    else:
                        sheet.cell(row, shift + column, text or None).style = look
                if first_cell.column == 1:  # beside a table the rows keep their height
                    raise_row(sheet, row, {
                        texts[TITLE_COLUMN]: TITLE_WIDTH, texts[SYMBOL_COLUMN]: SYMBOL_WIDTH,
                        texts[SOURCE_COLUMN]: SOURCE_WIDTH,
                    })  # fmt: skip
            self.scalar(sheet, scalar, decimals)

    def grid(self, sheet: Worksheet, block: Grid) -> None:
        """Scalars as quantity × instance."""
        corner = self.layout.places[block.id]
        first = self.layout.cells[next(c for c in block.rows[0].cells if c is not None).key].column
        if corner.row > HEADER_ROW:
            sheet.cell(corner.row - 1, corner.column, block.title).style = styles.SUBTITLE
        sheet.cell(corner.row, corner.column, "Величина").style = styles.HEADER
        if first > VALUE_COLUMN - 1:
            sheet.cell(corner.row, corner.column + 1, "Обозначение").style = styles.HEADER
        for offset, label in enumerate(block.labels):
            # A label may be a name that a person gave: never a formula.
            styles.as_text(sheet.cell(corner.row, first + offset, label)).style = styles.HEADER
        if first == VALUE_COLUMN - 1:  # below a table
            raise_row(sheet, corner.row, dict.fromkeys(("Величина", *block.labels), NARROW))
        decimals = decimals_in(block)
        for offset, row in enumerate(block.rows, 1):
            at, quantity = corner.row + offset, row.quantity
            wide = first > VALUE_COLUMN - 1
            label = sheet.cell(at, 1, capital(quantity.title) if wide else None)
            label.style = styles.TEXT
            if not wide:
                self.symbol(sheet, at, 1, quantity, styles.HEADER, unit=True)
            first_cell = next(cell for cell in row.cells if cell is not None)
            if sheet.title not in self.layout.model.drawn:
                formula = self.explained(quantity, first_cell.expr)
                label.comment = note(quantity, first_cell.source, formula)
            if not wide:
                raise_row(sheet, at, {quantity.header: NARROW})
            if wide:
                self.symbol(sheet, at, 2, quantity, unit=True)
                raise_row(sheet, at, {
                    capital(quantity.title): TITLE_WIDTH, quantity.header: SYMBOL_WIDTH,
                })  # fmt: skip
            for scalar in row.cells:
                if scalar is not None:
                    self.scalar(sheet, scalar, decimals)


def number_text(value: float, small: float = 0.0) -> str:
    """Return a value as a cell saves it."""
    if -_ZERO_NOISE <= value <= _ZERO_NOISE:
        return "0"
    return f"{value:{_SHORTER if -small < value < small else _DIGITS}}"


def column_texts(values: Sequence[float]) -> list[str]:
    """Return values of a column as its cells save them: of small ones fewer digits."""
    largest = max(map(abs, values), default=0.0)
    return [number_text(value, 0.1 * largest) for value in values]


def _step_of(values: Sequence[float], most: int) -> float:
    """Return a step of one, two or five that the largest value has up to so many of."""
    largest = max(map(abs, values))
    if not largest:
        return 1.0
    unit = 10.0 ** floor(log10(largest / most))
    return next(step * unit for step in (1, 2, 5, 10) if largest <= most * step * unit)


def decimals_in(block: ScalarTable | Grid) -> int:
    """Most decimals of a block."""
    return styles.decimals_of(scalar.quantity for scalar in scalars_of(block))


def field_symbol(item: Field) -> str:
    """Symbol of an input as text."""
    return plain_symbol(input_symbol_tex(item.symbol))


def note(quantity: Quantity, source: str, formula: str = "") -> Comment:
    """Comment of a header: what the quantity is, its formula and where this stands."""
    text = capital(quantity.title) + (f", {quantity.unit_label}" if quantity.unit_label else "")
    comment = Comment("\n".join(filter(None, (text, formula, source))), "kshm")
    comment.width, comment.height = 260, 70 + 17 * ceil(len(formula) / _NOTE_CHARS)
    return comment
