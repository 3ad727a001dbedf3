"""Power balance of the turbocharger."""

from dataclasses import replace

import pytest

from kshm.cycle.cycle import cycle
from reports.inputs.to_si.cycle import text_of

BOOSTED = ["turbo_diesel", "turbo_petrol"]


@pytest.mark.parametrize("name", BOOSTED)
def test_compressor_power_is_the_enthalpy_rise_before_the_cooler(engines, name):
    engine = engines[name]
    r = cycle(engine)
    ideal = engine.t_ambient * (engine.boost.pressure_ratio ** (2 / 7) - 1)
    rise = ideal / engine.boost.compressor_efficiency
    expected = r.effective.air_flow * 1005 * rise
    assert r.turbo.compressor_power == pytest.approx(expected, rel=1e-12)
    cooler = engine.boost.cooler_temperature_drop
    assert r.charge.t_k == pytest.approx(r.charge.t_compressor - cooler, rel=1e-14)


@pytest.mark.parametrize("name", BOOSTED)
def test_turbine_at_the_balance_pressure_drives_the_compressor(engines, name):
    engine = engines[name]
    r = cycle(engine)
    turbo, e = r.turbo, (r.turbo.k_gas - 1) / r.turbo.k_gas
    t_t = r.expansion.t_b * (turbo.p_t_balance / r.expansion.p_b) ** e
    p_out = engine.boost.outlet_pressure_ratio * engine.p_ambient
    power = turbo.turbine_flow * engine.boost.exhaust_cp * engine.boost.turbine_efficiency
    power *= t_t * (1 - (p_out / turbo.p_t_balance) ** e)
    assert power == pytest.approx(turbo.compressor_power, rel=1e-10)


@pytest.mark.parametrize("name", BOOSTED)
def test_the_named_c2_nearly_balances_after_recalculation(engines, name):
    engine = engines[name]
    r = cycle(replace(engine, exhaust_factor=cycle(engine).turbo.c2_balance))
    assert r.turbo.turbine_power == pytest.approx(r.turbo.compressor_power, rel=0.05)


@pytest.mark.parametrize("name", BOOSTED)
def test_mass_is_conserved(engines, name):
    r = cycle(engines[name])
    assert r.turbo.turbine_flow == pytest.approx(
        r.effective.air_flow + r.effective.fuel_flow, rel=1e-14
    )
    assert 1.2 < r.turbo.k_gas < 1.4


def test_more_back_pressure_more_turbine_power(diesel):
    powers = [
        cycle(replace(diesel, exhaust_factor=c)).turbo.turbine_power for c in (0.7, 0.9, 1.1, 1.3)
    ]
    assert powers == sorted(powers)


def test_turbine_without_pressure_drop_gives_nothing(diesel):
    weak = replace(diesel, boost=replace(diesel.boost, outlet_pressure_ratio=1.5))
    r = cycle(replace(weak, exhaust_factor=0.8))
    assert r.turbo.turbine_power == 0
    assert r.turbo.p_t_balance > 1.5e5
    assert any("увеличьте C_2" in text_of(w) for w in r.warnings)


def test_exhaust_numbers_are_inputs(diesel):
    base = cycle(diesel).turbo
    other = cycle(replace(diesel, boost=replace(diesel.boost, exhaust_cp=1265.0))).turbo
    assert other.turbine_power == pytest.approx(1.1 * base.turbine_power, rel=1e-12)
