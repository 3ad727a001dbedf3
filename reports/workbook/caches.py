"""Finish a workbook: cached values, fixed times, XML that all programs read.

openpyxl writes formulas without values; viewers that do not compute would show
empty cells.  The pass also makes the bytes depend on nothing but the content.
"""

from __future__ import annotations

import io
import math
import posixpath
import re
import zipfile
from collections.abc import Mapping, Sequence
from functools import cache
from itertools import groupby
from pathlib import Path
from posixpath import join, normpath
from typing import Protocol

import numpy as np
from lxml import etree
from openpyxl import Workbook
from openpyxl.utils import coordinate_to_tuple
from openpyxl.writer.excel import ExcelWriter

from kshm.nomenclature.symbols import LOWER, UPPER
from reports.workbook.cell_texts import cell_texts, escaped, finite
from reports.workbook.sheets import CacheValues, Runs, number_text
from reports.workbook.styles import FONT, SIZE

_A = "http://schemas.openxmlformats.org/drawingml/2006/main"
_C = "http://schemas.openxmlformats.org/drawingml/2006/chart"
_R = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
_XDR = "http://schemas.openxmlformats.org/drawingml/2006/spreadsheetDrawing"
_DRAWN = {"a": _A, "c": _C, "r": _R, "xdr": _XDR}
_MAIN = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
_REL = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
_PACKAGE = "http://schemas.openxmlformats.org/package/2006/relationships"
_CHART = "http://schemas.openxmlformats.org/drawingml/2006/chart"
_CHARTS, _DRAWINGS = "xl/charts/chart", "xl/drawings/drawing"
_VALUE = f"{{{_MAIN}}}v"
_DCTERMS = "http://purl.org/dc/terms/"
_MARK = "kshm"
_MARKED = re.compile(rf"<\?{_MARK} (\d+)\?>".encode())
# Of curves with more points every tenth is kept and, where a chord misses by more than this part
# of their height, every second.
_FINE_CURVE, _COARSE, _BEND, _BENT = 200, 10, 0.01, 2
_DRAWN_DIGITS = ".6g"  # of points: a picture needs no more
_PACKED = 7  # of 9: smaller by a fiftieth at hardly any time
_CHART_TEXT = (
    f'<c:txPr xmlns:c="{_CHART}" xmlns:a="{_A}"><a:bodyPr/><a:p><a:pPr><a:defRPr sz="800">'
    f'<a:latin typeface="{FONT}"/></a:defRPr></a:pPr><a:endParaRPr lang="ru-RU"/></a:p></c:txPr>'
)
_LEVELS = {LOWER: "subscript", UPPER: "superscript"}
_LETTERS, _INDEX = f'<sz val="{SIZE}"/>', SIZE + 2
# openpyxl writes the parts of a font in another order than the schema names them.
_FONT_ORDER = ("b", "i", "strike", "condense", "extend", "outline", "shadow", "u", "vertAlign",
               "sz", "color", "name", "family", "charset", "scheme")  # fmt: skip


def hoist(root: etree._Element) -> None:
    """Declare the namespaces of a chart or a drawing on its root."""
    etree.cleanup_namespaces(root, top_nsmap=_DRAWN)


def relative(data: bytes, name: str) -> etree._Element:
    """Return the relations of a part with paths from its own folder."""
    root = etree.fromstring(data)
    folder = posixpath.dirname(posixpath.dirname(name))
    for relation in root:
        target = relation.get("Target")
        if target.startswith("/"):
            relation.set("Target", posixpath.relpath(target, f"/{folder}"))
    return root


def described(archive: Mapping[str, bytes], name: str) -> etree._Element:
    """Return a drawing whose charts say in words what they show."""
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


class Readable(Protocol):
    """What gives a part of a package by its name."""

    def read(self, name: str, /) -> bytes:
        """Return the part."""


def sheet_parts(archive: Readable) -> dict[str, str]:
    """Sheet title → name of its part, found through the relations of the workbook."""
    book = etree.fromstring(archive.read("xl/workbook.xml"))
    rels = etree.fromstring(archive.read("xl/_rels/workbook.xml.rels"))
    targets = {rel.get("Id"): rel.get("Target") for rel in rels.iter(f"{{{_PACKAGE}}}Relationship")}
    parts = {}
    for sheet in book.iter(f"{{{_MAIN}}}sheet"):
        target = targets[sheet.get(f"{{{_REL}}}id")]
        absolute = target.startswith("/")
        parts[sheet.get("name")] = target[1:] if absolute else normpath(join("xl", target))
    return parts


