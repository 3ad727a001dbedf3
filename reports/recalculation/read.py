"""Read a workbook into a grid: sheets, defined names, strings."""

from __future__ import annotations

import re
import zipfile
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from posixpath import join, normpath

from lxml import etree

from reports.recalculation.formulas import (
    Token,
    column_number,
    formula_of,
    pattern,
    ref_of,
    unquoted,
)
from reports.recalculation.grid import MAX_SHEETS, Area, CellGrid
from reports.recalculation.ranges import cross, pick
from reports.recalculation.sheets import MAIN, Forms, parse_xml, read_sheet, rich_text
from reports.shared.errors import BadBook, UnknownFormula
from reports.workbook.intake import STRICT, Package

_MAX_TOKENS = 60  # tokens of a name: nobody calls more than that by one word

Meanings = Mapping[str, tuple[Token, ...]]
Local = Mapping[str, Meanings]  # of a sheet by its title
_STRICT = "{http://purl.oclc.org/ooxml/spreadsheetml/main}"
_REL = "{http://schemas.openxmlformats.org/officeDocument/2006/relationships}"
_ADDRESS = re.compile(  # without a $ a name means another cell in every cell
    r"('(?:[^']|'')+'|[^\W\d][\w.]*)!\$([A-Z]{1,3})\$([0-9]{1,7})"
    r"(?::\$([A-Z]{1,3})\$([0-9]{1,7}))?"
)


def meanings(grid: CellGrid, root: etree._Element) -> Meanings:
    """Names of the whole book that stand for a formula of constants and fixed cells."""
    names: dict[str, tuple[Token, ...]] = {}
    for name in root.iter("{*}definedName"):
        folded = str(name.get("name")).casefold()
        if name.get("localSheetId") is not None or grid.named(folded) is not None:
            continue
        try:
            tokens = pattern(str(name.text or "").strip(), 1, 1)
        except UnknownFormula:
            continue
        if 0 < len(tokens) <= _MAX_TOKENS and _is_fixed(tokens, grid):
            names[folded] = tokens
    return names


def _is_fixed(tokens: tuple[Token, ...], grid: CellGrid) -> bool:
    """Whether a name means the same in every cell, and names no other such name."""
    for before, (kind, value), after in zip(
        (("", ""), *tokens), tokens, (*tokens[1:], ("", "")), strict=False
    ):
        if kind == "ref":
            ref = ref_of(value)
            alone = before[0] != "sheet" and before != ("op", ":")
            if alone or not (ref.row_fixed and ref.column_fixed):
                return False
        elif kind in ("columns", "rows", "error"):
            return False
        elif kind == "name" and after != ("op", "("):
            plain = value.upper() in ("TRUE", "FALSE") or grid.named(value.casefold()) is not None
            if not plain or before[0] == "sheet":
                return False
    return True


def local_names(grid: CellGrid, root: etree._Element) -> Local:
    """Names that a sheet has of its own: there they hide those of the book.

    What stands for something else in every cell, or names a name, is a name that nobody knows.
    """
    titles = [str(sheet.get("name")) for sheet in root.iter("{*}sheet")]
    names: dict[str, dict[str, tuple[Token, ...]]] = {}
    for name in root.iter("{*}definedName"):
        sheet = str(name.get("localSheetId") or "")
        if not (sheet.isdecimal() and int(sheet) < len(titles)):
            continue
        title, folded = titles[int(sheet)], str(name.get("name")).casefold()
        tokens: tuple[Token, ...] = ()
        with suppress(UnknownFormula):
            tokens = pattern(str(name.text or "").strip(), 1, 1)
        fixed = 0 < len(tokens) <= _MAX_TOKENS and _is_fixed(tokens, grid) and not _names(tokens)
        names.setdefault(title, {})[folded] = tokens if fixed else _unknown(title, folded)
    return names


def _unknown(title: str, name: str) -> tuple[Token, ...]:
    return (("name", f"{title}!{name}"),)


