"""Inputs that make a result, and the least results, against answers known on paper."""

from __future__ import annotations

import sys

import numpy as np
import pytest

import kshm
import reports
from tests.api.test_api import small


def test_the_counterweight_of_a_single_cylinder_takes_half_of_the_reciprocating_mass() -> None:
    """The first order is |C + R - x| along the cylinder and |R - x| across, C = m_j r ω².

    R is what turns, x the counterweights': the greater is least at x = R + C/2, where it is C/2.
    """
    engine = small().with_(counterweight_kg=0)
    bare = kshm.solve(engine.with_({"balancing.counterweight_share": 0.5})).scalars
    best = kshm.optimise(engine, {"counterweight_kg": (0, 2)}, "F1_before_max")
    assert best.values["counterweight_kg"] == pytest.approx(bare["counterweight_web"], abs=1e-6)
    reciprocating = bare["F1_before_max"] - bare["Frot"]
    assert best.result == pytest.approx(reciprocating / 2, rel=1e-6)
    assert kshm.solve(best.engine).scalars["F1_before_max"] == best.result


def test_two_inputs_at_an_edge_and_the_greatest() -> None:
    """The mean speed of the piston is n·S/30: greatest at the greatest speed and stroke."""
    limits = {"speed_rpm": (2000, 3000), "crank_radius_mm": (35, 45)}
    best = kshm.optimise(small(), limits, "kinematics.mean_piston_speed", most=True)
    assert list(best.values.values()) == pytest.approx([3000, 45], rel=1e-7)
    assert best.result == pytest.approx(9.0, rel=1e-7)


@pytest.mark.parametrize(
    ("name", "key", "quantity", "value", "between"),
    [
        ("vaz-2106", "strength.bolt_mm", "st_bolt_n", 2.0, (7, 12)),
        ("gots-diesel", "balance.irregularity", "flywheel.irregularity", 0.02, (0.005, 0.05)),
        ("gots-diesel", "gas.max_pressure_mpa", "P4_1.N_MPa.max", 0.75, (6, 14)),
    ],
)
def test_an_input_that_makes_a_result(name, key, quantity, value, between) -> None:
    engine = reports.load(name, warn=False)
    actual = kshm.solve_for(engine, key, quantity, value, between=between)
    assert actual.result == pytest.approx(value, rel=1e-8)
    study = kshm.sweep(
        engine, {key: [actual.values[key]]}, quantities=[quantity.removesuffix(".max")]
    )
    assert study.iloc[0, 1] == pytest.approx(value, rel=1e-8)


def test_what_cannot_be_sought_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    engine = small()
    speed = "kinematics.mean_piston_speed"
    for said, call in (
        (r"c_m: does not reach 99 between these limits; it goes from 2\.66667 to 8",
         lambda: kshm.solve_for(engine, "speed_rpm", speed, 99, between=(1000, 3000))),
        ("no engine within the limits is solved: bore_mm = -9: Geometry.bore",
         lambda: kshm.solve_for(engine, "bore_mm", speed, 9, between=(-9, -1))),
        ("no engine within the limits",
         lambda: kshm.optimise(engine, {"bore_mm": (-9, -1)}, speed)),
        ("limits must be two numbers that rise",
         lambda: kshm.optimise(engine, {"bore_mm": (9, 1)}, speed)),
        ("from 1 to 3 inputs", lambda: kshm.optimise(engine, {}, speed)),
        ("name one of P4_1", lambda: kshm.optimise(engine, {"bore_mm": (80, 90)}, "P4_1.N_MPa")),
        ("the parts of a column",
         lambda: kshm.optimise(engine, {"bore_mm": (80, 90)}, "P4_1.N_MPa.x")),
    ):  # fmt: skip
        with pytest.raises(kshm.InputError, match=said):
            call()
    monkeypatch.setitem(sys.modules, "scipy", None)
    with pytest.raises(kshm.KshmError, match=r'pip install "kshm\[optimise\]"'):
        kshm.optimise(engine, {"bore_mm": (80, 90)}, speed)
    assert np.isfinite(kshm.solve(engine).torque.mean)