class _PartStore(dict[str, bytes]):
    """What openpyxl writes into a zip, without the zip: every part is read and written again."""

    def writestr(self, name: str, data: bytes | str) -> None:
        """Keep a part."""
        self[name] = data.encode() if isinstance(data, str) else data

    def write(self, file: str, name: str) -> None:
        """Keep a part from a file."""
        self[name] = Path(file).read_bytes()

    def read(self, name: str) -> bytes:
        """Return a part."""
        return self[name]

    def namelist(self) -> list[str]:
        """Names of the parts."""
        return list(self)

    def close(self) -> None:
        """Nothing to do."""


def finish(book: Workbook, caches: CacheValues | None = None) -> bytes:
    """Return the bytes of a workbook with the cached value of every formula cell and fixed times.

    Raises:
        CacheError: a formula without a value, or a value that is not finite.
        OSError, SerialisationError: there is no room for temporary files.
    """
    caches = caches or CacheValues()
    parts = _PartStore()
    ExcelWriter(book, parts).save()
    titles = {part: title for title, part in sheet_parts(parts).items()}
    result = io.BytesIO()
    with zipfile.ZipFile(result, "w") as target:
        for name, content in parts.items():
            data = content
            if name in titles:
                data = _fill(data, titles[name], caches)
            elif name.startswith(_CHARTS):
                data = _fill_chart(data, caches)
            elif name.startswith(_DRAWINGS):
                data = _written(described(parts, name))
            elif name.endswith(".rels"):
                data = _written(relative(data, name))
            elif name == "xl/styles.xml":
                data = _fonts(data)
            elif name == "docProps/core.xml":
                data = _fix_times(data)
            target.writestr(zipfile.ZipInfo(name), data, zipfile.ZIP_DEFLATED, _PACKED)
    return result.getvalue()


def _written(root: etree._Element) -> bytes:
    return bytes(etree.tostring(root, xml_declaration=True, encoding="UTF-8", standalone=True))


def _fill(data: bytes, title: str, caches: CacheValues) -> bytes:
    root = etree.fromstring(data)
    values = caches.values.get(title, {})
    for formula in root.iter(f"{{{_MAIN}}}f"):
        cell = formula.getparent()
        where = cell.get("r")
        value = finite(values.get(where), f"{title}!{where}")
        element = cell.find(_VALUE)
        if element is None:
            element = etree.SubElement(cell, _VALUE)
        if isinstance(value, str):
            cell.set("t", "str")
            element.text = value
        else:
            cell.attrib.pop("t", None)
            element.text = number_text(value)
    marks: list[bytes] = []
    _mark_symbols(root, caches.symbols.get(title, {}), marks)
    _mark_cells(root, title, caches, marks)
    return _unmarked(root, marks)


def _unmarked(root: etree._Element, marks: Sequence[bytes]) -> bytes:
    """Return XML with the texts whose places are marked."""
    return _MARKED.sub(lambda mark: marks[int(mark[1])], _written(root))


def _marked(text: str, marks: list[bytes]) -> etree._Element:
    """Return a mark where a text of XML belongs: no elements need be made of it."""
    marks.append(text.encode())
    return etree.ProcessingInstruction(_MARK, str(len(marks) - 1))


def _mark_cells(root: etree._Element, title: str, caches: CacheValues, marks: list[bytes]) -> None:
    """Mark where the cells belong that are written as text."""
    columns, bare = caches.columns.get(title, []), caches.bare.get(title, [])
    if not columns and not bare:
        return
    sheet_rows = root.find(f"{{{_MAIN}}}sheetData")
    rows = {int(row.get("r")): row for row in sheet_rows}
    looks = {c.get("r"): c.get("s") for row in sheet_rows for c in row}
    for number, cells in cell_texts(title, columns, bare, looks).items():
        if number not in rows:
            rows[number] = etree.Element(f"{{{_MAIN}}}row", r=str(number))
        old = {coordinate_to_tuple(c.get("r"))[1]: c for c in rows[number]}
        for is_text, run in groupby(sorted([*old, *cells]), cells.__contains__):
            if is_text:
                rows[number].append(_marked("".join(map(cells.__getitem__, run)), marks))
            else:
                rows[number].extend(map(old.__getitem__, run))
    sheet_rows[:] = [rows[number] for number in sorted(rows)]


