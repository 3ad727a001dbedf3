"""A table made to fit the width of the text: other widths, smaller type, parts by columns.

No number may be broken and nothing may stand over the edge of the page; so the width that
every column needs is found from what stands in it.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from markupsafe import Markup

from reports.document.page.blocks import Column, TableBlock
from reports.document.page.style import USUAL, Style
from reports.document.text.fonts import text_em
from reports.shared.russian import NBSP

_SIZES = ("", "dense", "tiny")
_AROUND = 8.5  # px of padding and rule of a cell
_WORD_EM = 9.0  # from which a word of a text is hyphenated
_SMALL = re.compile(r"<su[bp]>(.*?)</su[bp]>")
_SMALLER = 0.7  # of indices, as in report.css.j2
_SLANTED = 1.06  # slanted letters may be a little wider than upright ones
_ROOM = 0.999  # rounding of the widths in per cent


def fitted(block: TableBlock, size: str, style: Style) -> tuple[list[TableBlock], str]:
    """The table with widths that nothing overflows.

    Args:
        block: The table.
        size: Name of its type, ``""``, ``"dense"`` or ``"tiny"``.
        style: Width of the text and size of the type.

    Returns:
        One block, or several with the first column repeated, and the name of the type.
    """
    width = style.width_px * _ROOM
    sizes = _SIZES[_SIZES.index(size) :]
    for name in sizes:
        needs = _needs(block, style.table_em_px(name))
        if sum(needs) <= width:
            return [_spread(block, needs, width)], name
    name = sizes[min(1, len(sizes) - 1)]
    return [
        _spread(part, _needs(part, style.table_em_px(name)), width)
        for part in _parts(block, _needs(block, style.table_em_px(name)), width)
    ], name


def least_width(block: TableBlock) -> int:
    """Width below which the table would have to be scrolled on a screen [px]."""
    return round(sum(_needs(block, USUAL.table_em_px(""))))


def _needs(block: TableBlock, em: float) -> list[float]:
    """Least width of each column [px] at a size of the type [px]."""
    cells = zip(*block.rows, strict=True) if block.rows else [()] * len(block.columns)
    return [
        _AROUND + em * max(_head_em(column), *(_cell_em(cell, column) for cell in column_cells), 0)
        for column, column_cells in zip(block.columns, cells, strict=True)
    ]


def _head_em(column: Column) -> float:
    return max(map(_width, _pieces(column.head)), default=0.0)


def _cell_em(cell: str, column: Column) -> float:
    widest = max(map(_width, _pieces(cell)), default=0.0)
    return min(widest, _WORD_EM) if column.text else widest


def _pieces(text: str) -> Sequence[str]:
    """What a line may not be broken within; tags have no spaces here but in attributes."""
    return re.split(r" (?![^<]*>)|<br>|(?<=-)(?=[А-яё])", text)


def _width(piece: str) -> float:
    """Width of a piece of text or markup [em]."""
    if not isinstance(piece, Markup) and "<" not in piece:
        return text_em(piece)
    small = sum(text_em(Markup(inner).striptags()) for inner in _SMALL.findall(piece))
    rest = Markup(_SMALL.sub("", piece)).striptags()
    return _SLANTED * (text_em(rest.replace(" ", NBSP)) + _SMALLER * small)


def _spread(block: TableBlock, needs: Sequence[float], width: float) -> TableBlock:
    """Widths by the shares of the columns, none below its need."""
    total = sum(column.width for column in block.columns)
    if all(need <= width * c.width / total for need, c in zip(needs, block.columns, strict=True)):
        return block
    fixed: set[int] = set()
    widths = list(needs)
    while True:
        free = [i for i in range(len(needs)) if i not in fixed]
        rest = width - sum(needs[i] for i in fixed)
        shares = sum(block.columns[i].width for i in free)
        short = [i for i in free if rest * block.columns[i].width / shares < needs[i]]
        if not short or len(short) == len(free):
            for i in free:
                widths[i] = max(needs[i], rest * block.columns[i].width / shares)
            break
        fixed.update(short)
    columns = [replace(c, width=w) for c, w in zip(block.columns, widths, strict=True)]
    return replace(block, columns=tuple(columns))


def _parts(block: TableBlock, needs: Sequence[float], width: float) -> list[TableBlock]:
    """Parts of about equally many columns, the first column in each."""
    others = range(1, len(needs))
    for count in range(2, len(needs)):
        size = -(-len(others) // count)
        groups = [others[start : start + size] for start in range(0, len(others), size)]
        if all(needs[0] + sum(needs[i] for i in group) <= width for group in groups):
            break
    return [_part(block, (0, *group)) for group in groups]


def _part(block: TableBlock, places: Sequence[int]) -> TableBlock:
    return TableBlock(
        tuple(block.columns[i] for i in places),
        tuple(tuple(row[i] for i in places) for row in block.rows),
        tuple(i + 1 for i in places),
    )


_LEAST_PT = 5.0
_LINE = 1.12  # of the type


def type_pt(text: str, width_mm: float, height_mm: float, usual_pt: float) -> float:
    """The type in which a text fits into a cell: smaller in one line, else in several lines.

    Returns:
        Size [pt]; 0 if the text does not fit even in the smallest type.
    """
    # A line may end after a hyphen too.
    words = [text_em(word) for word in re.split(r"\s+|(?<=\w-)(?=\w)", text.strip()) if word]
    whole = sum(words) + 0.25 * max(0, len(words) - 1)
    count = round((usual_pt - _LEAST_PT) / 0.5) + 1
    sizes = [usual_pt - 0.5 * step for step in range(count)]
    if height_mm < 2 * usual_pt * _LINE * 25.4 / 72:  # a cell of one line
        sizes.sort(key=lambda size: whole * size / 72 * 25.4 > width_mm)
    for size in sizes:
        room = width_mm / 25.4 * 72 / size
        lines, used = 1, 0.0
        for word in words:
            if used and used + 0.25 + word > room:
                lines, used = lines + 1, 0.0
            used += word + (0.25 if used else 0.0)
        if max(words, default=0.0) <= room and lines * size * _LINE <= height_mm / 25.4 * 72:
            return size
    return 0.0
