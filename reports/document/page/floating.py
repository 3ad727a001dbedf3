"""Figures and small tables that float: to the top of the next page while the text goes on.

WeasyPrint knows no floats of the page, so the places are chosen beforehand: the heights of all
blocks are estimated here, and the pages of a chapter are filled with them in
:mod:`reports.document.page.placing`.  An estimate that is wrong by some lines costs no more
than these lines of blank paper.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial

from markupsafe import Markup

from reports.document.page.fitting import line_count
from reports.document.page.numbering import Figure
from reports.document.page.placing import WIDTH, Block, Kind, Spot, filled
from reports.document.page.style import Style
from reports.draw.fonts import text_em
from reports.draw.writers import PT_PER_MM

_PICTURE = re.compile(
    r'<figure id="(?P<name>[^"]+)"><(?:svg|img) class="fig"[^>]*?style="width:(?P<width>[\d.]+)mm"'
    r'[^>]*? data-size="(?P<wide>[\d.]+)/(?P<tall>[\d.]+)"[^>]*>'
)
_SIZE = re.compile(r'data-size="([\d.]+)/([\d.]+)"')

_SIZES = ("height", "most", "size")  # what the drawing functions call their size [mm]
_TRIES = 8
_FULL_SHARE = 0.995  # of the height that there is
_WITH_LETTERS = 0.92  # part of its size that a picture keeps whose letters shrink: 7.7 to 7 pt
_FIGURE = re.compile(r'<figure id="([^"]+)"')
_TAG = re.compile(r"<(/?)(p|h[1-3]|div|figure|ul|ol|nav|section)\b([^>]*)>")
_BOX = re.compile(r'data-size="([\d.]+)/([\d.]+)"')
_FORMULA = re.compile(r'<(?:svg|img) class="tex"[^>]*?style="([^"]*)"')
_EM = re.compile(r"height:([\d.]+)em")
_DEPTH = re.compile(r"vertical-align:-([\d.]+)em")
_ASCENT, _DESCENT = 0.95, 0.35  # of a line of text between formulas [em]
_NUMBERED = re.compile(r'<span class="hn">(\d+)')
_AFTER_NUMBER = 0.25  # of a heading [em], beside the space
_ROW = re.compile(r"<tr.*?</tr>", re.DOTALL)
_CELL = re.compile(r"<t[dh]([^>]*)>(.*?)</t[dh]>", re.DOTALL)
_LINED = re.compile(r'<table class="data[^"]* lined')
_SHARE = re.compile(r'<col style="width:([\d.]+)%')
_SMALL = re.compile(r"<su[bp]>(.*?)</su[bp]>", re.DOTALL)
_TAGS = re.compile(r"<(?!/?su[bp]\b)[^>]*>")  # all but those of indices
_PT = 96 / 72  # CSS pixels in a point
_SLACK = 0.1  # px kept free on every page: estimates are no measures
_RUN_ON = 'class="runon '
_SCANT = 0.3  # of a page, the last one before a chapter on a page of its own
_NEARLY = 0.07  # of a page: too little for a heading and what must follow it


def redrawn(body: str, figures: Mapping[str, Figure], pictured: Callable[[str, str], str]) -> str:
    """Return the text with every reduced figure drawn within its new height.

    Args:
        body: HTML of the chapters, of each figure the picture as an image.
        figures: Plans by the ids of the figures.
        pictured: Makes an image of a drawing and its alternative text.
    """

    def anew(match: re.Match[str]) -> str:
        share = float(match["width"]) * PT_PER_MM / float(match["wide"])
        plan = figures.get(match["name"])
        if plan is None or share >= _FULL_SHARE:
            return match.group()
        svg = smaller(plan.draw, share * float(match["tall"]))
        if svg is None:
            return match.group()
        return f'<figure id="{match["name"]}">{pictured(svg, plan.alt or plan.caption)}'

    return _PICTURE.sub(anew, body)


def smaller(draw: Callable[[], str], height: float) -> str | None:
    """Return a drawing within a height [pt]; ``None`` where its size is not to be chosen."""
    key = _size_key(draw)
    if key is None or not isinstance(draw, partial):
        return None
    size, margins = float(draw.keywords[key]), 0.0
    svg: str = draw()
    for _ in range(_TRIES):
        tall = _height(svg)
        if tall <= height:
            return svg
        # The room of the type around the field does not shrink.
        share = (_FULL_SHARE * height - margins) / (tall - margins)
        if share <= 0:
            break
        size *= share
        svg = draw.func(*draw.args, **draw.keywords | {key: size})
        margins = max(0.0, (_height(svg) - share * tall) / (1 - share))
    return None


def _size_key(draw: Callable[[], str]) -> str | None:
    """Return what a drawing calls its size; ``None`` where that is not to be chosen."""
    chosen = draw.keywords if isinstance(draw, partial) else {}
    return next((name for name in _SIZES if name in chosen), None)


def _height(svg: str) -> float:
    match = _SIZE.search(svg)
    return float(match[2]) if match else 0.0


def arranged(
    body: str, style: Style, figures: Mapping[str, Figure] | None = None, *, run_on: float = 1.0
) -> str:
    """Return the text with its figures and small tables where they leave no hole in the page.

    Args:
        body: HTML of the chapters.
        style: Sizes of sheet and type.
        figures: Plans by the ids of the figures.
        run_on: A numbered chapter follows on the same page if this share of it is free.
    """
    room = style.height_px - _SLACK
    line = style.em_px * style.line_spacing
    out: list[str] = []
    chapter: list[Block] = []
    spot = Spot(room, page=0)
    for block in _blocks(str(body), style, figures or {}):  # no Markup: nothing is escaped here
        if block.kind == "chapter":
            placed, end = filled(chapter, spot, room, line)
            follows = bool(chapter) and not {_number(chapter[0]), _number(block)} & {""}
            # A page all but full may run over by a line: then the heading follows that line.
            free = (room - end.used) / room
            if follows and run_on < 1 and (free > run_on or free < _NEARLY):
                html = block.html.replace('class="', _RUN_ON, 1)
                block = replace(block, html=html, above=18 * _PT)  # noqa: PLW2901
                spot = end
            else:
                placed, end = _fuller(chapter, spot, (placed, end), room, line)
                spot = Spot(0.0, page=end.page + 1)
            out += placed
            chapter = []
        chapter.append(block)
    placed, spot = _fuller(chapter, spot, filled(chapter, spot, room, line), room, line)
    return "\n".join([*out, *placed, f'<div data-page="{spot.page}"></div>'])


def _fuller(
    chapter: Sequence[Block],
    spot: Spot,
    filled_pages: tuple[list[str], Spot],
    room: float,
    line: float,
) -> tuple[list[str], Spot]:
    """Move a chapter that leaves few lines on a page to the next page."""
    _, end = filled_pages
    if not spot.used or end.page == spot.page or end.used > _SCANT * room:
        return filled_pages
    heading = replace(chapter[0], html=chapter[0].html.replace(_RUN_ON, 'class="', 1), above=0.0)
    other = filled([heading, *chapter[1:]], Spot(0.0, page=spot.page + 1), room, line)
    return other if other[1].page == end.page else filled_pages


def _number(chapter: Block) -> str:
    """Return the number in a chapter's heading, empty for introduction, conclusion, appendices."""
    match = _NUMBERED.search(chapter.html)
    return match[1] if match else ""


