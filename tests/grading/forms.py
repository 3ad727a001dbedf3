"""The forms in which workbooks come back: as Excel writes them, with rows and columns moved."""

from __future__ import annotations

import io
import re
import zipfile
from collections.abc import Callable

from lxml import etree

from reports.recalculation.formulas import column_number, pattern, render
from reports.workbook.caches import sheet_parts
from tools.referees.by_formualizer import Formualizer

MAIN = "{http://schemas.openxmlformats.org/spreadsheetml/2006/main}"
OFFICE = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
PACKAGE = "http://schemas.openxmlformats.org/package/2006"
_CHANGED = ("xl/styles.xml", "xl/_rels/workbook.xml.rels", "[Content_Types].xml")
_CELL = re.compile(r"([A-Z]+)([0-9]+)")


def rewritten(book: bytes, change: Callable[[str, bytes], bytes]) -> bytes:
    """A package with every part passed through a function."""
    stream = io.BytesIO()
    with (
        zipfile.ZipFile(io.BytesIO(book)) as source,
        zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as target,
    ):
        for name in source.namelist():
            target.writestr(name, change(name, source.read(name)))
    return stream.getvalue()


def as_excel(book: bytes) -> bytes:
    """The form Excel writes: shared formulas, shared strings, renumbered styles, caches."""
    (values,) = Formualizer().recalculate([book])
    with zipfile.ZipFile(io.BytesIO(book)) as archive:
        titles = {part: title for title, part in sheet_parts(archive).items()}
        styles = etree.fromstring(archive.read("xl/styles.xml"))
        count = len(styles.find(f"{MAIN}cellXfs"))
    strings: list[str] = []
    with zipfile.ZipFile(io.BytesIO(book)) as archive:
        sheets = {
            part: _excel_sheet(archive.read(part), values[title], strings, count)
            for part, title in titles.items()
        }

    def change(name: str, data: bytes) -> bytes:
        if name in sheets:
            return sheets[name]
        root = etree.fromstring(data) if name in _CHANGED else None
        if name == "xl/styles.xml":
            formats = root.find(f"{MAIN}cellXfs")
            formats[:] = list(reversed(formats))
        elif name == "xl/_rels/workbook.xml.rels":
            about = {"Id": "rIdStrings", "Type": f"{OFFICE}/sharedStrings",
                     "Target": "sharedStrings.xml"}  # fmt: skip
            etree.SubElement(root, f"{{{PACKAGE}/relationships}}Relationship", about)
        elif name == "[Content_Types].xml":
            kind = "application/vnd.openxmlformats-officedocument.spreadsheetml.sharedStrings+xml"
            about = {"PartName": "/xl/sharedStrings.xml", "ContentType": kind}
            etree.SubElement(root, f"{{{PACKAGE}/content-types}}Override", about)
        return data if root is None else _written(root)

    built = rewritten(book, change)
    stream = io.BytesIO(built)
    with zipfile.ZipFile(stream, "a", zipfile.ZIP_DEFLATED) as archive:
        root = etree.Element(f"{MAIN}sst", nsmap={None: MAIN[1:-1]})
        for text in strings:
            item = etree.SubElement(etree.SubElement(root, f"{MAIN}si"), f"{MAIN}t")
            item.text = text
        archive.writestr("xl/sharedStrings.xml", _written(root))
    return stream.getvalue()


_OURS = 10_000  # formulas that the book shares itself are numbered below


def _written(root: etree._Element) -> bytes:
    return etree.tostring(root, xml_declaration=True, encoding="UTF-8", standalone=True)


