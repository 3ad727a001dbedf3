"""Parse a sheet into a grid: a filled-down formula is one run, a known form is parsed once."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import lru_cache
from hashlib import blake2b
from itertools import count
from math import isfinite, nan

from lxml import etree

from reports.recalculation.formulas import column_number, filled, formula_at, row_template
from reports.recalculation.grid import (
    MAX_CELLS,
    MAX_COLUMN,
    MAX_ROW,
    Area,
    CellColumn,
    CellGrid,
    Constant,
    Run,
)
from reports.shared.errors import BadBook, UnknownFormula

_SAVED = re.compile(rb"<v>([^<]+)</v>")
_LOOKS = re.compile(
    rb' (?:s|ht|spans|customFormat|customHeight|x14ac:dyDescent)="[\w.: ]*"(?=[ />])'
)
_UTF8 = re.compile(rb"\s*(<\?xml[^>]*encoding=[\"'](?i:utf-8)[\"'][^>]*\?>|<(?!\?))")
_DIGITS = b"0123456789+-.eE"  # of numbers as programs save them
_MAX_FORMS = 400  # of which those of mistakes come once

Slot = tuple[int, int, str, bool, str]  # row, column, kind and text of a value, of a formula or not
Parser = Callable[[CellGrid, str, bytes, list[str]], list[Slot]]
MAIN = "{http://schemas.openxmlformats.org/spreadsheetml/2006/main}"
_ROW, _CELL, _FORMULA, _VALUE, _INLINE = (f"{MAIN}{tag}" for tag in ("row", "c", "f", "v", "is"))
_ADDRESS = re.compile(r"([A-Za-z]{1,3})([0-9]{1,7})")
About = tuple[str, str, str, str]  # of a formula: kind, text, key among the shared ones, extent


def value_of(kind: str, text: str | None, strings: list[str]) -> Constant | None:
    """Value of a cell as a number, a text or a flag; ``ValueError`` where it is none."""
    if not text:
        return None
    if kind == "n":
        number = float(text)
        if not isfinite(number) or "_" in text:
            raise ValueError
        return number
    if kind == "s":
        number = int(text)
        return strings[number] if number >= 0 else None
    return text.strip() == "1" if kind == "b" else text


@dataclass(frozen=True, slots=True)
class _FormColumn:
    """A column of a form, and which of the sheet's values stand where."""

    column: CellColumn  # with the texts that stand in cells themselves, without values
    saved: tuple[int, ...]  # numbers of the values, -1 where none is a number
    constants: tuple[tuple[int, int, str], ...]  # row, number of the value, kind
    errors: tuple[tuple[int, int], ...]


@dataclass
class Forms:
    """Cache of known forms, bounded."""

    _known: dict[tuple[str, bytes], tuple[dict[int, _FormColumn], int] | None] = field(
        default_factory=dict  # None where it was seen once
    )

    def fill(self, grid: CellGrid, title: str, data: bytes, strings: list[str]) -> bool:
        """Put a sheet of a known form into a grid; False where it must be parsed."""
        key, texts = _split(title, data)
        form = self._known.get(key)
        if form is None or grid.cells + form[1] > MAX_CELLS:
            return False
        self._known[key] = self._known.pop(key)  # used last, dropped last
        parts, cells = form
        try:
            columns = {number: _filled(part, texts, strings) for number, part in parts.items()}
        except (ValueError, IndexError):  # the parser says what is wrong
            return False
        grid.sheets[title].update(columns)
        grid.cells += cells
        return True

    def learn(self, grid: CellGrid, title: str, data: bytes, cells: int, parse: Parser) -> None:
        """Keep the form of a sheet that was just parsed, when it has come for the second time."""
        key, _ = _split(title, data)
        while len(self._known) >= _MAX_FORMS:
            self._known.pop(next(iter(self._known)))
        if key not in self._known:
            self._known[key] = None
            return
        columns = grid.sheets[title]
        plain = not any(run.array for column in columns.values() for run in column.runs)
        once = cells == sum(len(c.saved) + len(c.constants) + len(c.errors)
                            for c in columns.values())  # fmt: skip
        if not (plain and once and _UTF8.match(data)):
            return
        # Each value's number in its place shows which value the parser finds in which cell:
        # one that is written in another manner, or in a comment, would shift them.
        numbers = count()
        probe = _SAVED.sub(lambda _: b"<v>%d</v>" % next(numbers), data)
        many = next(numbers)
        slots = parse(CellGrid(sheets={title: {}}), title, probe, [""] * many)
        if [slot[-1] for slot in slots] != [str(k) for k in range(many)] or not columns.keys() >= {
            slot[1] for slot in slots
        }:
            return
        of_column: dict[int, list[tuple[int, Slot]]] = {number: [] for number in columns}
        for index, slot in enumerate(slots):
            of_column[slot[1]].append((index, slot))
        parts = {number: _part(columns[number], indices) for number, indices in of_column.items()}
        self._known[key] = (parts, cells)


