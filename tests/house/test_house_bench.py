"""The benchmarks still run: nobody calls them every day."""

from __future__ import annotations

import importlib
import io
import sys

import openpyxl
import pytest

from tests.bench.__main__ import names
from tests.bench._process import run
from tests.bench.workbook import cells_of, theirs
from tests.referee.changes import without_charts
from tests.workbook.made import coarse_book


def test_every_benchmark_has_its_figures():
    for name in names():
        assert callable(importlib.import_module(f"tests.bench.{name}").figures)


def test_what_did_not_work_has_no_time():
    with pytest.raises(RuntimeError, match="код 1"):
        run([sys.executable, "-S", "-c", "import nothing_of_the_kind"])


def test_the_other_library_writes_every_cell_of_ours():
    """Array formulas too, which it writes in a way of their own."""
    cells = cells_of(without_charts(coarse_book("gots-diesel")))
    book = openpyxl.load_workbook(io.BytesIO(theirs(cells)))
    for sheet, written in cells.items():
        found = sum(cell.value is not None for row in book[sheet].iter_rows() for cell in row)
        assert found == len(written), sheet
