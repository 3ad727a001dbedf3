"""Parts that cannot go together are refused by file and workbook; new engines have none."""

from __future__ import annotations

from typing import Any

import pytest

from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.new.generate import generate_engine
from reports.shared.errors import InputError
from reports.tables.registry import build_model
from reports.workbook.conditions import conditions
from reports.workbook.layout import Layout
from tests.conftest import sample

IMPOSSIBLE = {
    "pin_bore_mm": (60.0, "отверстие пальца 60 мм не меньше его диаметра"),
    "eye_outer_mm": (10.0, "не тоньше головки 10 мм"),
    "bosses_mm": (90.0, "не длиннее промежутка между бобышками 90 мм"),
    "skirt_mm": (200.0, "юбка 200 мм не ниже поршня"),
    "crown_mm": (200.0, "днище 200 мм не тоньше высоты поршня"),
    "shank_web_mm": (60.0, "стенка 60 мм не уже полки"),
    "shank_flange_mm": (30.0, "две полки 60 мм не ниже сечения стержня"),
    "pin_length_mm": (99.0, "палец 99 мм не короче диаметра цилиндра"),
}


def engine(**sizes: float) -> dict[str, Any]:
    raw = to_mapping(sample("gots-diesel"))
    raw["strength"] = {"kind": "diesel"} | sizes
    return raw


@pytest.mark.parametrize("key", IMPOSSIBLE)
def test_a_part_that_does_not_fit_is_refused(key: str) -> None:
    size, words = IMPOSSIBLE[key]
    with pytest.raises(InputError, match=words):
        load_mapping(engine(**{key: size}), source="e.toml")


def test_sizes_given_and_usual_ones_are_held_to_each_other() -> None:
    assert load_mapping(engine(), source="e.toml").warnings == ()
    assert load_mapping(engine(pin_mm=30.0, pin_bore_mm=15.0), source="e.toml").warnings == ()
    (odd,) = load_mapping(engine(eye_length_mm=60.0), source="e.toml").warnings
    assert "не проходит между бобышками" in odd.what


def test_the_workbook_holds_them_live() -> None:
    model = build_model(load_mapping(engine(pin_bore_mm=15.0), source="e.toml").model)
    scalars = dict.fromkeys(model.scalars, 20.0)
    formulas = [each.formula for each in conditions(model, Layout.of(model), scalars)]
    assert "strength_pin_bore_mm<st_pin_mm" in formulas


@pytest.mark.parametrize(
    "task",
    [
        {"cylinders": 8, "layout": "v", "kind": "petrol", "power_kw": 210.0, "speed_rpm": 5600.0,
         "bore_mm": 92.0, "stroke_mm": 84.0},
        {"cylinders": 12, "layout": "v", "kind": "diesel", "bore_mm": 300.0},
    ],
)  # fmt: skip
def test_the_eye_of_a_new_engine_goes_between_the_bosses(task: dict[str, Any]) -> None:
    """Sized by its pressure alone it was longer than their gap."""
    sizes = generate_engine(**task, strength=True).data["strength"]
    assert sizes["eye_length_mm"] < sizes["bosses_mm"]