def _blocks(body: str, style: Style, figures: Mapping[str, Figure]) -> Iterator[Block]:
    """Blocks of the body; a table's caption, box and end are one."""
    table: list[str] = []
    for html, tag, attributes in _elements(body):
        if 'class="tcap"' in attributes or table:
            table.append(html)
            if 'class="tclear"' in attributes:
                yield _table("\n".join(table), style)
                table = []
            continue
        block = _block(html, tag, attributes, style)
        yield replace(block, least=_WITH_LETTERS) if _shrinks_letters(html, figures) else block


def _shrinks_letters(html: str, figures: Mapping[str, Figure]) -> bool:
    """Whether a picture is not drawn anew, so that its letters shrink with it."""
    name = _FIGURE.match(html)
    plan = figures.get(name[1]) if name else None
    return plan is not None and _size_key(plan.draw) is None


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
        lines = _title_lines(html, _beside(style) / em / 1.15, bold=True) + html.count("<br>")
        return Block(html, "chapter", lines * em * 1.5, 0.0, 8 * _PT)
    if tag in ("h2", "h3"):
        height = _title_lines(html, _beside(style) / em, bold=True) * em * 1.3
        return Block(html, "heading", height, 14 * _PT, 8 * _PT)
    if tag == "p":
        flush = "flush" in attributes
        height = _lines(html, style, em, indent=not flush) * line
        return Block(html, "tied" if flush else "text", height, line=line)
    if 'class="eq' in attributes:
        heights = [_formula_line(style) * em for style in _FORMULA.findall(html)]
        padding = 4 * _PT * len(heights) if len(heights) > 1 else 0.0
        return Block(html, "tied", sum(heights) + padding, 6 * _PT, 6 * _PT)
    if tag == "figure":
        size = _figure_px(html, style)
        caption = html[html.find("<figcaption") :]
        lines = _title_lines(caption, style.width_px / em)
        height = size + lines * em * 1.3 + 4.5 * _PT
        return Block(html, "float", height, 10 * _PT, 10 * _PT, figure=size)
    if 'class="where"' in attributes:
        parts = re.findall(r"<p>.*?</p>", html, re.DOTALL)
        height = sum(_lines(part, style, em, indent=False) for part in parts) * line
        return Block(html, "tied", height, 0.0, 6 * _PT, line=line)
    if tag in ("ul", "ol"):
        items = re.findall(r"<li.*?</li>", html, re.DOTALL)
        return Block(html, "text", sum(_lines(item, style, em) for item in items) * line)
    return Block(html, "other", _lines(html, style, em) * line)


