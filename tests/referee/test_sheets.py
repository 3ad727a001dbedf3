"""Sheets into the grid: every form in which programs write cells, and cells that are none."""

from __future__ import annotations

import math

import pytest

from reports.recalculation.grid import BadBook
from reports.recalculation.read import read_grid
from tests.grading.forms import as_excel
from tests.referee.books import book_of, grid_of
from tests.workbook.made import coarse_book


def test_a_book_as_excel_writes_it_is_the_same_book():
    own = coarse_book("gots-diesel")
    grids = read_grid(own), read_grid(as_excel(own))
    runs = 0
    for title, columns in grids[0].sheets.items():
        for number, column in columns.items():
            other = grids[1].sheets[title][number]
            assert column.constants == other.constants
            pairs = zip(column.runs, other.runs, strict=True)
            for run, like in pairs:
                assert (run.first, run.count, run.formula) == (like.first, like.count, like.formula)
                runs += 1
    assert runs > 200


CELLS = (
    '<c r="A1"><v>1.5</v></c><c r="B1" t="s"><v>1</v></c><c r="C1" t="b"><v>1</v></c>'
    '<c r="D1" t="e"><v>#N/A</v></c>'
    '<c r="E1" t="inlineStr"><is><r><t>in</t></r><r><t>line</t></r></is></c>'
    '<c r="F1" t="str"><f>"x"</f><v>x</v></c>'
    '<c r="G1"><f>1+1</f><v>2</v></c><c r="H1" s="3"/><c><v>9</v></c>'
)


def test_kinds_of_cells():
    grid = grid_of(CELLS, ["zero", "one"])
    constants = {number: column.constants.get(1) for number, column in grid.sheets["A"].items()}
    assert constants == {1: 1.5, 2: "one", 3: True, 4: None, 5: "inline", 6: None, 7: None,
                         9: 9.0}  # fmt: skip
    assert grid.sheets["A"][4].errors == {1: "#N/A"}
    (text,), (number,) = grid.sheets["A"][6].runs, grid.sheets["A"][7].runs
    assert math.isnan(grid.sheets["A"][6].saved_of(text)[0])
    assert grid.sheets["A"][7].saved_of(number).tolist() == [2.0]


def test_values_saved_in_an_array_formula_are_not_typed_in():
    cells = (
        '<c r="B1"><f t="array" ref="B1:C1">A1:A1*{1,2}</f><v>7</v></c><c r="C1"><v>14</v></c>'
        '<c r="D1"><v>5</v></c>'
    )
    grid = grid_of(cells)
    assert grid.sheets["A"][3].constants == {}
    (run,) = grid.sheets["A"][3].runs
    assert grid.sheets["A"][3].saved_of(run).tolist() == [14.0]
    assert grid.sheets["A"][4].constants == {1: 5.0}
    with pytest.raises(BadBook, match="неверными границами"):
        grid_of('<c r="B1"><f t="array" ref="A1:XFD1048576">1</f></c>')
    over = grid_of('<c r="B1"><f t="array" ref="B1:C1">1</f></c><c r="C1"><f>2</f></c>')
    assert over.sheets["A"][2].runs[0].problem


@pytest.mark.parametrize(
    "value", ["nan", "1e999", "-inf", "one", "1,5", " ", "1 2", "0x10", "1_0", "\xa0"]
)
def test_a_value_that_is_no_number_is_refused(value):
    with pytest.raises(BadBook, match="неверным значением"):
        grid_of(f'<c r="A1"><v>2</v></c><c r="B1"><v>{value}</v></c>')


@pytest.mark.parametrize(
    "cell", ['<c r="A20001"><v>1</v></c>', '<c r="ALM1"><v>1</v></c>', '<c r="A0"><v>1</v></c>']
)
def test_cells_far_out_are_refused(cell):
    with pytest.raises(BadBook, match="далеко за таблицами"):
        grid_of(cell)


def test_names_of_cells_and_of_rectangles():
    import io

    from openpyxl import load_workbook
    from openpyxl.workbook.defined_name import DefinedName

    book = load_workbook(io.BytesIO(book_of({"A1": 1.0})))
    for name, text in (("Один", "Sheet!$A$1"), ("Много", "'Sheet'!$A$1:$B$3"), ("Сила", "1+1")):
        book.defined_names[name] = DefinedName(name, attr_text=text)
    stream = io.BytesIO()
    book.save(stream)
    grid = read_grid(stream.getvalue())
    assert grid.names == {"один": ("Sheet", 1, 1)}
    assert grid.named("много").last_row == 3
    assert grid.named("сила") is None
