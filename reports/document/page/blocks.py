"""Tables of the document: columns, rows, lists of quantities; its metadata."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from markupsafe import Markup

from reports.document.text.symbols import inline_html, titled_html
from reports.document.text.terms import Terms
from reports.document.text.texts import aligned, is_number, of_digits, quarters, rich
from reports.model.blocks import Grid
from reports.shared.font_coverage import cleaned
from reports.shared.russian import NBSP, capital

_LONG = 12  # rows from which a table is worth the lines
_DASH = "—"
_NO_ANGLE = 1e-6  # deg
_WORD = re.compile("[а-яё]{4,}")


@dataclass(frozen=True, slots=True)
class TableColumn:
    """A column of a table.

    Attributes:
        head: Heading; ``Markup`` (see :func:`symbol_head`) passes as it is.
        width: Share of the table's width relative to the other columns.
        text: Cells are text: left aligned and wrapped.
    """

    head: str
    width: float = 1.0
    text: bool = False


@dataclass(frozen=True, slots=True)
class Tabbed:
    """Rows as lines: ``tab`` is the width of a column, ``first`` that of the first one [px]."""

    lines: tuple[str, ...]
    tab: int
    first: float

    @property
    def indent(self) -> float:
        """Room before the first tab stop grid begins [px]."""
        return self.first - self.tab


@dataclass(frozen=True, slots=True)
class TableBlock:
    """A table ready for the macro ``table``; column numbers and repeated heading come from it.

    Attributes:
        columns: Headings and widths.
        rows: Cells.
        numbers: Numbers of the columns; empty for 1, 2, 3 …
    """

    columns: tuple[TableColumn, ...]
    rows: tuple[tuple[str, ...], ...]
    numbers: tuple[int, ...] = ()

    def __post_init__(self) -> None:
        for number, row in enumerate(self.rows, 1):
            if len(row) != len(self.columns):
                msg = f"Строка {number} таблицы: ячеек {len(row)}, граф {len(self.columns)}"
                raise ValueError(msg)

    @property
    def numbered(self) -> Sequence[int]:
        """Numbers of the columns."""
        return self.numbers or range(1, len(self.columns) + 1)

    @property
    def widths(self) -> list[str]:
        """Widths of the columns in per cent."""
        total = sum(column.width for column in self.columns)
        return [f"{100 * column.width / total:.2f}%" for column in self.columns]

    def tabbed(self, em_px: float, width_px: float) -> Tabbed | None:
        """Return the same rows as lines with tab stops, or ``None`` where that will not do.

        A cell costs WeasyPrint half a millisecond and a kilobyte or more; a line of ten
        numbers costs hardly more than one cell.  It serves long tables of numbers in equal
        columns, on paper only.

        Args:
            em_px: Size of the table's type.
            width_px: Width of the table.
        """
        count = len(self.columns)
        equal = len({column.width for column in self.columns}) == 1
        if len(self.rows) < _LONG or not equal or any(column.text for column in self.columns):
            return None
        cells = [cell for row in self.rows for cell in row]
        if not all(type(cell) is str and (is_number(cell) or cell == _DASH)
                   for cell in cells):  # fmt: skip
            return None
        tab = int(width_px / count)
        first = width_px - tab * (count - 1)
        quarter = em_px / 4
        widest = [max(map(quarters, column)) for column in zip(*self.rows, strict=True)]
        if max(widest) * quarter > tab - 4:
            return None
        middles = [tab - first / 2, *[tab / 2] * (count - 1)]
        leads = [
            NBSP * max(0, round(middle / quarter - width / 2))
            for middle, width in zip(middles, widest, strict=True)
        ]
        dashes = [NBSP * max(0, round(middle / quarter - 2)) + _DASH for middle in middles]
        lines = (
            "\t".join(
                dash if cell == _DASH else lead + cell
                for lead, dash, cell in zip(leads, dashes, row, strict=True)
            )
            for row in self.rows
        )
        return Tabbed(tuple(lines), tab, first)


def table_block(columns: Sequence[TableColumn], rows: Sequence[Sequence[object]]) -> TableBlock:
    """Build a table from written cells, bringing the numbers of each column in line.

    Headings of columns and rows begin with a capital letter.
    """
    shown = [[cell if isinstance(cell, str) else str(cell) for cell in row] for row in rows]
    for row in shown:
        row[:1] = map(_heading, row[:1])
    columns = [replace(column, head=_heading(column.head)) for column in columns]
    for number, column in enumerate(columns):
        texts = [row[number] for row in shown if number < len(row)]
        if column.text or len(texts) < len(shown) or any(isinstance(t, Markup) for t in texts):
            continue
        for row, text in zip(shown, aligned(texts), strict=True):
            row[number] = text
    return TableBlock(tuple(columns), tuple(map(tuple, shown)))


def _heading(text: str) -> str:
    """Return a heading whose first word is large; a unit, «кВт», stays what it is."""
    return capital(text) if _WORD.match(text) else text


def symbol_head(symbol_tex: str, unit: str = "") -> Markup:
    """Heading of a column: the symbol and, after a comma, the unit."""
    head = inline_html(symbol_tex)
    return Markup("{}, {}").format(head, unbroken(unit)) if unit else head


def unbroken(unit: str) -> Markup:
    """Return a unit that no line ends within."""
    return Markup('<span class="nb">{}</span>' if "/" in unit else "{}").format(rich(unit))


@dataclass(frozen=True, slots=True)
class DocumentInfo:
    """Metadata of the HTML and the PDF.  ``created`` is an ISO date and must not be the clock's."""

    title: str
    author: str = ""
    subject: str = ""
    keywords: str = ""
    created: str = "2000-01-01"
    generator: str = "kshm"