def put_local(grid: CellGrid, local: Local) -> None:
    """Replace names of single sheets in the formulas of a grid by what they stand for."""
    folded = {title.casefold(): names for title, names in local.items()}
    nobody = {title.casefold(): {name: _unknown(title, name) for name in names}
              for title, names in local.items()}  # fmt: skip
    for run in grid.runs():
        if run.formula is None:
            continue
        pattern = _localized(run.formula.pattern, run.sheet, folded)
        if pattern != run.formula.pattern:
            refers = any(formula_of(pattern).references)
            pattern = pattern if refers else _localized(run.formula.pattern, run.sheet, nobody)
            run.formula = formula_of(pattern)


def _localized(tokens: tuple[Token, ...], sheet: str, local: Local) -> tuple[Token, ...]:
    pattern: list[Token] = []
    for token, after in zip(tokens, (*tokens[1:], ("", "")), strict=True):
        before = pattern[-1] if pattern else ("", "")
        where = unquoted(before[1]) if before[0] == "sheet" else sheet
        names = local.get(where.casefold(), {})
        inner = names.get(token[1].casefold()) if token[0] == "name" else None
        if inner is None or after == ("op", "("):
            pattern.append(token)
            continue
        if before[0] == "sheet":
            pattern.pop()
        cells = all(kind in ("sheet", "ref", "name") or value == ":" for kind, value in inner)
        pattern += inner if cells else [("op", "("), *inner, ("op", ")")]
    return tuple(pattern)


def put_in(grid: CellGrid, names: Meanings, local: Local) -> None:
    """Replace names in the formulas of a grid by what they stand for.

    A formula that then refers to no cell is left: a number by a name is for a person to see.
    """
    for run in grid.runs():
        hidden = local.get(run.sheet, {}).keys()
        here = {name: inner for name, inner in names.items() if hidden.isdisjoint(_names(inner))}
        if run.formula is not None and not here.keys().isdisjoint(_names(run.formula.pattern)):
            formula = formula_of(_replaced(run.formula.pattern, here))
            if any(formula.references):
                run.formula = formula


def _names(tokens: tuple[Token, ...]) -> set[str]:
    return {value.casefold() for at, (kind, value) in enumerate(tokens)
            if kind == "name" and not _is_called(tokens, at)}  # fmt: skip


def _is_called(tokens: Sequence[Token], at: int) -> bool:
    return tuple(tokens[at + 1 : at + 2]) == (("op", "("),)


def _replaced(tokens: tuple[Token, ...], names: Meanings) -> tuple[Token, ...]:
    pattern: list[Token] = []
    for before, token, after in zip(
        (("", ""), *tokens), tokens, (*tokens[1:], ("", "")), strict=False
    ):
        inner = names.get(token[1].casefold()) if token[0] == "name" else None
        if inner is None or after == ("op", "(") or before[0] == "sheet":
            pattern.append(token)
        else:
            pattern += [("op", "("), *inner, ("op", ")")]
    return tuple(pattern)


def read_grid(book: bytes | Package, forms: Forms | None = None) -> CellGrid:
    """All cells of a workbook that has passed the intake; ``forms`` are those of its class.

    Raises:
        BadBook: damaged, or cells out of bounds.
    """
    try:
        return _read(book if isinstance(book, Package) else Package(book), forms)
    except (zipfile.BadZipFile, KeyError, EOFError, NotImplementedError, OSError):
        raise BadBook("файл .xlsx повреждён") from None


def _read(package: Package, forms: Forms | None) -> CellGrid:
    root = parse_xml(package.read("xl/workbook.xml"))
    if str(root.tag).startswith(_STRICT):
        raise BadBook("; ".join(STRICT))
    targets = _targets(package)
    sheets = list(root.iter(f"{MAIN}sheet"))
    if len(sheets) > MAX_SHEETS:
        raise BadBook(f"в книге больше {MAX_SHEETS} листов")
    grid = CellGrid()
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
    if names := meanings(grid, root):
        put_in(grid, names, local)
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


def _read_names(grid: CellGrid, root: etree._Element) -> None:
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
