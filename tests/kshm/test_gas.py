"""The polytropic indicator diagram between the points of the printed tables."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from kshm import solve
from kshm.chain.solve import solve_batch
from tests.textbook.book import solution


def pressures(step_deg: int = 1) -> tuple[np.ndarray, np.ndarray]:
    engine = replace(solution("gots-diesel").engine, step_deg=step_deg)
    raw = solve_batch([engine])
    return np.degrees(raw.phi).round(9), raw.p[0, 0] / 1e6


def at(angle: float) -> float:
    phi, p = pressures()
    return float(p[np.flatnonzero(phi == angle)[0]])


def test_residual_pressure_only_at_the_very_beginning() -> None:
    assert at(0) == at(720) == 0.182
    assert at(1) == at(179) == at(180) == 0.165
    assert at(181) > 0.165


def test_rise_is_a_straight_line_that_ends_at_tdc() -> None:
    steps = [at(angle + 1) - at(angle) for angle in (357, 358, 359)]
    np.testing.assert_allclose(steps, steps[0], rtol=1e-9)
    assert steps[0] > 0.1
    assert at(361) == 10.5  # the isobar begins at once after TDC


def test_isobar_ends_where_the_volume_is_rho_times_the_clearance() -> None:
    engine = solution("gots-diesel").engine
    phi, p = pressures()
    raw = solve_batch([replace(engine, step_deg=1)])
    ratio = 1 + 17 * raw.displacement[0, 0] / (2 * engine.geometry.crank_radius)
    expanding = (phi > 360) & (phi < 498)
    np.testing.assert_array_equal(p[expanding] == 10.5, ratio[expanding] <= 1.366)
    after = expanding & (ratio > 1.366)
    np.testing.assert_allclose(p[after], 10.5 * (1.366 / ratio[after]) ** 1.288, rtol=1e-12)


def test_release_is_a_straight_line_in_the_angle() -> None:
    phi, p = pressures()
    release = (phi >= 498) & (phi <= 565)
    np.testing.assert_allclose(np.diff(p[release], 2), 0, atol=1e-12)
    assert at(565) == at(566) == at(719) == 0.182


def test_an_exhaust_that_opens_on_the_isobar_begins_at_the_greatest_pressure() -> None:
    engine = solution("gots-diesel").engine
    gas = replace(engine.gas, rho=5.0, exhaust_open=math.radians(390))
    early = solve(replace(engine, gas=gas))
    assert early.scalars["x_open"] < gas.rho
    assert early.scalars["p_open"] == early.columns["gas"]["p_MPa"][39] == 10.5


def test_pressure_is_periodic() -> None:
    engine = solution("gots-diesel").engine
    turned = replace(engine, firing_offsets=tuple(o + 4 * math.pi for o in engine.firing_offsets))
    np.testing.assert_allclose(solve_batch([turned]).p, solve_batch([engine]).p, rtol=1e-9)
