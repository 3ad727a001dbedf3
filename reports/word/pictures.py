"""Figures as pictures of Word: an SVG, a PNG beside it, an alternative text."""

from __future__ import annotations

import base64
import hashlib
import io
import re
from typing import TYPE_CHECKING

from lxml import etree

from reports.word.markup import Element, paragraph, w
from reports.word.outline import outlined, picture

if TYPE_CHECKING:
    from docx.document import Document
    from lxml.html import HtmlElement

_EMU_MM = 36000
_WIDTH = re.compile(r"width:([\d.]+)mm")
_NAMES = {
    "a": "http://schemas.openxmlformats.org/drawingml/2006/main",
    "asvg": "http://schemas.microsoft.com/office/drawing/2016/SVG/main",
    "pic": "http://schemas.openxmlformats.org/drawingml/2006/picture",
    "r": "http://schemas.openxmlformats.org/officeDocument/2006/relationships",
    "wp": "http://schemas.openxmlformats.org/drawingml/2006/wordprocessingDrawing",
}
_SVG_BLIP = "{96DAC541-7B7A-43D3-8B79-37D633B846F1}"  # extension of Office 2016
_INLINE = """<wp:inline {names} distT="0" distB="0" distL="0" distR="0">
<wp:extent cx="{cx}" cy="{cy}"/><wp:docPr id="{number}" name="Рисунок {number}"/>
<wp:cNvGraphicFramePr><a:graphicFrameLocks noChangeAspect="1"/></wp:cNvGraphicFramePr>
<a:graphic><a:graphicData uri="{pic}"><pic:pic>
<pic:nvPicPr><pic:cNvPr id="{number}" name="figure{number}.svg"/><pic:cNvPicPr/></pic:nvPicPr>
<pic:blipFill><a:blip r:embed="{png}"><a:extLst><a:ext uri="{uri}">
<asvg:svgBlip r:embed="{svg}"/></a:ext></a:extLst></a:blip>
<a:stretch><a:fillRect/></a:stretch></pic:blipFill>
<pic:spPr><a:xfrm><a:off x="0" y="0"/><a:ext cx="{cx}" cy="{cy}"/></a:xfrm>
<a:prstGeom prst="rect"><a:avLst/></a:prstGeom></pic:spPr>
</pic:pic></a:graphicData></a:graphic></wp:inline>"""


class Pictures:
    """Puts figures into one document."""

    def __init__(self, document: Document) -> None:
        self._part = document.part
        self._count = 0
        self._drawings: dict[str, str] = {}  # of each drawing's name, so that none is kept twice

    def figure(self, image: HtmlElement, widest_mm: float) -> Element:
        """A paragraph with the picture of an ``img`` of the page."""
        style = image.get("style", "")
        found = _WIDTH.search(style)
        width = min(float(found[1]) if found else widest_mm, widest_mm)
        svg = outlined(base64.b64decode(image.get("src", "").partition(",")[2]).decode())
        across, down = _box(svg)
        self._count += 1
        drawn = _INLINE.format(
            names=" ".join(f'xmlns:{key}="{uri}"' for key, uri in _NAMES.items()),
            cx=round(width * _EMU_MM), cy=round(width * down / across * _EMU_MM),
            number=self._count, pic=_NAMES["pic"], uri=_SVG_BLIP,
            png=self._image(picture(svg, width)), svg=self._svg(svg),
        )  # fmt: skip
        inline = etree.fromstring(re.sub(r">\n<", "><", drawn))
        inline.find("wp:docPr", _NAMES).set("descr", image.get("alt", ""))
        return paragraph("Figure", [w("r", w("drawing", inline))])

    def _image(self, png: bytes) -> str:
        name, _ = self._part.get_or_add_image(io.BytesIO(png))
        return str(name)

    def _svg(self, svg: str) -> str:
        from docx.opc.constants import RELATIONSHIP_TYPE
        from docx.opc.packuri import PackURI
        from docx.opc.part import Part

        data = svg.encode()
        name = f"/word/media/{hashlib.sha256(data).hexdigest()[:16]}.svg"
        if name not in self._drawings:
            part = Part(PackURI(name), "image/svg+xml", data, self._part.package)
            self._drawings[name] = str(self._part.relate_to(part, RELATIONSHIP_TYPE.IMAGE))
        return self._drawings[name]


def _box(svg: str) -> tuple[float, float]:
    """Width and height of the drawing."""
    _, _, across, down = re.search(r'viewBox="([^"]+)"', svg)[1].split()  # type: ignore[index]
    return float(across), float(down)
