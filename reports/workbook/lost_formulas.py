"""Formulas of an edited workbook with numbers typed over them, which nobody would miss."""

from __future__ import annotations

import io
import zipfile
from collections import Counter
from collections.abc import Iterator, Mapping, Set
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

from lxml import etree
from openpyxl.utils.cell import coordinate_to_tuple, get_column_letter

from reports.model.blocks import Model
from reports.shared.errors import Problem
from reports.workbook.caches import sheet_parts
from reports.workbook.course import short_model
from reports.workbook.intake import check_package
from reports.workbook.write import formula_places

_MAIN = "{http://schemas.openxmlformats.org/spreadsheetml/2006/main}"
_MAX_NAMED = 5  # addresses of a sheet
_BLOCK = 10  # cells from which on equal rows mean a column put in
_FAULT = "вместо формулы вписано число, в расчёт оно не вошло"
_HINT = "верните формулу или постройте книгу заново"
_Places = Set[tuple[int, int]]  # rows and columns


@dataclass(frozen=True, slots=True)
class _Cells:
    """Places of formulas and of numbers on a sheet."""

    formulas: set[tuple[int, int]] = field(default_factory=set)
    numbers: set[tuple[int, int]] = field(default_factory=set)


def lost_formulas(path: Path, model: Model) -> tuple[Problem, ...]:
    """Return the cells of an edited workbook where a number stands over a formula, by sheets."""
    fresh = formula_places(short_model(model))
    edited = places_in(check_package(path))
    if fresh.keys() - edited.keys():
        return ()  # built for another structure, or not to be read
    return tuple(_problems(path.name, fresh, edited))


def _problems(
    source: str, fresh: Mapping[str, _Places], edited: Mapping[str, _Cells]
) -> Iterator[Problem]:
    for title, formulas in fresh.items():
        lost = formulas & edited[title].numbers
        if lost and not is_shifted(formulas, edited[title].formulas):
            names = [f"{get_column_letter(column)}{row}" for row, column in sorted(lost)]
            more = len(names) - _MAX_NAMED
            named = ", ".join(names[:_MAX_NAMED]) + (f" и ещё {more}" if more > 0 else "")
            yield Problem(f"{source}, {title}!{named}", _FAULT, _HINT)


def is_shifted(fresh: _Places, edited: _Places) -> bool:
    """Whether rows or columns were put in: as many formulas stand behind the others.

    >>> table = {(row, column) for row in (6, 7, 8) for column in (2, 3)}
    >>> is_shifted(table, {(row + 1, column) for row, column in table})
    True
    >>> is_shifted(table, table - {(7, 2)} | {(7, 9)})
    False
    """
    rows, columns = (
        Counter(cell[axis] for cell in fresh - edited)
        == Counter(cell[axis] for cell in edited - fresh)
        for axis in (0, 1)
    )
    return columns or (rows and len(fresh - edited) > _BLOCK)


def places_in(data: bytes) -> dict[str, _Cells]:
    """Return places of the cells of each sheet that can be read."""
    cells: dict[str, _Cells] = {}
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        for title, part in sheet_parts(archive).items():
            with suppress(KeyError, etree.XMLSyntaxError):  # of a damaged sheet nothing is known
                cells[title] = _cells_of(archive.read(part))
    return cells


def _cells_of(part: bytes) -> _Cells:
    cells = _Cells()
    for _, cell in etree.iterparse(io.BytesIO(part), tag=f"{_MAIN}c", resolve_entities=False):
        position = coordinate_to_tuple(cell.attrib["r"])
        if cell.find(f"{_MAIN}f") is not None:
            cells.formulas.add(position)
        elif cell.find(f"{_MAIN}v") is not None and cell.get("t", "n") == "n":
            cells.numbers.add(position)
        cell.clear()
    return cells
