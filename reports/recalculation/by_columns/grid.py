"""The cells of a workbook, column by column, read once and within bounds."""

from __future__ import annotations

import html
import io
import math
import re
import zipfile
from dataclasses import dataclass, field
from posixpath import join, normpath

import numpy as np
from lxml import etree
from numpy.typing import NDArray

from reports.recalculation.by_columns.syntax import (
    Token,
    UnknownFormula,
    column_number,
    filled,
    pattern,
    row_template,
)

_MAIN = "{http://schemas.openxmlformats.org/spreadsheetml/2006/main}"
_STRICT = "{http://purl.oclc.org/ooxml/spreadsheetml/main}"
_REL = "{http://schemas.openxmlformats.org/officeDocument/2006/relationships}"

MAX_ROW, MAX_COLUMN, MAX_CELLS, MAX_SHEETS = 20_000, 1_000, 400_000, 200

Constant = float | str | bool
Cached = float | str | bool | None
_PlainCell = tuple[str, str, str, str, str, str, str]  # as _PLAIN_CELL finds it

_ADDRESS = re.compile(r"('(?:[^']|'')+'|[^\W\d][\w.]*)!\$?([A-Z]{1,3})\$?([0-9]{1,7})")


class BadBook(ValueError):  # noqa: N818 - an expected find
    """A workbook that cannot be read; the message is Russian."""


@dataclass(slots=True)
class Run:
    """Cells of one column below each other with the same formula."""

    sheet: str
    column: int
    first: int
    count: int
    pattern: tuple[Token, ...] | None  # None: a formula that cannot be read
    text: str
    problem: str = ""
    values: NDArray[np.float64] | None = None  # filled by the engine, NaN for an error
    texts: dict[int, str] = field(default_factory=dict)  # rows whose value is a text
    state: str = "new"
    done: NDArray[np.bool_] | None = None  # cell by cell, for recurrences

    @property
    def last(self) -> int:
        """Last row."""
        return self.first + self.count - 1


@dataclass(slots=True)
class Column:
    """One column of a sheet: typed-in values, runs of formulas, claims of their values."""

    constants: dict[int, Constant] = field(default_factory=dict)
    errors: dict[int, str] = field(default_factory=dict)  # typed-in error values
    runs: list[Run] = field(default_factory=list)
    cached: dict[int, Cached] = field(default_factory=dict)

    def run_at(self, row: int) -> Run | None:
        """The run that holds a row."""
        for run in self.runs:
            if run.first <= row <= run.last:
                return run
        return None


@dataclass(slots=True)
class Grid:
    """A workbook: sheets by title, columns by number; defined names of single cells."""

    sheets: dict[str, dict[int, Column]] = field(default_factory=dict)
    names: dict[str, tuple[str, int, int]] = field(default_factory=dict)  # casefold → cell
    cells: int = 0

    def column(self, sheet: str, number: int) -> Column:
        """A column, empty where there is none."""
        return self.sheets.get(sheet, {}).get(number) or Column()

    def constant(self, sheet: str, row: int, column: int) -> Constant | None:
        """Typed-in value of a cell."""
        return self.column(sheet, column).constants.get(row)

    def title(self, sheet: str) -> str | None:
        """Title of a sheet as the book writes it; titles do not differ by case."""
        if sheet in self.sheets:
            return sheet
        wanted = sheet.casefold()
        return next((title for title in self.sheets if title.casefold() == wanted), None)


def parse_xml(data: bytes) -> etree._Element:
    """Root of a part; nothing is fetched or expanded.

    Raises:
        BadBook: no well-formed XML.
    """
    parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False)
    try:
        return etree.fromstring(data, parser)
    except etree.XMLSyntaxError:
        msg = "часть книги не читается как XML"
        raise BadBook(msg) from None


def read_grid(book: bytes) -> Grid:
    """All cells of a workbook that has passed the intake.

    Raises:
        BadBook: damaged, or cells out of bounds.
    """
    try:
        with zipfile.ZipFile(io.BytesIO(book)) as archive:
            return _read(archive)
    except (zipfile.BadZipFile, KeyError, EOFError, NotImplementedError, OSError):
        msg = "файл .xlsx повреждён"
        raise BadBook(msg) from None


