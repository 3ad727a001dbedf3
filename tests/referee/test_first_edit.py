"""The first edit in LibreOffice reaches every cell that depends on it, and is read back as saved.

The book keeps its saved values, as a person's does: LibreOffice believes them on loading, and a
cell that it loads dirty stops what is edited before it from reaching what stands behind it.
"""

from __future__ import annotations

import io
import json
import re
import subprocess
import zipfile
from collections import Counter
from pathlib import Path

import pytest
from openpyxl.utils.cell import column_index_from_string, coordinate_from_string

from reports.inputs.fields import iter_fields, to_mapping
from reports.tables.registry import build_model
from reports.workbook.caches import sheet_parts
from reports.workbook.cockpit import SHEET as WHAT_IF
from reports.workbook.layout import Layout
from reports.workbook.read import load_workbook_input
from reports.workbook.write import workbook_bytes
from tests.cover import ALL
from tests.referee.changes import Change, type_into, with_values, without_charts
from tests.referee.compare import CURVES, close, same_text
from tests.workbook.made import coarse, coarse_book, coarse_model
from tools.referees.by_formualizer import Formualizer
from tools.referees.cells import Book, cached_values

PYTHON = "/usr/bin/python3"
ENGINES = ("two-stroke", *(("gots-diesel", "yamz-238", "ecoboost-10") if ALL else ()))
COMPUTED = "mwm-6"  # with values that the program computes: they do not follow an open book
# Cells of the flywheel, whose correction for the step of the tables is that of the build.
OF_THE_BUILD = {"Маховик": 6, "Момент инерции": 30, "Содержание": 2}
INPUTS = {"geometry_rod_length_mm": 1.08, "regime_speed_rpm": 0.95, "geometry_bore_mm": 1.03}


def changes_of(name: str) -> list[Change]:
    fields = {field.name: field for field in iter_fields(coarse(name))}
    return [
        Change(fields[key], round(float(fields[key].value) * factor, 3))
        for key, factor in INPUTS.items()
    ]


def built(name: str, change: Change) -> Book:
    """The values of the book that is built from the changed input."""
    changed = with_values(coarse(name), [change])
    assert changed is not None
    cells = cached_values(workbook_bytes(build_model(changed)))
    del cells[WHAT_IF]  # compares with what the book was built from
    return cells


def unlike(book: Book, other: Book) -> Counter[str]:
    """Cells by sheet that two books tell differently."""
    return Counter(
        sheet
        for sheet, cells in book.items()
        if sheet != CURVES  # saved with the digits of a picture
        for cell, value in cells.items()
        if not same(value, other[sheet].get(cell), sheet, cell)
    )


def recalculated(name: str, change: Change) -> Book:
    """The values of the changed book, calculated anew from its formulas."""
    return Formualizer().recalculate([type_into(coarse_book(name), coarse(name), [change])])[0]


def edited(name: str, folder: Path) -> list[dict[str, list[list[float | str]]]]:
    """Rows of all sheets after the first edit of each input; no picture is loaded."""
    source = folder / f"{name}.xlsx"
    source.write_bytes(without_charts(coarse_book(name)))
    cells = Layout.of(coarse_model(name)).cells
    jobs = [
        (str(source), cell.sheet, cell.coordinate, change.value, str(saved(folder, change)))
        for change in changes_of(name)
        for cell in (cells[change.field.name],)
    ]
    script = Path(__file__).with_name("edited.py")
    done = subprocess.run(
        [PYTHON, str(script), str(folder / "profile")],
        input=json.dumps(jobs), capture_output=True, text=True, timeout=300, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr[-2000:]
    return json.loads(done.stdout)


def saved(folder: Path, change: Change) -> Path:
    """Where LibreOffice saves the edited book."""
    return folder / f"{change.field.name}.xlsx"


def at(rows: list[list[float | str]], coordinate: str) -> float | str | None:
    """The value of a cell; None beyond the used rows."""
    column, row = coordinate_from_string(coordinate)
    index = column_index_from_string(column) - 1
    return rows[row - 1][index] if row <= len(rows) and index < len(rows[0]) else None


def same(value: float | str, other: float | str | None, sheet: str, cell: str) -> bool:
    """Whether two cells tell one value."""
    if isinstance(value, float) and isinstance(other, float):
        return close(value, other, 1 + abs(value))
    return same_text(value, other, sheet, cell)


def stale(wanted: Book, collected: dict[str, list[list[float | str]]]) -> tuple[int, list[str]]:
    """Number of cells compared and those that differ."""
    compared, wrong = 0, []
    for sheet, cells in wanted.items():
        for cell, value in cells.items():
            compared += 1
            other = at(collected[sheet], cell)
            if not same(value, other, sheet, cell):
                wrong.append(f"{sheet}!{cell}: {value!r}, LibreOffice {other!r}")
    return compared, wrong


@pytest.mark.usefixtures("libreoffice")
@pytest.mark.libreoffice
@pytest.mark.parametrize("name", [*ENGINES, COMPUTED])
def test_the_first_edit_reaches_every_cell(name: str, tmp_path: Path) -> None:
    books = edited(name, tmp_path)
    for change, item in zip(changes_of(name), books, strict=True):
        wanted = recalculated(name, change)
        if name != COMPUTED:
            assert unlike(built(name, change), wanted) <= Counter(OF_THE_BUILD)
        compared, wrong = stale(wanted, item)
        assert wrong == [], (change.field.name, compared, len(wrong))
        assert compared > 5000
        back = load_workbook_input(saved(tmp_path, change)).model
        assert to_mapping(back) == to_mapping(with_values(coarse(name), [change]))


def test_no_cell_is_an_array_formula() -> None:
    for name in (*ENGINES, COMPUTED):
        with zipfile.ZipFile(io.BytesIO(coarse_book(name))) as archive:
            for part in sheet_parts(archive).values():
                assert not re.search(rb'<f [^>]*t="array"', archive.read(part)), (name, part)
