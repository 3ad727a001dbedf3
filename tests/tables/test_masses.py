"""Masses by every way of giving them: both statements agree, and what must hold does."""

from __future__ import annotations

import math
from typing import Any

import pytest

from kshm.engine.masses import Swinging
from kshm.mechanics.masses import (
    GRAVITY,
    pendulum_inertia,
    swung_centre,
    swung_inertia,
    three_masses,
    two_mass_inertia,
)
from reports.inputs.fields import to_mapping
from reports.inputs.load import Loaded, load_mapping
from reports.model.evaluation import evaluate_model
from reports.shared.errors import InputError
from reports.tables.registry import build_model
from tests.conftest import sample
from tests.referee.compare import recalculated_as_solved
from tests.tables.test_two_statements import assert_agree

PARTS = {"piston_group_kg": 1.52, "rod_kg": 1.752}
SWINGS = {
    "swings_small_end_per_min": 77.0,
    "swings_big_end_per_min": 85.5,
    "small_end_radius_mm": 14.0,
    "swing_edges_mm": 190.0,
}
WAYS: dict[str, dict[str, Any]] = {
    "share": {**PARTS, "rod_small_end_share": 0.275},
    "centre and inertia": {**PARTS, "rod_centre_mm": 107.0, "rod_inertia_kg_m2": 0.006},
    "weighing": {**PARTS, "rod_weighed_small_end_kg": 0.482},
    "swings": {**PARTS, **SWINGS},
    "estimate": {"estimate_fuel": "diesel"},
    "estimate of the piston": {"estimate_fuel": "petrol", "rod_kg": 1.0, "rod_centre_mm": 107.0},
    "estimate of the shaft": {
        "estimate_fuel": "diesel", "reciprocating_kg": 2.0, "rod_big_end_kg": 1.269,
    },
}  # fmt: skip


def loaded(masses: dict[str, Any], **shaft: str) -> Loaded:
    """The textbook's diesel on a coarse grid with other masses."""
    raw = to_mapping(sample("gots-diesel"))
    raw["calculation"]["step_deg"] = 30
    raw["masses"] = masses
    if "estimate_fuel" in masses:
        del raw["crankshaft"]["pin_mass_kg"]
    for web in raw["crankshaft"]["webs"]:
        if "estimate_fuel" in masses:
            del web["mass_kg"]
        elif shaft:
            web["actual_mass_kg"], web["centre_mm"] = web.pop("mass_kg"), 40.0
    return load_mapping(raw, source="masses.toml")


@pytest.mark.parametrize("way", WAYS)
def test_both_statements_agree(way: str) -> None:
    assert_agree(loaded(WAYS[way]).model)


def test_webs_by_mass_and_radius() -> None:
    data = loaded(WAYS["share"], webs="actual").model
    assert_agree(data)
    values = evaluate_model(build_model(data)).scalars
    assert values["m_k"] == pytest.approx(0.425 + 2 * 0.245 * 40 / 47, rel=1e-12)


@pytest.mark.parametrize("way", ["swings", "estimate"])
def test_recalculated_workbook_agrees(way: str) -> None:
    recalculated_as_solved(build_model(loaded(WAYS[way], webs="actual").model))


def test_swings_of_a_known_rod_give_it_back() -> None:
    """A rod of which mass, centre and inertia are chosen, swung by the law of the pendulum."""
    mass, centre, inertia, radius, edges = 1.7, 0.105, 0.0061, 0.013, 0.19
    arm = centre + radius

    def swings(distance: float) -> float:
        about = inertia + mass * distance**2
        return math.sqrt(mass * GRAVITY * distance / about) / (2 * math.pi)

    data = Swinging(mass, swings(arm), swings(edges - arm), radius, edges)
    assert swung_centre(data) == pytest.approx(centre, rel=1e-9)
    assert swung_inertia(data) == pytest.approx(inertia, rel=1e-8)
    about_a = pendulum_inertia(mass, arm, data.swings_small)
    assert about_a == pytest.approx(inertia + mass * arm**2, rel=1e-12)


