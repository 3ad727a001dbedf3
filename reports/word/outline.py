"""Figures for Word: an SVG whose letters are outlines, and the same as PNG.

Word sets the text of an SVG in whatever font the machine has; the figures' letters are STIX,
which hardly one has.  As outlines they look the same everywhere.
"""

from __future__ import annotations

import functools
from xml.etree import ElementTree as ET  # our own output, no foreign XML

from reports.document.text import fonts

_SVG = "{http://www.w3.org/2000/svg}"
_DPI = 220  # of the picture beside the SVG, for programs that show no SVG
_PT = 72
_INHERITED = ("font-family", "font-style", "font-weight", "font-size", "fill", "text-anchor")
_USUAL = {"font-family": fonts.FAMILY, "font-size": "11"}


def outlined(svg: str) -> str:
    """The SVG with each text as a path."""
    ET.register_namespace("", _SVG[1:-1])
    root = ET.fromstring(svg)
    _outline(root, _USUAL)
    return ET.tostring(root, encoding="unicode")


def picture(svg: str, width_mm: float) -> bytes:
    """An SVG without texts as PNG.

    Args:
        svg: the outlined SVG.
        width_mm: its width on paper [mm].
    """
    import resvg_py

    made = resvg_py.svg_to_bytes(
        svg_string=svg, width=round(width_mm / 25.4 * _DPI), background="white"
    )
    return bytes(made)


def _outline(element: ET.Element, above: dict[str, str]) -> None:
    looks = above | {name: element.attrib[name] for name in _INHERITED if name in element.attrib}
    for place, child in enumerate(list(element)):
        if child.tag != f"{_SVG}text":
            _outline(child, looks)
            continue
        path = ET.Element(f"{_SVG}path", {"d": _path_of(child, looks)})
        for name in ("transform", "fill"):
            if name in child.attrib:
                path.set(name, child.attrib[name])
        element[place] = path


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
    for place, (outline, width) in enumerate(glyphs):
        if place < len(xs) and place:
            x = xs[place]
        y = ys[min(place, len(ys) - 1)]
        out += [
            f"{code}{' '.join(_placed(x + size * a, y - size * b) for a, b in points)}"
            for code, points in outline
        ]
        x += size * width
    return "".join(out)


def _placed(x: float, y: float) -> str:
    return f"{x:.2f} {y:.2f}"


Outline = tuple[tuple[str, tuple[tuple[float, float], ...]], ...]


@functools.lru_cache(maxsize=2048)
def _glyph(family: str, style: str, weight: str, char: str) -> tuple[Outline, float]:
    """Outline [em] with y upwards and advance [em] of a letter."""
    from matplotlib.ft2font import LoadFlags
    from matplotlib.path import Path

    font = fonts.face(family, style, weight)
    if ord(char) not in font.get_charmap():
        second = fonts.face(fonts.SECOND, style, weight)
        lacking = ord(char) not in second.get_charmap()
        font = fonts.face(fonts.FAMILY, "normal", "normal") if lacking else second
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