def _mark_symbols(
    root: etree._Element, symbols: Mapping[str, tuple[Runs, bool]], marks: list[bytes]
) -> None:
    """Mark where the pieces of symbols belong, with indices as such."""
    for item in root.iter(f"{{{_MAIN}}}is") if symbols else ():
        symbol = symbols.get(item.getparent().get("r"))
        if symbol is not None:
            item[:] = [_marked(_pieces(*symbol), marks)]


@cache
def _pieces(runs: Runs, bold: bool) -> str:
    """Return the first piece looks as its cell does, the others say all of their look."""
    face = f'<rFont val="{FONT}"/>{"<b/>" if bold else ""}'
    pieces = []
    for number, (text, level) in enumerate(runs):
        # An index a little larger: programs make it about 0.6 of what is said.
        size = f'<sz val="{_INDEX}"/><vertAlign val="{_LEVELS[level]}"/>' if level else _LETTERS
        properties = f"<rPr>{face}{size}</rPr>" if number or level else ""
        pieces.append(f'<r>{properties}<t xml:space="preserve">{escaped(text)}</t></r>')
    return "".join(pieces)


def _fill_chart(data: bytes, caches: CacheValues) -> bytes:
    """Put the numbers of its ranges into a chart, for viewers that do not compute."""
    ranges = caches.ranges
    root, marks = etree.fromstring(data), list[bytes]()
    for series in root.iter(f"{{{_CHART}}}ser"):
        references = list(series.iter(f"{{{_CHART}}}numRef"))
        curves = [ranges[reference.findtext(f"{{{_CHART}}}f")] for reference in references]
        rows = shape_rows(curves)
        # Cells still to be filled in have no value.
        for reference, numbers in zip(references, curves, strict=True):
            points = "".join(
                f'<pt idx="{i}"><v>{numbers[i]:{_DRAWN_DIGITS}}</v></pt>'
                for i in rows
                if math.isfinite(numbers[i])
            )
            reference.append(_marked(
                f"<numCache><formatCode>General</formatCode>"
                f'<ptCount val="{len(numbers)}"/>{points}</numCache>', marks,
            ))  # fmt: skip
        for name in series.iter(f"{{{_CHART}}}strRef"):
            text = escaped(caches.names[name.findtext(f"{{{_CHART}}}f")])
            name.append(_marked(
                f'<strCache><ptCount val="1"/><pt idx="0"><v>{text}</v></pt></strCache>', marks,
            ))  # fmt: skip
        if len(rows) < max(map(len, curves), default=0):
            root.find(f".//{{{_CHART}}}dispBlanksAs").set("val", "span")
    # One face and size for all texts of a chart that say none.
    before = root.find(f"{{{_CHART}}}spPr")
    before = root.find(f"{{{_CHART}}}chart") if before is None else before
    before.addnext(etree.fromstring(_CHART_TEXT))
    hoist(root)
    return _unmarked(root, marks)


def shape_rows(curves: Sequence[Sequence[float]]) -> Sequence[int]:
    """Rows that have the shape of a curve: of a fine one those between which it is straight."""
    count = max(map(len, curves), default=0)
    if count <= _FINE_CURVE:
        return range(count)
    rows = np.arange(count)
    kept = rows % _COARSE == 0
    kept[-1] = True
    for numbers in map(np.asarray, curves):
        chord = np.interp(rows, rows[kept], numbers[kept])
        bent = np.abs(numbers - chord) > _BEND * np.ptp(numbers)
        between = np.repeat(np.maximum.reduceat(bent, rows[::_COARSE]), _COARSE)[:count]
        kept |= between & (rows % _BENT == 0)
    return np.flatnonzero(kept).tolist()


def _fonts(data: bytes) -> bytes:
    root = etree.fromstring(data)
    # Columns are as wide as digits of the first font: one whose metrics every system has.
    first = root.find(f"{{{_MAIN}}}fonts")[0]
    first.find(f"{{{_MAIN}}}name").set("val", FONT)
    first.find(f"{{{_MAIN}}}sz").set("val", str(SIZE))
    for other in ("family", "scheme"):
        first.remove(first.find(f"{{{_MAIN}}}{other}"))
    for font in root.iter(f"{{{_MAIN}}}font"):
        font[:] = sorted(font, key=lambda part: _FONT_ORDER.index(etree.QName(part).localname))
    return _written(root)


def _fix_times(data: bytes) -> bytes:
    root = etree.fromstring(data)
    for name in ("created", "modified"):
        for element in root.iter(f"{{{_DCTERMS}}}{name}"):
            element.text = "2006-02-21T00:00:00Z"
    return _written(root)
