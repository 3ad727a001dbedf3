"""Sheets in the usual form are read as the XML parser reads them, whatever was read before."""

from __future__ import annotations

import io
import random
import re
import zipfile

import pytest

from reports.recalculation.by_columns import BadBook, Grid
from reports.recalculation.by_columns.sheet_text import read_text
from reports.recalculation.by_columns.sheet_xml import read_xml
from tests.grading.forms import as_excel
from tests.referee.test_by_columns import coarse

STRINGS = [f"text {i}" for i in range(5000)]


def contents(grid: Grid) -> dict:
    """All that a grid holds, as plain data."""
    return {
        number: (
            column.constants,
            column.errors,
            [(run.first, run.count, run.text, run.pattern, run.problem) for run in column.runs],
            [repr(column.saved_of(run).tolist()) for run in column.runs],
        )
        for number, column in grid.sheets["A"].items()
    }


def other_numbers(data: bytes, rng: random.Random) -> bytes:
    """A sheet with other numbers; whole ones may be those of strings."""

    def other(match: re.Match[bytes]) -> bytes:
        return b"<v>%r</v>" % rng.uniform(-9, 9) if b"." in match[1] else match[0]

    return re.sub(rb"<v>([^<]+)</v>", other, data)


@pytest.mark.parametrize("form", ["own", "excel"])
def test_both_ways_of_reading_agree(form):
    book = coarse("gots-diesel") if form == "own" else as_excel(coarse("gots-diesel"))
    rng = random.Random(5)
    runs = 0
    with zipfile.ZipFile(io.BytesIO(book)) as archive:
        sheets = [archive.read(n) for n in archive.namelist() if n.startswith("xl/worksheets/s")]
    for sheet in sheets:
        # The second sheet has the form of the first one.
        for data in (sheet, other_numbers(sheet, rng)):
            quick, slow = Grid(sheets={"A": {}}), Grid(sheets={"A": {}})
            assert read_text(quick, "A", data, STRINGS)
            read_xml(slow, "A", data, STRINGS)
            assert contents(quick) == contents(slow)
            assert quick.cells == slow.cells
            runs += sum(len(found[2]) for found in contents(slow).values())
    assert runs > 200


SHEET = (
    '<worksheet xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main"><sheetData>'
    '<row r="1">{}</row></sheetData></worksheet>'
)


@pytest.mark.parametrize(
    "cells",
    [
        '<v>5</v><c r="A1"><v>1</v></c>',  # a value outside of the cells
        '<c r="A1"><v>1</v></c><c r="B1"><v>\0</v></c>',
        '<c r="A1"><f>\0</f><v>1</v></c>',
        '<c r="A1"><v>1</v>',
        '<c r="A1" new="1"><v>1</v></c>',
        '<c r="A1"><v>1</v></c><!-- -->',
    ],
)
def test_another_form_is_left_to_the_parser(cells):
    grid = Grid(sheets={"A": {}})
    assert not read_text(grid, "A", SHEET.format(cells).encode(), [])
    assert grid.sheets == {"A": {}}


@pytest.mark.parametrize(
    "value", ["nan", "1e999", "-inf", "one", "1,5", " ", "1 2", "0x10", "\xa0"]
)
def test_a_value_that_is_no_number_is_refused(value):
    sheet = SHEET.format(f'<c r="A1"><v>2</v></c><c r="B1"><v>{value}</v></c>').encode()
    with pytest.raises(BadBook, match="неверным значением"):
        read_text(Grid(sheets={"A": {}}), "A", sheet, [])


def test_values_of_one_sheet_do_not_stay_for_the_next():
    found = []
    for value in ("1.5", "2.5"):
        grid = Grid(sheets={"A": {}})
        assert read_text(grid, "A", SHEET.format(f'<c r="A1"><v>{value}</v></c>').encode(), [])
        found.append(grid.constant("A", 1, 1))
    assert found == [1.5, 2.5]
