"""From the blocks of the page to paragraphs, tables and pictures of Word."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING

from reports.document.page.style import Style
from reports.word import omml, tables
from reports.word.inline import Lines, letter_name
from reports.word.markup import (
    Element,
    bookmark_name,
    field,
    paragraph,
    run,
    twips,
    w,
)
from reports.word.pictures import Pictures
from reports.word.shapes import Place, rectangle

if TYPE_CHECKING:
    from lxml.html import HtmlElement

# Paragraph styles of the elements of the page by class, and of sections by what they hold.
_DIVS = {"kind": "CoverKind", "title": "Title", "people": "CoverPeople", "approve": "TaskApprove",
         "head": "TaskHead", "centre": "TaskCentre"}  # fmt: skip
_PARTS = {"cover": "Cover", "task": "Task", "notation": "Notation"}
_PARAGRAPHS = {"flush": "Flush", "keys": "Keywords"}
_BLOCKS = {"div", "p", "section", "ul", "ol", "figure", "table", "nav", "h1", "h2", "h3"}
_BESIDE = (0.04, 0.86, 0.10)  # of the width: left of a numbered formula, it, its number
_APPENDIX = re.compile(r"(Приложение )([А-Я])$")


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
            for made in self._block(element, usual):
                if _is_formula(made) and out and _is_formula(out[-1]):
                    out[-1].append(made[-1])
                else:
                    out.append(made)
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
            yield tables.table(self.lines, element, self.width, words)
            yield paragraph("AfterTable")
        elif tag in ("ul", "ol"):
            style = "Source" if "sources" in names else "ListBullet"
            for item in element.iterfind("li"):
                yield paragraph(style, self.lines.runs(item))
        else:
            yield from self._division(element, names, usual)

    def _division(self, element: HtmlElement, names: list[str], usual: str) -> Iterator[Element]:
        """A ``div`` or ``section`` by its class."""
        special: dict[str, Callable[[HtmlElement], Iterator[Element]]] = {
            "eq": self._formula, "where": self._where, "tcap": self._caption, "toc": self._contents,
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
        found = _APPENDIX.match(name)
        caps = frozenset({"caps"})
        if found is None:
            return [run(f"{name}\n", caps), run(title)]
        self.lines.letters.add(found[2])
        letter = self.lines.bookmarks.around(letter_name(found[2]), [run(found[2], caps)])
        return [run(found[1], caps), *letter, run(f"\n{title}")]

    def _figure(self, element: HtmlElement) -> Iterator[Element]:
        for image in element.iterfind(".//img"):
            yield self.pictures.figure(image, self.style.width_mm)
        for caption in element.iterfind("figcaption"):
            yield paragraph("FigureCaption", self.lines.runs(caption))

    def _caption(self, element: HtmlElement) -> Iterator[Element]:
        """A table's caption; that of a further part names the same number."""
        anchor, number = element.get("id"), "".join(element.find("span").itertext())
        if anchor:
            self._table = bookmark_name(anchor)
            content = self.lines.runs(element)
        else:
            content = [run(element.text or ""), *self._number(number)]
        source = element.getnext().find("table")
        if self.style.table_continuation and tables.may_break(source):
            self._continued = [run("Продолжение таблицы "), *self._number(number)]
            self._covers += 1
            content.append(w("r", w("drawing", self._cover())))
        yield paragraph("TableCaption", content)

    def _number(self, shown: str) -> list[Element]:
        return field(f"REF {self._table} \\h", shown)

    def _cover(self) -> Element:
        """White over the first row of a table on the sheet where it begins."""
        line = self.style.font_size_pt * 1.3 * 1.15 * 25.4 / 72  # the face is 1.15 em high
        place = Place("margin", -1.0, "line", line + 0.2, self.style.width_mm + 2.0,
                      tables.CONTINUED_MM + 0.2)  # fmt: skip
        return rectangle(place, 1000 + self._covers, "Начало таблицы", line=False)

    def _formula(self, element: HtmlElement) -> Iterator[Element]:
        """A displayed formula line by line; a numbered one in a row without rules."""
        end = "".join(element.find("span").itertext()).strip()
        sources = [s.get("data-tex") for s in element.iter("span") if s.get("data-tex")]
        made = [
            paragraph("Formula", [omml.displayed(tex, end if tex is sources[-1] else "")])
            for tex in sources
        ]
        number = element.find("span[@class='n']")
        if number is None:
            yield from made
            return
        widths = [round(self.width * share) for share in _BESIDE]
        numbered = paragraph("FormulaNumber", self.lines.runs(number))
        row = w("tr", w("trPr", w("cantSplit")))
        for width, content in zip(widths, ([paragraph("Formula")], made, [numbered]), strict=True):
            row.append(tables.cell(width, content))
        table = tables.frame_of("FormulaTable", widths)
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
        for place, item in enumerate(items):
            link = item.find("a")
            anchor = link.get("href", "")[1:]
            target = bookmark_name(anchor)
            line = [run("".join(link.itertext())), run("\t"),
                    *field(f"PAGEREF {target} \\h", page_of.get(anchor, ""))]  # fmt: skip
            content = [w("hyperlink", *line, anchor=target, history=1)]
            if not place:
                content = [begin, words, separate, *content]
            if place == len(items) - 1:
                content.append(end)
            yield paragraph(f"TOC{item.get('class', 'l1')[1]}", content)


def _is_formula(element: Element) -> bool:
    style = element.find(f"{{{element.nsmap['w']}}}tblPr/{{{element.nsmap['w']}}}tblStyle")
    return style is not None and "FormulaTable" in style.attrib.values()