def _formula_line(look: str) -> float:
    """Height of a line that holds a formula [em]."""
    height, depth = _EM.search(look), _DEPTH.search(look)
    below = float(depth[1]) if depth else 0.0
    above = (float(height[1]) if height else 0.0) - below
    return max(_ASCENT, above) + max(_DESCENT, below)


def _figure_px(html: str, style: Style) -> float:
    """Height of a figure's picture."""
    width, box = WIDTH.search(html), _BOX.search(html)
    if width is None or box is None:
        return 0.0
    shown = min(float(width[1]), style.width_mm) * 96 / 25.4
    return shown * float(box[2]) / float(box[1])


def _table(html: str, style: Style) -> Block:
    size = next((name for name in ("dense", "tiny") if f'class="data {name}' in html), "")
    em = style.table_em_px(size)
    title = html[: html.find("</div>")]
    caption = _title_lines(title, style.width_px / style.em_px) * 1.5 * style.em_px
    widths = [float(share) / 100 * style.width_px for share in _SHARE.findall(html)]
    rows = _ROW.findall(html)
    body = html.find("<tbody")
    heads = html.count("<tr", 0, body)
    titles = max((_row_lines(row, widths, em) for row in rows[:heads]), default=1)
    # The line of titles, that of the columns' numbers; the rules are drawn between them.
    head = (titles * 1.2 + 0.85 * 1.2) * em + 5.5 * _PT
    height = caption + head
    lines = html.find('<tr class="lines">')
    if lines > 0:
        each = [style.row_em * em] * html.count("\n", lines)
    else:
        around = (2.575 if _LINED.search(html) else 2.005) * _PT
        each = [_row_lines(row, widths, em) * em * 1.2 + around for row in rows[heads:]]
    height += sum(each)
    kind: Kind = "table"
    if re.search(r'class="data[^"]* keep', html):  # a part stays with those before it
        kind = "other" if re.search(r'class="data[^"]* part"', html) else "float"
    more = head + 1.5 * style.em_px
    return Block(html, kind, height, 10 * _PT, 10.5 * _PT, head=more, rows=tuple(each))


def _row_lines(row: str, widths: Sequence[float], em: float) -> int:
    """Lines of the highest cell of a row; only cells of running text divide their words."""
    most = 1
    for (look, cell), width in zip(_CELL.findall(row), widths, strict=False):
        if width > 0:
            text = 'class="t"' in look
            around = (6.6 if text else 4.6) * _PT  # padding and rule
            most = max(most, line_count(cell, (width - around) / em, divided=text))
    return most


def _beside(style: Style) -> float:
    """Width of the text beside its indent [px], as of a heading."""
    return style.width_px - style.indent_cm * 96 / 2.54


def _title_lines(html: str, width: float, *, bold: bool = False) -> int:
    """Lines of a heading or a caption within a width [em], ragged, its words whole."""
    lines, room = 1, width - _AFTER_NUMBER * bool(_NUMBERED.search(html))
    for word in _TAGS.sub("", html).split(" "):
        long = _width_em(word, bold=bold)
        if long > room:
            lines, room = lines + 1, width
        room -= long + text_em(" ")
    return lines


def _lines(html: str, style: Style, em: float, *, indent: bool = True) -> int:
    """Lines of a paragraph at a size of the type [px]."""
    first = indent * (style.width_px - _beside(style)) / em
    return line_count(html, style.width_px / em, indent=first)


def _width_em(html: str, *, bold: bool) -> float:
    """Length of a text set in one line [em]."""
    small = sum(text_em(Markup(part).striptags(), bold=bold) for part in _SMALL.findall(html))
    plain = " ".join(Markup(_SMALL.sub("", html)).striptags().split())
    return text_em(plain, bold=bold) + 0.7 * small
