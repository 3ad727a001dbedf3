"""The report as a Word file, from the same page, texts and numbers as the PDF.

The page is made once more as for the PDF and its elements are walked: paragraphs, tables and
formulas become those of Word, numbers and references become fields.
"""

from __future__ import annotations

import io
import re
import zipfile
from collections.abc import Iterator
from datetime import datetime
from typing import TYPE_CHECKING

from reports.document.page.style import FRAME_MM, SIDE_MM, Style
from reports.document.report import Report
from reports.word.blocks import Blocks, stamp_table
from reports.word.inline import Lines, count_totals
from reports.word.markup import Element, Rectangle, field, paragraph, rectangle, twips, w
from reports.word.pictures import Pictures
from reports.word.styles import dress

if TYPE_CHECKING:
    from docx.document import Document
    from docx.section import Section
    from lxml.html import HtmlElement

_THUMBNAIL = "docProps/thumbnail.jpeg"  # of the template


def set_sheet(section: Section, style: Style) -> None:
    """A4 with the margins of the style."""
    from docx.shared import Mm

    section.page_width, section.page_height = Mm(210), Mm(297)
    section.left_margin, section.right_margin = Mm(style.margins.left), Mm(style.margins.right)
    section.top_margin, section.bottom_margin = Mm(style.margins.top), Mm(style.margins.bottom)
    section.header_distance = section.footer_distance = Mm(10)


def front(section: Section, blocks: list[Element]) -> None:
    """Front sheets: no page numbers, town and year at the foot of the first one."""
    section.different_first_page_header_footer = True
    _put(section.first_page_footer, [paragraph("Cover", blocks)])
    _put(section.footer, [paragraph("Footer")])
    _put(section.header, [paragraph("Header")])


def numbered(section: Section, style: Style) -> None:
    """Sheets of the text with the number of the page at the foot."""
    section.different_first_page_header_footer = False
    side = style.page_number.rpartition("-")[2]
    _put(section.footer, [paragraph("Footer", field("PAGE", "2"), w("jc", val=side))])
    _put(section.header, [paragraph("Header")])


def framed(section: Section, style: Style, lines: Lines, blocks: list[HtmlElement]) -> None:
    """Sheets of the text in frames: form 2 on the first, form 2а on the others."""
    from docx.shared import Mm

    section.different_first_page_header_footer = True
    section.bottom_margin = Mm(30)
    section.footer_distance = Mm(5)
    indent = twips(FRAME_MM[0] - style.margins.left)
    for number, (foot, head) in enumerate((
        (section.first_page_footer, section.first_page_header),
        (section.footer, section.header),
    )):  # fmt: skip
        table = stamp_table(lines, blocks[number], indent)
        # A table must not end a footer; the line after it is as low as a line can be.
        last = paragraph("Footer", (), w("spacing", line=20, lineRule="exact"))
        drawn = [w("r", w("drawing", each)) for each in _frame(style, 900 + 20 * number)]
        # LibreOffice loses the words of boxes that stand in the header of a first sheet.
        _put(foot, [paragraph("Footer", drawn), table, last])
        _put(head, [paragraph("Header")])


def _frame(style: Style, number: int) -> Iterator[Element]:
    """Yield the frame of a sheet and the boxes left of it."""
    left, top, width, height = FRAME_MM
    area = Rectangle("page", left, "page", top, width, height)
    yield rectangle(area, number, "Рамка листа", line=True)
    for words, upper, tall in style.side_cells:
        edge = left - sum(SIDE_MM)
        for wide, inside in zip(SIDE_MM, (True, False), strict=True):
            number += 1
            box = Rectangle("page", edge, "page", upper, wide, tall)
            yield rectangle(box, number, words, line=True, inside=inside)
            edge += wide


def _put(part: object, content: list[Element]) -> None:
    part.is_linked_to_previous = False  # type: ignore[attr-defined]
    element = part._element  # type: ignore[attr-defined]
    for child in list(element):
        element.remove(child)
    element.extend(content)


def report_docx(report: Report) -> bytes:
    """Return the report as a Word file; the same input gives the same bytes."""
    # Every cell a cell: the lines of numbers that are fast on paper are no table in Word.
    return from_page(report.page("print", tagged=True), report.style)


