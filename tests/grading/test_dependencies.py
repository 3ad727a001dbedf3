"""What a blank takes with it, and directions that are one, whichever way they are written."""

from __future__ import annotations

import io
import re
import zipfile

import pytest
from openpyxl.utils import get_column_letter

from reports.workbook.caches import sheet_parts
from reports.workbook.layout import Layout
from tests.grading import classroom
from tests.grading.fill import filled_book
from tests.grading.forms import as_excel, rewritten
from tests.grading.test_verdicts import graded


@pytest.mark.parametrize(
    "changes",
    [{"omega": [None]}, {"lam": [None]}, {"r_crank": ["не знаю"]}, {"omega": ["=omega*1"]},
     {"P4_1.beta_rad": [None] * 25}],
)  # fmt: skip
def test_a_blank_takes_no_more_than_its_own_points_without_a_question(changes):
    result = graded(changes)
    lost = sum(one["of"] for one in result["items"] if one["verdict"] == "groundless")
    assert lost > 40
    assert any("засчитать их?" in text for text in result["manual"])


@pytest.mark.parametrize("changes", [{"omega": [500]}, {"P3_1.v1_m_s": [None] * 13}])
def test_what_costs_its_own_points_asks_nobody(changes):
    assert graded(changes)["manual"] == []


@pytest.mark.parametrize("turn", [360, -360])
def test_a_direction_saved_the_other_way_round_is_not_altered(turn):
    """One program says −180° where another says 180°."""
    book = as_excel(filled_book(classroom.handout(), classroom.assignment()))
    layout = Layout.of(classroom.assignment().model)
    table, column = layout.columns["P4_3_1.psiR_deg"]
    changed = saved_otherwise(book, table.sheet, column, lambda value: value + turn)
    assert classroom.marks(changed)["altered"] == []
    other = saved_otherwise(book, table.sheet, column, lambda value: value + 90)
    assert classroom.marks(other)["altered"] != []


def saved_otherwise(data, sheet, column, change):
    """A book with other numbers saved beside the formulas of a column."""
    with zipfile.ZipFile(io.BytesIO(data)) as source:
        part = sheet_parts(source)[sheet]
    letter = get_column_letter(column)

    def replaced(name, text):
        if name != part:
            return text
        cell = rf'(<c r="{letter}[1-2]?[0-9]"[^>]*><f[^>]*(?:/>|>[^<]*</f>)<v>)([^<]+)'
        built, count = re.subn(
            cell.encode(), lambda m: m[1] + repr(change(float(m[2]))).encode(), text
        )
        assert count > 10
        return built

    return rewritten(data, replaced)
