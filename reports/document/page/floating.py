"""Figures and small tables that float: to the top of the next page while the text goes on.

WeasyPrint knows no floats of the page, so the places are chosen beforehand: the heights of all
blocks are estimated, the pages of a chapter are filled with them, and what does not fit at the
foot of a page is put behind the text that does, at the next place between two paragraphs.  An
estimate that is wrong by some lines costs no more than these lines of blank paper.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Literal, NamedTuple

from markupsafe import Markup

from reports.document.page.style import Style
from reports.document.text.fonts import text_em

Kind = Literal["chapter", "heading", "text", "tied", "float", "table", "other"]

_TAG = re.compile(r"<(/?)(p|h[1-3]|div|figure|ul|ol|nav|section)\b([^>]*)>")
_HEADING = re.compile(r"<h[1-3]")
_WIDTH = re.compile(r'<(?:svg|img) class="fig"[^>]*?style="width:([\d.]+)mm')
_BOX = re.compile(r'data-size="([\d.]+)/([\d.]+)"')
_EM = re.compile(r"height:([\d.]+)em")
_NUMBERED = re.compile(r'<span class="hn">(\d+)')
_ROW = re.compile(r"<tr.*?</tr>", re.DOTALL)
_CELL = re.compile(r"<t[dh]([^>]*)>(.*?)</t[dh]>", re.DOTALL)
_SHARE = re.compile(r'<col style="width:([\d.]+)%')
_SMALL = re.compile(r"<su[bp]>(.*?)</su[bp]>", re.DOTALL)
_TAGS = re.compile(r"<(?!/?su[bp]\b)[^>]*>")  # all but those of indices
_PT = 96 / 72  # CSS pixels in a point
_FULL = 0.97  # of a line that words fill on the average
_LEAST = 0.7  # to which a figure may be reduced to fit the foot of a page
_SLACK = 0.5  # px kept free on every page: estimates are no measures
_HOLE = 0.12  # of a page that may stay blank, so that figures stand in their own section
_ROWS = 60.0  # px of a table's margin and first rows, which stand with its head
_NEARLY = 0.07  # of a page: too little for a heading and what must follow it
# px kept free below what would miss the page by a hair, where each chapter begins its page and
# where chapters run on: there the estimates of all pages before add up.
_DOUBT, _DOUBT_ON = 10.0, 45.0


class Spot(NamedTuple):
    """Where on a page the last block ends and the margin that it asks for below [px].

    ``page`` counts the pages of the body from one.
    """

    used: float
    margin: float = 0.0
    page: int = 1


@dataclass(frozen=True, slots=True)
class Block:
    """A block of the text and its estimated height without margins [px].

    ``tied`` blocks continue what stands before them, a formula or a line of its sentence.
    """

    html: str
    kind: Kind
    height: float
    above: float = 0.0  # margins; the larger of two that meet is kept
    below: float = 0.0
    figure: float = 0.0  # of it the picture, which may be reduced
    head: float = 0.0  # of it what a table repeats on each page that it goes on to
    rows: tuple[float, ...] = ()
    line: float = 0.0  # of a paragraph, and of what a heading must have below it
    least: int = 2  # lines of a paragraph that stand together


def arranged(body: str, style: Style, *, run_on: float = 1.0) -> str:
    """The text with its figures and small tables where they leave no hole in the page.

    Args:
        body: HTML of the chapters.
        style: Sizes of sheet and type.
        run_on: A numbered chapter follows on the same page if this share of it is free.
    """
    room = (297 - style.margins.top - style.margins.bottom) * 96 / 25.4 - _SLACK
    doubt = _DOUBT_ON if run_on < 1 else _DOUBT
    out: list[str] = []
    chapter: list[Block] = []
    spot = Spot(room, page=0)
    for block in _blocks(str(body), style):  # no Markup: nothing is escaped here
        if block.kind == "chapter":
            placed, spot = _filled(chapter, spot, room, doubt)
            out += placed
            follows = bool(chapter) and not {_number(chapter[0]), _number(block)} & {""}
            chapter = []
            # A page all but full may run over by a line: then the heading follows that line.
            free = (room - spot.used) / room
            if follows and run_on < 1 and (free > run_on or free < _NEARLY):
                html = block.html.replace('class="', 'class="runon ', 1)
                block = replace(block, html=html, above=18 * _PT)  # noqa: PLW2901
            else:
                spot = Spot(0.0, page=spot.page + 1)
        chapter.append(block)
    placed, spot = _filled(chapter, spot, room, doubt)
    return "\n".join([*out, *placed, f'<div data-page="{spot.page}"></div>'])


def _number(chapter: Block) -> str:
    """Number in a chapter's heading, empty for introduction, conclusion, appendices."""
    found = _NUMBERED.search(chapter.html)
    return found[1] if found else ""


