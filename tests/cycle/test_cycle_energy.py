"""The converged method obeys the first law in its own terms."""

import math
from dataclasses import replace

import numpy as np
import pytest

from kshm.cycle.cycle import cycle
from kshm.cycle.diagram import indicator_diagram
from kshm.cycle.dizdn_listing import Listing
from kshm.cycle.fuel import AIR, R_GAS, SPECIES, ZERO_C, mixture_heat, temperature_of
from kshm.cycle.performance import heat_balance
from tests.cycle.energy import cycle_energy


def test_heat_in_is_work_and_heat_out(engine):
    assert abs(cycle_energy(cycle(engine)).gap) < 1e-12


def test_the_listing_mode_does_not_balance(diesel):
    """The program's lag in n_1 and the 380° shift cost more than half a percent."""
    assert abs(cycle_energy(cycle(diesel, Listing())).gap) > 5e-3


def test_compression_is_the_adiabat_of_air(engine):
    result = cycle(engine)
    t_a, t_c = result.charge.t_a, result.compression.t_c
    work = R_GAS * (t_c - t_a) / (result.compression.n_1 - 1)
    assert work == pytest.approx(AIR.energy(t_c - ZERO_C) - AIR.energy(t_a - ZERO_C), rel=1e-12)


def test_expansion_releases_the_late_heat(engine):
    result = cycle(engine)
    comb, exp = result.combustion, result.expansion
    work = comb.mu * R_GAS * (comb.t_z - exp.t_b) / (exp.n_2 - 1)
    fall = comb.products.energy(comb.t_z - ZERO_C) - comb.products.energy(exp.t_b - ZERO_C)
    late = (engine.xi_b - engine.xi_z) * comb.heat
    assert work == pytest.approx(late + comb.mu * fall, rel=1e-11)


def test_state_equation_holds_at_every_corner(engine):
    """p V/T is the same at a and c, and μ times that at z and b."""
    r = cycle(engine)
    eps, rho = engine.compression_ratio, r.combustion.rho
    charge = r.charge.p_a * eps / r.charge.t_a
    assert r.compression.p_c / r.compression.t_c == pytest.approx(charge, rel=1e-12)
    burnt = r.combustion.mu * charge
    assert r.combustion.p_z * rho / r.combustion.t_z == pytest.approx(burnt, rel=1e-12)
    assert r.expansion.p_b * eps / r.expansion.t_b == pytest.approx(burnt, rel=1e-12)


def test_area_of_the_diagram_is_the_theoretical_pressure(engine):
    """Numerically, refining: the error falls with the square of the step."""
    r = cycle(engine)
    errors = []
    for step in (2, 1):
        d = indicator_diagram(r, step)
        area = np.trapezoid(d.pressure, d.volume)
        errors.append(area / r.effective.displacement / r.indicated.p_theory - 1)
    assert abs(errors[1]) < 2e-4
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.15)


def test_efficiency_is_work_over_heat_of_the_fuel(engine):
    r = cycle(engine)
    e = r.effective
    chemical = engine.fuel.heating_value * e.fuel_flow
    assert e.power_i / chemical == pytest.approx(r.indicated.eta_i, rel=1e-12)
    assert e.power_e / chemical == pytest.approx(e.eta_e, rel=1e-12)
    cycles = engine.omega / (4 * math.pi) * engine.cylinders
    assert e.power_i == pytest.approx(r.indicated.p_i * e.displacement * cycles, rel=1e-12)


def test_air_flow_is_what_the_filling_lets_in(engine):
    """G_a from α l_0 G_f against η_v ρ_k V_h i n/120, reached without the fuel."""
    r = cycle(engine)
    density = r.charge.p_k * 28.96 / (1e3 * R_GAS * r.charge.t_k)
    cycles = engine.omega / (4 * math.pi) * engine.cylinders
    mass = r.charge.eta_v * density * r.effective.displacement * cycles
    # With external mixture formation part of the filling is fuel vapour
    mass *= r.mixture.air / r.mixture.fresh
    assert r.effective.air_flow == pytest.approx(mass, rel=1e-12)


