"""Rod bearing, bending of the pin, continuous shaft against a beam of finite elements."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings

from kshm import solve
from kshm.engine.engine import Engine
from kshm.mechanics.masses import point_masses
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.inputs.sections.input_file import InputFile
from reports.inputs.to_si.engine import engine_and_cycle, to_engine
from reports.model.evaluation import evaluate_model
from reports.tables.registry import build_model
from tests.conftest import sample
from tests.kshm.engines import engines
from tests.referee.compare import recalculated_as_solved
from tests.tables.test_two_statements import assert_agree


def made(name: str = "gots-appendix1", **shaft: Any) -> InputFile:
    raw = to_mapping(sample(name))
    raw["calculation"]["step_deg"] = 30
    raw["crankshaft"] |= shaft
    return load_mapping(raw, source="b.toml").model


def forces_on_shaft(engine: Engine) -> tuple[list[float], list[np.ndarray]]:
    """Places along the shaft [m] and forces in shaft axes [N] over the angle, from scratch."""
    raw = solve(engine).raw
    area, unit = engine.geometry.piston_area, engine.geometry.crank_radius * engine.omega**2
    m_2 = point_masses(engine.masses, engine.geometry.rod_length)[1]
    places: list[float] = []
    forces: list[np.ndarray] = []
    start, one = 0.0, np.ones_like(raw.phi)

    def add(at: float, gamma: float, left: np.ndarray, up: np.ndarray) -> None:
        places.append(at)
        forces.append(
            np.stack([left * np.cos(gamma) - up * np.sin(gamma),
                      left * np.sin(gamma) + up * np.cos(gamma)], axis=-1)
        )  # fmt: skip

    shaft = engine.crankshaft
    for i, throw in enumerate(shaft.throws):
        l1, l2, l3, l4, l5, _ = throw.arms
        rod = start + l1 + throw.left_web_thickness + l2
        web = rod + l3 + l4 + l5 + throw.right_web_thickness / 2
        for c, index in enumerate(engine.arrangement):
            if index.throw == i:
                at = rod + l3 + l4 if index.rod_place else rod
                up = m_2 * unit - raw.K[0, c] * area
                add(at, throw.angle, -raw.T[0, c] * area, up)
        add(rod + l3, throw.angle, 0 * one, throw.pin_mass * unit * one)
        for at, part in ((start + l1 + throw.left_web_thickness / 2, throw.left_web),
                         (web, throw.right_web)):  # fmt: skip
            side = part.mass * np.sin(part.angle) + part.counterweight_mass * np.sin(
                part.counterweight_angle
            )
            along = part.mass * np.cos(part.angle) - part.counterweight_mass * np.cos(
                part.counterweight_angle
            )
            add(at, throw.angle, side * unit * one, along * unit * one)
        start += throw.length
    nose, rear = shaft.nose, shaft.rear
    add(-nose.arm, shaft.throws[0].angle, -nose.mass * unit * np.sin(nose.angle) * one,
        nose.mass * unit * np.cos(nose.angle) * one)  # fmt: skip
    add(start + rear.arm, shaft.throws[-1].angle, rear.mass * unit * np.sin(rear.angle) * one,
        rear.mass * unit * np.cos(rear.angle) * one)  # fmt: skip
    return places, forces


def beam_reactions(engine: Engine) -> np.ndarray:
    """Reactions on the shaft (journals, angles, 2) [N] by the stiffness method.

    Nodes are the supports, unknowns their rotations; loads within a span act by their
    fixed-end forces and moments, overhangs by force and moment on the end support.
    """
    places, forces = forces_on_shaft(engine)
    supports = np.concatenate([[0.0], np.cumsum([t.length for t in engine.crankshaft.throws])])
    count, shape = len(supports), forces[0].shape
    stiffness = np.zeros((2 * count, 2 * count))
    for row, span in enumerate(np.diff(supports)):
        k = np.array([[12, 6 * span, -12, 6 * span],
                      [6 * span, 4 * span**2, -6 * span, 2 * span**2],
                      [-12, -6 * span, 12, -6 * span],
                      [6 * span, 2 * span**2, -6 * span, 4 * span**2]]) / span**3  # fmt: skip
        stiffness[2 * row : 2 * row + 4, 2 * row : 2 * row + 4] += k
    load = np.zeros((2 * count, *shape))
    for position, force in zip(places, forces, strict=True):
        if position <= 0 or position >= supports[-1]:
            end = 0 if position <= 0 else count - 1
            load[2 * end] += force
            load[2 * end + 1] += force * (position - supports[end])
            continue
        row = int(np.searchsorted(supports, position, side="right")) - 1
        span = supports[row + 1] - supports[row]
        a, b = position - supports[row], supports[row + 1] - position
        load[2 * row] += force * b**2 * (3 * a + b) / span**3
        load[2 * row + 1] += force * a * b**2 / span**2
        load[2 * row + 2] += force * a**2 * (a + 3 * b) / span**3
        load[2 * row + 3] -= force * a**2 * b / span**2
    flat, turns = load.reshape(2 * count, -1), slice(1, None, 2)
    moved = np.zeros_like(flat)
    moved[turns] = np.linalg.solve(stiffness[turns, turns], flat[turns])
    actual: np.ndarray = (stiffness @ moved - flat)[::2]
    return actual.reshape(count, *shape)


def compared(engine: Engine) -> None:
    solution = solve(engine)
    table, area = solution.columns["continuous"], engine.geometry.piston_area
    expected = beam_reactions(engine) / area / 1e6
    scale = np.abs(expected).max()
    for k in range(1, len(engine.crankshaft.throws) + 2):
        for axis in (0, 1):
            ours = table[f"Rc{'xy'[axis]}{k}_MPa"]
            np.testing.assert_allclose(
                ours, expected[k - 1, :, axis], rtol=0, atol=1e-9 * scale, err_msg=f"{k} {axis}"
            )


@pytest.mark.parametrize("name", ["gots-appendix1", "d-240", "gots-diesel"])
def test_three_moments_agree_with_the_stiffness_method(name: str) -> None:
    compared(to_engine(made(name)))


@settings(max_examples=15)
@given(engines(step_deg=30))
def test_three_moments_agree_for_any_shaft(engine: Engine) -> None:
    whole = all(c.pin_angle == 0 and c.master is None for c in engine.arrangement)
    if len(engine.crankshaft.throws) > 1 and whole:
        compared(engine)
    else:
        assert "continuous" not in solve(engine).columns


def test_corrections_carry_no_force_and_no_moment() -> None:
    """Support moments only shift load between the supports: force and couple stay."""
    solution = solve(*engine_and_cycle(made("d-240")))
    spans = [t.length for t in solution.engine.crankshaft.throws]
    places = np.concatenate([[0.0], np.cumsum(spans)])
    table = solution.columns["continuous"]
    for axis in "xy":
        added = [
            table[f"Rc{axis}{k}_MPa"] - solution.columns[f"P4_3_{k}"][f"R{axis}_MPa"]
            for k in range(1, 6)
        ]
        np.testing.assert_allclose(sum(added), 0, atol=1e-9)
        couple = sum(a * position for a, position in zip(added, places, strict=True))
        np.testing.assert_allclose(couple, 0, atol=1e-9)


def test_a_massless_rod_presses_its_bearing_along_its_axis() -> None:
    """Without m_2 the load on the big end is the rod force S itself, nothing across."""
    raw = to_mapping(made())
    raw["masses"] = {"reciprocating_kg": 2.0, "rod_big_end_kg": 0.001}
    solution = solve(*engine_and_cycle(load_mapping(raw, source="b").model))
    table, forces = solution.columns["rod_bearing"], solution.columns["P4_1"]
    spin = solution.scalars["K_r_rod"]
    np.testing.assert_allclose(table["By_MPa"], forces["S_MPa"], atol=spin + 1e-9)
    np.testing.assert_allclose(table["Bx_MPa"], 0, atol=spin + 1e-9)
    whole = solve(*engine_and_cycle(made())).columns
    np.testing.assert_allclose(whole["rod_bearing"]["B_MPa"], whole["crankpin"]["Rpin_MPa"])


def test_plane_of_the_hole_given_or_best() -> None:
    by_wear, given_ = made(), made(oil_hole_deg=100.0)
    first, second = (evaluate_model(build_model(d)).scalars for d in (by_wear, given_))
    assert first["alpha_oil_deg"] == first["hole_pin_deg"]
    assert second["alpha_oil_deg"] == 100
    assert second["alpha_best_deg"] == first["alpha_best_deg"]
    best = evaluate_model(build_model(made(oil_hole_deg=first["alpha_best_deg"]))).scalars
    assert best["Malpha_swing"] == pytest.approx(first["Mbest_swing"], rel=1e-12)
    assert first["Mbest_swing"] <= min(first["Malpha_swing"], second["Malpha_swing"]) + 1e-9


@pytest.mark.parametrize("name", ["gots-appendix1", "d-240", "gots-p43"])
def test_statements_and_recalculation_agree(name: str) -> None:
    data = made(name, oil_hole_deg=35.0)
    model, _ = assert_agree(data)
    recalculated_as_solved(model)
    # Phases that contradict the shaft have no continuous scheme.
    assert ("continuous" in model.tables) == (name != "gots-p43")
