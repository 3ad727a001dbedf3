"""Typed cells that a spreadsheet has taken for texts or dates."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from reports.grading.reading.placement import Location
from reports.recalculation.formulas import is_doubtful
from reports.recalculation.grid import CellGrid
from reports.recalculation.read import worksheets
from reports.recalculation.sheets import MAIN, parse_xml
from reports.workbook.intake import Package
from reports.workbook.layout import Cell

TEXT_NUMBER = "число записано текстом: таблица с ним не считает"
TEXT_FORMULA = "формула записана текстом: таблица её не считает"
DATE = "вместо числа стоит дата: 1.5 таблица приняла за первое мая"

_EARLIEST = 10_000  # as dates are counted, May of 1927: what «5.27» becomes
_DIGITS, _MAX_DIGITS = 4, 300  # of a text that carries a number: titles have fewer
_LONG = 100  # signs of a text that may be counted
_PLAIN = str.maketrans({"\u00a0": " ", "\u202f": " ", "\u2009": " ", "−": "-", "–": "-"})
_NUMBER = re.compile(
    r"([-+]?(?:\d{1,3}(?: \d{3})+|\d+)?(?:[.,]\d+)?(?:[eE][-+]?\d+)?)"
    r" *(?:[°a-zA-Zа-яА-Я][^%=,;]{0,15})?"  # a unit; a per cent is another number
)


def number_of(text: str) -> float | None:
    """The number that a person has written as a text, with a unit or without; None for others."""
    match = _NUMBER.fullmatch(text.translate(_PLAIN).strip())
    try:
        return float(match[1].replace(" ", "").replace(",", ".")) if match else None
    except ValueError:
        return None


def carried(value: object) -> float | None:
    """The number that a constant may carry into a formula: a text by its digits, or its length."""
    if not isinstance(value, str):
        return value if type(value) is float else None
    digits = "".join(filter(str.isdecimal, value))
    if len(digits) >= _DIGITS:
        number = number_of(value)
        return float(digits[:_MAX_DIGITS]) if number is None else number
    return len(value) + 0.5 if len(value) >= _LONG else None  # not whole: no angle


def is_formula(text: str) -> bool:
    """Whether a formula was typed into a cell of texts, or with a space before it."""
    return text.strip().lstrip("'").startswith("=")


def means_something(text: str) -> bool:
    """Whether a text stands for a value: no remark, and no filling."""
    return number_of(text) is not None or is_formula(text) or is_doubtful(text, in_product=True)


def as_meant(typed: Sequence[object]) -> tuple[dict[int, float], dict[int, str]]:
    """Numbers among the texts of some cells, and what was taken for a text."""
    numbers, odd = {}, {}
    for i, text in enumerate(typed):
        if not isinstance(text, str):
            continue
        number = number_of(text)
        if number is not None:
            numbers[i], odd[i] = number, TEXT_NUMBER
        elif is_formula(text):
            odd[i] = TEXT_FORMULA
    return numbers, odd


def dates(package: Package, grid: CellGrid, locations: Iterable[Location]) -> frozenset[Cell]:
    """Cells of some locations that are shown as dates."""
    cells = {
        Cell(location.sheet, row, location.column)
        for location in locations
        for row, value in grid.column(location.sheet, location.column).constants.items()
        if _may_be(value) and row in location.rows
    }
    of_dates = _looks_of_dates(package) if cells else ()
    sheets = {cell.sheet for cell in cells} if of_dates else ()
    formats = {
        (title, cell.get("r"))
        for title, part in worksheets(package)
        if title in sheets
        for cell in parse_xml(package.read(part)).iter(f"{MAIN}c")
        if cell.get("s") in of_dates
    }
    return frozenset(cell for cell in cells if (cell.sheet, cell.coordinate) in formats)


def _may_be(value: object) -> bool:
    """Whether a typed value may be a date: a whole number of days."""
    return isinstance(value, float) and value >= _EARLIEST and value.is_integer()


def _looks_of_dates(package: Package) -> frozenset[str]:
    """Numbers of the cells' looks that show a number as a date."""
    from openpyxl.styles.numbers import builtin_format_code, is_date_format

    try:
        styles = parse_xml(package.read("xl/styles.xml"))
    except KeyError:
        return frozenset()
    codes = {item.get("numFmtId"): item.get("formatCode") for item in styles.iter(f"{MAIN}numFmt")}
    looks = styles.find(f"{MAIN}cellXfs")
    forms = [look.get("numFmtId", "0") for look in (looks if looks is not None else ())]
    return frozenset(
        str(number)
        for number, form in enumerate(forms)
        if is_date_format(codes.get(form) or builtin_format_code(int(form)))
    )
