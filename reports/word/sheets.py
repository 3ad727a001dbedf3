"""Sheets of the Word file: margins, page numbers, frames with title blocks in the footers."""

from __future__ import annotations

from typing import TYPE_CHECKING

from reports.document.page.style import Style
from reports.word import tables
from reports.word.inline import Lines
from reports.word.markup import Element, field, paragraph, twips, w
from reports.word.shapes import Place, rectangle

if TYPE_CHECKING:
    from docx.section import Section
    from lxml.html import HtmlElement

_FRAME = (20.0, 5.0, 185.0, 287.0)  # left, top, width, height of the frame [mm]


def set_sheet(section: Section, style: Style) -> None:
    """A4 with the margins of the style."""
    from docx.shared import Mm

    section.page_width, section.page_height = Mm(210), Mm(297)
    section.left_margin, section.right_margin = Mm(style.margins.left), Mm(style.margins.right)
    section.top_margin, section.bottom_margin = Mm(style.margins.top), Mm(style.margins.bottom)
    section.header_distance = section.footer_distance = Mm(10)


def front(section: Section, place: list[Element]) -> None:
    """Sheets before the text: no page numbers, town and year at the foot of the first one."""
    section.different_first_page_header_footer = True
    _put(section.first_page_footer, [paragraph("Cover", place)])
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
    indent = twips(_FRAME[0] - style.margins.left)
    for place, (foot, head) in enumerate((
        (section.first_page_footer, section.first_page_header),
        (section.footer, section.header),
    )):  # fmt: skip
        table = tables.stamp(lines, blocks[place], indent)
        # A table must not end a footer; the line after it is as low as a line can be.
        last = paragraph("Footer", (), w("spacing", line=20, lineRule="exact"))
        _put(foot, [paragraph("Footer"), table, last])
        _put(head, [paragraph("Header", [w("r", w("drawing", _rectangle(place + 1)))])])


def _rectangle(number: int) -> Element:
    left, top, width, height = _FRAME
    place = Place("page", left, "page", top, width, height)
    return rectangle(place, 900 + number, "Рамка листа", line=True)


def _put(part: object, content: list[Element]) -> None:
    part.is_linked_to_previous = False  # type: ignore[attr-defined]
    element = part._element  # type: ignore[attr-defined]
    for child in list(element):
        element.remove(child)
    element.extend(content)
