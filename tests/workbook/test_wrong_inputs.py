"""What a person sees of a cell that was deleted, or pasted into past the data validation."""

from __future__ import annotations

import io
import re
from collections.abc import Collection, Iterator
from functools import lru_cache
from types import NoneType

import formualizer
import openpyxl
import pytest
from openpyxl.worksheet.worksheet import Worksheet

from reports.inputs.fields import Field, key_text, set_value, to_mapping
from reports.inputs.load import load_mapping
from reports.model.blocks import NO, YES
from reports.shared.errors import InputError
from reports.shared.russian import capital, uncapital
from reports.tables.registry import build_model
from reports.workbook.cockpit import SHEET, VERDICT_ROW
from reports.workbook.conditions import conditions
from reports.workbook.inputs import options, shown
from reports.workbook.layout import INPUT_SHEET, Layout
from reports.workbook.verdict import (
    BAD,
    BEYOND,
    GOOD,
    ODD,
    RESHAPED,
    RESHAPED_ROW,
    UNKNOWN,
)
from reports.workbook.write import workbook_bytes
from tests.conftest import sample
from tests.cover import charts, quantities, samples_with
from tests.referee.changes import without_charts
from tests.workbook.made import (
    book,
    coarse,
    coarse_book,
    coarse_model,
    coarse_opened,
    coarse_values,
    model,
)
from tools.referees.cells import formula_cells, row_and_column, stripped

NAME = "two-stroke"


def changed(field: str, value: float | str | None) -> formualizer.Workbook:
    """The book with another value in a cell."""
    engine = formualizer.load_workbook_bytes(stripped(book(NAME))[0])
    position = Layout.of(model(NAME)).cells[field]
    engine.set_value(position.sheet, position.row, position.column, value)
    engine.evaluate_all()
    return engine


def verdict(engine: formualizer.Workbook) -> str:
    """What the first sheet says of the checks."""
    return str(engine.get_value("Содержание", VERDICT_ROW, 1))


@pytest.mark.parametrize("value", ["сто", None])
def test_checks_without_a_number_do_not_hold(value: str | None) -> None:
    assert verdict(changed("geometry_bore_mm", value)).startswith(UNKNOWN)


def test_a_check_that_fails_is_said_to_fail() -> None:
    assert verdict(changed("geometry_bore_mm", 73.0)) == GOOD
    engine = changed("geometry_rod_length_mm", 500.0)
    assert any(engine.get_value("Проверки", row, 4) == NO for row in range(4, 20))
    assert verdict(engine).startswith(f"{BAD}λ в пределах 0,15…0,45 (обычно 0,24…0,31) = 0.085")


WRONG = (0.0, None, "сто", -1.0)


def answers(name: str) -> Iterator[tuple[Field, float | str | None, str, int, bool]]:
    """What the first sheet says of every wrong value of a cell, errors, whether it is red.

    Of the other engine's cells those that the first has not; in few rows, as often as it is asked.
    """
    built, data = coarse_model(name), coarse_book(name)
    layout = Layout.of(built)
    engine = formualizer.load_workbook_bytes(stripped(data)[0])
    ranges = [
        formula_range(sheet, collected)
        for sheet, collected in formula_cells(data).items()
        if collected
    ]
    reds = red_rows(data)
    known = set() if name == NAME else set(coarse_model(NAME).fields)
    for item in (item for item in built.inputs if item.name not in known):
        position = layout.cells[item.name]
        for value in WRONG:
            engine.set_value(position.sheet, position.row, position.column, value)
            engine.evaluate_all()
            errors = sum(errors_in(engine, cells) for cells in ranges)
            red = engine.get_value(INPUT_SHEET, position.row, reds) in (1, 1 + RESHAPED_ROW)
            yield item, value, verdict(engine), errors, red
        engine.set_value(position.sheet, position.row, position.column, shown(item))


def formula_range(sheet: str, actual: Collection[str]) -> formualizer.RangeAddress:
    """The smallest range with all formulas of a sheet."""
    rows, columns = zip(*map(row_and_column, actual), strict=True)
    return formualizer.RangeAddress(sheet, min(rows), min(columns), max(rows), max(columns))


