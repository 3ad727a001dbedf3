"""What the macros of the templates are given: columns, tables, data of the document."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from markupsafe import Markup

from reports.document.text import numbers
from reports.document.text.symbols import inline_html
from reports.document.text.texts import rich
from reports.shared.russian import NBSP

_LONG = 12  # rows from which a table is worth the lines
_DASH = "—"


@dataclass(frozen=True, slots=True)
class Column:
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

    columns: tuple[Column, ...]
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
        """The same rows as lines with tab stops, or ``None`` where that will not do.

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
        if not all(type(cell) is str and (numbers.is_number(cell) or cell == _DASH)
                   for cell in cells):  # fmt: skip
            return None
        tab = int(width_px / count)
        first = width_px - tab * (count - 1)
        quarter = em_px / 4
        widest = [max(map(numbers.quarters, column)) for column in zip(*self.rows, strict=True)]
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


def table_block(columns: Sequence[Column], rows: Sequence[Sequence[object]]) -> TableBlock:
    """Build a table from written cells, bringing the numbers of each column in line."""
    shown = [[cell if isinstance(cell, str) else str(cell) for cell in row] for row in rows]
    for place, column in enumerate(columns):
        texts = [row[place] for row in shown if place < len(row)]
        if column.text or len(texts) < len(shown) or any(isinstance(t, Markup) for t in texts):
            continue
        for row, text in zip(shown, numbers.aligned(texts), strict=True):
            row[place] = text
    return TableBlock(tuple(columns), tuple(map(tuple, shown)))


def symbol_head(symbol_tex: str, unit: str = "") -> Markup:
    """Heading of a column: the symbol and, after a comma, the unit."""
    head = inline_html(symbol_tex)
    return Markup("{}, {}").format(head, unbroken(unit)) if unit else head


def unbroken(unit: str) -> Markup:
    """A unit that no line ends within."""
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
