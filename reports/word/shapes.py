"""Rectangles that lie at a place of the sheet: frames, and what covers a line."""

from __future__ import annotations

from typing import NamedTuple

from lxml import etree

from reports.word.markup import Element

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
<a:prstGeom prst="rect"><a:avLst/></a:prstGeom>{looks}</wps:spPr><wps:bodyPr/></wps:wsp>
</a:graphicData></a:graphic></wp:anchor>"""
_LINE = '<a:noFill/><a:ln w="21600"><a:solidFill><a:srgbClr val="000000"/></a:solidFill></a:ln>'
_WHITE = '<a:solidFill><a:srgbClr val="FFFFFF"/></a:solidFill><a:ln><a:noFill/></a:ln>'


class Place(NamedTuple):
    """Where a rectangle lies and how large it is [mm]; what it is counted from."""

    across: str
    left: float
    down: str
    top: float
    width: float
    height: float


def rectangle(place: Place, number: int, words: str, *, line: bool) -> Element:
    """A rectangle: a line behind the text, or white in front of it.

    Args:
        place: where it lies.
        number: its number among the drawings of the file.
        words: what it is.
        line: an empty frame; otherwise white without a line.
    """
    left, top, width, height = (
        round(_EMU_MM * value) for value in (place.left, place.top, place.width, place.height)
    )
    drawn = _ANCHOR.format(
        names=" ".join(f'xmlns:{key}="{uri}"' for key, uri in _NAMES.items()),
        behind=int(line), across=place.across, down=place.down, left=left, top=top,
        cx=width, cy=height, number=number, words=words, wps=_NAMES["wps"],
        looks=_LINE if line else _WHITE,
    )  # fmt: skip
    return etree.fromstring(drawn.replace(">\n<", "><"))
