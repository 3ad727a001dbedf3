"""The workbook with its caches beside XlsxWriter writing the same.

Both write every cell of the textbook's diesel at 10°: formulas with their values, numbers,
texts, number formats and the comments of headers, with compression, to memory.  XlsxWriter
gets the finished texts and values; ours compiles its formulas from the expressions and
also draws all charts, which the other does not.  With default settings XlsxWriter looks
for newer functions in every formula, which is most of its time.
"""

from __future__ import annotations

import io
from collections.abc import Iterator
from functools import lru_cache, partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any
from unittest.mock import patch

import openpyxl
import xlsxwriter
from openpyxl.worksheet.formula import ArrayFormula

from reports.inputs.load import load_toml
from reports.model.blocks import Model
from reports.model.evaluation import Values, evaluate_model
from reports.shared.resources import samples_dir
from reports.tables.registry import build_model
from reports.workbook import chart_parts, write
from reports.workbook.lost_formulas import places_in
from reports.workbook.read import load_workbook_input
from reports.workbook.sheets import BlockWriter
from reports.workbook.write import formula_places, workbook_bytes
from tests.bench._figure import Figure, interleaved, median, memory, ratio
from tools.referees.by_formualizer import Formualizer

Written = tuple[int, int, Any, Any, tuple[str, str], str | None]


@lru_cache
def solved() -> tuple[Model, Values]:
    """The model and its values, calculated before the clock starts."""
    model = build_model(load_toml(samples_dir() / "gots-diesel.toml").model)
    return model, evaluate_model(model)


def ours() -> bytes:
    """The workbook as ``kshm build`` writes it."""
    return workbook_bytes(*solved())


def unshared() -> bytes:
    """The same with a formula of its own in every cell of a table."""
    BlockWriter.shares = False
    try:
        return ours()
    finally:
        BlockWriter.shares = True


def parts_of_their_own() -> bytes:
    """The same with the XML of every part of every chart made anew."""
    with patch.object(chart_parts, "_copy", lambda part, tag: part.to_tree(tag)):
        return ours()


def as_cells() -> bytes:
    """The same with cells of openpyxl for those without a look."""
    books: list[openpyxl.Workbook] = []

    def made() -> openpyxl.Workbook:
        books.append(openpyxl.Workbook())
        return books[-1]

    def bare(
        self: BlockWriter, title: str, at: tuple[int, int], value: float | str, formula: str = ""
    ) -> None:
        if formula:
            self.formula(books[-1][title], *at, formula, value)
        else:
            books[-1][title].cell(*at, value)

    with patch.object(write, "Workbook", made), patch.object(BlockWriter, "bare", bare):
        return ours()


def cells_of(book: bytes) -> dict[str, list[Written]]:
    """All cells of each sheet: place, formula or value, cached value, look, comment."""
    formulas = openpyxl.load_workbook(io.BytesIO(book))
    values = openpyxl.load_workbook(io.BytesIO(book), data_only=True)
    return {
        sheet.title: [
            (c.row - 1, c.column - 1, c.value, values[sheet.title][c.coordinate].value,
             (c.style, c.number_format), c.comment.text if c.comment else None)
            for row in sheet.iter_rows() for c in row if c.value is not None
        ]
        for sheet in formulas.worksheets
    }  # fmt: skip


def theirs(sheets: dict[str, list[Written]]) -> bytes:
    """The same cells by XlsxWriter."""
    stream = io.BytesIO()
    book = xlsxwriter.Workbook(stream, {"in_memory": True})
    looks: dict[tuple[str, str], Any] = {}
    for title, cells in sheets.items():
        sheet = book.add_worksheet(title)
        for row, column, value, cached, look, comment in cells:
            if look not in looks:
                looks[look] = book.add_format(
                    {"num_format": look[1], "font_name": "Times New Roman", "border": 1}
                )
            if isinstance(value, ArrayFormula):
                sheet.write_array_formula(value.ref, value.text, looks[look], cached)
            elif isinstance(value, str) and value.startswith("="):
                sheet.write_formula(row, column, value, looks[look], cached)
            elif isinstance(value, str):
                sheet.write_string(row, column, value, looks[look])
            else:
                sheet.write_number(row, column, value, looks[look])
            if comment:
                sheet.write_comment(row, column, comment)
    book.close()
    return stream.getvalue()


def shared_formulas() -> Iterator[Figure]:
    """What one formula to a column of a table buys: time, size, and time of a program's reading."""
    books = {"ours": ours(), "unshared": unshared()}
    writing = interleaved({"ours": ours, "unshared": unshared}, rounds=5)
    yield Figure("по формуле в ячейке / общие: время", ratio(writing, "unshared", "ours"), "раз")
    size = len(books["unshared"]) / len(books["ours"])
    yield Figure("по формуле в ячейке / общие: размер", size, "раз")
    reading = interleaved(
        {name: partial(Formualizer().recalculate, [book]) for name, book in books.items()}, rounds=3
    )
    name = "по формуле в ячейке / общие: пересчёт formualizer"
    yield Figure(name, ratio(reading, "unshared", "ours"), "раз")


def shared_parts() -> Iterator[Figure]:
    """What parts that charts share buy, and cells that are no objects."""
    times = interleaved({"ours": ours, "parts": parts_of_their_own, "cells": as_cells}, rounds=5)
    yield Figure("части диаграмм заново / общие: время", ratio(times, "parts", "ours"), "раз")
    yield Figure("ячейки openpyxl / текстом: время", ratio(times, "cells", "ours"), "раз")


def figures() -> Iterator[Figure]:
    """Figures."""
    cells = cells_of(ours())
    count = sum(len(each) for each in cells.values())
    times = interleaved({"ours": ours, "theirs": lambda: theirs(cells)}, rounds=5)
    yield Figure("книга с кэшами и диаграммами", median(times["ours"]), "с",
                 f"{count} ячеек, {len(solved()[0].charts)} диаграмм")  # fmt: skip
    yield Figure("XlsxWriter, те же ячейки без диаграмм", median(times["theirs"]), "с")
    yield Figure("книга / XlsxWriter", ratio(times, "ours", "theirs"), "раз", "цель 0,5")
    yield Figure("на ячейку", median(times["ours"]) / count * 1e6, "мкс")
    yield from shared_formulas()
    yield from shared_parts()
    with TemporaryDirectory() as folder:
        path = Path(folder, "книга.xlsx")
        path.write_bytes(ours())
        reading = interleaved(
            {
                "inputs": lambda: load_workbook_input(path),
                "all": lambda: openpyxl.load_workbook(path),
            }
        )
    model = solved()[0]
    places = interleaved({
        "written": lambda: places_in(workbook_bytes(model)),
        "asked": lambda: formula_places(model),
    })  # fmt: skip
    yield Figure("места формул: из записанной книги / без неё",
                 ratio(places, "written", "asked"), "раз")  # fmt: skip
    yield Figure("исходные данные из книги", median(reading["inputs"]), "с")
    yield Figure("книга целиком / исходные данные", ratio(reading, "all", "inputs"), "раз")
    yield memory("книга", "from tests.bench.workbook import ours; ours()")