def errors_in(engine: formualizer.Workbook, cells: formualizer.RangeAddress) -> int:
    # Nearly all values are numbers, of which no text need be made.
    return sum(
        type(value) is not float and str(value).startswith(("#", "{"))
        for row in engine.sheet(cells.sheet).get_values(cells)
        if not {type(value) for value in row} <= {float, NoneType}
        for value in row
    )


@lru_cache(maxsize=2)
def red_rows(data: bytes) -> int:
    """The column by which rows of the input sheet turn red."""
    sheet = openpyxl.load_workbook(io.BytesIO(without_charts(data)))[INPUT_SHEET]
    (column,) = {
        mark[1]
        for places in sheet.conditional_formatting
        for rule in places.rules
        if rule.type == "expression"
        and (mark := re.fullmatch(r"\$([A-Z]+)\d+=[12]", rule.formula[0]))
    }
    return row_and_column(f"{column}1")[1]


def allowed(item: Field, value: float | str | None) -> bool:
    if item.choices is not None:
        return value in options(item)
    if item.minimum is None or item.maximum is None:
        return True
    return isinstance(value, float) and item.minimum <= value <= item.maximum


@pytest.mark.parametrize("name", [NAME, "d-240-bearings"])
def test_no_wrong_cell_leaves_a_book_that_says_all_is_well(name: str) -> None:
    seen = set()
    for item, value, said, errors, red in answers(name):
        lines = f"{item.name} = {value!r}: «{said}», ошибок {errors}"
        # A value may contradict another one, as a scavenge that begins before the exhaust.
        assert red or allowed(item, value), lines
        assert not (red and allowed(item, value)) or isinstance(door(name, {item: value}), str), (
            lines
        )
        if item.structural:
            assert said == RESHAPED, lines
        elif errors:
            assert said.startswith(UNKNOWN), lines
        elif red:
            assert said.startswith(BEYOND), lines
        else:
            assert said.startswith((GOOD, BAD)), lines
        seen.add((bool(errors), red))
    assert {(True, True), (False, True), (False, False)} <= seen


def door(name: str, changes: dict[Field, float | str | None]) -> str | list[str]:
    """What refuses a file with other values, or the keys that are warned of."""
    raw = to_mapping(sample(name))
    for item, value in changes.items():
        set_value(raw, item.path, value)
    try:
        return [problem.where for problem in load_mapping(raw, source="").warnings]
    except InputError as error:
        return str(error)


@pytest.mark.parametrize("name", [NAME, "d-240-bearings"])
def test_values_that_contradict_each_other_turn_red_as_the_door_refuses_them(name: str) -> None:
    built, data = coarse_model(name), coarse_book(name)
    layout = Layout.of(built)
    engine = formualizer.load_workbook_bytes(stripped(data)[0])
    reds, lines = red_rows(data), set()
    engine.evaluate_all()
    rows = {engine.get_value("Проверки", row, 1): row for row in range(1, 90)}
    for condition in conditions(built, layout, coarse_values(name).scalars):
        pair, verdict_row = condition.pair, rows[condition.title]
        if len(condition.fields) != 2:
            continue
        assert engine.get_value("Проверки", verdict_row, 4) == YES
        less, more = condition.fields
        change: dict[Field, float | str | None] = {
            less: min(2.5 * float(more.value), less.maximum or 0.0)
        }
        if pair.holds(float(change[less] or 0.0), float(more.value)):  # ρ up to 6, ε of 16
            change[more] = more.minimum
        for item, value in change.items():
            position = layout.cells[item.name]
            engine.set_value(position.sheet, position.row, position.column, value)
        engine.evaluate_all()
        wrong = ODD if pair.warning else NO
        assert engine.get_value("Проверки", verdict_row, 4) == wrong, condition.title
        for item in condition.fields:
            position = layout.cells[item.name]
            assert engine.get_value(position.sheet, position.row, reds) == (
                2 if pair.warning else 1
            )
        said = door(name, change)
        refused = isinstance(said, str)
        assert refused is not pair.warning, (condition.title, said)
        assert any(key_text(item.path) in said for item in condition.fields), condition.title
        for item in change:
            position = layout.cells[item.name]
            engine.set_value(position.sheet, position.row, position.column, item.value)
        engine.evaluate_all()
        lines.add(pair)
    assert len(lines) > 2


