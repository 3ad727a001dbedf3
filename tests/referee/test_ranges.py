"""Ranges where one value is wanted, as LibreOffice takes them."""

from __future__ import annotations

import io

import pytest
from openpyxl import Workbook
from openpyxl.workbook.defined_name import DefinedName

from reports.recalculation.evaluate import Evaluator
from reports.recalculation.read import read_grid
from reports.shared.errors import UnknownFormula
from tools.referees.by_libreoffice import LibreOffice

# In each row from the second to the fifth; the angles stand in column A, some more in row 9.
CROSSING = (
    "-$A$2:$A$5", "A:A*2", "SIN(RADIANS(фи))", "'Другой лист'!$B$1:$B$9^2", "ROUND($A:$A/7,2)+B2",
    "$A$9:$K$9+1", "9:9*2", "SUM(A2:A5)-$A$2:$A$5", "POWER(ABS($A$1:$A$9),2)+MAX(A2:A5)", "A1:A9/2",
    "INDEX($A$2:$A$5,3)", "INDEX(A:A,4)*2", "INDEX('Другой лист'!B1:C9,3,1)+INDEX(фи,2)",
    "INDEX($A$9:$K$9,7)", "INDEX($9:$9,7)", "SUM($A$1:INDEX($A$1:$A$9,3))",
    "INDEX(A1:B9,2,2)/INDEX($A$2:$A$5,ROW()-1)",
)  # fmt: skip
# For these a person is asked: another row, two columns, a function that may take all of it.
UNKNOWN = ("$A$3:$A$4*2", "$A$2:$B$5*2", "IF($A$2:$A$5>0,1,2)", "SUM($A$2:$A$5*2)", "A7:A9+1")
SINGLES = {
    "_xlfn.SINGLE($A$2:$A$5)*2": 2, "SUM(_xlfn.SINGLE(A:A),0)": 1, "-_xlfn.SINGLE(A2)": -1,
    "_xlfn.SINGLE(INDEX($A$2:$A$5,ROW()-1))": 1,
}  # fmt: skip


def book(formulas: tuple[str, ...]) -> bytes:
    built = Workbook()
    sheet, other = built.active, built.create_sheet("Другой лист")
    for row in range(1, 10):
        sheet.cell(row, 1).value, sheet.cell(row, 2).value = 30.0 * row - 45, 0.5 * row
        other.cell(row, 2).value = row + 0.25
    for column in range(1, 30):
        sheet.cell(9, column).value = 1.5 * column
    built.defined_names["фи"] = DefinedName("фи", attr_text="Sheet!$A$2:$A$5")
    for column, text in enumerate(formulas, 4):
        for row in range(2, 6):
            sheet.cell(row, column).value = f"={text}"
    stream = io.BytesIO()
    built.save(stream)
    return stream.getvalue()


@pytest.mark.libreoffice
def test_the_cell_in_ones_own_row_or_column_is_meant(libreoffice: LibreOffice) -> None:
    data = book(CROSSING)
    engine, (theirs,) = Evaluator(read_grid(data)), libreoffice.recalculate([data])
    for column, text in enumerate(CROSSING, 4):
        values, kinds = engine.values("Sheet", column, 2, 5)
        wanted = [theirs["Sheet"][f"{chr(64 + column)}{row}"] for row in range(2, 6)]
        assert kinds == "nnnn" and values == pytest.approx(wanted), text


@pytest.mark.parametrize("text", UNKNOWN)
def test_what_is_not_one_cell_for_certain_is_unknown(text: str) -> None:
    with pytest.raises(UnknownFormula, match="нужно одно значение"):
        Evaluator(read_grid(book((text,)))).values("Sheet", 4, 2, 5)


@pytest.mark.parametrize("text", SINGLES)
def test_a_newer_excel_writes_the_same_as_single(text: str) -> None:
    values, _ = Evaluator(read_grid(book((text,)))).values("Sheet", 4, 2, 2)
    assert values == pytest.approx([15.0 * SINGLES[text]])


@pytest.mark.parametrize(
    ("text", "rows"),
    [("INDEX($A$2:$A$5,4)", (5, 5)), ("INDEX($A$2:$A$5,5)", (2, 5)), ("INDEX(A:A,3)", (3, 3)),
     ("INDEX($3:$3,1)", (3, 3)), ("INDEX($A$2:$A$5,1+2)", (2, 5))],
)  # fmt: skip
def test_a_place_that_is_written_out_is_one_cell(text: str, rows: tuple[int, int]) -> None:
    grid = read_grid(book((text,)))
    (area,) = grid.precedents(grid.column("Sheet", 4).runs[0])
    assert (area.first_row, area.last_row) == rows