def _read(archive: zipfile.ZipFile) -> Grid:
    grid = Grid()
    root = parse_xml(archive.read("xl/workbook.xml"))
    main = _STRICT if root.tag.startswith(_STRICT) else _MAIN
    if main == _STRICT:
        msg = "книга сохранена в строгом формате Open XML; сохраните её как обычную .xlsx"
        raise BadBook(msg)
    relations = parse_xml(archive.read("xl/_rels/workbook.xml.rels"))
    targets = {rel.get("Id"): rel for rel in relations.iter("{*}Relationship")}
    strings: list[str] | None = None
    sheets = list(root.iter(f"{main}sheet"))
    if len(sheets) > MAX_SHEETS:
        msg = f"в книге больше {MAX_SHEETS} листов"
        raise BadBook(msg)
    for sheet in sheets:
        relation = targets.get(sheet.get(f"{_REL}id"))
        if relation is None or not str(relation.get("Type")).endswith("/worksheet"):
            continue
        target = str(relation.get("Target"))
        part = target[1:] if target.startswith("/") else normpath(join("xl", target))
        if strings is None:
            strings = _strings(archive, targets)
        title = str(sheet.get("name"))
        grid.sheets[title] = {}
        _read_sheet(grid, title, archive.read(part), strings)
    for name in root.iter(f"{main}definedName"):
        match = _ADDRESS.fullmatch(str(name.text or "").strip())
        if match is not None and name.get("localSheetId") is None:
            sheet_title = match[1].strip("'").replace("''", "'")
            cell = (sheet_title, int(match[3]), column_number(match[2]))
            grid.names[str(name.get("name")).casefold()] = cell
    return grid


def _strings(archive: zipfile.ZipFile, targets: dict[str | None, etree._Element]) -> list[str]:
    for relation in targets.values():
        if str(relation.get("Type")).endswith("/sharedStrings"):
            target = str(relation.get("Target"))
            part = target[1:] if target.startswith("/") else normpath(join("xl", target))
            root = parse_xml(archive.read(part))
            return [_rich(item) for item in root.iterchildren("{*}si")]
    return []


def _rich(item: etree._Element) -> str:
    """Text of a string item; phonetic hints are no text."""
    parts = []
    for text in item.iter("{*}t"):
        parent = text.getparent()
        if parent is None or not str(parent.tag).endswith("}rPh"):
            parts.append(text.text or "")
    return "".join(parts)


