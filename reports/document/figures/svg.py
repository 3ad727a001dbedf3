"""matplotlib's SVG made fit for a page with many of them.

Inline in HTML, ``style`` attributes would be read as CSS (WeasyPrint warns of every
property), identifiers would clash between figures, and nested empty groups cost time.
"""

from __future__ import annotations

import re
from html import escape
from xml.etree import ElementTree as ET  # our own output, no foreign XML

_SVG = "{http://www.w3.org/2000/svg}"
_NUMBER = re.compile(r"-?\d+\.\d{3,}")
_DROPPED = {"id", "clip-path", "style"}
_DEFAULTS = {
    ("stroke-dashoffset", "0"),
    ("fill-opacity", "1"),
    ("stroke-opacity", "1"),
    ("font-family", "STIXGeneral"),
    ("stroke-linejoin", "round"),
    ("text-anchor", "start"),
}
_USELESS = re.compile(r"rotate\(-?0 [^)]*\)\s*")
_FONT = re.compile(r"(?:(italic|oblique) )?([\d.]+)px (.*)")  # the shorthand of older versions
_GRID_LINE = re.compile(r'<path d="(M [^"]*)"( fill="none" stroke="#c4c4c4"[^>]*)/>')


def clean(svg: str, width_mm: float) -> str:
    """Turn a whole SVG file into a lean inline element of a given width.

    Args:
        svg: What matplotlib wrote; clip paths and identifiers are dropped, so nothing may
            depend on them.
        width_mm: Width of the figure on paper [mm].

    Raises:
        ValueError: The SVG uses markers or patterns, which need identifiers.
    """
    root = ET.fromstring(svg)
    box = " ".join(_short(part) for part in root.attrib["viewBox"].split())
    body = _gridless("".join(_write(child) for child in root))
    _, _, across, down = (float(part) for part in box.split())
    return (
        f'<svg class="fig" xmlns="http://www.w3.org/2000/svg" viewBox="{box}" '
        f'style="width:{width_mm:.1f}mm" data-size="{across:.4g}/{down:.4g}" '
        f'font-family="STIXGeneral" stroke-linejoin="round">'
        f"{body}</svg>"
    )


def _gridless(body: str) -> str:
    """Gather the grid lines of equal looks into one path each, below everything else.

    A line of its own for every mark is half of all elements, and elements cost time.
    """
    lines: dict[str, list[str]] = {}
    for path, looks in _GRID_LINE.findall(body):
        lines.setdefault(looks, []).append(path.strip())
    grids = (f'<path d="{" ".join(parts)}"{looks}/>' for looks, parts in lines.items())
    return "".join(grids) + _GRID_LINE.sub("", body)


def _write(element: ET.Element) -> str:
    tag = element.tag.removeprefix(_SVG)
    if tag in ("metadata", "style", "title", "defs"):
        return ""
    if tag in ("use", "image", "pattern"):
        msg = f"Рисунок содержит элемент {tag}, который зависит от идентификаторов"
        raise ValueError(msg)
    attributes = _attributes(element)
    text = element.text or ""
    inner = escape(text if tag in ("text", "tspan") else text.strip(), quote=False)
    for child in element:
        inner += _write(child) + escape((child.tail or "").strip(), quote=False)
    if tag == "g" and (not attributes or not inner):
        return inner
    written = "".join(f' {name}="{escape(value)}"' for name, value in attributes.items())
    return f"<{tag}{written}>{inner}</{tag}>" if inner else f"<{tag}{written}/>"


def _attributes(element: ET.Element) -> dict[str, str]:
    wanted = {name: value for name, value in element.attrib.items() if name not in _DROPPED}
    for rule in filter(None, element.attrib.get("style", "").split(";")):
        name, _, value = rule.partition(":")
        wanted |= _property(name.strip(), value.strip())
    wanted["transform"] = _USELESS.sub("", wanted.get("transform", "")).strip()
    wanted["d"] = re.sub(r"\s*\n\s*", "", wanted.get("d", ""))
    bare = wanted.get("stroke", "") == "none"
    return {
        name: _NUMBER.sub(lambda match: _short(match.group()), value)
        for name, value in wanted.items()
        if value and (name, value) not in _DEFAULTS and not (bare and name.startswith("stroke-"))
    }


def _property(name: str, value: str) -> dict[str, str]:
    font = _FONT.fullmatch(value) if name == "font" else None
    if font is not None:
        style = {"font-style": "italic"} if font[1] else {}
        return style | {"font-size": font[2]} | _property("font-family", font[3])
    if name == "font-family":
        value = value.split(",", maxsplit=1)[0].strip("' \"")
    return {name: value.removesuffix("px") if name == "font-size" else value}


def _short(number: str) -> str:
    text = f"{float(number):.2f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text
