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
_DROPPED = {"id", "clip-path"}
_DEFAULTS = {
    ("stroke-dashoffset", "0"),
    ("fill-opacity", "1"),
    ("stroke-opacity", "1"),
    ("font-family", "STIXGeneral"),
    ("stroke-linejoin", "round"),
    ("text-anchor", "start"),
}
_USELESS = re.compile(r"rotate\(-?0 [^)]*\)\s*")


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
    return (
        f'<svg class="fig" xmlns="http://www.w3.org/2000/svg" viewBox="{box}" '
        f'style="width:{width_mm:.1f}mm" font-family="STIXGeneral" stroke-linejoin="round">'
        f"{body}</svg>"
    )


_GRID_LINE = re.compile(r'<path d="(M [^"]*)"( fill="none" stroke="#c4c4c4"[^>]*)/>')


def _gridless(body: str) -> str:
    """Gather the grid lines of equal looks into one path each, below everything else.

    A line of its own for every mark is half of all elements, and elements cost time.
    """
    lines: dict[str, list[str]] = {}

    def take(match: re.Match[str]) -> str:
        lines.setdefault(match.group(2), []).append(match.group(1).strip())
        return ""

    rest = _GRID_LINE.sub(take, body)
    grids = (f'<path d="{" ".join(parts)}"{looks}/>' for looks, parts in lines.items())
    return "".join(grids) + rest


def _write(element: ET.Element) -> str:
    tag = element.tag.removeprefix(_SVG)
    if tag in ("metadata", "style", "title", "defs"):
        return ""
    if tag in ("use", "image", "pattern"):
        msg = f"Рисунок содержит элемент {tag}, который зависит от идентификаторов"
        raise ValueError(msg)
    attributes = _attributes(element)
    inner = "".join(_write(child) + escape(_tail(child), quote=False) for child in element)
    inner = escape(_text(element), quote=False) + inner
    if tag == "g" and (not attributes or not inner):
        return inner
    written = "".join(f' {name}="{escape(value)}"' for name, value in attributes.items())
    return f"<{tag}{written}>{inner}</{tag}>" if inner else f"<{tag}{written}/>"


def _attributes(element: ET.Element) -> dict[str, str]:
    found = {
        name: value for name, value in element.attrib.items() if name not in {*_DROPPED, "style"}
    }
    for rule in element.attrib.get("style", "").split(";"):
        name, _, value = rule.partition(":")
        found |= _property(name.strip(), value.strip())
    if "transform" in found:
        found["transform"] = _USELESS.sub("", found["transform"]).strip()
    if "d" in found:
        found["d"] = re.sub(r"\s*\n\s*", "", found["d"])
    if found.get("stroke", "") == "none":
        found = {name: value for name, value in found.items() if not name.startswith("stroke-")}
    return {
        name: _NUMBER.sub(lambda match: _short(match.group()), value)
        for name, value in found.items()
        if value and (name, value) not in _DEFAULTS
    }


def _property(name: str, value: str) -> dict[str, str]:
    if name == "font":
        # "italic 11px 'STIXGeneral'": the shorthand of older versions
        match = re.fullmatch(r"((?:italic|oblique) )?([\d.]+)px (.*)", value)
        if match is None:
            msg = f"Непонятный шрифт в рисунке: {value}"
            raise ValueError(msg)
        style = {"font-style": "italic"} if match.group(1) else {}
        return style | {"font-size": match.group(2), "font-family": _family(match.group(3))}
    if name == "font-family":
        value = _family(value)
    if name == "font-size":
        value = value.removesuffix("px")
    return {name: value} if name else {}


def _family(value: str) -> str:
    return value.split(",", maxsplit=1)[0].strip("' \"")


def _text(element: ET.Element) -> str:
    text = element.text or ""
    return text if element.tag in (f"{_SVG}text", f"{_SVG}tspan") else text.strip()


def _tail(element: ET.Element) -> str:
    return (element.tail or "").strip()


def _short(number: str) -> str:
    text = f"{float(number):.2f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text
