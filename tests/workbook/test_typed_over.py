"""Numbers typed over formulas of tables turn red: the marks cover all formulas and nothing else."""

from __future__ import annotations

import io
import re

import openpyxl
import pytest

from reports.model.blocks import TableSpec
from reports.workbook.layout import Layout
from tests.workbook.made import coarse_book, coarse_model

MARK = re.compile(r"NOT\(_xlfn\.ISFORMULA\(([A-Z]+\d+)\)\)")


@pytest.mark.parametrize("name", ["gots-diesel", "d-240-bearings"])
def test_every_formula_of_a_table_is_watched(name: str) -> None:
    model = coarse_model(name)
    layout = Layout.of(model)
    opened = openpyxl.load_workbook(io.BytesIO(coarse_book(name)))
    watched, count = dict[str, set[str]](), 0
    for sheet in opened:
        for places in sheet.conditional_formatting:
            for rule in places.rules:
                if mark := MARK.fullmatch((rule.formula or [""])[0]):
                    (field,) = places.sqref.ranges
                    assert field.coord.partition(":")[0] == mark[1]
                    cells = {cell.coordinate for row in sheet[field.coord] for cell in row}
                    watched.setdefault(sheet.title, set()).update(cells)
    for table in (block for block in model.blocks if isinstance(block, TableSpec)):
        if table.sheet not in opened.sheetnames:
            continue
        first = layout.places[table.id]
        formulas = {
            cell.coordinate
            for row in opened[table.sheet].iter_rows(
                min_row=first.row, max_row=layout.rows_of(table)[-1],
                min_col=first.column, max_col=first.column + len(table.columns) - 1,
            )
            for cell in row
            if str(getattr(cell.value, "text", cell.value)).startswith("=")
        }  # fmt: skip
        ends = {f"{cell}" for cell in formulas - watched.get(table.sheet, set())}
        # Ends of columns whose rows differ are left out.
        assert len(ends) <= 2 * len(table.columns), (table.id, sorted(ends))
        count += len(formulas) - len(ends)
    assert count > 1000
    for title, cells in watched.items():
        for at in cells:
            value = opened[title][at].value
            assert str(getattr(value, "text", value)).startswith("="), (title, at, value)
