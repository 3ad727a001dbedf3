"""Parts of a package in the form that all spreadsheet programs read.

Excel and LibreOffice take what openpyxl writes; others do not.  Gnumeric drops charts whose
namespaces stand on inner elements, IronCalc and exceljs refuse relations by absolute paths, and
openpyxl knows no alternative text for charts.
"""

from __future__ import annotations

import posixpath
from collections.abc import Mapping

from lxml import etree

_A = "http://schemas.openxmlformats.org/drawingml/2006/main"
_C = "http://schemas.openxmlformats.org/drawingml/2006/chart"
_R = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
_XDR = "http://schemas.openxmlformats.org/drawingml/2006/spreadsheetDrawing"
_DRAWN = {"a": _A, "c": _C, "r": _R, "xdr": _XDR}


def hoist(root: etree._Element) -> None:
    """Declare the namespaces of a chart or a drawing on its root."""
    etree.cleanup_namespaces(root, top_nsmap=_DRAWN)


def relative(data: bytes, name: str) -> etree._Element:
    """The relations of a part with paths from its own folder."""
    root = etree.fromstring(data)
    folder = posixpath.dirname(posixpath.dirname(name))
    for relation in root:
        target = relation.get("Target")
        if target.startswith("/"):
            relation.set("Target", posixpath.relpath(target, f"/{folder}"))
    return root


def described(archive: Mapping[str, bytes], name: str) -> etree._Element:
    """A drawing whose charts say in words what they show."""
    root = etree.fromstring(archive[name])
    folder, file = posixpath.split(name)
    relations = etree.fromstring(archive[f"{folder}/_rels/{file}.rels"])
    targets = {relation.get("Id"): relation.get("Target") for relation in relations}
    for frame in root.iter(f"{{{_XDR}}}graphicFrame"):
        target = targets[frame.find(f".//{{{_C}}}chart").get(f"{{{_R}}}id")]
        chart = etree.fromstring(archive[posixpath.join(folder, target).lstrip("/")])
        frame.find(f".//{{{_XDR}}}cNvPr").set("descr", _words(chart))
    hoist(root)
    return root


def _words(chart: etree._Element) -> str:
    """Title, axes and curves of a chart in a line."""
    axes = [_text(axis.find(f"{{{_C}}}title")) for axis in chart.iter(f"{{{_C}}}valAx")]
    names = [name.text or "" for name in chart.iterfind(f".//{{{_C}}}ser/{{{_C}}}tx/{{{_C}}}v")]
    parts = [
        _text(chart.find(f"{{{_C}}}chart/{{{_C}}}title")),
        f"Оси: {'; '.join(filter(None, axes))}" if any(axes) else "",
        f"Кривые: {', '.join(filter(None, names))}" if any(names) else "",
    ]
    return ". ".join(filter(None, parts))


def _text(title: etree._Element | None) -> str:
    return "" if title is None else "".join(t.text or "" for t in title.iter(f"{{{_A}}}t"))
