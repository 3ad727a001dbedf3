"""Reading the input cells of a workbook that ``build`` made and a person edited.

The workbook is found out by its defined names: every input field has one.  Only
values are read, and arithmetic of numbers; other formulas in input cells are refused, since their
cached values are a claim that nobody has checked.
"""

from __future__ import annotations

import ast
import io
import operator
import re
import warnings
from collections.abc import Callable
from functools import lru_cache
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Any

from reports.inputs.department_chapters import MAX_LINES, Texts, path_of_cell
from reports.inputs.fields import POINT_KEYS, iter_fields
from reports.inputs.load import Loaded, load_mapping
from reports.inputs.registry import SECTIONS
from reports.shared.errors import DeclarationError, InputError, Problem
from reports.workbook.intake import check_package
from reports.workbook.layout import (
    BOOK_MARK,
    INPUT_SHEET,
    OWN_SHEET,
    UNIT_COLUMN,
    VALUE_COLUMN,
    quoted,
)

if TYPE_CHECKING:  # openpyxl is loaded when a book is read
    from openpyxl.cell import ReadOnlyCell
    from openpyxl.workbook import Workbook

MAX_CELLS = 500_000  # of a sheet of inputs; thousands are usual
_ALWAYS = "engine_cylinders"  # every book has this input
_SUM = re.compile(r"=[0-9.()+\-*/\s]{1,200}")
_SIGNS: dict[type[ast.operator], Callable[[float, float], float]] = {
    ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul,
    ast.Div: operator.truediv,
}  # fmt: skip
_ADDRESS = re.compile(r"\$?([A-Z]{1,3})\$?([0-9]+)")


def load_workbook_input(path: Path) -> Loaded:
    """Return the checked input of an edited workbook.

    Raises:
        InputError: no workbook of ours, or its input cells are wrong; the
            messages name sheet and cell.
    """
    data = check_package(path)
    cells, addresses, units, books = _input_cells(data, path.name)
    raw: dict[str, Any] = {"books": books} if books else {}
    texts = tuple(books.items())
    addresses_of: dict[tuple[str | int, ...], str] = {}
    for name, value in cells.items():
        target = _path_of(name) or _own_path(name, texts)
        if target is None:
            continue
        addresses_of[target] = addresses[name]
        _put(raw, target, value)
    for section in SECTIONS.values():
        if section.lists:
            _close_lists(raw.get(section.name, {}))
    for regime in raw.get("regimes", {}).values():
        _close_lists(regime.get("gas", {}))
    _close_lists(raw)

    def locate(target: tuple[str | int, ...]) -> str:
        for length in range(len(target), 0, -1):
            if target[:length] in addresses_of:
                return addresses_of[target[:length]]
        nested = [cell for at, cell in addresses_of.items() if at[: len(target)] == target]
        return nested[0] if nested else INPUT_SHEET

    loaded = load_mapping(raw, source=path.name, locate=locate)
    _check_units(loaded, addresses, units, path.name)
    return loaded


def _check_units(
    loaded: Loaded, addresses: dict[str, str], units: dict[str, str], source: str
) -> None:
    """Refuse a number whose unit a person wrote anew: it would be taken in the old one."""
    problems = [
        Problem(
            f"{source}, {addresses[item.name]}",
            f"рядом стоит единица «{units[item.name]}» вместо «{item.unit}»",
            f"верните единицу и впишите число в «{item.unit}»",
        )
        for item in iter_fields(loaded.model)
        if item.name in units and not item.listed and _plain(units[item.name]) != _plain(item.unit)
    ]
    if problems:
        raise InputError(problems)


def _plain(unit: str) -> str:
    return re.sub(r"\s", "", unit).casefold()


def _own_path(name: str, books: Texts) -> tuple[str | int, ...] | None:
    """Path of an own input; none where the books are wrong, of which the check tells."""
    try:
        return path_of_cell(name, books)
    except DeclarationError:
        return None


