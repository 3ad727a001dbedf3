"""The finishing pass over the parts of a workbook: cached values, fixed times.

openpyxl writes formulas without values; viewers that do not compute would show
empty cells.  The pass also makes the bytes depend on nothing but the content.
"""

from __future__ import annotations

import io
import math
import zipfile
from posixpath import join, normpath

from lxml import etree

from reports.workbook.sheets import CacheValues

_MAIN = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
_REL = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
_PACKAGE = "http://schemas.openxmlformats.org/package/2006/relationships"
_DCTERMS = "http://purl.org/dc/terms/"
_EPOCH = (1980, 1, 1, 0, 0, 0)


class CacheError(ValueError):
    """A formula cell has no finite value to be cached."""


def sheet_parts(archive: zipfile.ZipFile) -> dict[str, str]:
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


def finish(book: bytes, caches: CacheValues) -> bytes:
    """Fill the cached value of every formula cell and fix all times.

    Raises:
        CacheError: a formula without a value, or a value that is not finite.
    """
    result = io.BytesIO()
    with (
        zipfile.ZipFile(io.BytesIO(book)) as source,
        zipfile.ZipFile(result, "w", zipfile.ZIP_DEFLATED) as target,
    ):
        titles = {part: title for title, part in sheet_parts(source).items()}
        for name in source.namelist():
            data = source.read(name)
            if name in titles:
                data = _fill(data, titles[name], caches.get(titles[name], {}))
            elif name == "xl/styles.xml":
                data = _order_fonts(data)
            elif name == "docProps/core.xml":
                data = _fix_times(data)
            target.writestr(zipfile.ZipInfo(name, _EPOCH), data, zipfile.ZIP_DEFLATED)
    return result.getvalue()


def _fill(data: bytes, title: str, values: dict[str, float | str]) -> bytes:
    root = etree.fromstring(data)
    formula_tag, value_tag = f"{{{_MAIN}}}f", f"{{{_MAIN}}}v"
    for formula in root.iter(formula_tag):
        cell = formula.getparent()
        where = cell.get("r")
        value = values.get(where)
        if value is None or (isinstance(value, float) and not math.isfinite(value)):
            msg = f"formula without a finite value: {title}!{where}: {value!r}"
            raise CacheError(msg)
        element = cell.find(value_tag)
        if element is None:
            element = etree.SubElement(cell, value_tag)
        if isinstance(value, str):
            cell.set("t", "str")
            element.text = value
        else:
            cell.attrib.pop("t", None)
            element.text = repr(float(value))
    return bytes(etree.tostring(root, xml_declaration=True, encoding="UTF-8", standalone=True))


# openpyxl writes the parts of a font in another order than the schema names them.
_FONT_ORDER = ("b", "i", "strike", "condense", "extend", "outline", "shadow", "u", "vertAlign",
               "sz", "color", "name", "family", "charset", "scheme")  # fmt: skip


def _order_fonts(data: bytes) -> bytes:
    root = etree.fromstring(data)
    for font in root.iter(f"{{{_MAIN}}}font"):
        parts = sorted(font, key=lambda part: _FONT_ORDER.index(etree.QName(part).localname))
        font[:] = parts
    return bytes(etree.tostring(root, xml_declaration=True, encoding="UTF-8", standalone=True))


def _fix_times(data: bytes) -> bytes:
    root = etree.fromstring(data)
    for name in ("created", "modified"):
        for element in root.iter(f"{{{_DCTERMS}}}{name}"):
            element.text = "2006-02-21T00:00:00Z"
    return bytes(etree.tostring(root, xml_declaration=True, encoding="UTF-8", standalone=True))
