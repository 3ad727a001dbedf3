"""The lines of a list, whichever file holds them: CSV of Excel or Moodle, or a book of Excel."""

from __future__ import annotations

import csv
import io
import unicodedata
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from reports.shared.errors import InputError, Problem, one_line
from reports.shared.kinds import ARCHIVE, OFFICE, TEXT, UTF16, kind_of
from reports.shared.reading import read_bytes
from reports.workbook.intake import check_data
from reports.workbook.layout import Cell

if TYPE_CHECKING:  # openpyxl is loaded when a book is read
    from openpyxl.cell import ReadOnlyCell
    from openpyxl.worksheet.worksheet import Worksheet

MAX_BYTES, MAX_FIELD = 2_000_000, 200
_MOST_COLUMNS, _MOST_ROWS = 100, 10_000  # one cell at the edge makes a sheet 17,000,000,000 cells
_FIRST_LINES = 20  # by which the delimiter is known


@dataclass(frozen=True, slots=True)
class Line:
    """A line that holds anything; ``faults`` are columns whose cells cannot be read, and why."""

    number: int
    cells: list[str]
    faults: dict[int, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Listing:
    """The lines of a CSV file, or of a sheet with a title."""

    file: str
    title: str
    lines: list[Line]

    def place(self, line: Line, column: int) -> str:
        """Where a cell is, for messages."""
        if not self.title:
            return f"{self.file}, строка {line.number}"
        address = Cell("", line.number, column + 1).coordinate
        return f"{self.file}, лист «{self.title}», {address}"


def listings(path: Path) -> list[Listing]:
    """What a CSV file or the sheets of a book hold, in their order; hidden sheets are left out.

    Raises:
        InputError: it is neither.
    """
    data = read_bytes(path, MAX_BYTES, "это не список группы")
    kind = kind_of(data)
    if kind in (ARCHIVE, OFFICE):
        return _sheets(path, data)
    if kind == UTF16:
        raise refused(path, "кодировка UTF-16", "сохраните как «CSV UTF-8»")
    if kind != TEXT:
        raise refused(path, "это двоичный файл, а нужен CSV или .xlsx", "выберите другой файл")
    return [Listing(path.name, "", _csv_lines(path, _text(path, data)))]


def refused(path: Path, what: str, hint: str) -> InputError:
    """The error of a file that is no list."""
    return InputError(Problem(path.name, what, hint))


def _clean(cell: str) -> str:
    return one_line(unicodedata.normalize("NFC", cell), MAX_FIELD + 1)


# --- CSV -------------------------------------------------------------------------------------


def _csv_lines(path: Path, text: str) -> list[Line]:
    first = text.splitlines()[:_FIRST_LINES]
    delimiter = max(";\t,", key=lambda char: sum(char in line for line in first))
    try:
        rows = list(csv.reader(io.StringIO(text, newline=""), delimiter=delimiter, strict=True))
    except csv.Error:
        raise refused(path, "это не CSV: не закрыта кавычка", "сохраните список заново") from None
    lines = [Line(i, [_clean(cell) for cell in row]) for i, row in enumerate(rows, 1)]
    lines = [line for line in lines if any(line.cells)]
    if lines and lines[0].cells[0].casefold() == "sep=":  # Excel's word on the delimiter
        del lines[0]
    return lines


def _text(path: Path, data: bytes) -> str:
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        pass
    text = data.decode("cp1251", errors="replace")
    letters = [char for char in text if char.isalpha()]
    russian = sum("а" <= char.casefold() <= "я" or char in "ёЁ" for char in letters)
    if "\ufffd" in text or russian < len(letters) / 3:
        raise refused(path, "кодировка не UTF-8 и не Windows-1251", "сохраните как «CSV UTF-8»")
    return text


# --- a book of Excel -------------------------------------------------------------------------


def _sheets(path: Path, data: bytes) -> list[Listing]:
    from openpyxl import load_workbook

    check_data(data, path.name)
    try:
        shown, written = (
            load_workbook(io.BytesIO(data), read_only=True, data_only=values)
            for values in (True, False)
        )
        return [
            Listing(path.name, sheet.title, list(_sheet_lines(sheet, written[sheet.title])))
            for sheet in shown.worksheets
            if sheet.sheet_state == "visible"
        ]
    except Exception:  # whatever openpyxl meets in a file of a program that it does not know
        raise refused(path, "книга не читается", "сохраните список как CSV") from None


def _sheet_lines(shown: Worksheet, written: Worksheet) -> Iterator[Line]:
    """Lines of a sheet with the saved values of its formulas."""
    for sheet in (shown, written):
        sheet.reset_dimensions()  # a claim of the file, and often a wrong one
    edge = {"max_row": _MOST_ROWS, "max_col": _MOST_COLUMNS}
    rows = (sheet.iter_rows(**edge) for sheet in (shown, written))
    for number, (values, sources) in enumerate(zip(*rows, strict=True), 1):
        faults = {
            i: why
            for i, (cell, source) in enumerate(zip(values, sources, strict=True))
            if (why := _fault(cell, source))
        }
        cells = ["" if i in faults else _clean(_shown(cell)) for i, cell in enumerate(values)]
        if any(cells) or faults:
            yield Line(number, cells, faults)


def _fault(cell: ReadOnlyCell, source: ReadOnlyCell) -> str:
    """Why a cell's text is not known, empty where it is."""
    if cell.value is None:
        return "значение формулы не сохранено" if source.data_type == "f" else ""
    if cell.data_type == "e":
        return f"ошибка {cell.value}"
    if cell.is_date:  # what was typed is lost: «3-12» became the third of December
        return "дата вместо текста"
    return "логическое значение вместо текста" if cell.data_type == "b" else ""


def _shown(cell: ReadOnlyCell) -> str:
    """The text of a cell as its sheet shows it."""
    value = cell.value
    if not isinstance(value, (int, float)):
        return str(value or "")
    text = f"{value:.15g}".replace(".", ",")
    zeros = cell.number_format  # «000000»: a number with the zeros in front of it
    return text.zfill(len(zeros)) if zeros and not zeros.strip("0") else text
