"""From the blocks of the page to paragraphs, tables and pictures of Word."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

from reports.document.page.style import Style
from reports.word import omml
from reports.word.inline import Lines, letter_name
from reports.word.markup import (
    Element,
    Rectangle,
    bookmark_name,
    field,
    paragraph,
    rectangle,
    run,
    twips,
    w,
)
from reports.word.pictures import Pictures
from reports.word.styles import cell_style

if TYPE_CHECKING:
    from lxml.html import HtmlElement

_WIDTH = re.compile(r"width:([\d.]+)(%|mm|px)")
CONTINUED_MM = 6.5  # height of the row «Продолжение таблицы»
_SHORT = 6  # rows of a table that stay together anyhow
_RULES = {"top": "single", "bottom": "single"}
# Paragraph styles of the elements of the page by class, and of sections by what they hold.
_DIVS = {"kind": "CoverKind", "title": "Title", "people": "CoverPeople", "approve": "TaskApprove",
         "head": "TaskHead", "centre": "TaskCentre"}  # fmt: skip
_PARTS = {"cover": "Cover", "task": "Task", "notation": "Notation"}
_PARAGRAPHS = {"flush": "Flush", "keys": "Keywords"}
_BLOCKS = {"div", "p", "section", "ul", "ol", "figure", "table", "nav", "h1", "h2", "h3"}
_BESIDE = (0.04, 0.86, 0.10)  # of the width: left of a numbered formula, it, its number
_SIGNED = (0.24, 0.42, 0.34)  # of the width: post, name, signature with its date
_APPENDIX = re.compile(r"(Приложение )([А-Я])$")
_BELOW = {"BodyText": "BodyAfterTable", "Flush": "FlushAfterTable"}


def table_of(
    lines: Lines, source: HtmlElement, width: int, continued: Sequence[Element] = ()
) -> Element:
    """Return a data table.

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
    table = frame_of(style, widths)
    if continued:
        table.append(_continued(continued, widths))
    for row in heads:
        table.append(_row(lines, row, widths, size, head=True, keep=True))
    for number, row in enumerate(rows):
        follows = number + 1 < len(rows) and "ba" in rows[number + 1].get("class", "").split()
        stays = (keep and number + 1 < len(rows)) or "aa" in row.get("class", "") or follows
        table.append(_row(lines, row, widths, size, keep=stays))
    return table


def frame_of(style: str, widths: Sequence[int], indent: int = 0) -> Element:
    """Return a table of fixed widths without rows [twips]."""
    properties = w("tblPr", w("tblStyle", val=style), w("tblW", w=sum(widths), type="dxa"),
              *([w("tblInd", w=indent, type="dxa")] if indent else []),
              w("tblLayout", type="fixed"), w("tblLook", val="0000"))  # fmt: skip
    return w("tbl", properties, w("tblGrid", *(w("gridCol", w=width) for width in widths)))


def table_cell(
    width: int, content: Sequence[Element], *more: Element, middle: bool = True
) -> Element:
    """Return a cell with its paragraphs; ``more`` are further properties in the schema's order."""
    properties = w("tcPr", w("tcW", w=width, type="dxa"), *more)
    if middle:
        properties.append(w("vAlign", val="center"))
    return w("tc", properties, *content)


def _continued(words: Sequence[Element], widths: Sequence[int]) -> Element:
    """Return a row of the heading without rules."""
    bare = w("tcBorders", *(w(side, val="nil") for side in ("top", "left", "right")))
    properties = w("trPr", w("cantSplit"), w("trHeight", val=twips(CONTINUED_MM), hRule="exact"),
              w("tblHeader"))  # fmt: skip
    content = paragraph("TableContinued", words, w("keepNext"))
    across = w("gridSpan", val=len(widths))
    return w("tr", properties, table_cell(sum(widths), [content], across, bare))


def may_break(source: HtmlElement) -> bool:
    """Whether a table is long enough to go on over the end of a sheet."""
    is_kept = "keep" in source.get("class", "").split()
    return not is_kept and len(source.findall("tbody/tr")) > _SHORT