class _Sheet:
    """Collects the cells of one sheet."""

    def __init__(self, grid: Grid, title: str, strings: list[str]) -> None:
        self.grid, self.title, self.strings = grid, title, strings
        self.columns = grid.sheets[title]
        self.shared: dict[str, tuple[str, int, int]] = {}  # si → text, row, column
        self.open: dict[int, tuple[Run, str | list[str | int] | None, str]] = {}

    def put(
        self,
        row: int,
        column: int,
        kind: str,
        formula: tuple[str, str, str] | None,
        value: str | None,
        inline: str | None,
    ) -> None:
        """One cell; ``formula`` is its kind, its text and its key among the shared ones."""
        if formula is None and value is None and inline is None:
            return
        if not (0 < row <= MAX_ROW and 0 < column <= MAX_COLUMN):
            msg = f"на листе «{self.title}» есть ячейки далеко за таблицами"
            raise BadBook(msg)
        self.grid.cells += 1
        if self.grid.cells > MAX_CELLS:
            msg = f"в книге больше {MAX_CELLS} заполненных ячеек"
            raise BadBook(msg)
        known = self.columns.get(column)
        if known is None:
            known = self.columns[column] = Column()
        found = inline if inline is not None else self._value(kind, value)
        if formula is not None:
            known.cached[row] = found
            self._formula(known, row, column, *formula)
        elif kind == "e":
            known.errors[row] = value or "#VALUE!"
        elif found is not None and found != "":
            known.constants[row] = found

    def follow(self, column: int, cells: list[_PlainCell], at: int) -> int:
        """Take the cells from ``at`` on that continue the run above them; tell how many."""
        current = self.open.get(column)
        if current is None:
            return 0
        run, template, _ = current
        if template is None:
            return 0
        row = run.first + run.count
        values: list[float | None] = []
        for _, digits, kind, about, formula, value, _ in cells[at:]:
            if digits != str(row) or row > MAX_ROW or not formula:
                break
            if kind not in ("", "n") or "t=" in about or "si=" in about:
                break
            wanted = filled(template, row)
            if formula != wanted and _plain_text(formula) != wanted:
                break
            try:
                number = float(value) if value else None
            except ValueError:
                break
            if number is not None and not -1e308 < number < 1e308:
                break
            values.append(number)
            row += 1
        first = run.first + run.count
        self.columns[column].cached.update(zip(range(first, row), values, strict=True))
        run.count += len(values)
        self.grid.cells += len(values)
        return len(values)

    def _value(self, kind: str, text: str | None) -> Cached:
        if text is None:
            return None
        try:
            if kind == "n":
                number = float(text)
                if not math.isfinite(number):
                    msg = "nan"
                    raise ValueError(msg)
                return number
            if kind == "s":
                return self.strings[int(text)] if int(text) >= 0 else None
        except (ValueError, IndexError):
            msg = f"на листе «{self.title}» есть ячейка с неверным значением"
            raise BadBook(msg) from None
        return text.strip() == "1" if kind == "b" else text

    def _formula(
        self, known: Column, row: int, column: int, kind: str, text: str, key: str
    ) -> None:
        current = self.open.get(column)
        if kind == "shared" and text:
            self.shared.setdefault(key, (text, row, column))
        if kind == "shared" and not text:
            if current is not None and current[2] == key and current[0].last == row - 1:
                current[0].count += 1
                return
            master = self.shared.get(key)
            if master is None:
                self._start(known, row, column, "", "общая формула без образца", key)
            else:
                self._start(known, row, column, master[0], "", key, origin=master[1:])
            return
        if kind not in ("normal", "shared"):
            self._start(known, row, column, text, "формула массива", "")
            return
        if (
            current is not None
            and current[1] is not None
            and current[0].first + current[0].count == row
            and filled(current[1], row) == text
        ):
            current[0].count += 1
            if kind == "shared":
                self.open[column] = (current[0], current[1], key)
            return
        self._start(known, row, column, text, "", key if kind == "shared" else "")

    def _start(
        self,
        known: Column,
        row: int,
        column: int,
        text: str,
        problem: str,
        key: str,
        origin: tuple[int, int] | None = None,
    ) -> None:
        made = None
        at_row, at_column = origin or (row, column)
        if not problem:
            try:
                made = pattern(text.removeprefix("="), at_row, at_column)
            except UnknownFormula as error:
                problem = str(error)
        run = Run(self.title, column, row, 1, made, text, problem)
        known.runs.append(run)
        template = row_template(text, row) if made is not None and origin is None else None
        self.open[column] = (run, template, key)


_CELL = re.compile(r"([A-Za-z]{1,3})([0-9]{1,7})")

# The form in which Excel, LibreOffice, Google Sheets and openpyxl write cells.  A sheet that
# is anything else goes through the XML parser, which takes three times as long.
_PLAIN_CELL = re.compile(
    r'<c r="([A-Z]{1,3})([1-9][0-9]{0,6})"(?: s="[0-9]+")?(?: t="([a-zA-Z]+)")?(?:/>|>'
    r"(?:<f([^>/]*)(?:/>|>([^<]*)</f>))?(?:<v>([^<]*)</v>|<v/>)?"
    r'(?:<is><t(?: xml:space="preserve")?>([^<]*)</t></is>)?</c>)'
)
_LETTER = re.compile(r"&#([1-9][0-9]{2,4});")  # from 100 up: no sign of the markup
_ESCAPES = (("&lt;", "<"), ("&gt;", ">"), ("&quot;", '"'), ("&apos;", "'"), ("&amp;", "&"))
_EMPTY_ROW = re.compile(rb"<row [^>]*/>")
_ATTRIBUTE = re.compile(r'(t|si)="([^"&]*)"')