def _input_cells(
    data: bytes, source: str
) -> tuple[dict[str, Any], dict[str, str], dict[str, str], dict[str, str]]:
    """Values of all named input cells, their places as ``лист!ячейка``, units, own books."""
    from openpyxl.utils.cell import coordinate_to_tuple

    book, title, sheet, books = _sheets(data, source)
    if _ALWAYS in book.defined_names and title not in book.sheetnames:
        fault = "в книге нет листа исходных данных, на который указывают имена её ячеек"
        problem = Problem(source, fault, "верните лист или возьмите книгу, какой её сделала kshm")
        raise InputError(problem)
    cells: dict[str, Any] = {}
    addresses: dict[str, str] = {}
    units: dict[str, str] = {}
    problems: list[Problem] = []
    for name, defined in book.defined_names.items():
        text = str(defined.attr_text or "")
        sheet_text, _, address = text.rpartition("!")
        if sheet_text not in (title, quoted(title)):
            continue
        match = _ADDRESS.fullmatch(address)
        if match is None:
            fault = f"имя {name} не указывает на ячейку"
            problems.append(Problem(source, fault, "восстановите лист исходных данных"))
            continue
        reference = f"{title}!{match.group(1)}{match.group(2)}"
        row, column = coordinate_to_tuple(match.group(1) + match.group(2))
        cell = sheet.get((row, column))
        value = _typed(cell)
        if value is None and cell is not None:
            fault = "в ячейке исходных данных стоит формула, а не число"
            hint = "впишите число или действия над числами, например =80+10"
            problems.append(Problem(f"{source}, {reference}", fault, hint))
            continue
        cells[name], addresses[name] = value, reference
        beside = sheet.get((row, UNIT_COLUMN))
        if column == VALUE_COLUMN and isinstance(value, int | float) and beside is not None:
            units[name] = str(beside.value)
    if problems:
        raise InputError(problems)
    if _ALWAYS not in cells:
        fault = "это не книга, созданная командой kshm build"
        raise InputError(Problem(source, fault, "укажите файл .toml или книгу kshm"))
    return cells, addresses, units, books


def _sheets(
    data: bytes, source: str
) -> tuple[Workbook, str, dict[tuple[int, int], ReadOnlyCell], dict[str, str]]:
    """Return a book, the title and cells of its sheet of inputs, own books."""
    from openpyxl import load_workbook

    try:
        with warnings.catch_warnings(action="ignore"):  # of parts that are not read
            book = load_workbook(io.BytesIO(data), read_only=True)  # charts take half of the time
            title = _input_sheet(book)
            return book, title, _cells_of(book, title), _books_of(_cells_of(book, OWN_SHEET))
    except InputError:
        raise
    except Exception as error:  # openpyxl raises anything on a damaged book
        fault = "книга повреждена и не читается"
        problem = Problem(source, fault, "сохраните её заново в Excel или LibreOffice")
        raise InputError(problem) from error


def _typed(cell: ReadOnlyCell | None) -> Any:  # noqa: ANN401
    """What a person typed into a cell that holds something; None of a formula with more in it."""
    if cell is None or cell.data_type != "f":
        return None if cell is None else cell.value
    return arithmetic(str(getattr(cell.value, "text", cell.value)))


def _books_of(cells: dict[tuple[int, int], ReadOnlyCell]) -> dict[str, str]:
    """Texts of own books by name, as their sheet has them line by line."""
    books: dict[str, str] = {}
    lines: list[str] = []
    name, last = "", 0
    for row, column in sorted(cells):
        text = str(cells[row, column].value)
        if column != 1:
            continue
        if text.startswith(BOOK_MARK):
            books[name] = "\n".join(lines) + "\n"
            name, lines = text.removeprefix(BOOK_MARK), []
        elif name:
            lines += [""] * min(row - last - 1, MAX_LINES)
            lines.append(text)
        last = row
    books[name] = "\n".join(lines) + "\n"
    del books[""]
    return books


