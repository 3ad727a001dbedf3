"""Elements of WordprocessingML: short words for making them, fields and bookmarks."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterable
from typing import NamedTuple, TypeAlias

from lxml import etree

W = "http://schemas.openxmlformats.org/wordprocessingml/2006/main"
_SPACE = "{http://www.w3.org/XML/1998/namespace}space"
# Anchors of the page begin with a word for the kind; a kind's numbers are one sequence.
SEQUENCES = {"ris": "Рисунок", "tab": "Таблица", "eq": "Формула", "src": "Источник"}
_LONGEST = 40  # letters of a bookmark's name
TWIPS_MM = 1440 / 25.4
Element: TypeAlias = etree._Element
_EMU_MM = 36000
_NAMES = {
    "a": "http://schemas.openxmlformats.org/drawingml/2006/main",
    "wp": "http://schemas.openxmlformats.org/drawingml/2006/wordprocessingDrawing",
    "wps": "http://schemas.microsoft.com/office/word/2010/wordprocessingShape",
}
_ANCHOR = """<wp:anchor {names} distT="0" distB="0" distL="0" distR="0" simplePos="0"
 relativeHeight="1" behindDoc="{behind}" locked="1" layoutInCell="0" allowOverlap="1">
<wp:simplePos x="0" y="0"/>
<wp:positionH relativeFrom="{across}"><wp:posOffset>{left}</wp:posOffset></wp:positionH>
<wp:positionV relativeFrom="{down}"><wp:posOffset>{top}</wp:posOffset></wp:positionV>
<wp:extent cx="{cx}" cy="{cy}"/><wp:wrapNone/>
<wp:docPr id="{number}" name="{words} {number}" descr="{words}"/><wp:cNvGraphicFramePr/>
<a:graphic><a:graphicData uri="{wps}"><wps:wsp><wps:cNvSpPr/><wps:spPr>
<a:xfrm><a:off x="0" y="0"/><a:ext cx="{cx}" cy="{cy}"/></a:xfrm>
<a:prstGeom prst="rect"><a:avLst/></a:prstGeom>{looks}</wps:spPr>{text}</wps:wsp>
</a:graphicData></a:graphic></wp:anchor>"""
# Words that are read from below.
_UPWARDS = """<wps:txbx><w:txbxContent xmlns:w="{W}"><w:p><w:pPr><w:pStyle w:val="Stamp"/></w:pPr>
<w:r><w:t>{words}</w:t></w:r></w:p></w:txbxContent></wps:txbx>
<wps:bodyPr vert="vert270" lIns="0" tIns="0" rIns="0" bIns="0" anchor="ctr"/>"""
_LINE = '<a:noFill/><a:ln w="21600"><a:solidFill><a:srgbClr val="000000"/></a:solidFill></a:ln>'
_WHITE = '<a:solidFill><a:srgbClr val="FFFFFF"/></a:solidFill><a:ln><a:noFill/></a:ln>'


def w(name: str, /, *children: Element, **attributes: object) -> Element:
    """Return an element ``w:name`` with attributes of the same namespace."""
    element = etree.Element(f"{{{W}}}{name}", nsmap={"w": W})
    for key, value in attributes.items():
        element.set(f"{{{W}}}{key}", str(value))
    element.extend(children)
    return element


def twips(millimetres: float) -> int:
    """Return a length in twentieths of a point."""
    return round(millimetres * TWIPS_MM)


def paragraph(style: str, content: Iterable[Element] = (), *more: Element) -> Element:
    """Return paragraph in a named style; ``more`` are further properties in the schema's order."""
    return w("p", w("pPr", w("pStyle", val=style), *more), *content)


def run(text: str, looks: frozenset[str] = frozenset()) -> Element:
    """Return a run of text; tabs and line ends become elements."""
    element = w("r", *([_looks(looks)] if looks else []))
    for part in re.split("([\t\n])", text):
        if part == "\t":
            element.append(w("tab"))
        elif part == "\n":
            element.append(w("br"))
        elif part:
            words = w("t")
            words.text = part
            words.set(_SPACE, "preserve")
            element.append(words)
    return element


def _looks(looks: frozenset[str]) -> Element:
    """Properties of a run, in the order of the schema."""
    properties = w("rPr")
    for name, element in (
        ("b", w("b")), ("i", w("i")), ("caps", w("caps")), ("u", w("u", val="single")),
        ("sub", w("vertAlign", val="subscript")), ("sup", w("vertAlign", val="superscript")),
    ):  # fmt: skip
        if name in looks:
            properties.append(element)
    return properties


def field(instruction: str, result: str, looks: frozenset[str] = frozenset()) -> list[Element]:
    """Return a field that Word renews, with what it shows until then."""
    words = w("instrText")
    words.text = f" {instruction} "
    words.set(_SPACE, "preserve")
    return [
        w("r", w("fldChar", fldCharType="begin")),
        w("r", words),
        w("r", w("fldChar", fldCharType="separate")),
        run(result, looks),
        w("r", w("fldChar", fldCharType="end")),
    ]


class Bookmarks:
    """Bookmarks of one document, each with a number of its own."""

    def __init__(self) -> None:
        self._count = 0

    def around(self, name: str, content: Iterable[Element]) -> list[Element]:
        """Return the content as a bookmark."""
        self._count += 1
        start = w("bookmarkStart", id=self._count, name=name)
        return [start, *content, w("bookmarkEnd", id=self._count)]


def bookmark_name(anchor: str) -> str:
    """Return a name that Word allows for an anchor of the page."""
    name = anchor.replace("-", "_", 1)
    if len(name) <= _LONGEST and re.fullmatch(r"\w+", name):
        return name
    digest = hashlib.sha256(anchor.encode()).hexdigest()[:12]
    return f"{re.sub(r'[^A-Za-z0-9]+', '_', anchor)[:27]}_{digest}"


class Rectangle(NamedTuple):
    """Position and size of a rectangle [mm] with its reference frames."""

    across: str
    left: float
    down: str
    top: float
    width: float
    height: float


def rectangle(
    area: Rectangle, number: int, words: str, *, line: bool, inside: bool = False
) -> Element:
    """Return a rectangle: a line behind the text, or white in front of it.

    Args:
        area: where it lies.
        number: its number among the drawings of the file.
        words: what it is.
        line: an empty frame; otherwise white without a line.
        inside: the words stand in it, turned to be read from below.
    """
    left, top, width, height = (
        round(_EMU_MM * value) for value in (area.left, area.top, area.width, area.height)
    )
    drawn = _ANCHOR.format(
        names=" ".join(f'xmlns:{key}="{uri}"' for key, uri in _NAMES.items()),
        behind=int(line), across=area.across, down=area.down, left=left, top=top,
        cx=width, cy=height, number=number, words=words, wps=_NAMES["wps"],
        looks=_LINE if line else _WHITE,
        text=_UPWARDS.format(W=W, words=words) if inside else "<wps:bodyPr/>",
    )  # fmt: skip
    return etree.fromstring(drawn.replace(">\n<", "><"))
