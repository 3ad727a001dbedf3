"""The sheets of the oil film and of the safety against the solver: two independent statements."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kshm import solve
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.inputs.sections.input_file import InputFile
from reports.inputs.sections.mechanism import CrankshaftSection
from reports.inputs.to_si.engine import engine_and_cycle
from reports.model.blocks import TableSpec
from reports.model.evaluation import Evaluation
from reports.tables.registry import build_model
from tests.bearings.files import laid_out, tractor
from tests.cover import examples, sparse
from tests.layouts import MAKERS
from tests.tables.test_two_statements import assert_agree, results_of

GIVEN = {
    "pin_clearance_min_mm": 0.05, "pin_clearance_max_mm": 0.12, "main_clearance_min_mm": 0.06,
    "main_clearance_max_mm": 0.15, "pin_width_mm": 30.0, "main_width_mm": 36.0,
    "pin_groove_mm": 3.0, "main_groove_mm": 4.0, "hole_mm": 4.0, "viscosity_40_mpa_s": 140.0,
    "viscosity_100_mpa_s": 13.0, "oil_temperature_c": 105.0, "supply_c": 85.0, "supply_mpa": 0.4,
    "material": "40h", "tensile_mpa": 900.0, "bending_limit_mpa": 400.0,
    "torsion_limit_mpa": 220.0, "fillet_mm": 4.0, "pin_bore_mm": 20.0, "main_bore_mm": 25.0,
}  # fmt: skip


@pytest.mark.parametrize("maker", sparse(MAKERS))
def test_rules_of_every_layout(maker: str) -> None:
    assert_agree(laid_out(maker, {}, step_deg=30))


@pytest.mark.parametrize("maker", ["four", "v_six", "articulated", "two_stroke"])
def test_everything_given(maker: str) -> None:
    assert_agree(laid_out(maker, GIVEN, step_deg=30))


def test_the_tractor_diesel() -> None:
    assert_agree(tractor(), solve(*engine_and_cycle(tractor())))


def unlike_throws(maker: str, **bearings: object) -> InputFile:
    """Pins of sizes of their own between webs of masses of their own."""
    data = to_mapping(laid_out(maker, bearings, step_deg=30))
    shaft = data["crankshaft"]
    diameter = shaft.pop("pin_diameter_mm")
    count = len(shaft["webs"]) // 2
    shaft["pin_diameters_mm"] = [diameter * (1 - 0.04 * (k % 2)) for k in range(count)]
    for number, web in enumerate(shaft["webs"]):
        web["mass_kg"] *= 1 + 0.1 * number
    return load_mapping(data, source=maker).model


@pytest.mark.parametrize("maker", ["basic", "four", "v_six", "articulated", "split", "two_stroke"])
def test_pins_and_webs_that_are_not_alike(maker: str) -> None:
    assert_agree(unlike_throws(maker))


def polar_modulus(shaft: CrankshaftSection, k: int) -> float:
    return float(np.pi / 16 * (shaft.pin_diameters_mm[k - 1] / 10) ** 3)


@settings(max_examples=examples(5, 10))
@given(
    maker=st.sampled_from(["basic", "four", "v_six", "articulated"]),
    diameters=st.lists(st.floats(0.85, 1.1), min_size=6, max_size=6),
    webs=st.lists(st.floats(0.5, 2.0), min_size=12, max_size=12),
    hole=st.sampled_from([None, 0.0, 60.0]),
)
def test_every_pin_is_bent_and_turned_by_its_own_moments(
    maker: str, diameters: list[float], webs: list[float], hole: float | None
) -> None:
    data = to_mapping(unlike_throws(maker))
    shaft = data["crankshaft"]
    whole = max(shaft["pin_diameters_mm"])
    count = len(shaft["pin_diameters_mm"])
    shaft["pin_diameters_mm"] = [round(whole * share, 2) for share in diameters[:count]]
    shaft["oil_hole_deg"] = hole
    for web, share in zip(shaft["webs"], webs, strict=False):
        web["mass_kg"] *= share
    model = load_mapping(data, source=maker).model
    _, actual = assert_agree(model)
    numbers = range(1, count + 1)
    for k in numbers:
        bent = np.ptp(actual.columns["throw_bending"][f"Mbend{k}_Nm"]) / 2
        turned = np.ptp(actual.columns["P4_5"][f"Mpin{k}_Nm"]) / 2
        modulus = polar_modulus(model.crankshaft, k)
        assert actual.scalars[f"safe_pin_bend_a{k}_MPa"] == pytest.approx(2 * bent / modulus)
        assert actual.scalars[f"safe_pin_a{k}_MPa"] == pytest.approx(turned / modulus)
        for where in ("hole", "fillet"):
            parts = [actual.scalars[f"safe_pin_{way}_{where}{k}"] for way in ("bend", "turn")]
            both = 1 / np.hypot(*(1 / n for n in parts))
            assert actual.scalars[f"safe_pin_{where}{k}"] == pytest.approx(both)
    least = {k: actual.scalars[f"safe_pin_n{k}"] for k in numbers}
    weakest = round(actual.scalars["safe_pin_weakest"])
    assert actual.scalars["safe_n_pin"] == least[weakest] == min(least.values())
    assert actual.scalars["safe_n_bend_hole"] == actual.scalars[f"safe_pin_bend_hole{weakest}"]


def test_a_groove_with_the_heat_balance() -> None:
    assert_agree(tractor(pin_groove_mm=4.0, oil="m10", material="vch60"))


def test_twice_the_viscosity_and_twice_the_square_of_the_clearance_is_the_same_orbit() -> None:
    oil = {"viscosity_40_mpa_s": 70.0, "viscosity_100_mpa_s": 10.0, "oil_temperature_c": 100.0}
    thick = oil | {"viscosity_40_mpa_s": 140.0, "viscosity_100_mpa_s": 20.0}

    def orbits(oil: dict[str, float], wide: float) -> list[np.ndarray]:
        gaps = {"main_clearance_min_mm": 0.06, "main_clearance_max_mm": 0.13}
        gaps |= {"pin_clearance_min_mm": 0.057, "pin_clearance_max_mm": 0.131}
        data = tractor(30, **oil, **{key: wide * gap for key, gap in gaps.items()})
        tables = solve(*engine_and_cycle(data)).columns
        return [tables[f"oil_orbit_{k}"][f"oil_eps{c}"] for k in (0, 1, 3) for c in (1, 2)]

    plain = orbits(oil, 1.0)
    assert max(e.max() for e in plain) > 0.8
    # One more cycle or one less, by the last digit, moves an orbit by what "closed" allows.
    np.testing.assert_allclose(orbits(thick, 2**0.5), plain, atol=5e-4)
    assert np.abs(np.subtract(orbits(thick, 1.0), plain)).max() > 0.01


def test_every_result_of_the_solver_stands_in_a_table() -> None:
    data = tractor(30)
    model, solution = build_model(data), solve(*engine_and_cycle(data))
    assert set(solution.columns) - {"P4_3"} == results_of(model)
    for table, columns in solution.columns.items():
        if table.startswith("oil_"):
            spec: TableSpec = model.tables[table]
            assert [c.key for c in spec.columns if not c.helper] == list(columns)
    assert set(solution.scalars) <= set(model.scalars)


def test_no_section_no_sheet() -> None:
    data = tractor(30).model_copy(update={"bearings": None})
    assert not [key for key in build_model(data).nodes if key.startswith(("oil_", "safe_"))]
    assert not [key for key in solve(*engine_and_cycle(data)).scalars if key.startswith("oil_")]


def test_values_of_a_changed_workbook_are_told_to_be_old() -> None:
    run = Evaluation(build_model(tractor(30)))
    assert run.value("oil_fresh") == "отвечают исходным данным"
    mark = {"oil_orbits.oil_mark": run.value("oil_orbits.oil_mark")}
    for change in ("bearings_supply_c", "masses_rod_kg", "bearings_pin_clearance_max_mm"):
        known = mark | {change: 1.01 * run.value(change)}
        assert "ИЗМЕНЕНЫ" in run.fork(known).value("oil_fresh")
