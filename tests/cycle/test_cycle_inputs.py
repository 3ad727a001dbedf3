"""The [cycle] section: what goes together, what no cycle follows from."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import pytest

from kshm.cycle.cycle import cycle
from kshm.nomenclature.dizdn_listing import EXTRA, INPUTS, OUTPUTS, value_of
from kshm.ranges import cycle_ranges
from reports.inputs.load import load_mapping
from reports.inputs.to_si.cycle import cycle_run
from reports.inputs.to_si.engine import engine_and_cycle
from reports.shared.errors import InputError
from tests.conftest import sample
from tests.cycle.cycle_engines import turbo_diesel
from tests.cycle.cycle_files import GIVEN_SIZES, GONE, SAMPLES, loaded, raw_of

DIESEL, PETROL = "cycle-turbo-diesel", "cycle-petrol"


def lines(name: str, changes: dict[str, Any]) -> list[str]:
    with pytest.raises(InputError) as caught:
        load_mapping(raw_of(name, changes), source="f.toml")
    assert caught.value.exit_code == 2
    return caught.value.lines()


def test_the_listing_reaches_the_solver_in_si() -> None:
    """With the printed ξ_b and the printed sizes the sample is the engine of appendix 2."""
    run = cycle_run(loaded(DIESEL, {**GIVEN_SIZES, "cycle.xi_b": 0.85}))
    expected = turbo_diesel()
    for name in type(expected).__dataclass_fields__:
        ours, theirs = getattr(run.cycle.inputs, name), getattr(expected, name)
        if isinstance(theirs, float):
            assert ours == pytest.approx(theirs, rel=1e-12), name
        elif name != "boost":
            assert ours == theirs, name
    for name in type(expected.boost).__dataclass_fields__:
        ours = getattr(run.cycle.inputs.boost, name)
        assert ours == pytest.approx(getattr(expected.boost, name), rel=1e-12), name


@pytest.mark.parametrize("name", SAMPLES)
def test_samples_start_from_power_and_speed_alone(name: str) -> None:
    data = sample(name)
    assert not hasattr(data.geometry, "bore_mm")
    engine, run = engine_and_cycle(data)
    assert engine.geometry.bore == pytest.approx(run.design.bore)
    assert 2 * engine.geometry.crank_radius == pytest.approx(run.design.stroke)
    assert engine.geometry.lam == pytest.approx(data.geometry.lambda_)
    assert engine.gas.p_max == run.cycle.combustion.p_z


def test_without_a_cycle_nothing_of_it_is_there() -> None:
    data = sample("gots-diesel")
    assert data.cycle is None
    assert cycle_run(data) is None
    assert engine_and_cycle(data)[1] is None


@pytest.mark.parametrize(
    ("name", "changes", "where", "words"),
    [
        (DIESEL, {"cycle.max_pressure_mpa": 7.0}, "cycle.max_pressure_mpa", "увеличьте p_z"),
        (DIESEL, {"cycle.max_pressure_mpa": 25.0}, "cycle.max_pressure_mpa", "уменьшите p_z"),
        (DIESEL, {"cycle.excess_air": 0.9}, "cycle.excess_air", "увеличьте α"),
        (PETROL, {"cycle.excess_air": 1.9}, "cycle.excess_air", "уменьшите α"),
        (DIESEL, {"geometry.compression_ratio": 28}, "geometry.compression_ratio", "уменьшите ε"),
        (PETROL, {"geometry.compression_ratio": 18}, "geometry.compression_ratio", "детонирует"),
        (DIESEL, {"cycle.power_kw": 9000}, "cycle.power_kw", "увеличьте число цилиндров"),
        (DIESEL, {"cycle.power_kw": 1}, "cycle.power_kw", "уменьшите число цилиндров"),
        (DIESEL, {"cycle.xi_b": 0.3}, "cycle.xi_b", "увеличьте ξ_b"),
        (PETROL, {"cycle.friction_b_mpa_s_m": 0.04, "cycle.friction_a_mpa": 0.4},
         "regime.mechanical_efficiency", "потери"),
        (DIESEL, {"cycle.torque_speed_rpm": 5000}, "cycle.torque_speed_rpm", "исправьте"),
        (DIESEL, {"cycle.cooler_drop_k": 240}, "cycle.cooler_drop_k", "уменьшите"),
    ],
)  # fmt: skip
def test_one_line_says_which_input_and_which_way(
    name: str, changes: dict[str, Any], where: str, words: str
) -> None:
    (line,) = lines(name, changes)
    assert line.startswith(f"f.toml: {where}: ")
    assert words in line


@pytest.mark.parametrize(
    ("name", "changes", "where", "words"),
    [
        (DIESEL, {"cycle.max_pressure_mpa": GONE}, "cycle.max_pressure_mpa", "не задан"),
        (PETROL, {"cycle.max_pressure_mpa": 8.0}, "cycle.max_pressure_mpa", "лишний ключ"),
        (DIESEL, {"cycle.h2_co_ratio": 0.5}, "cycle.h2_co_ratio", "с искровым зажиганием"),
        (DIESEL, {"cycle.stroke_bore": GONE}, "cycle.stroke_bore", "не задан"),
        (DIESEL, {"cycle.compressor_efficiency": GONE}, "cycle.compressor_efficiency", "не задан"),
        (PETROL, {"cycle.cooler_drop_k": 30}, "cycle.cooler_drop_k", "boost_ratio"),
        (DIESEL, {"cycle.fuel_carbon": 0.87}, "cycle.fuel_carbon", "fuel = own"),
        (DIESEL, {"regime.indicated_power_kw": 80}, "regime.indicated_power_kw", "уберите"),
        (DIESEL, {"regime.fullness": 0.9}, "regime.fullness", "cycle.fullness"),
        (DIESEL, {"cycle.adaptability": 1.2}, "cycle.torque_speed_rpm", "n_M"),
        (DIESEL, {"geometry.bore_mm": 88}, "geometry.bore_mm", "неизвестный ключ"),
        (PETROL, {"regime.mechanical_efficiency": 0.8}, "regime.mechanical_efficiency",
         "оставьте одно"),
        (PETROL, {"cycle.friction_b_mpa_s_m": GONE}, "cycle.friction_b_mpa_s_m", "не задан"),
    ],
)  # fmt: skip
def test_keys_that_do_not_go_together(
    name: str, changes: dict[str, Any], where: str, words: str
) -> None:
    (line,) = lines(name, changes)
    assert line.startswith(f"f.toml: {where}: ")
    assert words in line


def test_cycle_without_its_gas_and_gas_without_its_cycle() -> None:
    raw = raw_of(DIESEL)
    del raw["cycle"]
    raw["geometry"] |= {"bore_mm": 88.0, "stroke_mm": 94.0}
    with pytest.raises(InputError) as caught:
        load_mapping(raw, source="f.toml")
    assert caught.value.lines()[0].startswith("f.toml: cycle: нет раздела")
    polytropic = raw_of("d-240", {"regime.indicated_power_kw": GONE})
    polytropic["cycle"] = raw_of(DIESEL, GIVEN_SIZES)["cycle"]
    with pytest.raises(InputError) as caught:
        load_mapping(polytropic, source="f.toml")
    (line,) = caught.value.lines()
    assert line.startswith("f.toml: gas.source: ")
    assert "уберите [cycle]" in line


def test_a_doubtful_residual_temperature_is_a_warning() -> None:
    raw = raw_of(DIESEL, {"cycle.residual_temperature_k": 700})
    (warning,) = load_mapping(raw, source="f.toml").warnings
    assert warning.line().startswith("f.toml: cycle: T_r = 700 К расходится")
    assert "задайте T_r ближе" in warning.line()


def test_speed_law_by_adaptability() -> None:
    run = cycle_run(loaded("cycle-tractor-diesel"))
    assert run.law.adaptability == pytest.approx(1.15)
    assert run.points[1].omega == pytest.approx(1400 * math.pi / 30)
    assert not run.points[1].derived
    derived = cycle_run(loaded(DIESEL)).points
    assert derived[1].derived and derived[2].derived


def paths_of(engine) -> list[str]:
    return [path for path, *_ in cycle_ranges(engine.kind, boosted=engine.boost is not None)]


def test_every_engine_has_its_ranges(engine):
    ranges = paths_of(engine)
    assert len(ranges) >= 12
    result = cycle(engine)
    assert all(isinstance(value_of(result, key), float | int) for key in ranges)


def test_units_are_those_of_the_listing(diesel):
    result = cycle(diesel)
    assert value_of(result, "combustion.p_z") == pytest.approx(10.5)
    assert value_of(result, "inputs.t_residual") == 840


def test_boosted_petrol_is_not_measured_by_columns_of_the_natural_one(engines):
    keys = paths_of(engines["turbo_petrol"])
    assert "compression.p_c" not in keys
    assert "expansion.n_2" in keys


def test_every_name_leads_to_a_number(diesel):
    r = cycle(diesel)
    for q in INPUTS:
        assert value_of(diesel, q.key) == value_of(r, f"inputs.{q.key}")
    for q in (*OUTPUTS, *EXTRA):
        assert value_of(r, q.key) > 0
    assert len(OUTPUTS) == 34
    assert len({q.key for q in (*INPUTS, *OUTPUTS, *EXTRA)}) == len((*INPUTS, *OUTPUTS, *EXTRA))


def test_a_missing_number_is_refused(engines):
    with pytest.raises(AttributeError):
        value_of(cycle(engines["petrol"]), "turbo.p_t")
    with pytest.raises(AttributeError):
        value_of(replace(engines["petrol"], bore=None), "bore")
