"""Numbers without documents: what a cell of CSV holds."""

from __future__ import annotations

import pytest

from kshm.nomenclature.quantity import ray_key
from reports.exports.numbers import CsvForm, csv_text, export_tables, neutralised
from reports.inputs.solve_input import solved
from tests.conftest import sample


def test_a_force_that_a_ray_does_not_count_is_blank() -> None:
    tables = export_tables(solved(sample("gots-diesel")))
    loads = next(columns for columns in tables.values() if ray_key(1) in columns)
    cells = [cell for key, cells in loads.items() if key.startswith("ray_") for cell in cells]
    assert None in cells
    assert 0.0 not in cells
    assert 0.0 in tables["P3_1"]["s_mm"]  # a nought of any other column is a number


def test_a_cell_has_a_point_full_precision_and_no_formula() -> None:
    text = csv_text({"phi_deg": [0.0, 10.0], "x": [1 / 3, None], "mode": ["a", "b"]})
    assert text == "phi_deg,x,mode\n0,0.3333333333333333,a\n10,,b\n"
    assert [neutralised(text) for text in ("=1+1", "-x", "x=1")] == ["'=1+1", "'-x", "x=1"]


def test_a_result_that_is_no_number_is_refused() -> None:
    class Broken:
        columns = {"P3_1": {"s_mm": [float("nan")]}}  # noqa: RUF012 - stands for a solution
        wear_sums: dict = {}  # noqa: RUF012

    with pytest.raises(ValueError, match="not a number"):
        export_tables(Broken())


def test_a_csv_for_a_russian_excel_and_one_with_units() -> None:
    columns = {"phi_deg": [0.0, 10.0], "T_MPa": [1 / 3, None]}
    form = CsvForm(units=True, excel=True)
    assert csv_text(columns, form) == "phi_deg;T_MPa\n°;МПа\n0;0,3333333333333333\n10;\n"
    assert form.encoding == "utf-8-sig" and CsvForm().encoding == "utf-8"
