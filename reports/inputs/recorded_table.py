"""The table of a recorded diagram: separator, heading, columns of angle and pressure.

The file is a plain table of numbers: CSV with commas or semicolons, or columns between
blanks or tabs, such as a recorder writes.  What can be read in two ways is refused.
"""

from __future__ import annotations

import csv
import io
import math
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from itertools import takewhile
from pathlib import Path

from reports.shared.errors import InputError, UnfitTable, one_line
from reports.shared.file_types import CALLED, TEXT, UTF16, kind_of, read_bytes

MAX_BYTES = 8_000_000
MIN_ROWS = 3
# Separators between columns; of blanks any number makes one.
_CALLED = {";": "«;»", "\t": "табуляцию", ",": "запятую", " ": "пробелы"}
_NUMBER = re.compile(r"[-+]?(\d+([.,]\d+|\.)?|\.\d+)([eE][-+]?\d+)?")
Refuse = Callable[..., InputError]
Row = tuple[int, list[str]]
_THOUSANDS = re.compile(r"[-+−]?[1-9]\d{0,2}([ \u00a0\u202f'’.,])\d{3}(\1\d{3})*([.,]\d+)?")
_WITH_WORD = re.compile(r"([-+−]?[\d.,]+)\s*(\D+)")


@dataclass(frozen=True, slots=True)
class Recorded:
    """Angles and pressures as the file has them, with the number of each line.

    ``pressures`` has a column for each that was asked for, ``beside`` the columns of numbers
    behind the last of them; ``heads`` are the words over the angles.
    """

    lines: tuple[int, ...]
    angles: tuple[float, ...]
    pressures: tuple[tuple[float, ...], ...]
    beside: tuple[tuple[float, ...], ...] = field(default=(), compare=False)
    heads: tuple[str, ...] = field(default=(), compare=False)


@dataclass(frozen=True, slots=True)
class WantedColumns:
    """Columns to read, by number from 1 or by name, and the words for refusals."""

    angle: object
    pressures: tuple[object, ...]
    units: frozenset[str]  # what a heading says of a unit alone
    refused: Refuse


