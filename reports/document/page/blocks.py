"""What the macros of the templates are given: columns, tables, sources, title page."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass, field

from markupsafe import Markup

from reports.document.text import numbers
from reports.document.text.symbols import inline_html
from reports.document.text.texts import rich
from reports.shared.russian import NBSP

_WIDTH = 165 / 25.4 * 96  # px of the text's width on paper
_SIZES = {"": 12.0, "dense": 10.5, "tiny": 9.0}  # pt, as in report.css.j2
_LONG = 12  # rows from which a table is worth the lines


@dataclass(frozen=True, slots=True)
class Column:
    """A column of a table.

    Attributes:
        head: Heading; ``Markup`` (see :func:`symbol_head`) passes as it is.
        width: Share of the table's width relative to the other columns.
        group: Heading above this and its neighbours of the same group.
        text: Cells are text: left aligned and wrapped.
    """

    head: str
    width: float = 1.0
    group: str = ""
    text: bool = False


@dataclass(frozen=True, slots=True)
class HeadCell:
    """A cell of the table's heading with its spans."""

    head: str
    colspan: int = 1
    rowspan: int = 1


@dataclass(frozen=True, slots=True)
class TableBlock:
    """A table ready for the macro ``table``: heading rows, widths in per cent, cells.

    ``Column`` numbers and the repeated heading come from the macro; numbers in a column are
    brought in line here.
    """

    columns: tuple[Column, ...]
    rows: tuple[tuple[str, ...], ...]
    head_rows: tuple[tuple[HeadCell, ...], ...] = field(init=False)
    widths: tuple[str, ...] = field(init=False)

    def tabbed(self, size: str) -> Tabbed | None:
        """The same rows as lines with tab stops, or ``None`` where that will not do.

        A cell costs WeasyPrint half a millisecond and a kilobyte or more; a line of ten
        numbers costs hardly more than one cell.  It serves long tables of numbers in equal
        columns, on paper only.
        """
        return _tabbed(self, size)

    def __post_init__(self) -> None:
        for number, row in enumerate(self.rows, 1):
            if len(row) != len(self.columns):
                msg = f"Строка {number} таблицы: ячеек {len(row)}, граф {len(self.columns)}"
                raise ValueError(msg)
        total = sum(column.width for column in self.columns)
        widths = tuple(f"{100 * column.width / total:.2f}%" for column in self.columns)
        object.__setattr__(self, "widths", widths)
        object.__setattr__(self, "head_rows", _head_rows(self.columns))


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


def table_block(columns: Sequence[Column], rows: Sequence[Sequence[str]]) -> TableBlock:
    """Build a table from written cells, bringing the numbers of each column in line."""
    shown = [list(map(_cell, row)) for row in rows]
    for place, column in enumerate(columns):
        if column.text or any(place >= len(row) for row in shown):
            continue
        texts = [row[place] for row in shown]
        if any(isinstance(text, Markup) for text in texts):
            continue
        for row, text in zip(shown, numbers.aligned(texts), strict=True):
            row[place] = text
    return TableBlock(tuple(columns), tuple(map(tuple, shown)))


def symbol_head(symbol_tex: str, unit: str = "") -> Markup:
    """Heading of a column: the symbol and, after a comma, the unit."""
    head = inline_html(symbol_tex)
    return head + Markup(", {}").format(rich(unit)) if unit else head


@dataclass(frozen=True, slots=True)
class DocumentInfo:
    """Metadata of the HTML and the PDF.  ``created`` is an ISO date and must not be the clock's."""

    title: str
    author: str = ""
    subject: str = ""
    keywords: str = ""
    created: str = "2000-01-01"
    generator: str = "kshm"


def _cell(value: object) -> str:
    return value if isinstance(value, str) else str(value)


def _tabbed(block: TableBlock, size: str) -> Tabbed | None:
    count = len(block.columns)
    equal = len({column.width for column in block.columns}) == 1
    if len(block.rows) < _LONG or not equal or any(column.text for column in block.columns):
        return None
    if not all(type(cell) is str and numbers.is_number(cell) for row in block.rows for cell in row):
        return None
    tab = int(_WIDTH / count)
    first = _WIDTH - tab * (count - 1)
    quarter = _SIZES[size] * 96 / 72 / 4
    widest = [max(map(numbers.quarters, cells)) for cells in zip(*block.rows, strict=True)]
    if max(widest) * quarter > tab - 4:
        return None
    middles = [first / 2 - (first - tab), *[tab / 2] * (count - 1)]
    leads = [
        NBSP * max(0, round(middle / quarter - width / 2))
        for middle, width in zip(middles, widest, strict=True)
    ]
    lines = (
        "\t".join(lead + cell for lead, cell in zip(leads, row, strict=True)) for row in block.rows
    )
    return Tabbed(tuple(lines), tab, first)


def _head_rows(columns: tuple[Column, ...]) -> tuple[tuple[HeadCell, ...], ...]:
    if not any(column.group for column in columns):
        return (tuple(HeadCell(column.head) for column in columns),)
    upper: list[HeadCell] = []
    lower: list[HeadCell] = []
    for group, members in itertools.groupby(columns, key=lambda column: column.group):
        heads = [column.head for column in members]
        if group:
            upper.append(HeadCell(group, colspan=len(heads)))
            lower.extend(HeadCell(head) for head in heads)
        else:
            upper.extend(HeadCell(head, rowspan=2) for head in heads)
    return (tuple(upper), tuple(lower))
