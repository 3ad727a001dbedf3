"""The two columns of a recorded diagram, read from a table whose shape nobody told.

Separator and decimal sign are decided together, from all rows: every separator is tried with
the signs that each column then shows, and the file is refused where none or more than one
reading gives numbers.
"""

from __future__ import annotations

import csv
import io
import math
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from reports.shared.errors import InputError, one_line
from reports.shared.kinds import CALLED, TEXT, UTF16, kind_of
from reports.shared.reading import read_bytes

MAX_BYTES = 8_000_000
LEAST_ROWS = 3
# Separators between columns; of blanks any number makes one.
_CALLED = {";": "«;»", "\t": "табуляцию", ",": "запятую", " ": "пробелы"}
_NUMBER = re.compile(r"[-+]?(\d+([.,]\d+|\.)?|\.\d+)([eE][-+]?\d+)?")
Refuse = Callable[..., InputError]
Row = tuple[int, list[str]]


@dataclass(frozen=True, slots=True)
class Recorded:
    """Angles and pressures as the file has them, with the number of each line."""

    lines: tuple[int, ...]
    angles: tuple[float, ...]
    pressures: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class Wanted:
    """Which columns are asked for, by number from 1 or by name, and the words for refusals."""

    angle: object
    pressure: object
    units: frozenset[str]  # what a heading says of a unit alone
    refused: Refuse


class _UnfitError(Exception):
    """A separator that does not read the file; ``rows`` tells how far it came."""

    def __init__(self, rows: int, error: InputError, *, final: bool = False) -> None:
        super().__init__()
        self.rows, self.error, self.final = rows, error, final


def text_of(file: Path, refused: Refuse) -> str:
    """The text of a recorder's or a spreadsheet's file: UTF-8, UTF-16 or Windows-1251.

    Raises:
        InputError: it is missing, too large or no text.
    """
    data = read_bytes(file, MAX_BYTES, "оставьте в нём только диаграмму")
    kind = kind_of(data)
    if kind not in (TEXT, UTF16):
        raise refused(f"{CALLED[kind]}, а нужна текстовая таблица", "сохраните её как CSV")
    for encoding in ("utf-16",) if kind == UTF16 else ("utf-8-sig", "cp1251"):
        try:
            return data.decode(encoding)
        except UnicodeDecodeError:
            continue
    raise refused("кодировка не UTF-8, UTF-16 или Windows-1251", "сохраните как «CSV UTF-8»")


def recorded(text: str, wanted: Wanted) -> Recorded:
    """The asked columns of a table.

    Raises:
        InputError: there is no table of numbers, or it can be read in two ways.
    """
    found: dict[Recorded, str] = {}
    unfit: list[_UnfitError] = []
    for separator, called in _CALLED.items():
        try:
            reading = _read(_rows(text, separator), separator, wanted)
        except _UnfitError as error:
            unfit.append(error)
        else:
            found.setdefault(reading, f"столбцы через {called}")
    for reason in unfit:
        if reason.final:
            raise reason.error
    if len(found) > 1:
        ways = " или ".join(found.values())
        raise wanted.refused(f"числа читаются двояко: {ways}", "сохраните таблицу через «;»")
    if not found:
        raise max(unfit, key=lambda reason: reason.rows).error
    return next(iter(found))


def _rows(text: str, separator: str) -> list[Row]:
    """Numbers of lines and their fields; empty lines are left out."""
    if separator == " ":
        split: Iterator[Row] = ((n, line.split()) for n, line in enumerate(text.splitlines(), 1))
        return [row for row in split if row[1]]
    reader = csv.reader(io.StringIO(text), delimiter=separator, skipinitialspace=True)
    try:
        rows = [(reader.line_num, [field.strip() for field in fields]) for fields in reader]
    except csv.Error:  # a field without end
        return []
    return [row for row in rows if any(row[1])]


def _value(field: str) -> float | None:
    plain = field.replace("−", "-")
    if not _NUMBER.fullmatch(plain):
        return None
    value = float(plain.replace(",", "."))
    return value if math.isfinite(value) else None


