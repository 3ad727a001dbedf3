"""Cached values: every formula has one, and it is a number or a text."""

from __future__ import annotations

import math

import pytest
from openpyxl import Workbook

from reports.workbook.caches import CacheError, finish
from reports.workbook.sheets import CacheValues


@pytest.mark.parametrize("value", [None, math.nan, math.inf])
def test_a_formula_without_a_finite_value_is_refused(value: float | None) -> None:
    book = Workbook()
    book.active.title = "Лист"
    book.active["A1"] = "=1/3"
    values = {} if value is None else {"A1": value}
    with pytest.raises(CacheError, match="Лист!A1"):
        finish(book, CacheValues(values={"Лист": values}))