def _row(
    lines: Lines, row: HtmlElement, widths: Sequence[int], size: str,
    *, keep: bool, head: bool = False,
) -> Element:  # fmt: skip
    properties = w("trPr", w("cantSplit"), *([w("tblHeader")] if head else []))
    row_element = w("tr", properties)
    for source, width in zip(row, widths, strict=True):
        text = source.get("class") == "t"
        more = [w("keepNext")] if keep else []
        content = paragraph(cell_style(size, text=text), lines.runs(source), *more)
        rules = [w("tcBorders", *(w(side, val=kind, sz=4, space=0, color="auto")
                                  for side, kind in _RULES.items()))] if head else []  # fmt: skip
        row_element.append(table_cell(width, [content], *rules))
    return row_element


def _shares(source: HtmlElement, width: int) -> list[int]:
    """Widths of the columns [twips]."""
    shares = [float(_found(column)[1]) for column in source.iterfind("colgroup/col")]
    return [round(width * share / sum(shares)) for share in shares]


def _found(column: HtmlElement) -> re.Match[str]:
    match = _WIDTH.search(column.get("style", ""))
    if match is None:
        msg = "a column of a table has no width"
        raise ValueError(msg)
    return match


def stamp_table(lines: Lines, source: HtmlElement, indent: int) -> Element:
    """Return title block by ГОСТ 2.104: widths in millimetres, cells over several rows and columns.

    Args:
        lines: what writes the content of cells.
        source: the ``table`` of the page.
        indent: where it begins, from the left margin [twips].
    """
    widths = [twips(float(_found(column)[1])) for column in source.iterfind("colgroup/col")]
    table = frame_of("ReportTableLined", widths, indent)
    open_down: dict[int, tuple[int, int]] = {}  # column: rows still covered, width in columns
    for row in source.iter("tr"):
        height = w("trPr", w("trHeight", val=twips(5), hRule="exact"))
        table.append(w("tr", height, *_stamp_cells(lines, row, widths, open_down)))
    return table


def _stamp_cells(
    lines: Lines, row: HtmlElement, widths: Sequence[int], open_down: dict[int, tuple[int, int]]
) -> Iterator[Element]:
    column = 0
    waiting = list(row)
    while column < len(widths):
        left, span = open_down.get(column, (0, 0))
        if left:
            open_down[column] = (left - 1, span)
            merged = [w("vMerge")]
            content = [paragraph("Stamp")]
        else:
            source = waiting.pop(0)
            span, rows = int(source.get("colspan", "1")), int(source.get("rowspan", "1"))
            open_down[column] = (rows - 1, span)
            merged = [w("vMerge", val="restart")] if rows > 1 else []
            jc = [w("jc", val="left")] if source.get("class") == "l" else []
            content = [paragraph("Stamp", _sized(lines.runs(source), source), *jc)]
        across = [w("gridSpan", val=span)] if span > 1 else []
        yield table_cell(sum(widths[column : column + span]), content, *across, *merged)
        column += span


def _sized(runs: list[Element], source: HtmlElement) -> list[Element]:
    """Return runs in the type size of their cell."""
    match = re.search(r"font-size:([\d.]+)pt", source.get("style", ""))
    for piece in runs if match else []:
        properties = piece.find(f"{{{piece.nsmap['w']}}}rPr")
        if properties is None:
            properties = w("rPr")
            piece.insert(0, properties)
        points = round(2 * float(match[1])) if match else 0
        properties.extend([w("sz", val=points), w("szCs", val=points)])
    return runs


