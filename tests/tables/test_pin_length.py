"""A crankpin's length is that of the whole pin: what its readers take of it, by hand."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import NamedTuple

import pytest

from kshm import solve
from kshm.engine.torsion import Torsion
from kshm.mechanics.torsion import sections
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.inputs.to_si.engine import engine_and_cycle
from reports.model.evaluation import evaluate_model
from reports.new.generate import generate_engine
from reports.tables.registry import build_model
from tests.conftest import sample
from tests.cover import sparse


class Pin(NamedTuple):
    """What of a pin a throw and a rod have [mm]: pins in series, rods side by side."""

    diameter: float
    length: float
    parts: int = 1
    rods: int = 1


def split_six() -> dict:
    """A V6 of 90° whose pins are split by 30°, so that it fires evenly."""
    raw = generate_engine(6, layout="v", kind="diesel").data
    shaft = raw["crankshaft"]
    shaft.pop("firing_order", None)
    return raw | {
        "crankshaft": shaft | {
            "bank_angle_deg": 90, "split_pin_deg": 30.0, "pin_diameter_mm": 71.4,
            "throw_angles_deg": [0, 120, 240], "pin_length_mm": 32.1,
            "firing_offsets_deg": [0, 240, 120, 60, 300, 180],
        }
    }  # fmt: skip


def articulated_six() -> dict:
    from tests.layouts import articulated

    return articulated(to_mapping(sample("gots-diesel")))


CASES = {
    "yamz-236": (lambda: to_mapping(sample("yamz-236")), Pin(88, 84, rods=2)),
    "yamz-238": (lambda: to_mapping(sample("yamz-238")), Pin(88, 84, rods=2)),
    "V10": (lambda: generate_engine(10, layout="v").data, Pin(49.2, 44.3, rods=2)),
    "V2": (lambda: generate_engine(2, layout="v", kind="diesel").data, Pin(71.4, 64.3, rods=2)),
    "split V6": (split_six, Pin(71.4, 32.1, parts=2)),
    "articulated V6": (articulated_six, Pin(56, 28)),
    "in line": (lambda: to_mapping(sample("d-240-bearings")), Pin(68.25, 38)),
    "boxer": (lambda: to_mapping(sample("vw-1600")), Pin(55, 22)),
}


@pytest.fixture(params=sparse(CASES))
def name(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@lru_cache(maxsize=len(CASES))
def solved(name: str):
    raw = CASES[name][0]()
    raw["bearings"], raw["torsion"] = raw.get("bearings", {}), raw.get("torsion", {})
    model = load_mapping(raw, source="f").model
    engine, cycle = engine_and_cycle(model)
    return engine, solve(engine, cycle=cycle).scalars, evaluate_model(build_model(model)).scalars


def test_the_pressure_is_that_of_the_own_rod_on_its_part_of_the_pin(name):
    pin, (_, _, live) = CASES[name][1], solved(name)
    force = 1000 * float(live["Rpin_max_kN"])
    if pin.rods == 2:  # the sum of two rods stays for the polar diagram
        own = 1e6 * float(live["B_max"]) * float(live["F_piston"])
        assert own != pytest.approx(force)
        force = own
    for item in solved(name)[1:]:
        pressure = force / (pin.diameter * pin.length / pin.rods)
        assert float(item["q_pin_max"]) == pytest.approx(pressure)
        if name != "articulated V6":  # the film has the same force on the same width
            assert float(item["q_pin_max"]) == pytest.approx(float(item["oil_kmax1_MPa"]))
            assert float(item["q_pin_mean"]) == pytest.approx(float(item["oil_k1_MPa"]))


@pytest.mark.parametrize("name", ["yamz-236", "d-240-bearings"])
def test_the_film_and_the_pressure_have_one_width(name):
    raw = to_mapping(sample(name))
    raw["bearings"] = {**raw.get("bearings", {}), "pin_width_mm": 30.0, "pin_groove_mm": 4.0}
    model = load_mapping(raw, source="f").model
    engine, cycle = engine_and_cycle(model)
    numbers = solve(engine, cycle=cycle).scalars
    live = evaluate_model(build_model(model)).scalars
    d = model.crankshaft.pin_diameter_mm
    pressure = 1e6 * numbers["B_max"] * numbers["F_piston"] / (d * (30 - 4))
    for each in (numbers, live):
        for key in ("q_pin_max", "oil_kmax1_MPa"):
            assert float(each[key]) == pytest.approx(pressure)


def test_the_film_carries_a_rod_on_its_own_part(name):
    pin = CASES[name][1]
    if name == "articulated V6":
        assert "oil_F1_N" not in solved(name)[1]
        return
    for item in solved(name)[1:]:
        pressure = float(item["oil_F1_N"]) / (pin.diameter * pin.length / pin.rods)
        assert float(item["oil_k1_MPa"]) == pytest.approx(pressure)


def test_a_torque_passes_all_pins_of_a_throw(name):
    pin, (engine, _, live) = CASES[name][1], solved(name)
    along = pin.parts * pin.length / 1000
    assert sections(engine, Torsion()).pin_length[0] == pytest.approx(along)
    assert float(live["torLp1"]) == pytest.approx(along)
    s = sections(engine, Torsion())
    main, d = s.main_diameter[0], pin.diameter / 1000
    soft = (
        (s.main_length[0] + 0.4 * main) / main**4 + (along + 0.4 * d) / d**4
        + (s.radius[0] - 0.2 * (main + d)) / s.web[0]
    )  # fmt: skip
    shear = engine.torsion.shear_modulus * math.pi / 32
    assert float(live["tore_wilson_1"]) == pytest.approx(soft / shear)


def test_all_pins_of_a_throw_have_their_inertia(name):
    pin, (engine, actual, live) = CASES[name][1], solved(name)
    d, along, r = pin.diameter / 1000, pin.length / 1000, engine.geometry.crank_radius
    one = 7800 * along * math.pi * (d**4 / 32 + d**2 / 4 * r**2)
    if name == "articulated V6":  # the tables have no sum for it
        return
    assert float(live["I_pin"]) == pytest.approx(one)
    rest = float(live["I_main"]) + 2 * float(live["I_web"])
    for each in (actual, live):
        assert float(each["I_crank"]) == pytest.approx(rest + pin.parts * one)


def test_the_rod_model_has_the_width_of_one_rod(name):
    pin, (_, _, live) = CASES[name][1], solved(name)
    if name == "articulated V6":
        return
    inner, outer = pin.diameter / 2000, 0.55 * pin.diameter / 1000
    ring = 7800 * math.pi * pin.length / pin.rods / 1000 * (outer**2 - inner**2)
    assert float(live["rm_m_big"]) == pytest.approx(ring)
    assert float(live["rod_model_mass"]) == pytest.approx(solved(name)[1]["rod_model_mass"])


# Pressures [MPa], film reserve, throw stiffness by Ker Wilson [N·m/rad] and inertia [kg·m²]: by
# a script of their own, from the gas pressure to the heat balance of the film.
BY_HAND = {
    "yamz-236": (5.7180, 19.0938, 2.4310, 2.66341e6, 0.088383),
    "yamz-238": (5.7180, 19.0938, 2.4310, 2.66341e6, 0.088383),
    "in line": (5.3723, 20.2364, 2.0243, 1.39447e6, 0.034538),
}


@pytest.mark.parametrize("case", BY_HAND)
def test_figures_by_hand(case):
    mean, largest, reserve, stiffness, inertia = BY_HAND[case]
    _, actual, live = solved(case)
    assert actual["q_pin_mean"] == pytest.approx(mean, rel=1e-4)
    assert actual["q_pin_max"] == pytest.approx(largest, rel=1e-4)
    assert actual["oil_K1"] == pytest.approx(reserve, rel=1e-4)
    assert 1 / float(live["tore_wilson_1"]) == pytest.approx(stiffness, rel=1e-4)
    assert actual["I_crank"] == pytest.approx(inertia, rel=1e-4)
