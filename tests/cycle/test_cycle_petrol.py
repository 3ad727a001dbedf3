"""The petrol variant: figures of a usual engine, rich mixtures, vapour.

No printed petrol reference exists; the expected figures are the sanity numbers of the
method at ε = 9.5, α = 0.96.
"""

from dataclasses import replace

import pytest

from kshm.cycle.cycle import cycle
from kshm.cycle.performance import heat_balance
from kshm.nomenclature.dizdn_listing import value_of
from kshm.ranges import cycle_ranges


def test_sanity_figures(gasoline):
    """The other inputs of that run are not known: 2 %, 5 % in pressures."""
    r = cycle(gasoline)
    assert r.combustion.t_z == pytest.approx(2809, rel=0.01)
    assert r.combustion.p_z / 1e6 == pytest.approx(7.32, rel=0.05)
    assert r.expansion.n_2 == pytest.approx(1.243, rel=0.01)
    assert r.indicated.p_i / 1e6 == pytest.approx(1.10, rel=0.05)
    assert r.t_residual_check == pytest.approx(1043, rel=0.03)
    assert r.warnings == ()


def test_figures_to_the_digit(gasoline):
    """Pinned so that a change shows; the equations are proved by the energy tests."""
    r = cycle(gasoline)
    assert r.combustion.t_z == pytest.approx(2807.5153, abs=0.001)
    assert r.combustion.p_z == pytest.approx(7.2715439e6, rel=1e-6)
    assert r.expansion.n_2 == pytest.approx(1.23399292, rel=1e-6)


def test_burns_at_constant_volume(gasoline):
    r = cycle(gasoline)
    assert (r.combustion.rho, r.combustion.delta) == (1.0, 9.5)
    ratio = r.combustion.mu * r.combustion.t_z / r.compression.t_c
    assert r.combustion.p_z == pytest.approx(ratio * r.compression.p_c, rel=1e-14)


def test_usual_engine_is_inside_the_usual_ranges(gasoline):
    result = cycle(gasoline)
    outside = {
        key
        for key, (low, high), _ in cycle_ranges(gasoline.kind, boosted=False)
        if not low - 1e-9 <= value_of(result, key) <= high + 1e-9
    }
    # The old tables know T_c only up to 750 K; ε = 9.5 gives a little more
    assert outside <= {"compression.t_c"}


def test_rich_mixture_loses_heat_and_economy(gasoline):
    runs = [cycle(replace(gasoline, excess_air=a)) for a in (0.8, 0.9, 1.0)]
    losses = [heat_balance(r).shares["incomplete"] for r in runs]
    assert losses == sorted(losses, reverse=True)
    assert losses[-1] == 0
    consumption = [r.effective.g_e for r in runs]
    assert consumption == sorted(consumption, reverse=True)
    # The work itself hardly changes: more fuel, burnt less completely
    work = [r.indicated.p_i for r in runs]
    assert max(work) / min(work) < 1.08


def test_vapour_takes_place_in_the_charge(gasoline):
    r = cycle(gasoline)
    assert r.mixture.fresh == pytest.approx(r.mixture.air + 1 / 115, rel=1e-14)
    assert r.mixture.air == pytest.approx(0.96 * gasoline.fuel.stoichiometric_air, rel=1e-14)


def test_boost_raises_power_and_needs_lower_compression(engines):
    base, boosted = cycle(engines["petrol"]), cycle(engines["turbo_petrol"])
    assert boosted.effective.power_e > 1.3 * base.effective.power_e
    assert boosted.turbo is not None
    assert base.turbo is None
