"""Files of lists: the lines of CSV in any usual encoding and of the sheets of a book."""

from __future__ import annotations

import csv
import io
import re
import unicodedata
import warnings
import zipfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from reports.shared.errors import InputError, Problem, one_line
from reports.shared.file_types import ARCHIVE, OFFICE, TEXT, UTF16, kind_of, read_bytes
from reports.workbook.intake import check_data, repacked
from reports.workbook.layout import Cell

if TYPE_CHECKING:  # openpyxl is loaded when a book is read
    from openpyxl.cell import ReadOnlyCell
    from openpyxl.worksheet.worksheet import Worksheet

MAX_BYTES, MAX_FIELD = 2_000_000, 200
_MAX_COLUMNS, _MAX_ROWS = 100, 10_000  # one cell at the edge makes a sheet 17,000,000,000 cells
_FIRST_LINES = 20  # by which the delimiter is known
_AS_FORMULA = re.compile(r'="([^"]*)"')
# Other encodings of Russian lists: of Windows, of its command line, of old Unix, of a Mac.
_ENCODINGS = ("cp1251", "cp866", "koi8-r", "mac-cyrillic")
_WORD = re.compile(r"[А-ЯЁ][а-яё]+|[А-ЯЁ]+|[а-яё]+")
_LETTERS = re.compile(r"[^\W\d_]+")
_MIN_RUSSIAN = 0.6  # of the words that are no plain Latin
_USUAL = frozenset("километр вода суп нить")  # all letters that are usual
# A fill that says nothing, as some programs write it: openpyxl reads no such book.
_STYLES = "xl/styles.xml"
_NO_FILL = re.compile(rb"<((?:\w+:)?)fill\s*(?:/>|></\1fill>)")
_EMPTY_FILL = rb"<\1fill><\1patternFill/></\1fill>"
A_DATE = "дата вместо текста"


