"""The quick referee agrees with formualizer on whole workbooks and reads no cached value."""

from __future__ import annotations

import io
import zipfile

import numpy as np
import pytest

from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.recalculation.by_columns import Engine, UnknownFormula, read_grid
from reports.recalculation.by_columns.formulas import formula_at
from reports.recalculation.by_columns.syntax import pattern, render
from reports.recalculation.by_formualizer import Formualizer
from reports.recalculation.protocol import row_and_column
from reports.tables.registry import build_model
from reports.workbook.caches import sheet_parts
from reports.workbook.write import workbook_bytes
from tests.conftest import sample


def coarse(name: str) -> bytes:
    raw = to_mapping(sample(name))
    raw["calculation"]["step_deg"] = 30
    return workbook_bytes(build_model(load_mapping(raw, source=name).model))


@pytest.mark.parametrize("name", ["gots-diesel", "cycle-turbo-diesel", "d-240"])
def test_all_formulas_agree_with_formualizer(name):
    book = coarse(name)
    grid = read_grid(book)
    Engine(grid).evaluate_all()
    (wanted,) = Formualizer().recalculate([book])
    compared = 0
    for sheet, cells in wanted.items():
        largest: dict[int, float] = {}
        for cell, value in cells.items():
            column = row_and_column(cell)[1]
            if isinstance(value, float):
                largest[column] = max(largest.get(column, 1.0), abs(value))
        for cell, value in cells.items():
            row, column = row_and_column(cell)
            run = grid.sheets[sheet][column].run_at(row)
            assert run is not None, (sheet, cell)
            if isinstance(value, str):
                assert run.texts[row] == value, (sheet, cell)
            else:
                assert run.values is not None
                own = run.values[row - run.first]
                assert abs(own - value) <= 1e-9 * largest[column], (sheet, cell, own, value)
            compared += 1
    assert compared > 3000


def tampered(book: bytes) -> bytes:
    """Every cached value made 7, the formulas as they are."""
    import re

    stream = io.BytesIO()
    with (
        zipfile.ZipFile(io.BytesIO(book)) as source,
        zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as target,
    ):
        parts = set(sheet_parts(source).values())
        for name in source.namelist():
            data = source.read(name)
            if name in parts:
                data = re.sub(rb"(</f>|<f/>)<v>[^<]*</v>", rb"\1<v>7</v>", data)
            target.writestr(name, data)
    return stream.getvalue()


def test_cached_values_are_not_read():
    book = coarse("gots-diesel")
    values = []
    for data in (book, tampered(book)):
        grid = read_grid(data)
        Engine(grid).evaluate_all()
        values.append(
            np.concatenate([r.values for c in grid.sheets["П4.1"].values() for r in c.runs])
        )
    assert np.array_equal(values[0], values[1])


def book_of(cells: dict[str, object]) -> bytes:
    from openpyxl import Workbook

    book = Workbook()
    for at, value in cells.items():
        book.active[at] = value
    stream = io.BytesIO()
    book.save(stream)
    return stream.getvalue()


def value(formula: str, **cells: object) -> float | str:
    grid = read_grid(book_of({**cells, "Z1": formula}))
    engine = Engine(grid)
    engine.evaluate_all()
    run = grid.sheets["Sheet"][26].runs[0]
    return run.texts.get(1, run.values[0])


@pytest.mark.parametrize(
    ("formula", "wanted"),
    [
        ("=-A1^2", 9.0),  # the sign binds tighter than the power
        ("=2^3^2", 64.0),  # from the left
        ("=50%", 0.5),
        ("=SUM(A1:C2)", 9.0),
        ("=AVERAGE(A1:C2)", 2.25),  # blanks do not count
        ("=COUNT(A1:C2)", 4.0),
        ("=MAX(A1:C2,10)", 10.0),
        ("=IF(A1>2,B1,1/0)", 1.0),
        ("=IFERROR(1/0,5)", 5.0),
        ("=ROUND(2.5,0)", 3.0),
        ("=ROUND(-2.345,2)", -2.35),
        ("=MOD(-1,3)", 2.0),
        ("=INDEX(A1:A2,MATCH(3.5,A1:A2,1))", 3.0),
        ("=SUMPRODUCT(A1:A2,B1:B2)", 7.0),
        ('=IF(A1=3,"да","нет")', "да"),
        ("=ATAN2(1,1)*4", np.pi),
    ],
)
def test_single_formulas(formula, wanted):
    found = value(formula, A1=3.0, A2=4.0, B1=1.0, B2=1.0)
    assert found == wanted if isinstance(wanted, str) else found == pytest.approx(wanted, rel=1e-12)


@pytest.mark.parametrize("formula", ["=1/0", "=SQRT(-1)", "=LN(0)", "=0^0", "=MATCH(1,A1:A2,1)"])
def test_errors_are_no_numbers(formula):
    assert np.isnan(value(formula, A1=3.0, A2=4.0))


def test_a_recurrence_and_a_circle():
    cells = {"A1": 1.0, "A2": "=A1+1", "A3": "=A2+1", "A4": "=A3+1"}
    grid = read_grid(book_of({**cells, "B1": "=C1+1", "C1": "=B1+1"}))
    engine = Engine(grid)
    engine.evaluate_all()
    assert engine.values("Sheet", 1, 1, 4)[0].tolist() == [1, 2, 3, 4]
    assert engine.values("Sheet", 2, 1, 1)[1] == "e"


@pytest.mark.parametrize(
    "formula", ["=INDIRECT(\"A1\")", "=WEBSERVICE(\"http://x\")", "=A1+nothing", "=[1]Sheet1!A1",
                "=" + "(" * 80 + "1" + ")" * 80, "=SUM({1,2})", "=SUMPRODUCT(A1:A3,B1:B2)"],
)  # fmt: skip
def test_what_it_does_not_know_it_says(formula):
    grid = read_grid(book_of({"A1": 1.0, "Z1": formula}))
    with pytest.raises(UnknownFormula):
        Engine(grid).evaluate_all()


def test_a_pattern_gives_its_formula_back():
    text = 'SUM($A$1:A7)+\'П4.1\'!B7*IF(C$2>0,"a""b",-D7^2)'
    found = pattern(text, 7, 5)
    assert render(found, 7, 5) == "=" + text
    assert pattern(render(found, 9, 6)[1:], 9, 6) == found
    assert formula_at(text, 7, 5) is formula_at(render(found, 9, 6)[1:], 9, 6)
