"""The formula cells of a workbook, their saved values, and the workbook without them."""

from __future__ import annotations

import io
import re
import zipfile

from lxml import etree

from reports.workbook.caches import sheet_parts

CellValue = float | str | bool | None
Book = dict[str, dict[str, CellValue]]  # sheet → coordinate → value

_MAIN = "{http://schemas.openxmlformats.org/spreadsheetml/2006/main}"
_PICTURES = ("xl/charts/", "xl/drawings/", "xl/comments")
# Where sheets, their relationships and the list of contents name them.
_NAMED = re.compile(
    rb"<(?:legacyDrawing|drawing) [^>]*/>"
    rb'|<(?:Relationship|Override) [^>]*"/?(?:xl|\.\.)/(?:charts|drawings|comments)[^>]*/>'
)
_FORMULA, _VALUE = f"{_MAIN}f", f"{_MAIN}v"


def formula_cells(book: bytes) -> dict[str, list[str]]:
    """Sheet title → coordinates of its formula cells."""
    found = {}
    with zipfile.ZipFile(io.BytesIO(book)) as archive:
        for title, part in sheet_parts(archive).items():
            root = etree.fromstring(archive.read(part), etree.XMLParser(resolve_entities=False))
            found[title] = [str(f.getparent().get("r")) for f in root.iter(_FORMULA)]
    return found


def cached_values(book: bytes) -> Book:
    """Cached values of all formula cells."""
    found: Book = {}
    with zipfile.ZipFile(io.BytesIO(book)) as archive:
        for title, part in sheet_parts(archive).items():
            root = etree.fromstring(archive.read(part), etree.XMLParser(resolve_entities=False))
            values = found.setdefault(title, {})
            for formula in root.iter(_FORMULA):
                cell = formula.getparent()
                text = cell.findtext(_VALUE)
                is_text = cell.get("t") in ("str", "e")
                values[str(cell.get("r"))] = text if is_text or text is None else float(text)
    return found


def stripped(book: bytes) -> tuple[bytes, dict[str, list[str]]]:
    """The workbook without cached values, and its formula cells by sheet."""
    result = io.BytesIO()
    found: dict[str, list[str]] = {}
    with (
        zipfile.ZipFile(io.BytesIO(book)) as source,
        zipfile.ZipFile(result, "w") as target,  # read at once: not worth compressing
    ):
        titles = {part: title for title, part in sheet_parts(source).items()}
        for name in source.namelist():
            data = source.read(name)
            if name in titles:
                data, found[titles[name]] = _without_values(data)
            target.writestr(name, data)
    return result.getvalue(), {title: found[title] for title in titles.values()}


def _without_values(data: bytes) -> tuple[bytes, list[str]]:
    """A sheet's part without the values of its formulas, and their cells."""
    root = etree.fromstring(data, etree.XMLParser(resolve_entities=False))
    cells = []
    for formula in list(root.iter(_FORMULA)):
        cell = formula.getparent()
        cells.append(str(cell.get("r")))
        for value in cell.findall(_VALUE):
            cell.remove(value)
        cell.attrib.pop("t", None)
    return etree.tostring(root, xml_declaration=True, encoding="UTF-8"), cells


def without_pictures(book: bytes) -> bytes:
    """The workbook without charts and notes: nothing is calculated from them."""
    result = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(book)) as source, zipfile.ZipFile(result, "w") as target:
        for name in source.namelist():
            if not name.startswith(_PICTURES):
                target.writestr(name, _NAMED.sub(b"", source.read(name)))
    return result.getvalue()


def row_and_column(coordinate: str) -> tuple[int, int]:
    """Row and column numbers of an address such as ``AB12``."""
    match = re.fullmatch(r"([A-Z]{1,3})([1-9][0-9]{0,6})", coordinate)
    if match is None:
        msg = f"not a cell address: {coordinate}"
        raise ValueError(msg)
    column = 0
    for letter in match.group(1):
        column = column * 26 + ord(letter) - 64
    return int(match.group(2)), column