def _read_sheet(grid: Grid, title: str, data: bytes, strings: list[str]) -> None:
    sheet = _Sheet(grid, title, strings)
    if not _read_plain(sheet, data):
        _read_xml(sheet, title, parse_xml(data))


def _read_plain(sheet: _Sheet, data: bytes) -> bool:
    """Read a sheet in the usual form; False, and nothing read, where it is not."""
    head, _, rest = data.partition(b"<sheetData>")
    body, _, tail = rest.partition(b"</sheetData>")
    if b"<!" in data or b"<?" in body or not _is_whole(head, body, tail):
        return False
    try:
        text = body.decode("utf-8")
    except UnicodeDecodeError:
        return False
    if "&#" in text:  # letters that a writer of ASCII has spelt out
        text = _LETTER.sub(lambda match: chr(int(match[1])), text)
    cells = _PLAIN_CELL.findall(text)
    if len(cells) != text.count("<c "):
        return False
    by_column: dict[str, list[_PlainCell]] = {}
    for cell in cells:
        by_column.setdefault(cell[0], []).append(cell)
    for letters, found in by_column.items():
        _read_column(sheet, column_number(letters), found)
    return True


def _read_column(sheet: _Sheet, column: int, cells: list[_PlainCell]) -> None:
    """Cells of one column from the top, formulas that were filled down all at once."""
    at = 0
    while at < len(cells):
        taken = sheet.follow(column, cells, at)
        if taken:
            at += taken
            continue
        _, digits, kind, about, formula, value, inline = cells[at]
        made = None
        if formula or about:
            known = dict(_ATTRIBUTE.findall(about))
            made = (known.get("t", "normal"), _plain_text(formula), known.get("si", ""))
        if made is not None or value or inline:
            shown, own = _plain_text(value) or None, _plain_text(inline) or None
            sheet.put(int(digits), column, kind or "n", made, shown, own)
        at += 1


def _is_whole(head: bytes, body: bytes, tail: bytes) -> bool:
    """Whether a sheet in the usual form has its end and closes its rows."""
    closed = body.count(b"</row>") + len(_EMPTY_ROW.findall(body))
    return (
        f'<worksheet xmlns="{_MAIN[1:-1]}"'.encode() in head
        and tail.rstrip().endswith(b"</worksheet>")
        and body.count(b"<row") == closed
    )


def _plain_text(text: str) -> str:
    if "&" not in text:
        return text
    if "&#" in text:
        return html.unescape(text)
    for escaped, sign in _ESCAPES:
        text = text.replace(escaped, sign)
    return text


def _read_xml(sheet: _Sheet, title: str, root: etree._Element) -> None:
    row = 0
    for line in root.iter(f"{_MAIN}row"):
        given = line.get("r")
        row = int(given) if given is not None and given.isdigit() else row + 1
        column = 0
        for cell in line.iterchildren(f"{_MAIN}c"):
            address = cell.get("r")
            if address is None:
                column += 1
            else:
                match = _CELL.fullmatch(address)
                if match is None:
                    msg = f"на листе «{title}» ячейка с неверным адресом"
                    raise BadBook(msg)
                row, column = int(match[2]), column_number(match[1])
            formula = cell.find(f"{_MAIN}f")
            inline = cell.find(f"{_MAIN}is")
            about = None
            if formula is not None:
                kind = formula.get("t", "normal")
                about = (kind, formula.text or "", formula.get("si", ""))
            sheet.put(
                row,
                column,
                cell.get("t", "n"),
                about,
                cell.findtext(f"{_MAIN}v") or None,
                None if inline is None else _rich(inline),
            )
