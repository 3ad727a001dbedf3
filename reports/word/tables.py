"""Tables of the page as tables of Word, with a heading that is repeated on every sheet."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from reports.word.inline import Lines
from reports.word.markup import Element, paragraph, twips, w
from reports.word.styles import cell_style

if TYPE_CHECKING:
    from lxml.html import HtmlElement

_WIDTH = re.compile(r"width:([\d.]+)(%|mm|px)")
CONTINUED_MM = 6.5  # height of the row «Продолжение таблицы»
_SHORT = 6  # rows of a table that stay together anyhow
_RULES = {"top": "single", "bottom": "single"}


def table(
    lines: Lines, source: HtmlElement, width: int, continued: Sequence[Element] = ()
) -> Element:
    """A data table.

    Args:
        lines: what writes the content of cells.
        source: the ``table`` of the page.
        width: its width [twips].
        continued: «Продолжение таблицы N», which stands above its heading on later sheets; on
            the first one the caption covers it.
    """
    names = source.get("class", "").split()
    size = next((name for name in ("dense", "tiny") if name in names), "")
    style = "ReportTableLined" if "lined" in names else "ReportTable"
    widths = _shares(source, width)
    heads = [row for row in source.iterfind("thead/tr") if row.get("class") != "gap"]
    rows = source.findall("tbody/tr")
    keep = "keep" in names
    made = frame_of(style, widths)
    if continued:
        made.append(_continued(continued, widths))
    for row in heads:
        made.append(_row(lines, row, widths, size, head=True, keep=True))
    for place, row in enumerate(rows):
        follows = place + 1 < len(rows) and "ba" in rows[place + 1].get("class", "").split()
        stays = (keep and place + 1 < len(rows)) or "aa" in row.get("class", "") or follows
        made.append(_row(lines, row, widths, size, keep=stays))
    return made


def frame_of(style: str, widths: Sequence[int], indent: int = 0) -> Element:
    """A table of fixed widths without rows [twips]."""
    about = w("tblPr", w("tblStyle", val=style), w("tblW", w=sum(widths), type="dxa"),
              *([w("tblInd", w=indent, type="dxa")] if indent else []),
              w("tblLayout", type="fixed"), w("tblLook", val="0000"))  # fmt: skip
    return w("tbl", about, w("tblGrid", *(w("gridCol", w=width) for width in widths)))


def cell(width: int, content: Sequence[Element], *more: Element, middle: bool = True) -> Element:
    """A cell with its paragraphs; ``more`` are further properties in the schema's order."""
    about = w("tcPr", w("tcW", w=width, type="dxa"), *more)
    if middle:
        about.append(w("vAlign", val="center"))
    return w("tc", about, *content)


def _continued(words: Sequence[Element], widths: Sequence[int]) -> Element:
    """A row of the heading without rules."""
    bare = w("tcBorders", *(w(side, val="nil") for side in ("top", "left", "right")))
    about = w("trPr", w("cantSplit"), w("trHeight", val=twips(CONTINUED_MM), hRule="exact"),
              w("tblHeader"))  # fmt: skip
    content = paragraph("TableContinued", words, w("keepNext"))
    across = w("gridSpan", val=len(widths))
    return w("tr", about, cell(sum(widths), [content], across, bare))


def may_break(source: HtmlElement) -> bool:
    """Whether a table is long enough to go on over the end of a sheet."""
    kept = "keep" in source.get("class", "").split()
    return not kept and len(source.findall("tbody/tr")) > _SHORT


def _row(
    lines: Lines, row: HtmlElement, widths: Sequence[int], size: str,
    *, keep: bool, head: bool = False,
) -> Element:  # fmt: skip
    about = w("trPr", w("cantSplit"), *([w("tblHeader")] if head else []))
    made = w("tr", about)
    for source, width in zip(row, widths, strict=True):
        text = source.get("class") == "t"
        more = [w("keepNext")] if keep else []
        content = paragraph(cell_style(size, text=text), lines.runs(source), *more)
        rules = [w("tcBorders", *(w(side, val=kind, sz=4, space=0, color="auto")
                                  for side, kind in _RULES.items()))] if head else []  # fmt: skip
        made.append(cell(width, [content], *rules))
    return made


def _shares(source: HtmlElement, width: int) -> list[int]:
    """Widths of the columns [twips]."""
    shares = [float(_found(column)[1]) for column in source.iterfind("colgroup/col")]
    return [round(width * share / sum(shares)) for share in shares]


def _found(column: HtmlElement) -> re.Match[str]:
    found = _WIDTH.search(column.get("style", ""))
    if found is None:
        msg = "a column of a table has no width"
        raise ValueError(msg)
    return found


def stamp(lines: Lines, source: HtmlElement, indent: int) -> Element:
    """A title block by ГОСТ 2.104: widths in millimetres, cells over several rows and columns.

    Args:
        lines: what writes the content of cells.
        source: the ``table`` of the page.
        indent: where it begins, from the left margin [twips].
    """
    widths = [twips(float(_found(column)[1])) for column in source.iterfind("colgroup/col")]
    made = frame_of("ReportTableLined", widths, indent)
    open_down: dict[int, tuple[int, int]] = {}  # column: rows still covered, width in columns
    for row in source.iter("tr"):
        height = w("trPr", w("trHeight", val=twips(5), hRule="exact"))
        made.append(w("tr", height, *_stamp_cells(lines, row, widths, open_down)))
    return made


def _stamp_cells(
    lines: Lines, row: HtmlElement, widths: Sequence[int], open_down: dict[int, tuple[int, int]]
) -> Iterator[Element]:
    place = 0
    waiting = list(row)
    while place < len(widths):
        left, span = open_down.get(place, (0, 0))
        if left:
            open_down[place] = (left - 1, span)
            merged = [w("vMerge")]
            content = [paragraph("Stamp")]
        else:
            source = waiting.pop(0)
            span, rows = int(source.get("colspan", "1")), int(source.get("rowspan", "1"))
            open_down[place] = (rows - 1, span)
            merged = [w("vMerge", val="restart")] if rows > 1 else []
            jc = [w("jc", val="left")] if source.get("class") == "l" else []
            content = [paragraph("Stamp", _sized(lines.runs(source), source), *jc)]
        across = [w("gridSpan", val=span)] if span > 1 else []
        yield cell(sum(widths[place : place + span]), content, *across, *merged)
        place += span


def _sized(runs: list[Element], source: HtmlElement) -> list[Element]:
    """Runs in the size that a cell was given to hold its words."""
    found = re.search(r"font-size:([\d.]+)pt", source.get("style", ""))
    for made in runs if found else []:
        about = made.find(f"{{{made.nsmap['w']}}}rPr")
        if about is None:
            about = w("rPr")
            made.insert(0, about)
        points = round(2 * float(found[1])) if found else 0
        about.extend([w("sz", val=points), w("szCs", val=points)])
    return runs
