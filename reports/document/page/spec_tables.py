"""Tables of the report from the specifications: columns over φ, grids, lists of scalars."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np
from markupsafe import Markup

from reports.document.page.blocks import Column, TableBlock, symbol_head, table_block
from reports.document.text import numbers
from reports.document.text.symbols import titled_html
from reports.document.text.terms import Terms
from reports.model.blocks import Grid
from reports.shared.russian import capital
from reports.shared.signs import cleaned

_NO_ANGLE = 1e-6  # deg


def angle_table(
    terms: Terms,
    table: str,
    keys: Sequence[str] | None = None,
    *,
    own_symbols: bool = False,
    step: float = 0.0,
) -> TableBlock:
    """A table over the crank angle, by default with all rows.

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
        cells.append([numbers.of_digits(v, digits) or "—" for v in values])
        tex = terms.tex(f"{table}.{column.key}") if own_symbols else q.tex
        heads.append(Column(symbol_head(tex, q.unit_label)))
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
    """A list «величина, обозначение, значение, единица»."""
    columns = (
        Column("Величина", 5.2, text=True),
        Column("Обозначение", 1.6),
        Column("Значение", 1.6),
        Column("Единица", 1.3),
    )
    # Values of different kinds: Markup keeps them from being lined up as one column.
    return table_block(
        columns, [[titled_html(a), b, Markup("{}").format(_printed(c)), d] for a, b, c, d in rows]
    )


def _printed(value: str) -> str:
    """A value as text that the font has: a name from the input may hold anything."""
    return value if isinstance(value, Markup) else cleaned(value)


def unit_cell(unit: str) -> str:
    """Unit of a cell, a dash for a pure number."""
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
        cells = ["—" if value is None else numbers.of_digits(value, digits) for value in values]
        shown.append([symbol_head(q.tex, q.unit_label), *cells])
    columns = [Column("Величина", 1.4), *(Column(label) for label in labels or grid.labels)]
    return table_block(columns, shown)


def counted_table(terms: Terms, table: str, keys: Sequence[str]) -> TableBlock:
    """A table over the orders; where none of them is a half they are whole numbers."""
    block = angle_table(terms, table, keys)
    ends = {str(row[0])[-2:] for row in block.rows}
    if ends != {",0"}:
        return block
    return replace(block, rows=tuple((str(row[0])[:-2], *row[1:]) for row in block.rows))