def _read(rows: list[Row], separator: str, wanted: Wanted) -> Recorded:
    """Numbers of the asked columns between separators of one kind.

    Raises:
        _UnfitError: it is not so that the file is written.
    """
    nothing = wanted.refused("не найдена таблица чисел", "нужны столбцы угла и давления")
    numeric = [i for i, (_, row) in enumerate(rows) if sum(_value(f) is not None for f in row) > 1]
    if not numeric:
        raise _UnfitError(0, nothing)
    columns = tuple(
        _column(asked, rows, numeric[0], key, wanted, len(numeric))
        for asked, key in (
            (wanted.angle, "gas.angle_column"), (wanted.pressure, "gas.pressure_column"),
        )
    )  # fmt: skip
    cells = [[row[c] if c < len(row) else "" for c in columns] for _, row in rows]
    values = [[_value(cell) for cell in pair] for pair in cells]
    first = next((i for i, pair in enumerate(values) if None not in pair), len(rows))
    while first and values[first - 1][0] is not None:
        first -= 1  # a pressure that is no number is a fault, not a heading
    fault = _fault(rows, cells, values, first, separator, wanted.refused)
    if fault is not None:
        raise fault
    body = rows[first:]
    if len(body) < LEAST_ROWS:
        raise _UnfitError(0, nothing)
    if separator == "," and _torn(rows[:first], body, columns, wanted.units):
        what = "запятая стоит и между столбцами, и в дробях"
        torn = wanted.refused(what, "сохраните таблицу через «;» или числа с точкой")
        raise _UnfitError(len(body), torn, final=True)
    angles, pressures = zip(*values[first:], strict=True)
    return Recorded(tuple(line for line, _ in body), angles, pressures)


def _fault(
    rows: list[Row], cells: list[list[str]], values: list[list[float | None]], first: int,
    separator: str, refused: Refuse,
) -> _UnfitError | None:  # fmt: skip
    """The first row that does not belong to one table of numbers."""
    signs = ["", ""]
    for i in range(first, len(rows)):
        line, fields = rows[i]
        for column, (cell, value) in enumerate(zip(cells[i], values[i], strict=True)):
            if value is None:
                what = f"строка {line}: не числа" + (f" («{one_line(cell, 20)}»)" if cell else "")
                return _UnfitError(i - first, refused(what, "оставьте одну таблицу без пропусков"))
            sign = "".join(mark for mark in ".," if mark in cell)
            signs[column] = signs[column] or sign
            if sign and sign != signs[column]:
                what = f"строка {line}: в столбце стоят и точка, и запятая"
                return _UnfitError(i - first, refused(what, "оставьте один знак дроби"))
        if separator in ", " and len(fields) != len(rows[first][1]):
            what = f"строка {line}: чисел {len(fields)}, а выше {len(rows[first][1])}"
            hint = "в таблице должно быть одно число столбцов"
            return _UnfitError(i - first, refused(what, hint))
    return None


def _column(
    asked: object, rows: list[Row], first: int, key: str, wanted: Wanted, score: int
) -> int:
    """Index of a column by its number from 1 or by its name in any row of the heading."""
    width = len(rows[first][1])
    if isinstance(asked, int) and not isinstance(asked, bool):
        if 1 <= asked <= width:
            return asked - 1
        what, hint = f"нет столбца {asked}", f"в таблице столбцов {width}"
        raise _UnfitError(score, wanted.refused(what, hint, key=key))
    names = [fields for _, fields in rows[:first]]
    word = str(asked).strip().casefold()
    for fields in names:
        places = [i for i, field in enumerate(fields) if field.casefold() == word]
        exact = [i for i in places if fields[i] == asked]
        if len(exact or places) == 1:
            return (exact or places)[0]
        if places:
            what = f"столбцов «{one_line(str(asked), 40)}» несколько"
            raise _UnfitError(score, wanted.refused(what, "укажите номер", key=key))
    told = [one_line(name, 20) for fields in names for name in fields if name]
    hint = f"есть: {', '.join(told[:12])}" if told else "у столбцов нет заголовков: укажите номер"
    what = f"нет столбца «{one_line(str(asked), 40)}»"
    raise _UnfitError(score, wanted.refused(what, hint, key=key))


def _torn(
    heads: list[Row], body: list[Row], columns: tuple[int, ...], units: frozenset[str]
) -> bool:
    """Whether commas between the columns may as well be decimal ones."""
    rows = [fields for _, fields in body]
    if any("." in field or "," in field for fields in rows for field in fields):
        return False
    behind = [c + 1 for c in columns if c + 1 not in columns and c + 1 < len(rows[0])]
    if not any(all(fields[c].isdecimal() for fields in rows) for c in behind):
        return False
    return not any(
        len(names) == len(rows[0]) and not any(name.casefold() in units for name in names)
        for _, names in heads
    )