def from_page(page: str, style: Style) -> bytes:
    """Return a page of the report as a Word file."""
    import docx
    import lxml.html

    root = lxml.html.document_fromstring(page)
    document = docx.Document()
    dress(document, style)
    lines = Lines()
    blocks = Blocks(lines, Pictures(document), style)
    lines.pages = _number_pages(root, style)
    _fill(document, root, blocks)
    count_totals(document.element.body, lines.bookmarks)
    _describe(document, root)
    stream = io.BytesIO()
    document.save(stream)
    return _timeless(stream.getvalue())


def _number_pages(root: HtmlElement, style: Style) -> int:
    """Turn the estimated pages of headings into pages of the file; how many there are."""
    fronts = root.xpath("//section[contains(concat(' ', @class, ' '), ' sheet ')"
                        " or contains(concat(' ', @class, ' '), ' brief ')]")  # fmt: skip
    height = style.height_px
    entries = len(root.xpath("//nav//li"))
    before = len(fronts) + -(-int((entries + 2) * 1.3 * style.em_px) // int(height))
    page = before
    for heading in root.xpath("//*[@data-page]"):
        page = before + int(heading.get("data-page"))
        heading.set("data-page", str(page))
    return page


def _fill(document: Document, root: HtmlElement, blocks: Blocks) -> None:
    """Front sheets in one section; the text, or what stands in a frame, in another."""
    from docx.enum.section import WD_SECTION

    body = document.element.body
    text = root.find(".//div[@class='text']")
    stamps = root.xpath("//div[@class='form2' or @class='form2a']")
    for stamp in stamps:
        stamp.getparent().remove(stamp)
    fronts = root.xpath("//section[contains(concat(' ', @class, ' '), ' sheet ')]")
    slots = root.xpath("//div[@class='place']")
    for item in slots:
        item.drop_tree()
    # Sheets before the text are one page each; the frame begins with the text at the latest.
    frame_page = blocks.style.frame_from if stamps else None
    bare = len(fronts) if frame_page is None else min(frame_page - 1, len(fronts))
    first = document.sections[0]
    set_sheet(first, blocks.style)
    front(first, blocks.lines.runs(slots[0]) if slots else [])
    section = first
    for number, sheet in enumerate([*fronts, text]):
        elements = blocks.written([sheet])
        if number == bare:
            section = document.add_section(WD_SECTION.NEW_PAGE)
        elif number and sheet is not text:
            _new_page(elements[0])
        for element in elements:
            body.insert(len(body) - 1, element)
    if stamps:
        tables = [stamp.find("table") for stamp in stamps]
        framed(section, blocks.style, blocks.lines, tables)
    else:
        numbered(section, blocks.style)


def _new_page(element: object) -> None:
    from reports.word.markup import W, w

    properties = element.find(f"{{{W}}}pPr")  # type: ignore[attr-defined]
    properties.insert(1, w("pageBreakBefore"))


def _describe(document: Document, root: HtmlElement) -> None:
    """Copy title, author, subject and date of the page into the file's properties."""

    def meta(name: str) -> str:
        element = root.find(f".//meta[@name='{name}']")
        return "" if element is None else str(element.get("content"))

    properties = document.core_properties
    properties.title, properties.author = root.findtext(".//title") or "", meta("author")
    properties.subject, properties.keywords = meta("description"), meta("keywords")
    properties.last_modified_by, properties.comments, properties.language = (
        meta("author"),
        "",
        "ru-RU",
    )
    properties.created = properties.modified = datetime.fromisoformat(meta("dcterms.created"))
    properties.revision = 1


def _timeless(data: bytes) -> bytes:
    """Remove times of packing and the library's template properties from the archive."""
    stream = io.BytesIO()
    with (
        zipfile.ZipFile(io.BytesIO(data)) as source,
        zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive,
    ):
        for name in source.namelist():
            if name == _THUMBNAIL:
                continue
            part = source.read(name)
            if name == "_rels/.rels":
                part = re.sub(rb"<Relationship [^>]*thumbnail[^>]*/>", b"", part)
            elif name == "docProps/app.xml":
                part = re.sub(rb"(<Application>)[^<]*", rb"\g<1>kshm", part)
                part = re.sub(rb"\s*<Template>[^<]*</Template>", b"", part)
            archive.writestr(zipfile.ZipInfo(name), part, zipfile.ZIP_DEFLATED)
    return stream.getvalue()