def _filled(
    blocks: Sequence[Block], spot: Spot, room: float, doubt: float
) -> tuple[list[str], Spot]:
    """The blocks of one chapter in their new order, and where its last page ends."""
    out: list[str] = []
    waiting: list[Block] = []
    for index, block in enumerate(blocks):
        if waiting and block.kind not in ("tied", "other"):
            spot, placed, waiting = _placed(waiting, spot, room, doubt)
            out += placed
        if waiting and block.kind == "heading" and room - spot.used < _HOLE * room:
            spot, placed, waiting = *_all_placed(waiting, spot, room, doubt), []
            out += placed
        if block.kind == "float" or (waiting and block.kind == "table"):
            waiting.append(block)
            if not (index + 1 < len(blocks) and blocks[index + 1].kind == "tied"):
                spot, placed, waiting = _placed(waiting, spot, room, doubt)
                out += placed
            continue
        spot = _after(block, spot, room)
        out.append(_paged(block, spot.page))
    spot, placed = _all_placed(waiting, spot, room, doubt)
    return [*out, *placed], spot


def _paged(block: Block, page: int) -> str:
    """A heading told its page as estimated: contents that nobody has renewed show it."""
    heading = block.kind in ("chapter", "heading")
    return (
        _HEADING.sub(rf'\g<0> data-page="{page}"', block.html, count=1) if heading else block.html
    )


def _all_placed(
    waiting: list[Block], spot: Spot, room: float, doubt: float
) -> tuple[Spot, list[str]]:
    """Each of the waiting blocks on the page that comes next, others beside it where they fit."""
    out: list[str] = []
    while waiting:
        out.append(waiting[0].html)
        spot = _after(waiting[0], spot, room)
        spot, placed, waiting = _placed(waiting[1:], spot, room, doubt)
        out += placed
    return spot, out


def _placed(
    waiting: list[Block], spot: Spot, room: float, doubt: float
) -> tuple[Spot, list[str], list[Block]]:
    """What of the waiting blocks fits on this page, in order; where the page ends then."""
    placed: list[str] = []
    while waiting:
        block = waiting[0]
        begin = spot.used + max(spot.margin, block.above)
        rest = room - begin - (doubt if spot.used else 0.0)
        if block.kind == "table" or block.height <= rest:
            placed.append(block.html)
            spot = _after(block, spot, room)
        elif block.figure and rest >= block.height - (1 - _LEAST) * block.figure:
            placed.append(_reduced(block, 1 - (block.height - rest) / block.figure))
            spot = Spot(room, page=spot.page)
        else:
            break
        waiting = waiting[1:]
    return spot, placed, waiting


def _after(block: Block, spot: Spot, room: float) -> Spot:
    """Where a block ends on its last page."""
    begin = spot.used + max(spot.margin, block.above)
    total = begin + block.height
    # What follows a heading stands below it: two lines at least.
    tail = block.below + 2 * block.line if block.kind == "heading" else 0.0
    if total + tail <= room:
        return Spot(total, block.below, spot.page)
    if block.kind in ("text", "table") or (block.kind == "tied" and block.line):
        end, pages = _over(block, begin, room)
        return Spot(end, block.below, spot.page + pages)
    return Spot(min(block.above + block.height, room), block.below, spot.page + 1)