def _split(title: str, data: bytes) -> tuple[tuple[str, bytes], list[bytes]]:
    """Title and digest of a sheet without its values and its looks; the values."""
    parts = _SAVED.split(data)
    frame = b"<v>#</v>".join(parts[::2])
    return (title, blake2b(_LOOKS.sub(b"", frame)).digest()), parts[1::2]


def _part(column: CellColumn, slots: list[tuple[int, Slot]]) -> _FormColumn:
    numbers = {row: k for k, (row, _, kind, formula, _) in slots if formula and kind == "n"}
    typed = [(row, k, kind) for k, (row, _, kind, formula, _) in slots if not formula]
    constants = tuple(entry for entry in typed if entry[2] != "e")
    errors = tuple((row, k) for row, k, kind in typed if kind == "e")
    constants_left = {
        row: v for row, v in column.constants.items() if row not in {c[0] for c in constants}
    }
    form = CellColumn(
        constants_left, {}, [replace(run) for run in column.runs], list(column.saved_rows)
    )
    return _FormColumn(
        form, tuple(numbers.get(r, -1) for r in column.saved_rows), constants, errors
    )


def _filled(part: _FormColumn, texts: list[bytes], strings: list[str]) -> CellColumn:
    """Return a column with the values of another book.

    Raises:
        ValueError: a value that is none, or is not written plainly.
        IndexError: no such string.
    """
    form = part.column
    saved = [float(texts[k]) if k >= 0 else nan for k in part.saved]
    plain = b"".join([texts[k] for k in part.saved if k >= 0])
    if plain.translate(None, _DIGITS) or float("inf") in map(abs, saved):
        raise ValueError
    column = CellColumn(dict(form.constants), {}, [], list(form.saved_rows), saved)
    column.runs = [Run(r.sheet, r.column, r.first, r.count, r.formula, r.text, r.problem)
                 for r in form.runs]  # fmt: skip
    for row, k, kind in part.constants:
        value = value_of(kind, _text(texts[k]), strings)
        if value is None:
            raise ValueError
        if value != "":
            column.constants[row] = value
    if form.constants and part.constants:  # texts stand among the numbers
        column.constants = dict(sorted(column.constants.items()))
    for row, k in part.errors:
        column.errors[row] = _text(texts[k])
    return column


def _text(data: bytes) -> str:
    if b"&" in data:  # an entity is the parser's
        raise ValueError
    return data.decode()


def parse_xml(data: bytes) -> etree._Element:
    """Root of a part; nothing is fetched or expanded.

    Raises:
        BadBook: no well-formed XML.
    """
    parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False)
    try:
        return etree.fromstring(data, parser)
    except etree.XMLSyntaxError:
        raise BadBook("часть книги не читается как XML") from None


def rich_text(item: etree._Element) -> str:
    """Text of a string item; phonetic hints are no text."""
    if len(item) == 1 and not len(item[0]):  # no runs of different looks
        return item[0].text or ""
    parts = []
    for text in item.iter("{*}t"):
        parent = text.getparent()
        if parent is None or not str(parent.tag).endswith("}rPh"):
            parts.append(text.text or "")
    return "".join(parts)


def read_sheet(
    grid: CellGrid, title: str, data: bytes, strings: list[str], forms: Forms | None = None
) -> None:
    """Put a sheet into a grid; ``forms`` are those of the class, known and to be learnt.

    Raises:
        BadBook: no well-formed XML, cells out of bounds, or values that are none.
    """
    if forms is not None and forms.fill(grid, title, data, strings):
        return
    before = grid.cells
    _parsed(grid, title, data, strings)
    if forms is not None:
        forms.learn(grid, title, data, grid.cells - before, _parsed)


def _parsed(grid: CellGrid, title: str, data: bytes, strings: list[str]) -> list[Slot]:
    """Read all cells; the values of the sheet in their order."""
    sheet = _Sheet(grid, title)
    slots: list[Slot] = []
    row = 0
    for line in parse_xml(data).iter(_ROW):
        row_text = line.get("r")
        row = int(row_text) if row_text is not None and row_text.isdigit() else row + 1
        column = 0
        for cell in line:
            if cell.tag != _CELL:
                continue
            address = cell.get("r")
            if address is None:
                column += 1
            else:
                row, column = _place(address)
            kind, text, details, saved = cell.get("t", "n"), None, None, None
            for part in cell:
                if part.tag == _VALUE:
                    text = saved = part.text
                elif part.tag == _FORMULA:
                    details = _about(part)
                elif part.tag == _INLINE:
                    text, kind = rich_text(part), "str"
            if saved and text:
                slots.append((row, column, kind, details is not None, text))
            try:
                sheet.put(row, column, value_of(kind, text, strings), kind, details)
            except (ValueError, IndexError) as error:
                if isinstance(error, BadBook):
                    raise
                raise BadBook(f"на листе «{title}» есть ячейка с неверным значением") from None
    sheet.finish()
    return slots


def _about(formula: etree._Element) -> About:
    kind, text = formula.get("t"), formula.text or ""
    if kind is None:
        return "normal", text, "", ""
    return kind, text, formula.get("si", ""), formula.get("ref", "")


