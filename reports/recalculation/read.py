"""A workbook's parts put together: its sheets by title, its defined names, its strings."""

from __future__ import annotations

import re
import zipfile
from collections.abc import Iterable, Iterator
from posixpath import join, normpath

from lxml import etree

from reports.recalculation.crossing import cross
from reports.recalculation.forms import Forms
from reports.recalculation.grid import MAX_SHEETS, Area, BadBook, Grid
from reports.recalculation.language import column_number
from reports.recalculation.meanings import local_names, meanings, put_in, put_local
from reports.recalculation.picked import pick
from reports.recalculation.sheets import MAIN, parse_xml, read_sheet, rich_text
from reports.workbook.package import Package

_STRICT = "{http://purl.oclc.org/ooxml/spreadsheetml/main}"
_REL = "{http://schemas.openxmlformats.org/officeDocument/2006/relationships}"
_ADDRESS = re.compile(  # without a $ a name means another cell in every cell
    r"('(?:[^']|'')+'|[^\W\d][\w.]*)!\$([A-Z]{1,3})\$([0-9]{1,7})"
    r"(?::\$([A-Z]{1,3})\$([0-9]{1,7}))?"
)


def read_grid(book: bytes | Package, forms: Forms | None = None) -> Grid:
    """All cells of a workbook that has passed the intake; ``forms`` are those of its class.

    Raises:
        BadBook: damaged, or cells out of bounds.
    """
    try:
        return _read(book if isinstance(book, Package) else Package(book), forms)
    except (zipfile.BadZipFile, KeyError, EOFError, NotImplementedError, OSError):
        raise BadBook("файл .xlsx повреждён") from None


def _read(package: Package, forms: Forms | None) -> Grid:
    root = parse_xml(package.read("xl/workbook.xml"))
    if str(root.tag).startswith(_STRICT):
        raise BadBook("книга сохранена в строгом формате Open XML; сохраните её как обычную .xlsx")
    targets = _targets(package)
    sheets = list(root.iter(f"{MAIN}sheet"))
    if len(sheets) > MAX_SHEETS:
        raise BadBook(f"в книге больше {MAX_SHEETS} листов")
    grid = Grid()
    _read_names(grid, root)
    texts = [part for rel in targets.values() if (part := _part(rel, "sharedStrings"))]
    strings: list[str] = []
    if sheets and texts:
        strings = [rich_text(item) for item in parse_xml(package.read(texts[0])).iter("{*}si")]
    for title, part in _worksheets(sheets, targets):
        grid.sheets[title] = {}
        read_sheet(grid, title, package.read(part), strings, forms)
    if local := local_names(grid, root):
        put_local(grid, local)
    if known := meanings(grid, root):
        put_in(grid, known, local)
    pick(grid)
    cross(grid)
    return grid


def worksheets(package: Package) -> Iterator[tuple[str, str]]:
    """Titles of the sheets with the names of their parts."""
    root = parse_xml(package.read("xl/workbook.xml"))
    return _worksheets(root.iter(f"{MAIN}sheet"), _targets(package))


def _targets(package: Package) -> dict[str | None, etree._Element]:
    relations = parse_xml(package.read("xl/_rels/workbook.xml.rels"))
    return {rel.get("Id"): rel for rel in relations.iter("{*}Relationship")}


def _worksheets(
    sheets: Iterable[etree._Element], targets: dict[str | None, etree._Element]
) -> Iterator[tuple[str, str]]:
    for sheet in sheets:
        relation = targets.get(sheet.get(f"{_REL}id"))
        if relation is not None and (part := _part(relation, "worksheet")):
            yield str(sheet.get("name")), part


def _part(relation: etree._Element, kind: str) -> str:
    """Name of the part that a relation of a kind leads to."""
    if not str(relation.get("Type")).endswith(f"/{kind}"):
        return ""
    target = str(relation.get("Target"))
    return target[1:] if target.startswith("/") else normpath(join("xl", target))


def _read_names(grid: Grid, root: etree._Element) -> None:
    for name in root.iter(f"{MAIN}definedName"):
        match = _ADDRESS.fullmatch(str(name.text or "").strip())
        if match is None or name.get("localSheetId") is not None:
            continue
        title = match[1].strip("'").replace("''", "'")
        folded = str(name.get("name")).casefold()
        row, column = int(match[3]), column_number(match[2])
        if match[4] is None:
            grid.names[folded] = (title, row, column)
        else:
            grid.areas[folded] = Area(title, row, int(match[5]), column, column_number(match[4]))
