"""The benchmarks still run: nobody calls them every day."""

from __future__ import annotations

import importlib
import io
import sys

import openpyxl
import pytest

from tests.bench.__main__ import main, names
from tests.bench._history import by_commit
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
        item = sum(cell.value is not None for row in book[sheet].iter_rows() for cell in row)
        assert item == len(written), sheet


def test_the_history_is_drawn_by_commit(tmp_path, capsys):
    history, picture = tmp_path / "h.csv", tmp_path / "h.svg"
    rows = ("a,A,m,solver: solve,2,s", "b,A,m,solver: solve,4,s", "c,B,m,solver: solve,6,s",
            "d,B,other,solver: solve,9,s", "e,B,m,web: page,1,s")  # fmt: skip
    history.write_text("date,commit,machine,name,value,unit\n" + "\n".join(rows), encoding="utf-8")
    commits, values = by_commit(history)
    assert commits == ["A", "B"] and values["solver: solve"] == {"A": 3.0, "B": 6.0}
    assert main(["solver", "--history", str(history), "--draw", str(picture)]) == 0
    assert capsys.readouterr().out.endswith("линий 1\n") and b"<svg" in picture.read_bytes()
    assert main(["--history", str(tmp_path / "none.csv"), "--draw", str(picture)]) == 2