def arithmetic(text: str) -> float | None:
    """Value of a formula of numbers, brackets and + - * / alone; None of any other.

    >>> arithmetic("=2*(40+4)")
    88.0
    """
    if not _SUM.fullmatch(text):
        return None
    try:
        value = _value_of(ast.parse(text[1:].strip(), mode="eval").body)
    except (SyntaxError, ZeroDivisionError, OverflowError, RecursionError, ValueError):
        return None
    return value if isfinite(value) else None


def _value_of(node: ast.expr) -> float:
    match node:
        case ast.Constant(value=int() | float() as number):
            return float(number)
        case ast.UnaryOp(op=ast.USub() | ast.UAdd() as sign, operand=operand):
            return _value_of(operand) * (-1 if isinstance(sign, ast.USub) else 1)
        case ast.BinOp(left=left, op=op, right=right) if type(op) in _SIGNS:
            return float(_SIGNS[type(op)](_value_of(left), _value_of(right)))
    raise ValueError(ast.dump(node))


def _cells_of(book: Workbook, title: str) -> dict[tuple[int, int], ReadOnlyCell]:
    """Cells of a sheet that hold something by row and column; none where there is no such sheet."""
    if title not in book.sheetnames:
        return {}
    sheet = book[title]
    sheet.reset_dimensions()  # what a file says of its size may be wrong
    cells: dict[tuple[int, int], ReadOnlyCell] = {}
    seen = 0
    for row in sheet.iter_rows():
        seen += len(row)
        if seen > MAX_CELLS:
            hint = "удалите лишнее или возьмите книгу, какой её сделала kshm"
            raise InputError(Problem(title, "на листе слишком много ячеек", hint))
        cells |= {(cell.row, cell.column): cell for cell in row if cell.value is not None}
    return cells


def _input_sheet(book: Workbook) -> str:
    """Title of the sheet of inputs, which a person may have renamed: its names point at it."""
    defined = book.defined_names.get(_ALWAYS)
    text = "" if defined is None else str(defined.attr_text or "").rpartition("!")[0]
    return text[1:-1].replace("''", "'") if text.startswith("'") else text or INPUT_SHEET


def _path_of(name: str) -> tuple[str | int, ...] | None:
    """Path of an input field from the name of its cell, see ``reports.inputs.fields``."""
    further = re.fullmatch(r"(\w+)_R([0-9]+)", name)
    if further is not None:
        path = _path_of(further[1])
        if path is None or path[0] not in ("regime", "gas") or int(further[2]) < 2:
            return None
        return ("regimes", int(further[2]) - 2, *path[path[0] == "regime" :])
    for section in SECTIONS.values():
        for key, spec in section.lists.items():
            match = re.fullmatch(_cell_pattern(spec.cells), name)
            if match is None:
                continue
            index, part = int(match["n"]) - 1, match.groupdict().get("key")
            if part is None:
                return section.name, key, index
            return section.name, key, index, POINT_KEYS.index(part) if part in POINT_KEYS else part
    for section in SECTIONS.values():
        if name.startswith(section.name + "_"):
            return section.name, name.removeprefix(section.name + "_")
    return None


@lru_cache
def _cell_pattern(cells: str) -> str:
    return cells.replace("{n}", r"(?P<n>[0-9]+)").replace("{key}", r"(?P<key>\w+)")


def _put(raw: dict[str, Any], path: tuple[str | int, ...], value: Any) -> None:  # noqa: ANN401
    """Put a value into nested dicts; lists are dicts of indices until ``_close_lists``."""
    target: dict[Any, Any] = raw
    for part in path[:-1]:
        target = target.setdefault(part, {})
    target[path[-1]] = value


def _close_lists(section: dict[Any, Any]) -> None:
    for key, value in section.items():
        if isinstance(value, dict) and all(isinstance(part, int) for part in value):
            _close_lists(value)
            section[key] = [value[index] for index in sorted(value)]
