"""The section [torsion]: what is refused, what is odd, what may be left out."""

from __future__ import annotations

import tomllib
from typing import Any

import pytest

from kshm.engine.torsion import Torsion, TrainMass
from reports.inputs.fields import iter_fields, to_mapping
from reports.inputs.load import load_mapping, load_text
from reports.inputs.template import new_file
from reports.shared.errors import InputError
from tests.conftest import sample
from tests.torsion.files import TWO_DISCS


def load(section: dict[str, Any], name: str = "d-240") -> Any:
    raw = to_mapping(sample(name))
    raw["torsion"] = section
    return load_mapping(raw, source="файл")


def masses(*inertias: float, **more: Any) -> dict[str, Any]:
    entries = [{"inertia_kg_m2": j, "stiffness_nm_rad": 1e6} for j in inertias]
    return {"masses": entries, **more}


def test_an_empty_section_is_enough() -> None:
    assert load({}).warnings == ()
    assert load({}).model.torsion.loss_factor == 0.035


@pytest.mark.parametrize(
    ("section", "said"),
    [
        (masses(1.0), "масс 1, а нужно от 2 до 20"),
        (masses(*[1.0] * 21), "масс 21, а нужно от 2 до 20"),
        ({"masses": [{"inertia_kg_m2": 1.0}, {"inertia_kg_m2": 1.0}]},
         "жёсткость участка между массами не задана"),
        ({"masses": [{"inertia_kg_m2": 1.0, "stiffness_nm_rad": 1e6, "throw": 5.0},
                     {"inertia_kg_m2": 1.0}]}, "нет колена 5; нужно число от 0 до 4"),
        ({"masses": [{"inertia_kg_m2": 1.0, "stiffness_nm_rad": 1e6, "throw": 1.0},
                     {"inertia_kg_m2": 1.0, "throw": 1.0}]}, "колено 1 названо дважды"),
        (masses(1.0, 1.0, flywheel_kg_m2=1.0), "схема задана массами"),
        ({"throws_kg_m2": [0.1, 0.1]}, "значений 2, а нужно 4; колен 4"),
        ({"throws_nm_rad": [1e6] * 4}, "значений 4, а нужно 3; колен 4"),
        ({"driven_nm_rad": 1e6}, "жёсткость за маховиком задана, а массы за ним нет"),
        ({"speed_min_rpm": 2000.0, "speed_max_rpm": 1000.0}, "диапазон от 2000 до 1000"),
        ({"peaks": [{"speed_rpm": 1500.0, "pressure_mpa": 8.0},
                    {"speed_rpm": 1500.0, "pressure_mpa": 9.0}]}, "не больше предыдущей"),
        ({"main_bore_mm": 90.0}, "отверстие 90 мм не меньше шейки"),
        ({"flywheel_kg_m2": -1.0}, "допустимо от"),
        ({"flywheel": 1.0}, "flywheel_kg_m2"),
    ],
)  # fmt: skip
def test_what_cannot_be_is_refused_in_a_line(section: dict[str, Any], said: str) -> None:
    with pytest.raises(InputError) as error:
        load(section)
    lines = [str(problem) for problem in error.value.problems]
    assert any(said in f"{p.what}; {p.hint}" for p in error.value.problems), lines


def test_a_bore_is_smaller_than_the_thinnest_journal() -> None:
    raw = to_mapping(sample("d-240"))
    raw["crankshaft"] |= {"main_diameter_mm": None, "main_diameters_mm": [75.0, 75, 70, 75, 75]}
    raw["torsion"] = {"main_bore_mm": 69.9}
    load_mapping(raw, source="файл")
    raw["torsion"] = {"main_bore_mm": 70.0}
    with pytest.raises(InputError, match="отверстие 70 мм не меньше шейки 70 мм"):
        load_mapping(raw, source="файл")


def test_one_shaft_has_one_bore() -> None:
    """What is forgotten in one of two sections made the shaft solid there."""
    raw = to_mapping(sample("d-240-bearings"))
    raw["bearings"] |= {"pin_bore_mm": 20.0, "main_bore_mm": 25.0}
    raw["torsion"] = {"pin_bore_mm": 20.0}
    (message,) = load_mapping(raw, source="файл").warnings
    assert "в расчёте подшипников 25 мм, а в крутильной схеме 0 мм" in message.what
    assert message.where == "файл: bearings.main_bore_mm"
    raw["torsion"]["main_bore_mm"] = 30.0
    (message,) = load_mapping(raw, source="файл").warnings
    assert message.where == "файл: torsion.main_bore_mm"
    raw["torsion"]["main_bore_mm"] = 25.0
    assert load_mapping(raw, source="файл").warnings == ()


def test_a_bore_is_smaller_than_each_shaft_of_a_train() -> None:
    section = masses(1.0, 1.0, main_bore_mm=40.0)
    section["masses"][1]["diameter_mm"] = 40.1
    load(section)
    section["masses"][1]["diameter_mm"] = 40.0
    with pytest.raises(InputError, match="вал 40 мм не толще отверстия main_bore_mm"):
        load(section)


@pytest.mark.parametrize(
    ("section", "key"),
    [
        ({"loss_factor": 0.4}, "loss_factor"),
        ({"shear_modulus_mpa": 2e5}, "shear_modulus_mpa"),
        ({"stress_allowed_mpa": 400.0}, "stress_allowed_mpa"),
        ({"speed_max_rpm": 22000.0}, "speed_max_rpm"),
    ],
)
def test_what_is_unusual_is_told(section: dict[str, Any], key: str) -> None:
    assert any(key in warning.where for warning in load(section).warnings)


def test_a_train_in_the_form_of_the_manual() -> None:
    text = (
        new_file("d-240")
        + """
[torsion]

[[torsion.masses]]
name = "ротор"
inertia_kg_m2 = 211.4
stiffness_nm_rad = 9775000.0

[[torsion.masses]]
name = "двигатель"
inertia_kg_m2 = 8.3
throw = 1
"""
    )
    assert tomllib.loads(text)["torsion"]["masses"][1]["throw"] == 1
    model = load_text(text, source="t").model
    assert model.torsion == load(TWO_DISCS).model.torsion


def test_an_end_that_becomes_grounded_changes_the_workbook() -> None:
    fields = {field.name: field for field in iter_fields(load({}).model)}
    assert fields["torsion_ground_nm_rad"].structural
    grounded = {field.name: field for field in iter_fields(load({"ground_nm_rad": 5.0}).model)}
    assert not grounded["torsion_ground_nm_rad"].structural


def test_a_train_that_is_none_is_refused_by_the_solver_too() -> None:
    soft, stiff = TrainMass("soft", 1.0), TrainMass("stiff", 1.0, 1e6)
    for changes, said in (
        ({"masses": (stiff,)}, "2 to 20 masses"),
        ({"masses": (stiff,) * 21}, "2 to 20 masses"),
        ({"masses": (stiff, soft, stiff)}, "between two masses needs a stiffness"),
        ({"masses": (stiff, stiff, soft, stiff)}, "between two masses needs a stiffness"),
        ({"peaks": ((200.0, 9e6), (200.0, 8e6))}, "must rise"),
        ({"peaks": ((200.0, 9e6), (100.0, 8e6))}, "must rise"),
    ):
        with pytest.raises(ValueError, match=said):
            Torsion(**changes)
    assert Torsion(masses=(stiff, stiff, soft)).masses  # its last end may be free
