"""Figures for Word: an SVG whose letters are outlines, and the same as PNG.

Word sets the text of an SVG in whatever font the machine has; the figures' letters are STIX,
which hardly one has.  As outlines they look the same everywhere.
"""

from __future__ import annotations

import base64
import functools
import hashlib
import io
import re
from typing import TYPE_CHECKING
from xml.etree import ElementTree as ET  # our own output, no foreign XML

from lxml import etree

from reports.draw import fonts
from reports.word.markup import Element, paragraph, w

if TYPE_CHECKING:
    from docx.document import Document
    from lxml.html import HtmlElement

_SVG = "{http://www.w3.org/2000/svg}"
_DPI = 220  # of the picture beside the SVG, for programs that show no SVG
_PT = 72
_INHERITED = ("font-family", "font-style", "font-weight", "font-size", "fill", "text-anchor")
_USUAL = {"font-family": fonts.FAMILY, "font-size": "11"}
Outline = tuple[tuple[str, tuple[tuple[float, float], ...]], ...]
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


def outlined(svg: str) -> str:
    """Return the SVG with each text as a path."""
    ET.register_namespace("", _SVG[1:-1])
    root = ET.fromstring(svg)
    _outline(root, _USUAL)
    return ET.tostring(root, encoding="unicode")


def picture(svg: str, width_mm: float) -> bytes:
    """Return an SVG without texts as PNG.

    Args:
        svg: the outlined SVG.
        width_mm: its width on paper [mm].
    """
    import resvg_py

    png = resvg_py.svg_to_bytes(
        svg_string=svg, width=round(width_mm / 25.4 * _DPI), background="white"
    )
    return bytes(png)


def _outline(element: ET.Element, above: dict[str, str]) -> None:
    looks = above | {name: element.attrib[name] for name in _INHERITED if name in element.attrib}
    for number, child in enumerate(list(element)):
        if child.tag != f"{_SVG}text":
            _outline(child, looks)
            continue
        path = ET.Element(f"{_SVG}path", {"d": _path_of(child, looks)})
        for name in ("transform", "fill"):
            if name in child.attrib:
                path.set(name, child.attrib[name])
        element[number] = path


def _path_of(text: ET.Element, above: dict[str, str]) -> str:
    """Outlines of a text and of its spans."""
    looks = above | dict(text.attrib)
    spans = [span for span in text if span.tag == f"{_SVG}tspan"]
    parts = [_line(span.text or "", looks | dict(span.attrib)) for span in spans]
    return "".join([_line((text.text or "").strip("\n "), looks), *parts])


def _line(text: str, looks: dict[str, str]) -> str:
    """Outlines of letters on one line, each at its own place where places are given."""
    size = float(looks["font-size"])
    family = looks["font-family"].partition(",")[0]
    face = (family, *(looks.get(name, "normal") for name in ("font-style", "font-weight")))
    xs, ys = (list(map(float, looks.get(axis, "0").split())) for axis in "xy")
    glyphs = [_glyph(*face, char) for char in text]
    shift = {"middle": 0.5, "end": 1.0}.get(looks.get("text-anchor", ""), 0.0)
    x = xs[0] - shift * size * sum(width for _, width in glyphs)
    out = []
    for number, (outline, width) in enumerate(glyphs):
        if number < len(xs) and number:
            x = xs[number]
        y = ys[min(number, len(ys) - 1)]
        out += [
            f"{code}{' '.join(_placed(x + size * a, y - size * b) for a, b in points)}"
            for code, points in outline
        ]
        x += size * width
    return "".join(out)


def _placed(x: float, y: float) -> str:
    return f"{x:.2f} {y:.2f}"


@functools.lru_cache(maxsize=2048)
def _glyph(family: str, style: str, weight: str, char: str) -> tuple[Outline, float]:
    """Outline [em] with y upwards and advance [em] of a letter."""
    from matplotlib.ft2font import LoadFlags
    from matplotlib.path import Path

    font = fonts.face_with(char, style, weight, family) or fonts.face(fonts.FAMILY)
    units = float(font.units_per_EM)
    glyph = font.load_char(ord(char), flags=LoadFlags.NO_SCALE)
    vertices, codes = font.get_path()
    scale = 64.0 / units  # the outline is told in 64ths
    path = Path(vertices * scale, codes)
    letters = {Path.MOVETO: "M", Path.LINETO: "L", Path.CURVE3: "Q", Path.CURVE4: "C"}
    outline = tuple(
        (letters[code], tuple(zip(*[iter(map(float, points))] * 2, strict=True)))
        if code in letters
        else ("Z", ())
        for points, code in path.iter_segments(simplify=False, curves=True)
    )
    return outline, float(glyph.horiAdvance) / units


class Pictures:
    """Puts figures into one document."""

    def __init__(self, document: Document) -> None:
        self._part = document.part
        self._count = 0
        self._drawings: dict[str, str] = {}  # of each drawing's name, so that none is kept twice

    def figure(self, image: HtmlElement, widest_mm: float) -> Element:
        """Return a paragraph with the picture of an ``img`` of the page."""
        style = image.get("style", "")
        match = _WIDTH.search(style)
        width = min(float(match[1]) if match else widest_mm, widest_mm)
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
