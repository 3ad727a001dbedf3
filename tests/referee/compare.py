"""Comparison of recalculated workbooks with caches and with the solver."""

from __future__ import annotations

import re
from collections.abc import Mapping
from string import ascii_uppercase

import numpy as np

from reports.inputs.sections.input_file import InputFile
from reports.inputs.solve_input import solved
from reports.model.blocks import Model
from reports.model.evaluation import Graph
from reports.tables.registry import build_model
from reports.workbook.layout import FIRST_ROW, Layout
from reports.workbook.substitution import SHEET as SUBSTITUTION
from reports.workbook.write import workbook_bytes
from tools.referees.by_formualizer import Formualizer
from tools.referees.cells import Book, CellValue, cached_values

TOLERANCE = 1e-9
_NUMBER = re.compile(r"\d+(?:\.\d+)?(?:[eE][-+]?\d+)?")
TURN = 360.0  # deg
CURVES = "Кривые"  # the sheet that charts alone are drawn from


def close(ours: float, theirs: float, scale: float) -> bool:
    return abs(ours - theirs) <= TOLERANCE * max(1.0, scale)


def same_text(ours: object, theirs: object, sheet: str, cell: str) -> bool:
    """Whether two texts are one; of lines over tables the last digits of numbers may differ."""
    if sheet != SUBSTITUTION and cell.lstrip(ascii_uppercase) != "1":
        return ours == theirs
    if isinstance(theirs, float):  # a text of digits alone, as Gnumeric saves it
        theirs = repr(theirs)
    if not (isinstance(ours, str) and isinstance(theirs, str)):
        return False
    if ours == theirs:
        return True
    parts, others = (_NUMBER.split(text) for text in (ours, theirs))
    return parts == others and np.allclose(
        *([float(each) for each in _NUMBER.findall(text)] for text in (ours, theirs)),
        rtol=1e-3, atol=1e-7,
    )  # fmt: skip


def differences_from_caches(book: bytes, recalculated: Book) -> list[str]:
    """Formula cells whose recalculated value is not their cached value."""
    wrong = []
    for sheet, cells in cached_values(book).items():
        numbers = [abs(v) for v in cells.values() if isinstance(v, float)]
        scale = max(numbers, default=1.0)
        near = near_enough(sheet, cells)
        for cell, cached in cells.items():
            value = recalculated[sheet][cell]
            if cell in near and isinstance(value, float):
                fits = abs(value - cached) <= near[cell]
            elif sheet == CURVES and isinstance(value, float) and abs(value - cached) == TURN:
                fits = True  # of equal greatest loads a turn apart the last digits choose
            elif isinstance(cached, float):
                fits = isinstance(value, float) and close(
                    value, cached, min(scale, 1 + abs(cached))
                )
            else:
                fits = cached is not None and same_text(cached, value, sheet, cell)
            if not fits:
                wrong.append(f"{sheet}!{cell}: cached {cached!r}, recalculated {value!r}")
    return wrong


def near_enough(sheet: str, cells: Mapping[str, CellValue]) -> dict[str, float]:
    """How near values of the curves' sheet are: saved for pictures, see ``test_curves``.

    Nothing of other sheets.
    """
    if sheet != CURVES:
        return {}
    last = FIRST_ROW
    while f"A{last + 1}" in cells:  # below the curves all digits are saved
        last += 1
    numbers = {
        cell: value
        for cell, value in cells.items()
        if isinstance(value, float) and int(cell.lstrip(ascii_uppercase)) <= last
    }
    largest: dict[str, float] = {}
    for cell, value in numbers.items():
        letters = cell.rstrip("0123456789")
        largest[letters] = max(largest.get(letters, 0.0), abs(value))
    return {cell: 0.06 * largest[cell.rstrip("0123456789")] + TOLERANCE for cell in numbers}


def differences_from_solver(
    model: Model, recalculated: Book, *, edited: bool = False
) -> tuple[int, list[str]]:
    """Cells compared with the solver and those that differ by more than the tolerance.

    In an ``edited`` book what follows from values of the build is old, as the book says.
    """
    solution = solved(model.input)
    layout = Layout.of(model)
    compared, wrong = 0, []
    # What the program computes at the build does not follow an open workbook.
    computed = {
        f"{table.id}.{column.key}"
        for table in model.tables.values()
        for column in table.columns
        if table.is_computed(column)
    }
    graph = Graph(model)

    def is_old(node: str) -> bool:
        return not computed.isdisjoint(graph.ancestors(node))

    for table in model.tables.values():
        ours = solution.columns.get(table.id, {})
        for column in table.columns[1:]:
            if column.helper or table.helper or table.is_computed(column):
                continue
            if edited and is_old(f"{table.id}.{column.key}"):
                continue
            expected = ours[column.key]
            scale = float(np.abs(expected).max())
            letters = layout.range_of(f"{table.id}.{column.key}").split("$")[1]
            for index, value in enumerate(expected):
                compared += 1
                got = recalculated[table.sheet][f"{letters}{FIRST_ROW + index}"]
                if not isinstance(got, float) or not close(got, float(value), scale):
                    wrong.append(f"{table.id}.{column.key}[{index}]: {got!r}, solver {value!r}")
    for key, value in solution.scalars.items():
        if edited and is_old(key):
            continue
        cell = layout.cells[key]
        compared += 1
        got = recalculated[cell.sheet][cell.coordinate]
        if not isinstance(got, float) or not close(got, value, abs(value)):
            wrong.append(f"{key}: {got!r}, solver {value!r}")
    return compared, wrong


def recalculated_as_solved(model: Model) -> bytes:
    """A model's workbook, once Formualizer has found its caches and the solver's numbers."""
    book = workbook_bytes(model)
    (result,) = Formualizer().recalculate([book])
    wrong = [*errors_in(result), *differences_from_caches(book, result)]
    wrong += differences_from_solver(model, result)[1]
    assert not wrong, wrong
    return book


def errors_in(recalculated: Book) -> list[str]:
    """Cells with an error value or without a value."""
    return [
        f"{sheet}!{cell}: {value!r}"
        for sheet, cells in recalculated.items()
        for cell, value in cells.items()
        if value is None or (isinstance(value, str) and value.startswith("#"))
    ]


def model_of(data: InputFile) -> Model:
    return build_model(data)
