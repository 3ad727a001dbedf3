"""What a person sees of a cell that was deleted, or pasted into past the data validation."""

from __future__ import annotations

import io

import formualizer
import openpyxl
import pytest

from reports.shared.russian import capital, uncapital
from reports.tables.overview.summary import NO
from reports.workbook.layout import INPUT_SHEET, Layout
from reports.workbook.what_if import SHEET
from tests.conftest import sample_names
from tests.workbook.made import book, coarse_book, coarse_model, model
from tools.referees.cells import stripped

NAME = "two-stroke"


def changed(field: str, value: float | str | None) -> formualizer.Workbook:
    """The book with another value in a cell."""
    engine = formualizer.load_workbook_bytes(stripped(book(NAME))[0])
    place = Layout.of(model(NAME)).cells[field]
    engine.set_value(place.sheet, place.row, place.column, value)
    engine.evaluate_all()
    return engine


def verdict(engine: formualizer.Workbook) -> str:
    """What the first sheet says of the checks."""
    column = [engine.get_value("Содержание", row, 1) for row in range(1, 20)]
    return str(engine.get_value("Содержание", 1 + column.index("Проверки расчёта"), 2))


@pytest.mark.parametrize("value", ["сто", None])
def test_checks_without_a_number_do_not_hold(value: str | None) -> None:
    assert verdict(changed("geometry_bore_mm", value)).startswith("не посчитаны")


def test_a_check_that_fails_is_said_to_fail() -> None:
    assert verdict(changed("geometry_bore_mm", 73.0)) == "все выполнены"
    engine = changed("geometry_rod_length_mm", 500.0)
    assert any(engine.get_value("Проверки", row, 4) == NO for row in range(4, 20))
    assert verdict(engine) == "не все, см. «Проверки»"


@pytest.mark.parametrize("name", sample_names())
def test_every_cell_with_a_range_turns_red_beyond_it(name: str) -> None:
    sheet = openpyxl.load_workbook(io.BytesIO(coarse_book(name)))[INPUT_SHEET]
    found = {
        (area.coord, *map(float, rule.formula))
        for places in sheet.conditional_formatting
        for rule in places.rules
        if rule.operator == "notBetween" and rule.dxf.fill.bgColor.rgb.endswith("FFC7CE")
        for area in places.sqref.ranges
    }
    made = coarse_model(name)
    layout = Layout.of(made)
    assert found == {
        (layout.cells[item.name].coordinate, item.minimum, item.maximum)
        for item in made.inputs
        if item.minimum is not None and item.maximum is not None
    }


def test_what_was_nothing_and_is_something_is_a_change() -> None:
    nothing = next(f for f in model(NAME).inputs if f.name == "crankshaft_rear_mass_kg")
    title = capital(nothing.title)
    before = changed(nothing.name, 0.0)
    row = next(row for row in range(4, 130) if before.get_value(SHEET, row, 1) == title)
    assert before.get_value(SHEET, row, 5) == 0
    assert changed(nothing.name, 1.0).get_value(SHEET, row, 5) == "—"


def test_a_symbol_is_no_word_to_begin_with_a_large_letter() -> None:
    assert capital("λ в обычных пределах") == "λ в обычных пределах"
    assert capital("ёмкость") == "Ёмкость"
    assert uncapital("T в конце сжатия") == "T в конце сжатия"
    assert uncapital("КПД компрессора") == "КПД компрессора"
    assert uncapital("Частота вращения") == "частота вращения"