@dataclass(frozen=True, slots=True)
class RosterLine:
    """A line that holds anything; ``faults`` are columns whose cells cannot be read, and why."""

    number: int
    cells: list[str]
    faults: dict[int, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class RosterListing:
    """The lines of a CSV file, or of a sheet with a title."""

    file: str
    title: str
    lines: list[RosterLine]

    def place(self, line: RosterLine, column: int) -> str:
        """Address of a cell, for messages."""
        if not self.title:
            return f"{self.file}, строка {line.number}"
        address = Cell("", line.number, column + 1).coordinate
        return f"{self.file}, лист «{self.title}», {address}"


def listings(path: Path) -> list[RosterListing]:
    """What a CSV file or the sheets of a book hold, in their order; hidden sheets are left out.

    Raises:
        InputError: it is neither.
    """
    data = read_bytes(path, MAX_BYTES, "это не список группы")
    kind = kind_of(data)
    if kind in (ARCHIVE, OFFICE):
        return _sheets(path, data)
    if kind not in (TEXT, UTF16):
        raise refused(path, "это двоичный файл, а нужен CSV или .xlsx", "выберите другой файл")
    return [RosterListing(path.name, "", _csv_lines(path, _text(path, data)))]


def refused(path: Path, problem: str, hint: str) -> InputError:
    """Return the error of a file that is no list."""
    return InputError(Problem(path.name, problem, hint))


def _clean(cell: str) -> str:
    text = _AS_FORMULA.fullmatch(cell.strip())  # ="00012": how a site keeps zeros through Excel
    return one_line(unicodedata.normalize("NFC", text[1] if text else cell), MAX_FIELD + 1)


# --- CSV -------------------------------------------------------------------------------------


def _csv_lines(path: Path, text: str) -> list[RosterLine]:
    first = text.splitlines()[:_FIRST_LINES]
    delimiter = max(";\t,", key=lambda char: sum(char in line for line in first))
    try:
        rows = list(csv.reader(io.StringIO(text, newline=""), delimiter=delimiter, strict=True))
    except csv.Error:
        raise refused(path, "это не CSV: не закрыта кавычка", "сохраните список заново") from None
    lines = [RosterLine(i, [_clean(cell) for cell in row]) for i, row in enumerate(rows, 1)]
    lines = [line for line in lines if any(line.cells)]
    if lines and lines[0].cells[0].casefold() == "sep=":  # Excel's word on the delimiter
        del lines[0]
    return lines


def _text(path: Path, data: bytes) -> str:
    """Return the text of a list in the one encoding that gives Russian words."""
    try:
        return data.decode("utf-16" if kind_of(data) == UTF16 else "utf-8-sig")
    except UnicodeDecodeError:
        pass
    texts = (data.decode(encoding, errors="replace") for encoding in _ENCODINGS)
    scores = sorted(((_russian(text), text) for text in texts), reverse=True)
    (best, text), (second, other) = scores[:2]
    if best < _MIN_RUSSIAN or (best == second and text != other):
        problem = "кодировка не UTF-8 и не Windows-1251, cp866, KOI8-R или Mac"
        raise refused(path, problem, "сохраните как «CSV UTF-8»")
    return text


def _russian(text: str) -> float:
    """Share of the foreign words that are written as Russian ones are: case, usual letters."""
    words = [w for w in _LETTERS.findall(text) if not w.isascii() and len(w) > 2]
    if not words or "\ufffd" in text:
        return 0.0
    fit = sum(_WORD.fullmatch(word) is not None for word in words) / len(words)
    letters = "".join(words).casefold()
    usual = sum(char in _USUAL for char in letters) / len(letters)
    odd = sum(not char.isascii() and not char.isalnum() and char not in "«»№—–" for char in text)
    return fit * min(1.0, usual / 0.6) - odd / len(letters)


# --- a book of Excel -------------------------------------------------------------------------


def _sheets(path: Path, data: bytes) -> list[RosterListing]:
    from openpyxl import load_workbook

    package = check_data(data, path.name)
    data = package.data
    styles = package.read(_STYLES) if _STYLES in package.names() else b""
    if _NO_FILL.search(styles):
        data = repacked(data, {_STYLES: _NO_FILL.sub(_EMPTY_FILL, styles)})
    try:
        with warnings.catch_warnings(action="ignore"):  # of what a list does not need
            cached, written = (
                load_workbook(io.BytesIO(data), read_only=True, data_only=values)
                for values in (True, False)
            )
            merged = _merged(data)
            return [
                RosterListing(
                    path.name,
                    sheet.title,
                    _filled_down(
                        list(_sheet_lines(sheet, written[sheet.title])), merged.get(sheet.title, ())
                    ),
                )
                for sheet in cached.worksheets
                if sheet.sheet_state == "visible"
            ]
    except Exception:  # whatever openpyxl meets in a file of a program that it does not know
        raise refused(path, "книга не читается", "сохраните список как CSV") from None


def _merged(data: bytes) -> dict[str, list[tuple[int, int, int, int]]]:
    """First row, first column, last row and last column of the merged cells of each sheet."""
    from openpyxl import load_workbook

    with zipfile.ZipFile(io.BytesIO(data)) as parts:
        names = [name for name in parts.namelist() if name.startswith("xl/worksheets/")]
        if not any(b"<mergeCell " in parts.read(name) for name in names):
            return {}
    book = load_workbook(io.BytesIO(data))
    return {
        sheet.title: [(r.min_row, r.min_col, r.max_row, r.max_col) for r in sheet.merged_cells]
        for sheet in book.worksheets
    }


def _filled_down(
    lines: list[RosterLine], merged: Sequence[tuple[int, int, int, int]]
) -> list[RosterLine]:
    """Lines with the text of a cell that is merged downwards in each of its rows."""
    by_number = {line.number: line for line in lines}
    for first, column, last, _ in merged:
        above = by_number.get(first)
        text = above.cells[column - 1] if above and column <= len(above.cells) else ""
        for number in range(first + 1, last + 1):
            line = by_number.get(number)
            if text and line is not None and column <= len(line.cells):
                line.cells[column - 1] = line.cells[column - 1] or text
    return lines


def _sheet_lines(cached: Worksheet, written: Worksheet) -> Iterator[RosterLine]:
    """Lines of a sheet with the saved values of its formulas."""
    for sheet in (cached, written):
        sheet.reset_dimensions()  # a claim of the file, and often a wrong one
    edge = {"max_row": _MAX_ROWS, "max_col": _MAX_COLUMNS}
    rows = (sheet.iter_rows(**edge) for sheet in (cached, written))
    for number, (values, sources) in enumerate(zip(*rows, strict=True), 1):
        faults = {
            i: why
            for i, (cell, source) in enumerate(zip(values, sources, strict=True))
            if (why := _fault(cell, source))
        }
        cells = ["" if i in faults else _clean(_shown(cell)) for i, cell in enumerate(values)]
        for i, cell in enumerate(values):
            if faults.get(i) == A_DATE and cell.value is not None:
                faults[i], cells[i] = A_DATE, str(cell.value)
        if any(cells) or faults:
            yield RosterLine(number, cells, faults)


def _fault(cell: ReadOnlyCell, source: ReadOnlyCell) -> str:
    """Why a cell's text is not known, empty where it is."""
    if cell.value is None:
        return "значение формулы не сохранено" if source.data_type == "f" else ""
    if cell.data_type == "e":
        return f"ошибка {cell.value}"
    if cell.is_date:  # what was typed is lost: «3-12» became the third of December
        return A_DATE
    return "логическое значение вместо текста" if cell.data_type == "b" else ""


def _shown(cell: ReadOnlyCell) -> str:
    """Return the text of a cell as its sheet shows it."""
    value = cell.value
    if not isinstance(value, (int, float)):
        return str(value or "")
    text = f"{value:.15g}".replace(".", ",")
    zeros = cell.number_format  # «000000»: a number with the zeros in front of it
    return text.zfill(len(zeros)) if zeros and not zeros.strip("0") else text
