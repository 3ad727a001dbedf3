"""Limits of inputs are numbers of cells, which validation, marks and verdicts read."""

from __future__ import annotations

import pytest

from reports.inputs.fields import Field
from reports.workbook import styles
from reports.workbook.inputs import options
from reports.workbook.layout import INPUT_SHEET, MAX_COLUMN, MIN_COLUMN, Layout
from tests.workbook.made import coarse_model, coarse_opened

NAME = "gots-diesel"


def limited() -> list[Field]:
    fields = [each for each in coarse_model(NAME).inputs if each.maximum is not None]
    return [each for each in fields if not each.listed and not options(each)]


def test_limits_stand_as_numbers_beside_their_inputs() -> None:
    sheet, layout = coarse_opened(NAME)[INPUT_SHEET], Layout.of(coarse_model(NAME))
    for item in limited():
        row = layout.cells[item.name].row
        limits = [sheet.cell(row, column).value for column in (MIN_COLUMN, MAX_COLUMN)]
        assert limits == [item.minimum, item.maximum], item.name
    assert len(limited()) > 20


def test_validation_reads_the_limits_beside() -> None:
    sheet, layout = coarse_opened(NAME)[INPUT_SHEET], Layout.of(coarse_model(NAME))
    rules = {
        str(cells): (rule.formula1, rule.formula2)
        for rule in sheet.data_validations.dataValidation
        for cells in rule.sqref.ranges
    }
    marks = {
        tuple(rule.formula)
        for places in sheet.conditional_formatting
        for rule in places.rules
        if rule.operator == "notBetween"
    }
    for item in limited():
        cell = layout.cells[item.name]
        limits = (f"$E{cell.row}", f"$F{cell.row}")
        assert rules[cell.coordinate] == limits, item.name
        assert limits in marks, item.name


@pytest.mark.parametrize(
    ("value", "look"), [(720.0, "General"), (141.26, "0.0"), (-12.3, "0.00"), (0.5, "0.00##")]
)
def test_digits_of_what_is_judged_follow_its_size(value: float, look: str) -> None:
    assert styles.few_digits(value) == look