def test_a_regime_is_held_to_its_own_gas() -> None:
    """Combustion begins at a given angle in the first regime, after a delay in the others."""
    built = coarse_model("gots-regimes")
    actual = conditions(built, Layout.of(built), coarse_values("gots-regimes").scalars)
    delays = [c.pair.warning for c in actual if c.pair.less == "gas.ignition_delay_deg"]
    assert delays == [True, False, False]


def test_points_out_of_order_turn_red() -> None:
    raw = to_mapping(coarse(NAME))
    points = [[0.0, 0.1], [90.0, 0.3], [180.0, 6.0], [270.0, 0.4], [360.0, 0.1]]
    raw["gas"] = {"source": "table", "ambient_pressure_mpa": 0.1, "points": points}
    model = build_model(load_mapping(raw, source="").model)
    data = workbook_bytes(model)
    engine, reds = formualizer.load_workbook_bytes(stripped(data)[0]), red_rows(data)
    places = Layout.of(model).cells
    rows = [places[f"gas_point_{n}_deg"].row for n in range(1, 6)]
    for angle, state in ((91.0, 0), (90.0, 1), (200.0, 0), (280.0, 1)):
        position = places["gas_point_3_deg"]
        engine.set_value(position.sheet, position.row, position.column, angle)
        engine.evaluate_all()
        assert [engine.get_value(INPUT_SHEET, row, reds) for row in rows] == [state] * 5, angle


def test_what_is_odd_at_the_start_is_so_in_the_caches() -> None:
    raw = to_mapping(coarse(NAME))
    raw["gas"]["expansion_exponent"] = 1.5  # more than that of compression
    model = build_model(load_mapping(raw, source="").model)
    data = workbook_bytes(model)
    cached, engine = openpyxl.load_workbook(io.BytesIO(data), data_only=True), stripped(data)[0]
    live = formualizer.load_workbook_bytes(engine)
    live.evaluate_all()
    position, column = Layout.of(model).cells["gas_expansion_exponent"], red_rows(data)
    for row in (position.row, position.row + 1):
        assert cached[INPUT_SHEET].cell(row, column).value == live.get_value(
            INPUT_SHEET, row, column
        ), row
    assert cached[INPUT_SHEET].cell(position.row, column).value == 2
    assert ODD in [cell.value for cell in cached["Проверки"]["D"]]
    assert verdict(live).startswith(BAD)  # of the coarse grid, not of what is odd


def limit_of(sheet: Worksheet, text: str) -> float:
    """A limit of a rule, which of a record is typed and of a single input stands in a cell."""
    return sheet[text.replace("$", "")].value if text.startswith("$") else float(text)


@pytest.mark.parametrize("name", samples_with(charts, quantities))
def test_every_cell_with_a_range_turns_red_beyond_it(name: str) -> None:
    sheet = coarse_opened(name)[INPUT_SHEET]
    collected = {
        (area.coord, *(limit_of(sheet, text) for text in rule.formula))
        for places in sheet.conditional_formatting
        for rule in places.rules
        if rule.operator == "notBetween" and rule.dxf.fill.bgColor.rgb.endswith("FFC7CE")
        for area in places.sqref.ranges
    }
    built = coarse_model(name)
    layout = Layout.of(built)
    assert collected == {
        (layout.cells[item.name].coordinate, item.minimum, item.maximum)
        for item in built.inputs
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


@pytest.mark.parametrize("name", samples_with(charts, quantities))
def test_a_list_of_a_cell_offers_what_the_cell_holds(name: str) -> None:
    """A step chosen as «10°» would be a text, and every table without a number."""
    sheet = coarse_opened(name)[INPUT_SHEET]
    lists = [rule for rule in sheet.data_validations.dataValidation if rule.type == "list"]
    assert len(lists) > 5
    for rule in lists:
        offered = rule.formula1.strip('"').split(",")
        for position in rule.sqref.ranges:
            assert str(sheet[position.coord].value) in offered, (position.coord, offered)