def angle_table(
    terms: Terms,
    table: str,
    keys: Sequence[str] | None = None,
    *,
    own_symbols: bool = False,
    step: float = 0.0,
) -> TableBlock:
    """Return a table over the crank angle, by default with all rows.

    Args:
        terms: symbols and values.
        table: id of the table.
        keys: its columns, by default all but the helpers.
        own_symbols: symbols of formulas instead of those of the nomenclature.
        step: print the rows at multiples of this angle [deg] and the last one; 0 prints all.
    """
    spec = terms.model.tables[table]
    columns = [c for c in spec.columns if (c.key in keys if keys else not c.helper)]
    cells: list[list[str]] = []
    heads = []
    for column in columns:
        q = column.quantity
        values = np.asarray(terms.values.columns[table][column.key], dtype=float).tolist()
        digits = q.digits.within(max(map(abs, values)))
        cells.append([of_digits(v, digits) or "—" for v in values])
        tex = terms.tex(f"{table}.{column.key}") if own_symbols else q.tex
        heads.append(TableColumn(symbol_head(tex, q.unit_label)))
    rows = list(zip(*cells, strict=True))
    if step:
        angles = np.asarray(spec.rows, dtype=float)
        kept = np.abs(np.remainder(angles + step / 2, step) - step / 2) < _NO_ANGLE
        kept[-1] = True
        rows = [row for row, keep in zip(rows, kept, strict=True) if keep]
    return table_block(heads, rows)


def scalar_table(terms: Terms, keys: Iterable[str]) -> TableBlock:
    """Quantity, symbol, value, unit: one row for each scalar."""
    rows = [
        [capital(terms.title(k)), terms.sym(k), terms.num(k), unit_cell(terms.unit(k))]
        for k in keys
    ]
    return list_block(rows)


def list_block(rows: Sequence[Sequence[str]]) -> TableBlock:
    """Return a list «величина, обозначение, значение, единица»."""
    columns = (
        TableColumn("Величина", 5.2, text=True),
        TableColumn("Обозначение", 1.6),
        TableColumn("Значение", 1.6),
        TableColumn("Единица", 1.3),
    )
    # Values of different kinds: Markup keeps them from being lined up as one column.
    return table_block(
        columns, [[titled_html(a), b, Markup("{}").format(_printed(c)), d] for a, b, c, d in rows]
    )


def _printed(value: str) -> str:
    """Return a value as text that the font has: a name from the input may hold anything."""
    return value if isinstance(value, Markup) else cleaned(value)


def unit_cell(unit: str) -> str:
    """Return the unit of a cell, a dash for a pure number."""
    return unit or "—"


def grid_table(
    terms: Terms, grid: Grid, rows: Iterable[str] = (), labels: Iterable[str] = ()
) -> TableBlock:
    """A grid with its instances as columns; ``rows`` names the quantities to show, all else."""
    by_key = {row.of: row for row in grid.rows}
    shown = []
    for row in (by_key[key] for key in rows or by_key if key in by_key):
        q = row.quantity
        values = [None if cell is None else terms.value(cell.key) for cell in row.cells]
        digits = q.digits.within(max(abs(value or 0) for value in values))
        cells = ["—" if value is None else of_digits(value, digits) for value in values]
        shown.append([symbol_head(q.tex, q.unit_label), *cells])
    columns = [
        TableColumn("Величина", 1.4),
        *(TableColumn(label) for label in labels or grid.labels),
    ]
    return table_block(columns, shown)


def counted_table(terms: Terms, table: str, keys: Sequence[str]) -> TableBlock:
    """Return a table over the orders; where none of them is a half they are whole numbers."""
    block = angle_table(terms, table, keys)
    ends = {str(row[0])[-2:] for row in block.rows}
    if ends != {",0"}:
        return block
    return replace(block, rows=tuple((str(row[0])[:-2], *row[1:]) for row in block.rows))