def _excel_sheet(data: bytes, values: dict, strings: list[str], styles: int) -> bytes:
    root = etree.fromstring(data)
    masters: dict[tuple, tuple[int, list]] = {}
    for cell in root.iter(f"{MAIN}c"):
        style = int(cell.get("s", "0"))
        cell.set("s", str(styles - 1 - style))
        letters, row = _CELL.fullmatch(cell.get("r")).groups()
        if cell.get("t") == "inlineStr":
            inline = cell.find(f"{MAIN}is")
            if inline is None:
                cell.attrib.pop("t")
                continue
            strings.append("".join(inline.itertext()))
            cell.remove(inline)
            cell.set("t", "s")
            etree.SubElement(cell, f"{MAIN}v").text = str(len(strings) - 1)
        formula = cell.find(f"{MAIN}f")
        if formula is None or formula.text is None:
            continue
        value = values[cell.get("r")]
        for old in cell.findall(f"{MAIN}v"):
            cell.remove(old)
        cell.attrib.pop("t", None)
        if isinstance(value, str):
            cell.set("t", "e" if value.startswith("#") else "str")
        if value is not None:
            etree.SubElement(cell, f"{MAIN}v").text = (
                value if isinstance(value, str) else repr(value)
            )
        if formula.get("t") in ("array", "shared"):  # stay with their cells
            continue
        try:
            key = (letters, pattern(formula.text, int(row), column_number(letters)))
        except ValueError:
            continue
        masters.setdefault(key, (len(masters), []))[1].append((int(row), cell))
    for (letters, _), (number, cells) in masters.items():
        rows = [row for row, _ in cells]
        if len(rows) < 2 or rows != list(range(rows[0], rows[-1] + 1)):
            continue
        for index, (_, cell) in enumerate(cells):
            formula = cell.find(f"{MAIN}f")
            formula.set("t", "shared")
            formula.set("si", str(_OURS + number))
            if index:
                formula.text = None
            else:
                formula.set("ref", f"{letters}{rows[0]}:{letters}{rows[-1]}")
    return _written(root)


def tampered(book: bytes, sheet: str, cell: str) -> bytes:
    """A saved value changed by hand, its formula kept."""
    with zipfile.ZipFile(io.BytesIO(book)) as archive:
        part = sheet_parts(archive)[sheet]

    def change(name: str, data: bytes) -> bytes:
        if name != part:
            return data
        root = etree.fromstring(data)
        (actual,) = root.iterfind(f".//{MAIN}c[@r='{cell}']")
        value = actual.find(f"{MAIN}v")
        value.text = repr(float(value.text) * 2 + 1)
        return _written(root)

    return rewritten(book, change)


def insert(book, sheet: str, *, row: int = 0, column: int = 0) -> None:
    """Insert an empty row or column as a spreadsheet does: all references follow."""
    for other in book.worksheets:
        for line in other.iter_rows():
            for cell in line:
                if isinstance(cell.value, str) and cell.value.startswith("="):
                    at = other.title
                    cell.value = "=" + _moved(cell.value[1:], at, sheet, row, column)
    for name in book.defined_names.values():
        name.attr_text = _moved(name.attr_text, "", sheet, row, column)
    target = book[sheet]
    if row:
        target.insert_rows(row)
    if column:
        target.insert_cols(column)


_REFERENCE = re.compile(r"('(?:[^']|'')+'!)?(\$?)([A-Z]{1,3})(\$?)([0-9]+)(?![\w(])(:)?")


def _moved(text: str, own: str, sheet: str, row: int, column: int) -> str:
    area = ""

    def move(match: re.Match[str]) -> str:
        nonlocal area
        before = text[match.start() - 1] if match.start() else ""
        if before.isalnum() or before in ("_", "."):
            return match.group()
        named = match[1] or area
        area = named if match[6] else ""  # the second end of a range is on the same sheet
        title = named[1:-2].replace("''", "'") if named else own
        letters, number = match[3], int(match[5])
        if title == sheet:
            if row and number >= row:
                number += 1
            if column and column_number(letters) >= column:
                position = pattern(f"{letters}1", 1, 1)
                letters = render(position, 1, 2)[1:-1]
        return f"{match[1] or ''}{match[2]}{letters}{match[4]}{number}{match[6] or ''}"

    return _REFERENCE.sub(move, text)