@lru_cache(maxsize=50_000)  # most books of a class have the same cells
def _place(address: str) -> tuple[int, int]:
    match = _ADDRESS.fullmatch(address)
    if match is None:
        raise BadBook(f"в книге есть ячейка с неверным адресом «{address[:20]}»")
    return int(match[2]), column_number(match[1])


class _Sheet:
    """Takes the cells of one sheet."""

    def __init__(self, grid: CellGrid, title: str) -> None:
        self.grid, self.title = grid, title
        self.columns = grid.sheets[title]
        self._shared: dict[str, tuple[str, int, int]] = {}  # si → text, row, column
        self._open: dict[int, tuple[Run, str | list[str | int] | None, str]] = {}
        self._arrays: list[Run] = []

    def put(
        self, row: int, column: int, value: Constant | None, kind: str, details: About | None
    ) -> None:
        """One cell.

        Raises:
            BadBook: the cell lies far out, or there are too many.
        """
        if details is None and value is None:
            return
        if not (0 < row <= MAX_ROW and 0 < column <= MAX_COLUMN):
            raise BadBook(f"на листе «{self.title}» есть ячейки далеко за таблицами")
        self.grid.cells += 1
        if self.grid.cells > MAX_CELLS:
            raise BadBook(f"в книге больше {MAX_CELLS} заполненных ячеек")
        cells = self.columns.get(column)
        if cells is None:
            cells = self.columns[column] = CellColumn()
        if details is not None:
            cells.saved_rows.append(row)
            is_number = isinstance(value, float) and kind == "n"
            cells.saved.append(value if is_number else nan)  # type: ignore[arg-type]
            self._formula(cells, row, column, *details)
        elif kind == "e":
            cells.errors[row] = str(value)
        elif value != "" and value is not None:
            cells.constants[row] = value

    def finish(self) -> None:
        """Cells of array formulas are calculated: what is saved in them was not typed in."""
        for run in self._arrays:
            area = run.array
            assert area is not None
            for number in range(area.first_column, area.last_column + 1):
                column = self.columns.setdefault(number, CellColumn())
                if len(column.runs_in(area.first_row, area.last_row)) > (number == run.column):
                    run.problem = "формула массива поверх других формул"
                for row in range(area.first_row, area.last_row + 1):
                    column.errors.pop(row, None)
                    value = column.constants.pop(row, None)
                    if row not in column.saved_rows:
                        column.saved_rows.append(row)
                        column.saved.append(value if type(value) is float else nan)
                if number > run.column:
                    copy = Run(run.sheet, number, run.first, run.count, run.formula, run.text,
                               run.problem, area)  # fmt: skip
                    column.runs.append(copy)

    def _formula(
        self, cells: CellColumn, row: int, column: int, kind: str, text: str, key: str, extent: str
    ) -> None:
        run, template, shared = self._open.get(column, (None, None, ""))
        follows = run is not None and run.first + run.count == row
        if kind == "normal" and follows and template and filled(template, row) == text:
            run.count += 1  # type: ignore[union-attr]
            return
        if kind == "shared" and text:
            self._shared.setdefault(key, (text, row, column))
        if kind == "shared" and not text:
            if run is not None and follows and shared == key:
                run.count += 1
                return
            master = self._shared.get(key)
            if master is None:
                self._start(cells, row, column, "", "общая формула без образца", key)
            else:
                self._start(cells, row, column, master[0], "", key, origin=master[1:])
        elif kind == "array":
            self._array(cells, row, column, text, extent)
        elif kind not in ("normal", "shared"):
            self._start(cells, row, column, text, "таблица данных", "")
        elif run is not None and follows and template and filled(template, row) == text:
            run.count += 1
            if kind == "shared":
                self._open[column] = (run, template, key)
        else:
            self._start(cells, row, column, text, "", key if kind == "shared" else "")

    def _array(self, cells: CellColumn, row: int, column: int, text: str, extent: str) -> None:
        first, _, last = extent.partition(":")
        ends = [_place(cell) for cell in (first, last or first)]
        (top, left), (bottom, right) = ends
        inside = top == row <= bottom <= MAX_ROW and left == column <= right <= MAX_COLUMN
        if not inside or (bottom - top + 1) * (right - left + 1) > MAX_ROW:
            raise BadBook(f"на листе «{self.title}» формула массива с неверными границами")
        run = self._start(cells, row, column, text, "", "")
        run.count, run.array = bottom - top + 1, Area(self.title, top, bottom, left, right)
        self._open.pop(column)
        self._arrays.append(run)

    def _start(
        self, cells: CellColumn, row: int, column: int, text: str, problem: str, key: str,
        origin: tuple[int, int] | None = None,
    ) -> Run:  # fmt: skip
        opened = None
        if not problem and not text.strip(" ="):
            problem = "пустая формула"
        if not problem:
            try:
                opened = formula_at(text.removeprefix("="), *(origin or (row, column)))
            except UnknownFormula as error:
                problem = str(error)
        run = Run(self.title, column, row, 1, opened, text, problem)
        cells.runs.append(run)
        template = row_template(text, row) if opened is not None and origin is None else None
        self._open[column] = (run, template, key)
        return run
