"""One web, inertia of a throw and flywheel, the weakest journal of a shaft: both statements."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Any

import numpy as np
import pytest

from kshm import solve
from kshm.mechanics.torsion import sections
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.inputs.solve_input import refined, solved, webs_remark
from reports.inputs.to_si.engine import engine_and_cycle
from reports.model.evaluation import evaluate_model
from reports.new.generate import generate_engine
from reports.tables.registry import build_model
from tests.conftest import sample
from tests.layouts import articulated


def drawn(name: str) -> dict[str, Any]:
    """An engine that others may change."""
    if name == "V6":
        return generate_engine(6, layout="v").data
    if name == "two-stroke":
        return generate_engine(3, strokes=2, kind="diesel").data
    if name == "five":
        return generate_engine(5, kind="diesel").data
    if name == "articulated":
        return articulated(to_mapping(sample("gots-diesel")))
    return to_mapping(sample(name))


def changed(name: str) -> dict[str, Any]:
    """The engine with torsion, unlike webs and outer counterweights."""
    raw = drawn(name)
    raw["torsion"] = {}
    shaft = raw["crankshaft"]
    for number, arms in enumerate(shaft["arms"]):
        arms["left_web_mm"] = 0.0 if number == 1 else 20.0 + number
    shaft |= {"nose_mass_kg": 0.3, "nose_arm_mm": 90.0, "rear_mass_kg": 0.2, "rear_arm_mm": 80.0}
    return raw


@lru_cache(maxsize=8)
def numbers(name: str):
    model = load_mapping(changed(name), source="f").model
    engine, cycle = engine_and_cycle(model)
    return model, engine, solve(engine, cycle=cycle), evaluate_model(build_model(model))


NAMES = ["V6", "two-stroke", "five", "yamz-238"]


@pytest.mark.parametrize("name", NAMES)
def test_the_throws_of_the_train_are_the_engine(name: str) -> None:
    model, _, solution, live = numbers(name)
    throws = len(model.crankshaft.throw_angles_deg)
    for inertias, whole in (
        (solution.columns["torsion_forms"]["tor_J_kgm2"], solution.scalars["I_engine_mean"]),
        ([float(live.scalars[f"torJ{k}"]) for k in range(1, throws + 2)],
         live.scalars["I_engine_mean"]),
    ):  # fmt: skip
        assert sum(inertias[1 : throws + 1]) == pytest.approx(float(whole), rel=1e-9)


@pytest.mark.parametrize("name", NAMES)
def test_one_web_for_inertia_and_stiffness(name: str) -> None:
    model, engine, _, live = numbers(name)
    bore = 2 * math.sqrt(float(live.scalars["F_piston"]) / math.pi)
    width = 1.125 * bore
    r, steel = float(live.scalars["r_crank"]), 7800
    shaft = model.crankshaft
    main, length = shaft.main_diameter_mm / 1e3, np.mean(shaft.main_lengths_mm) / 1e3
    d, along = shaft.pin_diameter_mm / 1e3, shaft.pin_length_mm / 1e3
    height = r + (d + main) / 2 + 0.01
    rest = steel * math.pi * (
        main**4 / 32 * length + d**4 / 32 * along + d**2 / 4 * along * r**2
    )  # fmt: skip
    for k, arms in enumerate(shaft.arms, 1):
        sides = [h / 1e3 or 0.175 * bore for h in (arms.left_web_mm, arms.right_web_mm)]
        webs = steel * height * width * sum(sides) * ((height**2 + width**2) / 12 + r**2 / 4)
        key = "I_crank" if k == 1 else f"I_crank_throw{k}"
        assert float(live.scalars[key]) == pytest.approx(rest + webs)
        s = sections(engine, engine.torsion)
        assert (s.thickness[k - 1], s.width[k - 1]) == pytest.approx((sum(sides) / 2, width))


@pytest.mark.parametrize("name", ["V6", "yamz-238"])
def test_the_web_of_the_strength_is_that_of_the_throw(name: str) -> None:
    raw = changed(name)
    raw["strength"] = {"kind": "diesel", "web_width_mm": 91.0, "web_thickness_mm": 17.0}
    model = load_mapping(raw, source="f").model
    live = evaluate_model(build_model(model)).scalars
    engine, cycle = engine_and_cycle(model)
    actual = solve(engine, cycle=cycle).scalars
    assert [live[f"web{k}_left_mm"] for k in (1, 2, 3)] == [20, 17, 22]
    assert live["st_web_width_mm"] == live["web1_width_mm"] == 91
    assert float(live["st_web_thickness_mm"]) == 17
    assert actual["I_crank"] == pytest.approx(float(live["I_crank"]))
    assert not webs_remark(model)  # a web is without a thickness of its own
    raw["crankshaft"]["arms"][1]["left_web_mm"] = 21.0
    remark = webs_remark(load_mapping(raw, source="f").model)
    assert remark.startswith("strength.web_thickness_mm: 17")


@pytest.mark.parametrize("name", [*NAMES, "articulated"])
def test_a_shaft_is_as_weak_as_its_weakest_journal(name: str) -> None:
    raw = drawn(name)
    raw["torsion"] = {"pin_bore_mm": 10.0}
    model = load_mapping(raw, source="f").model
    live = evaluate_model(build_model(model)).scalars
    shaft = model.crankshaft
    d, main = shaft.pin_diameter_mm / 10, shaft.main_diameter_mm / 10
    pin = math.pi * (d**4 - 1) / (16 * d)
    throws = len(shaft.throw_angles_deg)
    for k in range(1, throws + 2):
        assert float(live[f"torW{k}"]) == pytest.approx(min(pin, math.pi * main**3 / 16))


@pytest.mark.parametrize("name", ["yamz-238", "V6"])
@pytest.mark.parametrize("step", [1, 10, 30])
def test_one_flywheel_on_every_grid(name: str, step: int) -> None:
    raw = drawn(name)
    raw["torsion"], raw["calculation"] = {}, {"step_deg": step}
    model = load_mapping(raw, source="f").model
    fine = solved(refined(model)).scalars
    live = evaluate_model(build_model(model)).scalars
    wanted = evaluate_model(build_model(refined(model))).scalars["I_flywheel"]
    for each in (solved(model).scalars, live, fine):
        assert float(each["I_flywheel"]) == pytest.approx(float(wanted), rel=1e-6)
    assert float(live["tor_flywheel"]) == pytest.approx(solved(model).scalars["tor_flywheel"])
    if float(wanted) > 0:
        assert float(live["delta_work"]) == pytest.approx(model.balance.irregularity)


# Two-term kinematics and polytropes in plain Python, from the file to the flywheel: pressures
# [MPa], the first throw and the mean of the engine [kg·m²], the flywheel by a step of 1°.
BY_HAND = {
    "yamz-238": (5.71797, 19.09384, 0.08838, 0.79455, 1.46064),
    "yamz-236": (5.71797, 19.09384, 0.08838, 0.59591, 0.90322),
    "d-240-bearings": (5.37226, 20.23635, 0.03454, 0.23556, 0.64117),
}


@pytest.mark.parametrize("name", BY_HAND)
def test_figures_by_hand(name: str) -> None:
    keys = ("q_pin_mean", "q_pin_max", "I_crank", "I_engine_mean", "I_flywheel")
    for each in (solved(sample(name)).scalars, evaluate_model(build_model(sample(name))).scalars):
        assert [float(each[key]) for key in keys] == pytest.approx(BY_HAND[name], abs=6e-6)
