"""Limits of the cycle that are known without calculating it."""

import math
from dataclasses import replace

import pytest

from kshm.cycle.cycle import cycle
from kshm.cycle.fuel import AIR, FUELS, ZERO_C, burn, mixture_heat
from kshm.cycle.processes import compress, fill, ignite
from tests.cycle.refusals import refused

ALPHAS = [10.0, 100.0, 1e4, 1e6]


def burnt(inputs, alpha, xi_z=None):
    """Combustion at any α, past the check of the inputs."""
    inputs = replace(inputs, excess_air=alpha, xi_z=inputs.xi_z if xi_z is None else xi_z)
    mixture = burn(inputs.fuel, alpha, external=inputs.external)
    charge = fill(inputs)
    compression = compress(charge, inputs.compression_ratio)
    if inputs.p_max is not None:
        inputs = replace(inputs, p_max=compression.p_c * (1 + 1e-9))
    return compression, ignite(inputs, mixture, charge, compression, mixture_heat(mixture.shares))


@pytest.mark.parametrize("name", ["turbo_diesel", "petrol"])
def test_much_air_leaves_air_and_no_rise(engines, name):
    """At constant volume; a diesel at p_z = p_c would have ρ < 1 in the end."""
    engine = replace(engines[name], p_max=None)
    rises, molecular = [], []
    for alpha in ALPHAS:
        compression, combustion = burnt(engine, alpha)
        rises.append(combustion.t_z / compression.t_c - 1)
        molecular.append(combustion.mu - 1)
    assert rises == sorted(rises, reverse=True)
    assert abs(rises[-1]) < 2e-3
    assert abs(molecular[-1]) < 1e-6


def test_much_air_at_constant_pressure(diesel):
    """The rise falls as 1/α, at ρ → 1."""
    collected = [burnt(diesel, alpha) for alpha in (25.0, 50.0, 100.0)]
    rises = [combustion.t_z - compression.t_c for compression, combustion in collected]
    assert rises[0] / rises[1] == pytest.approx(2, rel=0.1)
    assert rises[1] / rises[2] == pytest.approx(2, rel=0.15)
    assert collected[-1][1].rho == pytest.approx(1, abs=0.03)


def test_products_of_much_air_are_air():
    """O2 and N2 mixed, as far as the table's own lines agree."""
    products = mixture_heat(burn(FUELS["diesel"], 1e6, external=False).shares)
    assert products.mean(700.0) == pytest.approx(AIR.mean(700.0), rel=3e-3)


def test_no_heat_used_means_no_combustion_rise(gasoline):
    """ξ_z = 0: only the moles and the composition change, the energy does not."""
    compression, combustion = burnt(gasoline, 1e6, xi_z=0.0)
    assert combustion.t_z == pytest.approx(compression.t_c, rel=2e-3)
    compression, combustion = burnt(gasoline, 1.5, xi_z=0.0)
    assert abs(combustion.t_z / compression.t_c - 1) < 0.08


def test_no_heat_used_raises_no_pressure_in_a_diesel(diesel):
    with refused("ρ < 1"):
        cycle(replace(diesel, xi_z=0.0))


def test_combustion_rise_is_linear_in_xi_for_small_xi(engines):
    rises = []
    for xi in (0.0, 1e-3, 2e-3):
        compression, combustion = burnt(engines["petrol"], 1.0, xi_z=xi)
        rises.append(combustion.t_z - compression.t_c)
    assert rises[1] > rises[0]
    assert rises[2] - rises[1] == pytest.approx(rises[1] - rises[0], rel=1e-2)


def test_diesel_at_its_highest_pressure_burns_like_petrol(diesel):
    """ρ → 1: the constant-pressure part vanishes and T_z is that of constant volume."""
    mixture = burn(diesel.fuel, diesel.excess_air, external=False)
    products = mixture_heat(mixture.shares)
    charge = fill(diesel)
    compression = compress(charge, diesel.compression_ratio)
    volume = ignite(replace(diesel, p_max=None), mixture, charge, compression, products)
    top = replace(diesel, p_max=volume.p_z * (1 - 1e-10))
    limit = ignite(top, mixture, charge, compression, products)
    assert limit.rho == pytest.approx(1, abs=1e-8)
    assert limit.t_z == pytest.approx(volume.t_z, rel=1e-8)


