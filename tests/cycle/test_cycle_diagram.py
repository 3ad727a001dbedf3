"""Points of the indicator diagram and the gas pressure for the dynamics."""

import math
from dataclasses import replace

import numpy as np
import pytest

from kshm.cycle.cycle import Listing, cycle
from kshm.cycle.diagram import indicator_diagram, isobar_angle, polytropic_gas, tabulated_gas
from tests.cycle.refusals import refused


def test_corners(engine):
    r = cycle(engine)
    d = indicator_diagram(r, 10)
    v_c = r.effective.displacement / (engine.compression_ratio - 1)
    a, b = 0, -1
    c = int(np.searchsorted(d.phi, 2 * np.pi))
    assert d.pressure[a] == pytest.approx(r.charge.p_a, rel=1e-12)
    assert d.temperature[a] == pytest.approx(r.charge.t_a, rel=1e-12)
    assert d.pressure[b] == pytest.approx(r.expansion.p_b, rel=1e-12)
    assert d.temperature[b] == pytest.approx(r.expansion.t_b, rel=1e-12)
    assert d.volume[[a, b]] / v_c == pytest.approx(engine.compression_ratio, rel=1e-12)
    assert d.pressure[c] == pytest.approx(r.compression.p_c, rel=1e-12)
    assert d.pressure[c + 1] == r.combustion.p_z
    assert d.phi[c] == d.phi[c + 1] == 2 * np.pi
    assert d.volume[c] == pytest.approx(v_c, rel=1e-12)


def test_point_z_stands_where_the_volume_is_rho(engine):
    r = cycle(engine)
    d = indicator_diagram(r, 10)
    z = int(np.flatnonzero(d.phi == isobar_angle(r))[-1])
    v_c = r.effective.displacement / (engine.compression_ratio - 1)
    assert d.volume[z] / v_c == pytest.approx(r.combustion.rho, rel=1e-12)
    assert d.pressure[z] == pytest.approx(r.combustion.p_z, rel=1e-12)
    assert d.temperature[z] == pytest.approx(r.combustion.t_z, rel=1e-12)


def test_gas_law_on_every_point(engine):
    r = cycle(engine)
    d = indicator_diagram(r, 1)
    moles = d.pressure * d.volume / d.temperature
    c = int(np.searchsorted(d.phi, 2 * np.pi))
    assert np.allclose(moles[: c + 1] / moles[0], 1, rtol=1e-11)
    assert np.allclose(moles[c + 1 :] / moles[0], r.combustion.mu, rtol=1e-11)


def test_arrays_are_read_only_and_on_the_grid(engine):
    d = indicator_diagram(cycle(engine), 10)
    with pytest.raises(ValueError, match="read-only"):
        d.pressure[0] = 0
    assert {round(x) for x in np.degrees(d.phi)} >= set(range(180, 541, 10))
    assert np.all(np.diff(d.phi) >= 0)


@pytest.mark.parametrize("step", [0, -5, 7, 200])
def test_step_must_divide(engine, step):
    with refused("делитель числа 180"):
        indicator_diagram(cycle(engine), step)


def test_gas_of_the_dynamics_covers_the_cycle(engine):
    r = cycle(engine)
    gas = tabulated_gas(r, 1)
    angles, p = np.array(gas.angles), np.array(gas.pressures)
    assert np.all(np.diff(angles) > 0)
    assert (angles[0], angles[-1]) == (0.0, 4 * math.pi)
    assert p[0] == p[-1] == r.charge.p_r
    at = np.radians([90.0, 180.0, 360.0, 540.0, 630.0])
    expected = [r.charge.p_a, r.charge.p_a, r.combustion.p_z, r.expansion.p_b, r.charge.p_r]
    assert np.interp(np.mod(at, angles[-1]), angles, p) == pytest.approx(expected, rel=1e-9)


def test_work_of_the_gas_is_p_theory_less_pumping(engine):
    r = cycle(engine)
    gas = tabulated_gas(r, 1)
    angles = np.array(gas.angles)
    s = 1 + 1 / engine.lam - np.cos(angles) - np.sqrt(1 / engine.lam**2 - np.sin(angles) ** 2)
    work = np.trapezoid(np.array(gas.pressures), s / 2)
    expected = r.indicated.p_theory - (r.charge.p_r - r.charge.p_a)
    assert work == pytest.approx(expected, rel=3e-4)


def test_peak_factor_cuts_the_top(gasoline):
    r = cycle(gasoline)
    cut = np.array(tabulated_gas(r, peak_factor=0.85).pressures)
    full = np.array(tabulated_gas(r).pressures)
    assert cut.max() == pytest.approx(0.85 * r.combustion.p_z)
    below = full < 0.85 * r.combustion.p_z
    assert np.array_equal(cut[below], full[below])


def test_polytropic_gas_takes_the_numbers_of_the_cycle(engine):
    r = cycle(engine)
    gas = polytropic_gas(
        r, ignition_advance=0.3, combustion_start=6.2, exhaust_open=8.6, exhaust_close=9.8
    )
    assert (gas.p_intake, gas.p_residual, gas.p_max) == (
        r.charge.p_a,
        r.charge.p_r,
        r.combustion.p_z,
    )
    assert (gas.n_compression, gas.n_expansion) == (r.compression.n_1, r.expansion.n_2)
    assert gas.rho == r.combustion.rho
    assert (gas.ignition_advance, gas.exhaust_close) == (0.3, 9.8)


def test_listing_mode_has_its_own_grid(diesel):
    d = indicator_diagram(cycle(diesel, Listing()))
    degrees = np.degrees(d.phi)
    assert degrees.size == 55
    assert list(np.round(degrees[18:22])) == [360, 361, 362, 363]


def test_grid_of_a_short_isobar_in_listing_mode(diesel):
    short = cycle(replace(diesel, p_max=12.5e6), Listing())
    degrees = np.degrees(indicator_diagram(short).phi)
    assert np.all(np.diff(degrees) > 0.5)
    assert degrees[-1] == pytest.approx(540)
