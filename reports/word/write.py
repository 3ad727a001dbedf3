"""The report as a Word file, from the same page, texts and numbers as the PDF.

The page is made once more as for the PDF and its elements are walked: paragraphs, tables and
formulas become those of Word, numbers and references become fields.
"""

from __future__ import annotations

import io
import zipfile
from datetime import datetime
from typing import TYPE_CHECKING

from reports.document.page.style import Style
from reports.document.report import Report
from reports.word import sheets, totals
from reports.word.blocks import Blocks
from reports.word.inline import Lines
from reports.word.pictures import Pictures
from reports.word.styles import dress

if TYPE_CHECKING:
    from docx.document import Document
    from lxml.html import HtmlElement


def report_docx(report: Report) -> bytes:
    """The report as a Word file; the same input gives the same bytes."""
    # Every cell a cell: the lines of numbers that are fast on paper are no table in Word.
    return from_page(report.page("print", tagged=True), report.style)


def from_page(page: str, style: Style) -> bytes:
    """A page of the report as a Word file."""
    import docx
    import lxml.html

    root = lxml.html.document_fromstring(page)
    document = docx.Document()
    dress(document, style)
    lines = Lines()
    blocks = Blocks(lines, Pictures(document), style)
    lines.pages = _number_pages(root, style)
    _fill(document, root, blocks)
    totals.count(document.element.body, lines.bookmarks)
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
    """Front sheets in one section, the text in another."""
    from docx.enum.section import WD_SECTION

    body = document.element.body
    text = root.find(".//div[@class='text']")
    stamps = text.xpath("./div[@class='form2' or @class='form2a']")
    for stamp in stamps:
        text.remove(stamp)
    fronts = root.xpath("//section[contains(concat(' ', @class, ' '), ' sheet ')]")
    place = root.xpath("//div[@class='place']")
    for item in place:
        item.drop_tree()
    for number, sheet in enumerate(fronts):
        made = blocks.written([sheet])
        if number:
            _new_page(made[0])
        for element in made:
            body.insert(len(body) - 1, element)
    first = document.sections[0]
    sheets.set_sheet(first, blocks.style)
    sheets.front(first, blocks.lines.runs(place[0]) if place else [])
    section = document.add_section(WD_SECTION.NEW_PAGE)
    for element in blocks.written([text]):
        body.insert(len(body) - 1, element)
    if stamps:
        found = [stamp.find("table") for stamp in stamps]
        sheets.framed(section, blocks.style, blocks.lines, found)
    else:
        sheets.numbered(section, blocks.style)


def _new_page(element: object) -> None:
    from reports.word.markup import W, w

    about = element.find(f"{{{W}}}pPr")  # type: ignore[attr-defined]
    about.insert(1, w("pageBreakBefore"))


def _describe(document: Document, root: HtmlElement) -> None:
    """Title, author, subject and date of the page; nothing of this machine or of now."""

    def meta(name: str) -> str:
        found = root.find(f".//meta[@name='{name}']")
        return "" if found is None else str(found.get("content"))

    about = document.core_properties
    about.title, about.author = root.findtext(".//title") or "", meta("author")
    about.subject, about.keywords = meta("description"), meta("keywords")
    about.last_modified_by, about.comments, about.language = meta("author"), "", "ru-RU"
    about.created = about.modified = datetime.fromisoformat(meta("dcterms.created"))
    about.revision = 1


def _timeless(data: bytes) -> bytes:
    """The same file without the times at which its parts were packed."""
    stream = io.BytesIO()
    with (
        zipfile.ZipFile(io.BytesIO(data)) as given,
        zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as made,
    ):
        for name in given.namelist():
            made.writestr(zipfile.ZipInfo(name), given.read(name), zipfile.ZIP_DEFLATED)
    return stream.getvalue()