def test_nothing_late_means_adiabatic_expansion(diesel):
    """ξ_b = ξ_z: no heat enters, R ΔT/(n_2 − 1) is the fall of energy."""
    result = cycle(replace(diesel, xi_b=diesel.xi_z))
    comb, exp = result.combustion, result.expansion
    u_z, u_b = (comb.products.energy(t - ZERO_C) for t in (comb.t_z, exp.t_b))
    assert exp.n_2 - 1 == pytest.approx(8.315 * (comb.t_z - exp.t_b) / (u_z - u_b), rel=1e-12)


def test_more_late_heat_flattens_the_expansion(diesel):
    exponents = [cycle(replace(diesel, xi_b=xi)).expansion.n_2 for xi in (0.80, 0.84, 0.90, 0.95)]
    assert exponents == sorted(exponents, reverse=True)


def test_compressor_without_boost_is_no_compressor(diesel):
    """π_k = 1 without cooler or losses is the naturally aspirated engine."""
    idle = replace(
        diesel.boost, pressure_ratio=1.0, cooler_pressure_loss=0.0, cooler_temperature_drop=0.0
    )
    boosted, natural = (cycle(replace(diesel, boost=b, p_max=8e6)) for b in (idle, None))
    assert boosted.indicated == natural.indicated
    assert boosted.turbo.compressor_power == 0
    assert natural.turbo is None


def test_residual_gas_vanishes_with_full_scavenging(diesel):
    result = cycle(replace(diesel, scavenging=0.0))
    assert result.charge.gamma == 0
    assert result.charge.t_a == pytest.approx(result.charge.t_k + diesel.charge_heating)
    assert result.combustion.mu == result.mixture.mu_0


def test_rich_mixture_conserves_every_element():
    for alpha in (0.7, 0.85, 0.99, 1.0, 1.2):
        fuel = FUELS["ethanol"]
        m = burn(fuel, alpha, external=True, h2_co=0.47)
        assert m.co2 + m.co == pytest.approx(fuel.carbon / 12, rel=1e-12)
        assert m.h2o + m.h2 == pytest.approx(fuel.hydrogen / 2, rel=1e-12)
        oxygen = m.co2 + m.co / 2 + m.h2o / 2 + m.o2
        assert oxygen == pytest.approx(0.208 * m.air + fuel.oxygen / 32, rel=1e-12)
        assert m.n2 == pytest.approx(0.792 * m.air, rel=1e-12)
        assert math.isclose(sum(m.shares.values()), 1, rel_tol=1e-12)
        if alpha < 1:
            assert m.h2 / m.co == pytest.approx(0.47, rel=1e-12)


@pytest.mark.parametrize("name", sorted(FUELS))
def test_lean_and_rich_products_meet_at_alpha_one(name):
    below, above = (burn(FUELS[name], 1 + d, external=True) for d in (-1e-12, 1e-12))
    assert below.products == pytest.approx(above.products, rel=1e-10)
    assert below.heat_loss == pytest.approx(0, abs=1)


@pytest.mark.parametrize("name", ["ethanol", "methane"])
def test_pure_fuels_have_the_composition_of_their_molecule(name):
    atoms = {"ethanol": (2, 6, 1), "methane": (1, 4, 0)}[name]
    mass = 12.011 * atoms[0] + 1.008 * atoms[1] + 15.999 * atoms[2]
    fuel = FUELS[name]
    assert fuel.carbon == pytest.approx(12.011 * atoms[0] / mass, abs=2e-4)
    assert fuel.hydrogen == pytest.approx(1.008 * atoms[1] / mass, abs=2e-4)
    assert fuel.oxygen == pytest.approx(15.999 * atoms[2] / mass, abs=2e-4)
    assert fuel.vapour_molar_mass == pytest.approx(mass, abs=0.01)


def test_stoichiometric_air_of_the_listing():
    fuel = FUELS["diesel"]
    assert fuel.stoichiometric_air == pytest.approx(0.4994, abs=5e-5)
    assert fuel.stoichiometric_air_mass == pytest.approx(14.46, abs=5e-3)
    assert burn(fuel, 1.45, external=False).mu_0 == pytest.approx(1.04367, abs=5e-6)


@pytest.mark.parametrize("h2_co", [0.3, 20.0])
def test_too_little_air_even_for_incomplete_combustion(h2_co):
    """Small H2/CO runs out of carbon, large H2/CO out of hydrogen."""
    fuel = FUELS["petrol"]
    limit = 1 - min(fuel.carbon / 12, fuel.hydrogen / 2 / h2_co) * (1 + h2_co) / (
        2 * 0.208 * fuel.stoichiometric_air
    )
    assert burn(fuel, limit + 1e-6, external=True, h2_co=h2_co)
    with refused("увеличьте α"):
        burn(fuel, limit - 1e-6, external=True, h2_co=h2_co)
