"""Cell addresses of everything in the workbook; no other module spells them.

Angle tables begin in the same row of every sheet, so that a row-wise formula
refers to one row number whatever table it reads.  Scalars and inputs are
defined names; cells of grids are absolute addresses.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

from openpyxl.utils import get_column_letter

from reports.formula.excel import number
from reports.inputs.fields import Field
from reports.model.blocks import Block, Grid, Model, ScalarTable, TableSpec, scalars_of
from reports.workbook.orders import Grid as AngleGrid
from reports.workbook.orders import Waves, grid_of, place_of, runs_of, waves_of

OWN_SHEET, BOOK_MARK = "Свои книги", "▸ Книга: "  # of texts of own books; before their names
INPUT_SHEET = "Исходные данные"
CONTENTS_SHEET = "Содержание"
WAVES_SHEET = "Синусы и косинусы"

TITLE_ROW = 1
NOTE_ROW = 2
HEADER_ROW = 4
NUMBER_ROW = 5
FIRST_ROW = 6

# Columns of a scalar list and of the input list.
TITLE_COLUMN, SYMBOL_COLUMN, VALUE_COLUMN, UNIT_COLUMN, SOURCE_COLUMN = 1, 2, 3, 4, 5
MIN_COLUMN, MAX_COLUMN = SOURCE_COLUMN, 6  # of the limits of an input
KEY_COLUMN = 12  # folded, behind the widest list of records

# What is changed most stands together behind what the engine is; words about the work stand last.
_MAIN_DATA, _MAIN_SECTION = "Основные данные", "geometry"
_MAIN_NAMES = {
    "regime_speed_rpm", "gas_max_pressure_mpa", "cycle_max_pressure_mpa", "cycle_power_kw",
    "masses_reciprocating_kg", "masses_piston_group_kg", "masses_rod_kg",
}  # fmt: skip
_ORDER = {"engine": 0, "report": 3, "workbook": 3}
_ROW = "\x01"  # stands for the row number in a formula compiled once for a whole column
_NEXT = "\x02"
_ABOVE = "\x03"
# The column of the first row's order; that of the next row stands beside it.
_BELOW = re.compile("\x05(\\d+)\x05")  # the same for rows
_DOWN_TO_HERE = re.compile(f":[A-Z]+{_ROW}")
_WAVE = re.compile("\x04(\\d+)\x04")


def arranged(inputs: Sequence[Field]) -> list[Field]:
    """Input fields in the order of their sheet, each with the title of its group there."""

    def grouped(item: Field) -> Field:
        main = item.path[0] == _MAIN_SECTION or item.name in _MAIN_NAMES
        return replace(item, section=_MAIN_DATA) if main else item

    def order(item: Field) -> int:
        return 1 if item.section == _MAIN_DATA else _ORDER.get(str(item.path[0]), 2)

    return sorted(map(grouped, inputs), key=order)


@dataclass(frozen=True, slots=True)
class Cell:
    """A cell by sheet title, row and column, both from 1."""

    sheet: str
    row: int
    column: int

    @property
    def coordinate(self) -> str:
        """Relative address within the sheet."""
        return f"{get_column_letter(self.column)}{self.row}"

    @property
    def absolute(self) -> str:
        """Absolute address with the sheet."""
        letter = get_column_letter(self.column)
        return f"{quoted(self.sheet)}!${letter}${self.row}"


def quoted(sheet: str) -> str:
    """Sheet title as a formula writes it."""
    return "'" + sheet.replace("'", "''") + "'"


def column_range(sheet: str, column: int, first: int, last: int) -> str:
    """Absolute range of rows of one column, as charts and formulas of other sheets write it."""
    letter = get_column_letter(column)
    return f"{quoted(sheet)}!${letter}${first}:${letter}${last}"


def area(first: Cell, last: Cell) -> str:
    """Range between two cells of a sheet, without the sheet."""
    return f"{first.coordinate}:{last.coordinate}"


@dataclass
class Layout:
    """Addresses of a model's inputs, scalars and columns."""

    model: Model
    cells: dict[str, Cell] = field(default_factory=dict)  # scalars and inputs
    named: set[str] = field(default_factory=set)
    places: dict[str, Cell] = field(default_factory=dict)  # upper left corners of blocks by id
    columns: dict[str, tuple[TableSpec, int]] = field(default_factory=dict)  # table.column
    next_row: dict[str, int] = field(default_factory=dict)
    next_column: dict[str, int] = field(default_factory=dict)
    beside: dict[str, int] = field(default_factory=dict)  # row of the next list beside a table
    waves: dict[AngleGrid, int] = field(default_factory=dict)  # column of the angles
    run_waves: dict[str, int] = field(default_factory=dict)  # row of a run's angles

    @classmethod
    def of(cls, model: Model) -> Layout:
        """Lay a model out."""
        layout = cls(model)
        layout._inputs()
        angle_sheets = {block.sheet for block in model.blocks if isinstance(block, TableSpec)}
        for block in model.blocks:
            if isinstance(block, TableSpec):
                layout._table(block)
        for block in model.blocks:
            beside_table = block.sheet in angle_sheets
            if isinstance(block, ScalarTable):
                layout._list(block, beside_table=beside_table)
            elif isinstance(block, Grid):
                layout._grid(block, below_table=beside_table)
        column = 1
        for grid, waves in layout.orders.items():
            layout.waves[grid] = column
            column += 1 + sum(map(len, waves.orders.values())) + 1
        row = max((FIRST_ROW + len(rows) for rows, _ in layout.orders), default=HEADER_ROW)
        for run, waves in layout.run_orders.items():
            layout.run_waves[run] = row + 2
            row += 3 + sum(map(len, waves.orders.values()))
        return layout

    @cached_property
    def orders(self) -> Mapping[AngleGrid, Waves]:
        """Orders of the sines and cosines by the grid of their angles."""
        return waves_of(self.model)

    # --- assignment -------------------------------------------------------------------

    def _inputs(self) -> None:
        row, section, entry = NUMBER_ROW, "", None
        for item in arranged(self.model.inputs):
            listed = item.listed
            if item.section != section:
                row += 1 if section else 0
                section, entry = item.section, None
                row += 2 if listed else 1
            if listed:
                # Lists of records stand as small tables: a row an entry, a column a key.
                if entry is not None and item.path[-2] != entry:
                    row += 1
                column = self._entry_column(item)
                entry = item.path[-2]
                self.cells[item.name] = Cell(INPUT_SHEET, row, column)
            else:
                self.cells[item.name] = Cell(INPUT_SHEET, row, VALUE_COLUMN)
                row += 1
            self.named.add(item.name)
        self.next_row[INPUT_SHEET] = row + 2

    def _entry_column(self, item: Field) -> int:
        same = [f for f in self.model.inputs if f.path[:-1] == item.path[:-1]]
        return 2 + [f.name for f in same].index(item.name)

    def _table(self, table: TableSpec) -> None:
        column = self.next_column.get(table.sheet, 1)
        self.places[table.id] = Cell(table.sheet, HEADER_ROW, column)
        for offset, item in enumerate(table.columns):
            self.columns[f"{table.id}.{item.key}"] = (table, column + offset)
        self.next_column[table.sheet] = column + len(table.columns) + 1
        bottom = FIRST_ROW + len(table.rows) + 1
        self.next_row[table.sheet] = max(self.next_row.get(table.sheet, 0), bottom)

    def _list(self, block: ScalarTable, *, beside_table: bool) -> None:
        # Beside a table below the rows that stay in view and are repeated on every sheet.
        rows, top = (self.beside, FIRST_ROW) if beside_table else (self.next_row, HEADER_ROW)
        row = rows.get(block.sheet, top)
        column = self.next_column[block.sheet] if beside_table else 1
        self.places[block.id] = Cell(block.sheet, row, column)
        in_row = 1 if block.verdicts is None else 2  # a verdict beside its value
        for index, scalar in enumerate(block.scalars):
            at = column + VALUE_COLUMN - 1 + index % in_row
            self.cells[scalar.key] = Cell(block.sheet, row + 1 + index // in_row, at)
            self.named.add(scalar.key)
        rows[block.sheet] = row + len(block.scalars) // in_row + 2

    def _grid(self, grid: Grid, *, below_table: bool) -> None:
        row = self.next_row.get(grid.sheet, HEADER_ROW)
        if any(cell.row == row - 2 for cell in self.cells.values() if cell.sheet == grid.sheet):
            row += 1  # the title stands above the header: keep it off the list before
        first = 2 if below_table else 3  # aligned with the columns of the table above
        self.places[grid.id] = Cell(grid.sheet, row, 1)
        for r, grid_row in enumerate(grid.rows):
            for c, scalar in enumerate(grid_row.cells):
                if scalar is not None:
                    self.cells[scalar.key] = Cell(grid.sheet, row + 1 + r, first + c)
        self.next_row[grid.sheet] = row + len(grid.rows) + 3

    # --- addresses --------------------------------------------------------------------

    def last_column(self, blocks: Iterable[Block]) -> int:
        """Last column of some tables, lists and grids of a sheet."""
        last = 1
        for block in blocks:
            first = self.places[block.id].column
            if isinstance(block, TableSpec):
                last = max(last, first + len(block.columns) - 1)
            elif isinstance(block, ScalarTable):
                last = max(last, first + SOURCE_COLUMN - 1)
            else:
                last = max(last, *(self.cells[cell.key].column for cell in scalars_of(block)))
        return last

    def rows_of(self, table: TableSpec) -> range:
        """Sheet rows of a table's data."""
        return range(FIRST_ROW, FIRST_ROW + len(table.rows))

    def column_of(self, key: str) -> int:
        """Sheet column of ``table.column``."""
        return self.columns[key][1]

    def name_of(self, key: str) -> str:
        """Return defined name of a scalar or input, or the absolute address of a grid's cell."""
        return key if key in self.named else self.cells[key].absolute

    def range_of(self, key: str, *, rows: int | None = None) -> str:
        """Absolute range of a column, of a grid's row (``grid.quantity``) or of input points."""
        if key in self.columns:
            table, column = self.columns[key]
            last = FIRST_ROW + (rows or len(table.rows)) - 1
            return column_range(table.sheet, column, FIRST_ROW, last)
        cells = self.cells_of_run(key)
        first, last_cell = cells[0], cells[(rows or len(cells)) - 1]
        ends = f"${get_column_letter(last_cell.column)}${last_cell.row}"
        return f"{first.absolute}:{ends}"

    @cached_property
    def run_orders(self) -> Mapping[str, Waves]:
        """Orders of the sines and cosines by the run of their angles."""
        return runs_of(self.model)

    def wave_row(self, turn: str, run: str, orders: tuple[float, ...]) -> int:
        """Sheet row of a function of the first of some orders times the angles of a run."""
        return self.run_waves[run] + 1 + _place(self.run_orders[run], turn, orders)

    def wave_column(self, turn: str, grid: AngleGrid, orders: tuple[float, ...]) -> int:
        """Sheet column of a function of the first of some orders times the angles of a grid."""
        return self.waves[grid] + 1 + _place(self.orders[grid], turn, orders)

    def cells_of_run(self, key: str) -> list[Cell]:
        """Cells of a grid's row or of input points, see ``keys_of_run``."""
        return [self.cells[name] for name in self.keys_of_run(key)]

    def keys_of_run(self, key: str) -> tuple[str, ...]:
        """Scalars of a grid's row ``grid.quantity``, or the inputs of a diagram's points.

        Raises:
            KeyError: there is no such run.
        """
        return self.model.input_runs.get(key) or self.model.grid_runs[key]

    def step_formula(self, table: TableSpec, row: int, column: int) -> str:
        """First column of a row from the row above and the step of the table's grid."""
        # A fraction, because 0.1 in a formula would look like an input typed into it.
        fraction = f"1/{round(1 / table.step)}" if table.step and table.step < 1 else None
        step = "calculation_step_deg" if table.step is None else fraction or number(table.step)
        return f"={Cell('', row - 1, column).coordinate}+{step}"

    def defined_names(self) -> Mapping[str, str]:
        """Return defined name → absolute address."""
        return {name: self.cells[name].absolute for name in sorted(self.named)}


def _place(waves: Waves, turn: str, orders: tuple[float, ...]) -> int:
    """Return the number of the waves that stand before some orders."""
    names = tuple(waves.orders)
    before = sum(len(waves.orders[name]) for name in names[: names.index(turn)])
    position = place_of(waves.orders[turn], orders)
    assert position is not None
    return before + position


class RowReferences:
    """References of a formula compiled once for a whole column, see ``at_row``.

    Cells of the formula's own sheet are called without its title.
    """

    def __init__(self, layout: Layout, table: TableSpec | None, sheet: str = "") -> None:
        self._layout = layout
        self._table = table
        self._own = quoted(sheet or (table.sheet if table is not None else "")) + "!"

    def name(self, key: str) -> str:
        """Scalar, or this row's cell of a column."""
        column = self._column(key)
        if column is None:
            return self._layout.name_of(key).removeprefix(self._own)
        return self._cell(column, _ROW)

    def column(self, key: str, *, repeat_last: bool) -> str:
        """Whole column."""
        full = self._qualified(key)
        if repeat_last:
            return self._layout.range_of(full).removeprefix(self._own)
        if full in self._layout.columns:
            count = len(self._layout.columns[full][0].rows)
        else:
            count = len(self._layout.cells_of_run(full))
        return self._layout.range_of(full, rows=count - 1).removeprefix(self._own)

    def last(self, key: str) -> str:
        """Last cell of a column."""
        table, column = self._layout.columns[self._qualified(key)]
        last = Cell(table.sheet, FIRST_ROW + len(table.rows) - 1, column).absolute
        return last.removeprefix(self._own)

    def following(self, key: str) -> str:
        """Next row's cell."""
        return self._cell(self._layout.columns[self._qualified(key)], _NEXT)

    def previous(self, key: str) -> str:
        """Cell of the row above; in the first row that of the header."""
        return self._cell(self._layout.columns[self._qualified(key)], _ABOVE)

    def down_to_here(self, key: str) -> str:
        """Column from its first row down to this row."""
        column = self._layout.columns[self._qualified(key)]
        here = self._cell(column, _ROW)
        letter = get_column_letter(column[1])
        prefix, separator, last = here.rpartition("!")
        return f"{prefix}{separator}${letter}${FIRST_ROW}:{last}"

    def each(self, key: str) -> list[str]:
        """Cells of a run."""
        full = self._qualified(key)
        if full in self._layout.columns:
            table, column = self._layout.columns[full]
            cells = [Cell(table.sheet, row, column) for row in self._layout.rows_of(table)]
        else:
            cells = self._layout.cells_of_run(full)
        return [cell.absolute.removeprefix(self._own) for cell in cells]

    def wave(self, turn: str, angle: str, order: float | str) -> str:
        """Sines or cosines of an order; of each row's own where it is a column."""
        grid = grid_of(self._layout.columns[self._qualified(angle)][0])
        last = FIRST_ROW + len(grid[0]) - 2
        column = self._layout.wave_column(turn, grid, self._orders(order))
        if isinstance(order, float):
            return column_range(WAVES_SHEET, column, FIRST_ROW, last)
        letter = f"\x04{column}\x04"
        return f"{quoted(WAVES_SHEET)}!${letter}${FIRST_ROW}:${letter}${last}"

    def run_wave(self, turn: str, angles: str, order: float | str) -> str:
        """Sines or cosines of a run's angles; of each row's own order where it is a column."""
        row = str(self._layout.wave_row(turn, angles, self._orders(order)))
        mark = row if isinstance(order, float) else f"\x05{row}\x05"
        last = get_column_letter(1 + len(self._layout.keys_of_run(angles)))
        return f"{quoted(WAVES_SHEET)}!$B${mark}:${last}${mark}"

    def _orders(self, order: float | str) -> tuple[float, ...]:
        """Return an order, or those of the table's rows."""
        if isinstance(order, float):
            return (order,)
        assert self._table is not None
        return self._table.rows

    def _qualified(self, key: str) -> str:
        local = f"{self._table.id}.{key}" if self._table is not None else key
        return local if local in self._layout.columns else key

    def _column(self, key: str) -> tuple[TableSpec, int] | None:
        return self._layout.columns.get(self._qualified(key))

    def _cell(self, placed: tuple[TableSpec, int], row: str) -> str:
        table, column = placed
        letter = get_column_letter(column)
        if self._table is not None and table.sheet == self._table.sheet:
            return f"{letter}{row}"
        return f"{quoted(table.sheet)}!{letter}{row}"


def at_row(formula: str, row: int, *, last: bool = False) -> str:
    """Return a column's formula in one row; in the last row the following row is the row itself."""
    below = str(row if last else row + 1)
    if "\x05" in formula:
        formula = _BELOW.sub(lambda match: str(int(match[1]) + row - FIRST_ROW), formula)
    if "\x04" in formula:
        formula = _WAVE.sub(
            lambda match: get_column_letter(int(match[1]) + row - FIRST_ROW), formula
        )
    return formula.replace(_ROW, str(row)).replace(_NEXT, below).replace(_ABOVE, str(row - 1))


def can_share(formula: str) -> bool:
    """Whether one formula serves all rows of a column as spreadsheet programs shift it.

    They share none that names another sheet; what rows above give, LibreOffice then calculates in
    another order and to other last digits.
    """
    marks = any(mark in formula for mark in ("!", _NEXT, _ABOVE, "\x04", "\x05"))
    return not marks and _DOWN_TO_HERE.search(formula) is None


def check_names(layout: Layout) -> None:
    """Refuse names that Excel would not tell apart.

    Raises:
        ValueError: two names differ only in case.
    """
    seen: dict[str, str] = {}
    for name in layout.named:
        other = seen.setdefault(name.casefold(), name)
        if other != name:
            raise ValueError(f"names {other} and {name} differ only in case")
