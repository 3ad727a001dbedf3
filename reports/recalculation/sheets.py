"""The cells of a sheet into a grid: formulas that were filled down become one run."""

from __future__ import annotations

import re
from functools import lru_cache
from math import nan

from lxml import etree

from reports.recalculation.forms import Forms, Slot, value_of
from reports.recalculation.formulas import formula_at
from reports.recalculation.grid import (
    MAX_CELLS,
    MAX_COLUMN,
    MAX_ROW,
    Area,
    BadBook,
    Column,
    Constant,
    Grid,
    Run,
)
from reports.recalculation.language import UnknownFormula, column_number, filled, row_template

MAIN = "{http://schemas.openxmlformats.org/spreadsheetml/2006/main}"
_ROW, _CELL, _FORMULA, _VALUE, _INLINE = (f"{MAIN}{tag}" for tag in ("row", "c", "f", "v", "is"))
_ADDRESS = re.compile(r"([A-Za-z]{1,3})([0-9]{1,7})")

About = tuple[str, str, str, str]  # of a formula: kind, text, key among the shared ones, extent


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
    grid: Grid, title: str, data: bytes, strings: list[str], forms: Forms | None = None
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


def _parsed(grid: Grid, title: str, data: bytes, strings: list[str]) -> list[Slot]:
    """Read all cells; the values of the sheet in their order."""
    sheet = _Sheet(grid, title)
    slots: list[Slot] = []
    row = 0
    for line in parse_xml(data).iter(_ROW):
        given = line.get("r")
        row = int(given) if given is not None and given.isdigit() else row + 1
        column = 0
        for cell in line:
            if cell.tag != _CELL:
                continue
            address = cell.get("r")
            if address is None:
                column += 1
            else:
                row, column = _place(address)
            kind, text, about, saved = cell.get("t", "n"), None, None, None
            for part in cell:
                if part.tag == _VALUE:
                    text = saved = part.text
                elif part.tag == _FORMULA:
                    about = _about(part)
                elif part.tag == _INLINE:
                    text, kind = rich_text(part), "str"
            if saved and text:
                slots.append((row, column, kind, about is not None, text))
            try:
                sheet.put(row, column, value_of(kind, text, strings), kind, about)
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

    def __init__(self, grid: Grid, title: str) -> None:
        self.grid, self.title = grid, title
        self.columns = grid.sheets[title]
        self._shared: dict[str, tuple[str, int, int]] = {}  # si → text, row, column
        self._open: dict[int, tuple[Run, str | list[str | int] | None, str]] = {}
        self._arrays: list[Run] = []

    def put(
        self, row: int, column: int, value: Constant | None, kind: str, about: About | None
    ) -> None:
        """One cell.

        Raises:
            BadBook: the cell lies far out, or there are too many.
        """
        if about is None and value is None:
            return
        if not (0 < row <= MAX_ROW and 0 < column <= MAX_COLUMN):
            raise BadBook(f"на листе «{self.title}» есть ячейки далеко за таблицами")
        self.grid.cells += 1
        if self.grid.cells > MAX_CELLS:
            raise BadBook(f"в книге больше {MAX_CELLS} заполненных ячеек")
        known = self.columns.get(column)
        if known is None:
            known = self.columns[column] = Column()
        if about is not None:
            known.saved_rows.append(row)
            is_number = isinstance(value, float) and kind == "n"
            known.saved.append(value if is_number else nan)  # type: ignore[arg-type]
            self._formula(known, row, column, *about)
        elif kind == "e":
            known.errors[row] = str(value)
        elif value != "" and value is not None:
            known.constants[row] = value

    def finish(self) -> None:
        """Cells of array formulas are calculated: what is saved in them was not typed in."""
        for run in self._arrays:
            area = run.array
            assert area is not None
            for number in range(area.first_column, area.last_column + 1):
                column = self.columns.setdefault(number, Column())
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
        self, known: Column, row: int, column: int, kind: str, text: str, key: str, extent: str
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
                self._start(known, row, column, "", "общая формула без образца", key)
            else:
                self._start(known, row, column, master[0], "", key, origin=master[1:])
        elif kind == "array":
            self._array(known, row, column, text, extent)
        elif kind not in ("normal", "shared"):
            self._start(known, row, column, text, "таблица данных", "")
        elif run is not None and follows and template and filled(template, row) == text:
            run.count += 1
            if kind == "shared":
                self._open[column] = (run, template, key)
        else:
            self._start(known, row, column, text, "", key if kind == "shared" else "")

    def _array(self, known: Column, row: int, column: int, text: str, extent: str) -> None:
        first, _, last = extent.partition(":")
        ends = [_place(cell) for cell in (first, last or first)]
        (top, left), (bottom, right) = ends
        inside = top == row <= bottom <= MAX_ROW and left == column <= right <= MAX_COLUMN
        if not inside or (bottom - top + 1) * (right - left + 1) > MAX_ROW:
            raise BadBook(f"на листе «{self.title}» формула массива с неверными границами")
        run = self._start(known, row, column, text, "", "")
        run.count, run.array = bottom - top + 1, Area(self.title, top, bottom, left, right)
        self._open.pop(column)
        self._arrays.append(run)

    def _start(
        self, known: Column, row: int, column: int, text: str, problem: str, key: str,
        origin: tuple[int, int] | None = None,
    ) -> Run:  # fmt: skip
        made = None
        if not problem and not text.strip(" ="):
            problem = "пустая формула"
        if not problem:
            try:
                made = formula_at(text.removeprefix("="), *(origin or (row, column)))
            except UnknownFormula as error:
                problem = str(error)
        run = Run(self.title, column, row, 1, made, text, problem)
        known.runs.append(run)
        template = row_template(text, row) if made is not None and origin is None else None
        self._open[column] = (run, template, key)
        return run
