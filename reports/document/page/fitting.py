"""Fit of tables and paragraphs: widths, smaller type, parts by columns, count of lines.

No number may be broken and nothing may stand over the edge of the page; so the width that
every column needs is found from what stands in it.
"""

from __future__ import annotations

import functools
import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from html import unescape
from typing import TYPE_CHECKING, NamedTuple

from markupsafe import Markup

from reports.document.page.blocks import TableBlock, TableColumn
from reports.document.page.style import USUAL, Style
from reports.draw.fonts import text_em
from reports.shared.russian import NBSP

if TYPE_CHECKING:
    from pyphen import Pyphen

_SIZES = ("", "dense", "tiny")
_AROUND = 8.5  # px of padding and rule of a cell
_WORD_EM = 9.0  # from which a word of a text is hyphenated
_SMALL = re.compile(r"<su[bp]>(.*?)</su[bp]>")
_SMALLER = 0.7  # of indices, as in report.css.j2
_SLANTED = 1.06  # slanted letters may be a little wider than upright ones
_ROOM = 0.999  # rounding of the widths in per cent
DIVIDED = (4, 2, 2)  # letters of a word that is divided and of its parts, at least
_TOKEN = re.compile(r"<(/?)(\w+)([^>]*)>|([^<]+)")
_UNBROKEN = re.compile(r'class="(?:nb|ref)"')
# After a hyphen, a dash or a stroke before a letter a line may end.
_PARTS = re.compile(r"(?<=[^\W\d]-)(?=[^\W\d])|(?<=–)(?=[^\s])|(?<=[^\W\d]/)(?=[^\W\d]|\()")
_LETTERS = re.compile(r"[^\W\d_]+")
_MIN_PT = 5.0
_LINE = 1.12  # of the type


