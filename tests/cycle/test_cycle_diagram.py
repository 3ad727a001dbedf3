"""Points of the indicator diagram and the gas pressure for the dynamics."""

from dataclasses import replace

import numpy as np
import pytest

from kshm.cycle.cycle import cycle
from kshm.cycle.diagram import indicator_diagram, isobar_angle, polytropic_gas
from kshm.cycle.dizdn_listing import Listing
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


def test_work_of_the_diagram_is_p_theory(engine):
    r = cycle(engine)
    d = indicator_diagram(r, 1)
    work = np.trapezoid(d.pressure, d.volume) / r.effective.displacement
    assert work == pytest.approx(r.indicated.p_theory, rel=3e-4)


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
