"""A workbook's parts put together: its sheets by title, its defined names, its strings."""

from __future__ import annotations

import re
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from posixpath import join, normpath

from reports.recalculation.by_columns.grid import MAX_SHEETS, BadBook, Grid
from reports.recalculation.by_columns.sheet_form import plain_text
from reports.recalculation.by_columns.sheet_text import read_text
from reports.recalculation.by_columns.sheet_xml import parse_xml, read_xml, rich_text
from reports.recalculation.by_columns.syntax import column_number
from reports.workbook.package import Package

_MAIN = "{http://schemas.openxmlformats.org/spreadsheetml/2006/main}"
_STRICT = "{http://purl.oclc.org/ooxml/spreadsheetml/main}"
_REL = "{http://schemas.openxmlformats.org/officeDocument/2006/relationships}"
_ADDRESS = re.compile(r"('(?:[^']|'')+'|[^\W\d][\w.]*)!\$?([A-Z]{1,3})\$?([0-9]{1,7})")
_STRING = re.compile(r'<si><t(?: xml:space="preserve")?>([^<]*)</t></si>')
_BETWEEN = "\x01"  # no XML has it
_SMALL = 2**20


@dataclass(frozen=True, slots=True)
class _Contents:
    """What the workbook's own part and its relations say."""

    sheets: tuple[tuple[str, str], ...]  # title and name of the part
    strings: str | None
    names: Mapping[str, tuple[str, int, int]]


def read_grid(book: bytes | Package) -> Grid:
    """All cells of a workbook that has passed the intake.

    Raises:
        BadBook: damaged, or cells out of bounds.
    """
    try:
        return _read(book if isinstance(book, Package) else Package(book))
    except (zipfile.BadZipFile, KeyError, EOFError, NotImplementedError, OSError):
        msg = "файл .xlsx повреждён"
        raise BadBook(msg) from None


def _read(package: Package) -> Grid:
    parts = package.read("xl/workbook.xml"), package.read("xl/_rels/workbook.xml.rels")
    about = _known_contents(*parts) if len(parts[0]) < _SMALL else _contents(*parts)
    grid = Grid(names=dict(about.names))
    strings: list[str] = []
    if about.sheets and about.strings is not None:
        strings = _strings(package.read(about.strings))
    for title, part in about.sheets:
        grid.sheets[title] = {}
        data = package.read(part)
        if not read_text(grid, title, data, strings):
            read_xml(grid, title, data, strings)
    return grid


@lru_cache(maxsize=16)  # the same for all books of a class that one program has saved
def _known_contents(workbook: bytes, relations: bytes) -> _Contents:
    return _contents(workbook, relations)


def _contents(workbook: bytes, relations: bytes) -> _Contents:
    root = parse_xml(workbook)
    if str(root.tag).startswith(_STRICT):
        msg = "книга сохранена в строгом формате Open XML; сохраните её как обычную .xlsx"
        raise BadBook(msg)
    targets = {rel.get("Id"): rel for rel in parse_xml(relations).iter("{*}Relationship")}
    found = list(root.iter(f"{_MAIN}sheet"))
    if len(found) > MAX_SHEETS:
        msg = f"в книге больше {MAX_SHEETS} листов"
        raise BadBook(msg)
    sheets = []
    for sheet in found:
        relation = targets.get(sheet.get(f"{_REL}id"))
        if relation is not None and str(relation.get("Type")).endswith("/worksheet"):
            sheets.append((str(sheet.get("name")), _part(str(relation.get("Target")))))
    strings = None
    for relation in targets.values():
        if str(relation.get("Type")).endswith("/sharedStrings"):
            strings = _part(str(relation.get("Target")))
            break
    names = {}
    for name in root.iter(f"{_MAIN}definedName"):
        match = _ADDRESS.fullmatch(str(name.text or "").strip())
        if match is not None and name.get("localSheetId") is None:
            title = match[1].strip("'").replace("''", "'")
            cell = (title, int(match[3]), column_number(match[2]))
            names[str(name.get("name")).casefold()] = cell
    return _Contents(tuple(sheets), strings, names)


def _part(target: str) -> str:
    return target[1:] if target.startswith("/") else normpath(join("xl", target))


def _strings(data: bytes) -> list[str]:
    plain = _plain_strings(data)
    if plain is not None:
        return plain
    return [rich_text(item) for item in parse_xml(data).iterchildren("{*}si")]


def _plain_strings(data: bytes) -> list[str] | None:
    """Strings of a part in the usual form; None where anything in it is not."""
    head, _, rest = data.partition(b"<sst ")
    _, _, rest = rest.partition(b">")
    body, end, tail = rest.partition(b"</sst>")
    if not end or tail.strip() or b"<!" in data or not _is_utf8(head):
        return None
    try:
        text = body.decode("utf-8")
    except UnicodeDecodeError:
        return None
    pieces = _STRING.split(text)
    if "".join(pieces[::2]).strip() or _BETWEEN in text:
        return None
    return plain_text(_BETWEEN.join(pieces[1::2])).split(_BETWEEN) if len(pieces) > 1 else []


def _is_utf8(head: bytes) -> bool:
    return b"encoding=" not in head or b'encoding="UTF-8"' in head