def test_three_masses_keep_mass_centre_and_inertia() -> None:
    mass, centre, length, inertia = 1.752, 0.1073, 0.148, 0.006
    first, second, third = three_masses(mass, centre, length, inertia)
    assert first + second + third == pytest.approx(mass, rel=1e-12)
    assert first * centre == pytest.approx(second * (length - centre), rel=1e-12)
    kept = first * centre**2 + second * (length - centre) ** 2
    assert kept == pytest.approx(inertia, rel=1e-12)
    assert two_mass_inertia(mass, centre, length) > inertia  # as the book says
    rod = two_mass_inertia(mass, centre, length)
    assert three_masses(mass, centre, length, rod)[2] == pytest.approx(0, abs=1e-12)


def test_the_estimate_is_marked() -> None:
    actual = loaded(WAYS["estimate"])
    (warning,) = (w for w in actual.warnings if "таблице 4" in w.what)
    assert warning.what == (
        "оценены по таблице 4 учебника: поршневая группа, шатун, шатунная шейка, щёки"
    )
    notes = [block.note for block in build_model(actual.model).blocks if block.note]
    assert any(note.startswith("Массы оценены по таблице 4") for note in notes)


REFUSED: dict[str, tuple[dict[str, Any], str]] = {
    "negative inertia": (
        {**PARTS, **SWINGS, "swings_small_end_per_min": 110.0, "swings_big_end_per_min": 106.0},
        "masses.swing_edges_mm: по качаниям момент инерции шатуна отрицателен; "
        "проверьте n_A, n_C, r_1 и l_3",
    ),
    "centre outside the rod by swings": (
        {**PARTS, **SWINGS, "swings_small_end_per_min": 60.0},
        "masses.swing_edges_mm: по качаниям l1 = 1392,08 мм, вне шатуна",
    ),
    "centre outside the rod": (
        {**PARTS, "rod_centre_mm": 150.0},
        "masses.rod_centre_mm: центр масс 150 мм лежит не между головками шатуна; "
        "длина шатуна 148 мм",
    ),
    "scale shows more than the rod": (
        {**PARTS, "rod_weighed_small_end_kg": 1.8},
        "masses.rod_weighed_small_end_kg: весы показали 1,8 кг, не меньше массы шатуна; "
        "масса шатуна 1,752 кг",
    ),
    "two ways": (
        {**PARTS, **SWINGS, "rod_centre_mm": 107.0},
        "masses: заданы и rod_centre_mm, и качания; задайте либо reciprocating_kg и "
        "rod_big_end_kg, либо piston_group_kg, rod_kg и одно из rod_centre_mm, "
        "rod_small_end_share",
    ),
    "half of the swings": (
        {**PARTS, "swings_small_end_per_min": 77.0, "swing_edges_mm": 190.0},
        "masses.swings_big_end_per_min: не хватает данных качаний; нужны "
        "swings_small_end_per_min, swings_big_end_per_min, small_end_radius_mm, swing_edges_mm",
    ),
    "nothing to estimate": (
        {**PARTS, "rod_centre_mm": 107.0, "estimate_fuel": "diesel"},
        "masses.estimate_fuel: оценивать нечего: все массы заданы; уберите estimate_fuel",
    ),
    "estimate without fuel": (
        {**PARTS, "rod_centre_mm": 107.0, "estimate_piston": "iron"},
        "masses.estimate_piston: ключ нужен только при оценке; добавьте estimate_fuel",
    ),
}


@pytest.mark.parametrize("case", REFUSED)
def test_bad_masses_are_one_line(case: str) -> None:
    masses, expected = REFUSED[case]
    raw = to_mapping(sample("gots-diesel"))
    raw["masses"] = masses
    with pytest.raises(InputError) as caught:
        load_mapping(raw, source="m.toml")
    (problem,) = caught.value.problems
    assert problem.line().removeprefix("m.toml: ").startswith(expected)


def test_a_shaft_without_masses_needs_an_estimate() -> None:
    raw = to_mapping(sample("gots-diesel"))
    del raw["crankshaft"]["pin_mass_kg"]
    del raw["crankshaft"]["webs"][0]["mass_kg"]
    with pytest.raises(InputError) as caught:
        load_mapping(raw, source="m.toml")
    lines = [problem.line() for problem in caught.value.problems]
    assert lines[0] == "m.toml: crankshaft.webs: массы щёк заданы разными способами; " \
        "задайте все щёки одинаково"  # fmt: skip
    assert "crankshaft.pin_mass_kg: масса не задана" in lines[1]