class Blocks:
    """Writes the elements of one page in order."""

    def __init__(self, lines: Lines, pictures: Pictures, style: Style) -> None:
        self.lines, self.pictures, self.style = lines, pictures, style
        self.width = twips(style.width_mm)
        self._table = ""  # bookmark of the table at hand, for its further parts
        self._covers = 0
        self._continued: list[Element] = []  # words of the table at hand on later sheets

    def written(self, elements: Iterable[HtmlElement], usual: str = "BodyText") -> list[Element]:
        """Elements as blocks; formulas that follow one another share a table."""
        out: list[Element] = []
        for element in elements:
            for block in self._block(element, usual):
                if out and _in_rows(block) and _in_rows(block) == _in_rows(out[-1]):
                    out[-1].append(block[-1])
                    continue
                if out and _is_table(out[-1]) and not _in_rows(out[-1]):
                    if _is_table(block):  # side by side they would be one
                        out.append(paragraph("AfterTable"))
                    else:
                        _moved_down(block)
                out.append(block)
        return out

    def _block(self, element: HtmlElement, usual: str) -> Iterator[Element]:
        names = str(element.get("class", "")).split()
        tag = element.tag
        if tag in ("h1", "h2", "h3"):
            yield self._heading(element, names, usual)
        elif tag == "p":
            style = next((_PARAGRAPHS[n] for n in names if n in _PARAGRAPHS), usual)
            yield paragraph(usual if usual in ("Task", "Notation") else style,
                            self.lines.runs(element))  # fmt: skip
        elif tag == "figure":
            yield from self._figure(element)
        elif tag == "table":
            words, self._continued = self._continued, []
            yield table_of(self.lines, element, self.width, words)
        elif tag in ("ul", "ol"):
            style = "Source" if "sources" in names else "ListBullet"
            for item in element.iterfind("li"):
                yield paragraph(style, self.lines.runs(item))
        else:
            yield from self._division(element, names, usual)

    def _division(self, element: HtmlElement, names: list[str], usual: str) -> Iterator[Element]:
        """Yield a ``div`` or ``section`` by its class."""
        special: dict[str, Callable[[HtmlElement], Iterator[Element]]] = {
            "eq": self._formula, "where": self._where, "tcap": self._caption, "toc": self._contents,
            "person": self._person,
        }  # fmt: skip
        name = next((n for n in names if n in special), "")
        if name:
            yield from special[name](element)
        elif element.get("id") == "report-end":
            yield paragraph(
                "AfterTable", self.lines.bookmarks.around(bookmark_name("report-end"), [])
            )
        elif any(child.tag in _BLOCKS for child in element):
            inner = next((_PARTS[n] for n in names if n in _PARTS), usual)
            within = next((_DIVS[n] for n in names if n in _DIVS), inner)
            yield from self.written(element, within)
        elif "".join(element.itertext()).strip():
            style = next((_DIVS[n] for n in names if n in _DIVS), usual)
            yield paragraph(style, self.lines.runs(element))

    def _heading(self, element: HtmlElement, names: list[str], usual: str) -> Element:
        for number in element.iterfind("span[@class='hn']"):  # the list of headings has its own
            number.tail = (number.tail or "").lstrip("\u00a0 ")
            number.text = ""
        own_page = []
        if "runon" in names:
            own_page = [w("pageBreakBefore", val=0), w("spacing", before=360)]
        anchor = element.get("id")
        if anchor is None or usual != "BodyText":
            return paragraph("FrontHeading", self.lines.runs(element))
        style = f"Heading{element.tag[1]}"
        content = self.lines.runs(element)
        if "appendix" in names:
            style, content = "Appendix", self._appendix(element)
        elif "plain" in names:
            style = "HeadingPlain"
        marked = self.lines.bookmarks.around(bookmark_name(anchor), content)
        return paragraph(style, marked, *own_page)

    def _appendix(self, element: HtmlElement) -> list[Element]:
        """«Приложение А» with its letter as a bookmark: the tables' numbers show it."""
        name, title = ("".join(span.itertext()) for span in element.iterfind("span"))
        match = _APPENDIX.match(name)
        caps = frozenset({"caps"} if self.style.appendix.isupper() else ())
        if match is None:
            return [run(f"{name}\n", caps), run(title)]
        self.lines.letters.add(match[2])
        letter = self.lines.bookmarks.around(letter_name(match[2]), [run(match[2], caps)])
        return [run(match[1], caps), *letter, run(f"\n{title}")]

    def _figure(self, element: HtmlElement) -> Iterator[Element]:
        for image in element.iterfind(".//img"):
            yield self.pictures.figure(image, self.style.width_mm)
        for caption in element.iterfind("figcaption"):
            yield paragraph("FigureCaption", self.lines.runs(caption))

    def _caption(self, element: HtmlElement) -> Iterator[Element]:
        """Yield a table's caption; that of a further part names the same number."""
        anchor, number = element.get("id"), "".join(element.find("span").itertext())
        if anchor:
            self._table = bookmark_name(anchor)
            content = self.lines.runs(element)
        else:
            content = [run(element.text or ""), *self._number(number)]
        source = element.getnext().find("table")
        if self.style.table_continuation and may_break(source):
            self._continued = [run("Продолжение таблицы "), *self._number(number)]
            self._covers += 1
            content.append(w("r", w("drawing", self._cover())))
        yield paragraph("TableCaption", content)

    def _number(self, text: str) -> list[Element]:
        return field(f"REF {self._table} \\h", text)

    def _cover(self) -> Element:
        """White rectangle over a table's continuation row on its first sheet."""
        line = self.style.font_size_pt * 1.3 * 1.15 * 25.4 / 72  # the face is 1.15 em high
        area = Rectangle("margin", -1.0, "line", line + 0.2, self.style.width_mm + 2.0,
                      CONTINUED_MM + 0.2)  # fmt: skip
        return rectangle(area, 1000 + self._covers, "Начало таблицы", line=False)

    def _formula(self, element: HtmlElement) -> Iterator[Element]:
        """Yield a displayed formula line by line; a numbered one in a row without rules."""
        end = "".join(element.find("span").itertext()).strip()
        sources = [s.get("data-tex") for s in element.iter("span") if s.get("data-tex")]
        lines = [
            paragraph("Formula", [omml.displayed(tex, end if tex is sources[-1] else "")])
            for tex in sources
        ]
        number = element.find("span[@class='n']")
        if number is None:
            yield from lines
            return
        widths = [round(self.width * share) for share in _BESIDE]
        numbered = paragraph("FormulaNumber", self.lines.runs(number))
        row = w("tr", w("trPr", w("cantSplit")))
        for width, content in zip(widths, ([paragraph("Formula")], lines, [numbered]), strict=True):
            row.append(table_cell(width, content))
        table = frame_of("FormulaTable", widths)
        table.append(row)
        yield table

    def _person(self, element: HtmlElement) -> Iterator[Element]:
        """Yield a row of the title page: post, name, a line with «подпись, дата» under it."""
        widths = [round(self.width * share) for share in _SIGNED]
        row = w("tr", w("trPr", w("cantSplit")))
        for width, part in zip(widths, element.iterfind("span"), strict=True):
            jc = "center" if part.get("class") == "sign" else "left"
            content = paragraph("CoverPerson", self.lines.runs(part), w("jc", val=jc))
            row.append(table_cell(width, [content], middle=False))
        table = frame_of("SignTable", widths)
        table.append(row)
        yield table

    def _where(self, element: HtmlElement) -> Iterator[Element]:
        for item in element.iterfind("p"):
            lead = [] if item.find("span[@class='g']") is not None else [run("\t")]
            yield paragraph("Where", [*lead, *self.lines.runs(item)])

    def _contents(self, element: HtmlElement) -> Iterator[Element]:
        """Contents as a field with the pages as estimated, until Word or LibreOffice renews it."""
        page_of = {h.get("id"): h.get("data-page") for h in element.xpath("//*[@data-page]")}
        title = element.find("h1")
        if title is not None:
            yield paragraph("FrontHeading", self.lines.runs(title))
        items = element.findall(".//li")
        begin, words, separate, _, end = field('TOC \\o "1-3" \\h \\z \\u', "")
        for number, item in enumerate(items):
            link = item.find("a")
            anchor = link.get("href", "")[1:]
            target = bookmark_name(anchor)
            line = [run("".join(link.itertext())), run("\t"),
                    *field(f"PAGEREF {target} \\h", page_of.get(anchor, ""))]  # fmt: skip
            content = [w("hyperlink", *line, anchor=target, history=1)]
            if not number:
                content = [begin, words, separate, *content]
            if number == len(items) - 1:
                content.append(end)
            yield paragraph(f"TOC{item.get('class', 'l1')[1]}", content)


def _is_table(element: Element) -> bool:
    return str(element.tag).endswith("}tbl")


def _moved_down(block: Element) -> None:
    """Give a paragraph after a table the style with room above."""
    style = block.find(f"{{{block.nsmap['w']}}}pPr/{{{block.nsmap['w']}}}pStyle")
    if style is not None:
        key = f"{{{block.nsmap['w']}}}val"
        style.set(key, _BELOW.get(style.get(key, ""), style.get(key, "")))


def _in_rows(element: Element) -> str:
    """Style of a table whose rows go on with those of the next one; empty for any other block."""
    style = element.find(f"{{{element.nsmap['w']}}}tblPr/{{{element.nsmap['w']}}}tblStyle")
    name = "" if style is None else str(style.get(f"{{{element.nsmap['w']}}}val"))
    return name if name in ("FormulaTable", "SignTable") else ""