def fitted(block: TableBlock, size: str, style: Style) -> tuple[list[TableBlock], str]:
    """Return the table with widths that nothing overflows.

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


def _head_em(column: TableColumn) -> float:
    return max(map(_width, _pieces(column.head)), default=0.0)


def _cell_em(cell: str, column: TableColumn) -> float:
    widest = max(map(_width, _pieces(cell)), default=0.0)
    return min(widest, _WORD_EM) if column.text else widest


def _pieces(text: str) -> Sequence[str]:
    """Unbreakable pieces of a line."""
    return re.split(r" (?![^<]*>)|<br>|(?<=-)(?=[А-яё])", text)


def _width(piece: str) -> float:
    """Width of a piece of text or markup [em]."""
    if not isinstance(piece, Markup) and "<" not in piece:
        return text_em(piece)
    small = sum(text_em(Markup(inner).striptags()) for inner in _SMALL.findall(piece))
    text = Markup(_SMALL.sub("", piece)).striptags()
    return _SLANTED * (text_em(text.replace(" ", NBSP)) + _SMALLER * small)


def _spread(block: TableBlock, needs: Sequence[float], width: float) -> TableBlock:
    """Widths by the shares of the columns, none below its need."""
    total = sum(column.width for column in block.columns)
    if all(need <= width * c.width / total for need, c in zip(needs, block.columns, strict=True)):
        return block
    fixed: set[int] = set()
    widths = list(needs)
    while True:
        free = [i for i in range(len(needs)) if i not in fixed]
        room = width - sum(needs[i] for i in fixed)
        shares = sum(block.columns[i].width for i in free)
        short = [i for i in free if room * block.columns[i].width / shares < needs[i]]
        if not short or len(short) == len(free):
            for i in free:
                widths[i] = max(needs[i], room * block.columns[i].width / shares)
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


def _part(block: TableBlock, columns: Sequence[int]) -> TableBlock:
    return TableBlock(
        tuple(block.columns[i] for i in columns),
        tuple(tuple(row[i] for i in columns) for row in block.rows),
        tuple(i + 1 for i in columns),
    )


def type_pt(text: str, width_mm: float, height_mm: float, usual_pt: float) -> float:
    """Return the type in which a text fits into a cell: smaller in one line, else in several lines.

    Returns:
        Size [pt]; 0 if the text does not fit even in the smallest type.
    """
    # A line may end after a hyphen too.
    words = [text_em(word) for word in re.split(r"\s+|(?<=\w-)(?=\w)", text.strip()) if word]
    whole = sum(words) + 0.25 * max(0, len(words) - 1)
    count = round((usual_pt - _MIN_PT) / 0.5) + 1
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


class _Piece(NamedTuple):
    """An unbreakable piece of a line; plain text may be hyphenated."""

    width: float
    space: float  # after it
    text: str = ""


def line_count(html: str, room: float, *, indent: float = 0.0, divided: bool = True) -> int:
    """Lines of a paragraph.

    Args:
        html: Its text; the only elements are inline ones.
        room: Width of a line [em].
        indent: Of the first line [em].
        divided: Words are hyphenated.
    """
    lines, used = 1, indent
    for width, space, text in _line_pieces(html):
        if used + width <= room or not used:
            used += width + space
            continue
        remainder = _divided(text, room - used) if text and divided else 0.0
        lines, used = lines + 1, (remainder or width) + space
    return lines


def _line_pieces(html: str) -> Iterator[_Piece]:
    """Pieces of the text with their widths."""
    width, plain, text = 0.0, True, ""
    for run, small, unbroken, slanted in _runs(html):
        scale = _SMALLER if small else 1.0
        words = [run] if unbroken else re.split(r"( +)", run)
        for word in words:
            if word and not word.strip(" "):
                if width:
                    yield _Piece(width, text_em(" "), text if plain else "")
                width, plain, text = 0.0, True, ""
                continue
            parts = [word] if unbroken or small else _PARTS.split(word)
            for part in parts[:-1]:
                width += scale * text_em(part, slanted=slanted)
                yield _Piece(width, 0.0, text + part if plain else "")
                width, plain, text = 0.0, True, ""
            width += scale * text_em(parts[-1], slanted=slanted)
            plain = plain and not (small or unbroken or slanted)
            text += parts[-1]
    if width:
        yield _Piece(width, 0.0, text if plain else "")


def _runs(html: str) -> Iterator[tuple[str, bool, bool, bool]]:
    """Stretches of text: whether they are small, must not be divided, are slanted."""
    small = unbroken = slanted = 0
    open_tags: list[tuple[bool, bool, bool]] = []
    for closing, tag, attributes, text in _TOKEN.findall(html):
        if text:
            run = re.sub(r"[ \n\t]+", " ", unescape(text))
            yield run, small > 0, unbroken > 0, slanted > 0
        elif closing:
            if open_tags:
                less, whole, turned = open_tags.pop()
                small, unbroken, slanted = small - less, unbroken - whole, slanted - turned
        elif tag not in ("br", "img") and not attributes.endswith("/"):
            less, whole = tag in ("sub", "sup"), bool(_UNBROKEN.search(attributes))
            open_tags.append((less, whole, tag == "i"))
            small, unbroken, slanted = small + less, unbroken + whole, slanted + (tag == "i")


def _divided(text: str, room: float) -> float:
    """Width of the part of a word that goes on to the next line; 0 if none fits before."""
    word = next((m for m in _LETTERS.finditer(text) if len(m.group()) >= DIVIDED[0]), None)
    if word is None:
        return 0.0
    for split in reversed(_places(word.group())):
        at = word.start() + split
        if text_em(text[:at]) + text_em("-") <= room:
            return text_em(text[at:])
    return 0.0


@functools.lru_cache(maxsize=4096)
def _places(word: str) -> tuple[int, ...]:
    return tuple(_dictionary().positions(word))


@functools.cache
def _dictionary() -> Pyphen:
    from pyphen import Pyphen

    return Pyphen(lang="ru_RU", left=DIVIDED[1], right=DIVIDED[2])