def text_of(file: Path, refused: Refuse) -> str:
    """Return the text of a recorder's or a spreadsheet's file: UTF-8, UTF-16 or Windows-1251.

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


def recorded(text: str, columns: WantedColumns) -> Recorded:
    """Columns of angle and pressure of a table.

    Raises:
        InputError: there is no table of numbers, or it can be read in two ways.
    """
    readings: dict[Recorded, str] = {}
    unfit: list[UnfitTable] = []
    for separator, called in _CALLED.items():
        try:
            reading = _read(_rows(text, separator), separator, columns)
        except UnfitTable as error:
            unfit.append(error)
        else:
            readings.setdefault(reading, f"столбцы через {called}")
    for reason in unfit:
        if reason.final:
            raise reason.error
    if len(readings) > 1:
        ways = " или ".join(readings.values())
        raise columns.refused(f"числа читаются двояко: {ways}", "сохраните таблицу через «;»")
    if not readings:
        raise max(unfit, key=lambda reason: reason.rows).error
    return next(iter(readings))


def _rows(text: str, separator: str) -> list[Row]:
    """Numbers of lines and their fields; empty lines are left out."""
    text = text.replace("\r\n", "\n").replace("\r", "\n")  # Windows, and what was a Macintosh
    if separator == " ":
        split: Iterator[Row] = ((n, line.split()) for n, line in enumerate(text.splitlines(), 1))
        return [row for row in split if row[1]]
    reader = csv.reader(io.StringIO(text), delimiter=separator, skipinitialspace=True)
    try:
        rows = [(reader.line_num, [field.strip() for field in fields]) for fields in reader]
    except csv.Error:  # a field without end
        return []
    return [row for row in rows if any(row[1])]


def _value(cell: str) -> float | None:
    plain = cell.replace("−", "-")
    if not _NUMBER.fullmatch(plain):
        return None
    value = float(plain.replace(",", "."))
    return value if math.isfinite(value) else None


def _mend(cell: str, units: frozenset[str]) -> str:
    """Return the mend that makes a cell a number; empty if there is none."""
    if _value(cell) is not None:
        return ""
    if _THOUSANDS.fullmatch(cell):
        return "уберите разделители тысяч"
    word = _WITH_WORD.fullmatch(cell)
    if word and word[2].strip().casefold() in units and _value(word[1]) is not None:
        return f"уберите из ячеек «{word[2].strip()}»"
    return ""


def _read(rows: list[Row], separator: str, requested: WantedColumns) -> Recorded:
    """Columns of angle and pressure between separators of one kind.

    Raises:
        UnfitTable: it is not so that the file is written.
    """
    nothing = requested.refused("не найдена таблица чисел", "нужны столбцы угла и давления")
    like = [
        [_value(f) is not None or bool(_mend(f, requested.units)) for f in row] for _, row in rows
    ]
    numeric = [sum(fields) > 1 for fields in like]
    if not any(numeric):
        raise UnfitTable(0, nothing)
    start, score = _longest(numeric), sum(numeric)
    keys = [(requested.angle, "gas.angle_column")]
    keys += [(column, "gas.pressure_column") for column in requested.pressures]
    located = [_column(column, rows, start, key, requested, score) for column, key in keys]
    columns, after = [match[0] for match in located], max(match[1] for match in located)
    cells = [[row[c] if c < len(row) else "" for c in columns] for _, row in rows]
    values = [[_value(cell) for cell in group] for group in cells]
    first = next((i for i in range(after, len(rows)) if all(
        c < len(like[i]) and like[i][c] for c in columns)), len(rows))  # fmt: skip
    while first > after and values[first - 1][0] is not None:
        first -= 1  # a pressure that is no number is a fault, not a heading
    first += _is_numbering(rows, values, first, columns[0])
    fault = _fault(rows, cells, values, first, separator, requested)
    if fault is not None:
        raise fault
    body = rows[first:]
    if len(body) < MIN_ROWS:
        raise UnfitTable(0, nothing)
    if separator == "," and _torn(rows[:first], body, tuple(columns), requested.units):
        problem = "запятая стоит и между столбцами, и в дробях"
        torn = requested.refused(problem, "сохраните таблицу через «;» или числа с точкой")
        raise UnfitTable(len(body), torn, final=True)
    angles, *pressures = zip(*values[first:], strict=True)
    above = takewhile(lambda row: sum(map(bool, row[1])) > 1, reversed(rows[:first]))
    heads = tuple(row[columns[0]] for _, row in above if columns[0] < len(row))
    beside = tuple(_columns_beside(body, columns[-1] + 1))
    return Recorded(tuple(line for line, _ in body), angles, tuple(pressures), beside, heads)


def _longest(numeric: list[bool]) -> int:
    """Where the longest run of rows of numbers begins."""
    best, begin = (0, 0), None
    for i, good in enumerate([*numeric, False]):
        if good and begin is None:
            begin = i
        if not good and begin is not None:
            best, begin = max(best, (i - begin, -begin)), None
    return -best[1]


def _is_numbering(
    rows: list[Row], values: list[list[float | None]], first: int, angle: int
) -> bool:
    """Whether the first row of numbers numbers the columns, from 0 or from 1."""
    if len(rows) - first < MIN_ROWS:
        return False
    numbers = [_value(cell) for cell in rows[first][1] if cell]
    base = numbers[0] if numbers else None
    if len(numbers) < 2 or base not in (0, 1) or numbers != [base + i for i in range(len(numbers))]:
        return False
    (here, p, *_), (second, p_2, *_), (third, *_) = values[first : first + 3]
    if None in (here, p, second, p_2, third):
        return False
    if second <= here:  # type: ignore[operator]
        return True
    goes_on = abs((second - here) - (third - second)) <= 0.01 * abs(third - second)  # type: ignore[operator]
    if goes_on:  # a point, unless its pressure stands alone
        return bool(abs(p - p_2) > 0.5 * max(abs(p), abs(p_2)))  # type: ignore[operator,arg-type]
    return base == 1 and first > 0


def _columns_beside(body: list[Row], first: int) -> Iterator[tuple[float, ...]]:
    """Consecutive columns of numbers, from a first one."""
    for column in range(first, min(len(fields) for _, fields in body)):
        numbers = [_value(fields[column]) for _, fields in body]
        if None in numbers:
            return
        yield tuple(number for number in numbers if number is not None)


def _fault(
    rows: list[Row], cells: list[list[str]], values: list[list[float | None]], first: int,
    separator: str, requested: WantedColumns,
) -> UnfitTable | None:  # fmt: skip
    """First row that breaks the table of numbers."""
    refused, signs = requested.refused, [""] * len(cells[0])
    for i in range(first, len(rows)):
        line, fields = rows[i]
        for column, (cell, value) in enumerate(zip(cells[i], values[i], strict=True)):
            if value is None:
                problem = f"строка {line}: не числа" + (
                    f" («{one_line(cell, 20)}»)" if cell else ""
                )
                mend = _mend(cell, requested.units) or "оставьте одну таблицу без пропусков"
                # A cell that is nearly a number is the reason, however few rows stand above it.
                score = len(rows) if _mend(cell, requested.units) else i - first
                return UnfitTable(score, refused(problem, mend))
            sign = "".join(mark for mark in ".," if mark in cell)
            signs[column] = signs[column] or sign
            if sign and sign != signs[column]:
                problem = f"строка {line}: в столбце стоят и точка, и запятая"
                return UnfitTable(i - first, refused(problem, "оставьте один знак дроби"))
        if separator in ", " and len(fields) != len(rows[first][1]):
            problem = f"строка {line}: чисел {len(fields)}, а выше {len(rows[first][1])}"
            hint = "в таблице должно быть одно число столбцов"
            return UnfitTable(i - first, refused(problem, hint))
    return _thousands(rows, cells, first, refused)


def _thousands(
    rows: list[Row], cells: list[list[str]], first: int, refused: Refuse
) -> UnfitTable | None:
    """Return first "1,234" of a column that has whole hundreds without a sign beside such cells."""
    for column in zip(*cells[first:], strict=True):
        signed = [i for i, cell in enumerate(column) if "," in cell or "." in cell]
        whole = any(cell.lstrip("-+−").isdecimal() and len(cell) > 2 for cell in column)
        if signed and whole and all(_THOUSANDS.fullmatch(column[i]) for i in signed):
            problem = f"строка {rows[first + signed[0]][0]}: «{column[signed[0]]}» читается двояко"
            return UnfitTable(len(rows), refused(problem, "уберите разделители тысяч"), final=True)
    return None


def _column(
    column: object, rows: list[Row], first: int, key: str, requested: WantedColumns, score: int
) -> tuple[int, int]:
    """Index of a column by its number from 1 or its name, and the row below which it begins."""
    width = len(rows[first][1])
    if isinstance(column, int) and not isinstance(column, bool):
        if 1 <= column <= width:
            return column - 1, 0
        problem, hint = f"нет столбца {column}", f"в таблице столбцов {width}"
        raise UnfitTable(score, requested.refused(problem, hint, key=key))
    names = [fields for _, fields in rows[:first]]
    word = str(column).strip().casefold()
    for i, fields in reversed([*enumerate(names)]):  # the heading is the nearest row
        indices = [j for j, name in enumerate(fields) if name.casefold() == word]
        exact = [j for j in indices if fields[j] == column]
        if len(exact or indices) == 1:
            return (exact or indices)[0], i + 1
        if indices:
            problem = f"столбцов «{one_line(str(column), 40)}» несколько"
            raise UnfitTable(score, requested.refused(problem, "укажите номер", key=key))
    nearest = [fields for fields in reversed(names) if len([*filter(None, fields)]) > 1]
    heads = [one_line(name, 20) for fields in nearest[:2] for name in fields if name]
    hint = f"есть: {', '.join(heads[:12])}" if heads else "у столбцов нет заголовков: укажите номер"
    problem = f"нет столбца «{one_line(str(column), 40)}»"
    raise UnfitTable(score, requested.refused(problem, hint, key=key))


def _torn(
    heads: list[Row], body: list[Row], columns: tuple[int, ...], units: frozenset[str]
) -> bool:
    """Whether commas between the columns may be decimal ones."""
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