def test_heat_balance_adds_up(engine):
    balance = heat_balance(cycle(engine))
    assert sum(balance.shares.values()) == pytest.approx(1, rel=1e-12)
    assert all(0 <= share < 0.6 for share in balance.shares.values())
    assert (balance.incomplete > 0) == (engine.excess_air < 1)
    assert (balance.cooler > 0) == (engine.boost is not None)


def test_pumping_term_is_off_unless_wanted(engine):
    plain, less = cycle(engine), cycle(replace(engine, subtract_pumping=True))
    gap = plain.indicated.p_i - less.indicated.p_i
    assert gap == pytest.approx(plain.charge.p_r - plain.charge.p_a, rel=1e-9)


@pytest.mark.parametrize("name", sorted(SPECIES))
def test_energy_is_continuous_rising_and_true_is_its_slope(name):
    gas = SPECIES[name]
    t = np.arange(0.0, 2800.0, 0.5)
    energy = np.array([gas.energy(x) for x in t])
    step = np.diff(energy) / 0.5
    assert step.min() > 15
    # A jump of 1 % of the energy at 1500 °C would be 600 kJ/(kmol·K) on this grid
    assert step.max() < 70
    for x in (20.0, 900.0, 1450.0, 2000.0):
        slope = (gas.energy(x + 1e-3) - gas.energy(x - 1e-3)) / 2e-3
        assert gas.true(x) == pytest.approx(slope, rel=1e-6)


@pytest.mark.parametrize("t", [5.0, 700.0, 1399.0, 1450.0, 1499.9, 1500.0, 1500.1, 2400.0])
@pytest.mark.parametrize("extra", [0.0, R_GAS])
def test_temperature_is_the_root(t, extra):
    heat = mixture_heat({"CO2": 0.12, "H2O": 0.13, "N2": 0.75})
    content = 1.04 * (heat.mean(t) + extra) * t
    assert temperature_of(heat, content, 1.04, extra) == pytest.approx(t, rel=1e-12)


@pytest.mark.parametrize("name", sorted(SPECIES))
def test_printed_formulas_hold_outside_the_blend(name):
    gas = SPECIES[name]
    (a, b, c), (a_up, b_up) = gas.lower, gas.upper
    assert gas.mean(1400.0) == pytest.approx(a + b * 1400 + c * 1400**2, rel=1e-14)
    assert gas.mean(1500.0) == pytest.approx(a_up + b_up * 1500, rel=1e-14)
    half = (a + b * 1450 + c * 1450**2 + a_up + b_up * 1450) / 2
    assert gas.mean(1450.0) == pytest.approx(half, rel=1e-14)


def test_exhaust_carries_enthalpy_above_the_charge(engine):
    r = cycle(engine)
    t_r, t_k = engine.t_residual - ZERO_C, r.charge.t_k - ZERO_C
    out = r.mixture.products * (r.combustion.products.mean(t_r) + R_GAS) * t_r
    come = r.mixture.fresh * (AIR.mean(t_k) + R_GAS) * t_k
    flow = r.effective.fuel_flow
    assert heat_balance(r).exhaust == pytest.approx(1e3 * flow * (out - come), rel=1e-12)
    assert heat_balance(r).total == pytest.approx(flow * engine.fuel.heating_value, rel=1e-14)


# Mean heat capacities worked out by hand from the two columns at 1000 and 2000 °C
TABLE = {
    "air": (23.238, 25.285),
    "O2": (24.731, 26.823),
    "N2": (22.898, 24.865),
    "H2": (21.478, 23.194),
    "CO": (23.267, 25.350),
    "CO2": (41.454, 45.821),
    "H2O": (30.312, 35.546),
}


@pytest.mark.parametrize("name", sorted(SPECIES))
def test_heat_capacities_of_the_species(name):
    collected = [SPECIES[name].mean(t) for t in (1000.0, 2000.0)]
    assert collected == pytest.approx(TABLE[name], abs=5e-4)