def _over(block: Block, begin: float, room: float) -> tuple[float, int]:
    """Height on its last page of a block that goes on over the page's end, and further pages."""
    if block.kind == "table":
        end, pages = block.height - sum(block.rows), 1
        if room - begin >= block.head + _ROWS:
            end, pages = end + begin, 0
        for row in block.rows:
            full = end + row > room
            end, pages = (block.head if full else end) + row, pages + full
        return end, pages
    over = begin + block.height - room
    if block.line:  # no line of a paragraph stands alone
        free = int((room - begin) / block.line)
        lines = round(block.height / block.line)
        if block.least > 1:
            free = 0 if free < block.least or lines < 2 * block.least else free
        over = (lines - min(free, max(lines - block.least, 0))) * block.line
    return over % room, 1 + int(over // room)


def _reduced(block: Block, share: float) -> str:
    """The figure smaller."""

    def smaller(match: re.Match[str]) -> str:
        width = float(match[1])
        head = match.group()[: match.start(1) - match.start()]
        return f"{head}{width * share:.1f}mm"

    return _WIDTH.sub(smaller, block.html, count=1)


def _blocks(body: str, style: Style) -> Iterator[Block]:
    """Blocks of the body; a table's caption, box and end are one."""
    table: list[str] = []
    for html, tag, attributes in _elements(body):
        if 'class="tcap"' in attributes or table:
            table.append(html)
            if 'class="tclear"' in attributes:
                yield _table("\n".join(table), style)
                table = []
            continue
        yield _block(html, tag, attributes, style)


def _elements(body: str) -> Iterator[tuple[str, str, str]]:
    """Outermost elements with tag and attributes; what lies between them goes with the next."""
    depth = start = 0
    tag = attributes = ""
    for match in _TAG.finditer(body):
        if match[1]:
            depth -= 1
            if depth == 0:
                yield body[start : match.end()].strip(), tag, attributes
                start = match.end()
        else:
            if depth == 0:
                tag, attributes = match[2], match[3]
            depth += 1
    if body[start:].strip():
        yield body[start:].strip(), "", ""


def _block(html: str, tag: str, attributes: str, style: Style) -> Block:
    em = style.em_px
    line = em * style.line_spacing
    if tag == "h1":
        lines = _title_lines(html, style, em * 1.15) + html.count("<br>")
        return Block(html, "chapter", lines * em * 1.5, 0.0, 8 * _PT)
    if tag in ("h2", "h3"):
        height = _lines(html, style, em) * em * 1.3
        return Block(html, "heading", height, 14 * _PT, 8 * _PT, line=line)
    if tag == "p":
        flush = "flush" in attributes
        height = _lines(html, style, em, indent=not flush) * line
        return Block(html, "tied" if flush else "text", height, line=line)
    if 'class="eq' in attributes:
        heights = [max(1.3, float(height)) * em for height in _EM.findall(html)]
        padding = 4 * _PT * len(heights) if len(heights) > 1 else 0.0
        return Block(html, "tied", sum(heights) + padding, 6 * _PT, 6 * _PT)
    if tag == "figure":
        size = _figure_px(html, style)
        caption = html[html.find("<figcaption") :]
        lines = _title_lines(caption, style, em)
        height = size + lines * em * 1.3 + 4.5 * _PT
        return Block(html, "float", height, 10 * _PT, 10 * _PT, figure=size)
    if 'class="where"' in attributes:
        parts = re.findall(r"<p>.*?</p>", html, re.DOTALL)
        height = sum(_lines(part, style, em, indent=False) for part in parts) * line
        return Block(html, "tied", height, 0.0, 6 * _PT, line=line, least=1)
    if tag in ("ul", "ol"):
        items = re.findall(r"<li.*?</li>", html, re.DOTALL)
        return Block(html, "text", sum(_lines(item, style, em) for item in items) * line)
    return Block(html, "other", _lines(html, style, em) * line)


def _figure_px(html: str, style: Style) -> float:
    """Height of a figure's picture."""
    width, box = _WIDTH.search(html), _BOX.search(html)
    if width is None or box is None:
        return 0.0
    shown = min(float(width[1]), style.width_mm) * 96 / 25.4
    return shown * float(box[2]) / float(box[1])


def _table(html: str, style: Style) -> Block:
    size = next((name for name in ("dense", "tiny") if f'class="data {name}' in html), "")
    em = style.table_em_px(size)
    caption = _title_lines(html[: html.find("</div>")], style, style.em_px) * 1.5 * style.em_px
    widths = [float(share) / 100 * style.width_px - 9 for share in _SHARE.findall(html)]
    rows = _ROW.findall(html)
    body = html.find("<tbody")
    heads = html.count("<tr", 0, body)
    titles = max((_row_lines(row, widths, em) for row in rows[:heads]), default=1)
    # The line of titles, that of the columns' numbers; the rules are drawn between them.
    head = (titles * 1.2 + 0.85 * 1.2) * em + 5.5 * _PT
    height = caption + head
    lines = html.find('<tr class="lines">')
    if lines > 0:
        each = [1.37 * em] * html.count("\n", lines)
    else:
        each = [_row_lines(row, widths, em) * em * 1.2 + 2.05 * _PT for row in rows[heads:]]
    height += sum(each)
    kind: Kind = "float" if re.search(r'class="data[^"]* keep', html) else "table"
    more = head + 1.5 * style.em_px
    return Block(html, kind, height, 10 * _PT, 10 * _PT, head=more, rows=tuple(each))


def _row_lines(row: str, widths: Sequence[float], em: float) -> int:
    """Lines of the highest cell of a row; only cells of running text divide their words."""
    most = 1
    for (look, cell), width in zip(_CELL.findall(row), widths, strict=False):
        if width > 0:
            text = Markup(cell).striptags()
            lines = -int(-text_em(text) * em // width)
            most = max(most, lines if 'class="t"' in look else min(lines, text.count(" ") + 1))
    return most


def _title_lines(html: str, style: Style, em: float) -> int:
    """Lines of a heading or a caption, ragged, without indent, its words whole."""
    lines, rest = 1, style.width_px / em
    for word in _TAGS.sub("", html).split(" "):
        width = _width_em(word)
        if width > rest:
            lines, rest = lines + 1, style.width_px / em
        rest -= width + text_em(" ")
    return lines


def _lines(html: str, style: Style, em: float, *, indent: bool = True) -> int:
    """Lines of a paragraph at a size of the type [px]."""
    width = _width_em(html) * em + indent * style.indent_cm * 96 / 2.54
    return 1 if width <= style.width_px else -int(-width // (style.width_px * _FULL))


def _width_em(html: str) -> float:
    """Length of a text set in one line [em]."""
    small = sum(text_em(Markup(part).striptags()) for part in _SMALL.findall(html))
    plain = " ".join(Markup(_SMALL.sub("", html)).striptags().split())
    return text_em(plain) + 0.7 * small
