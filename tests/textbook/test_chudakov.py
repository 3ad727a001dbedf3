"""Chudakov and Zharnov: torque harmonics, the Д-50, zones, suppression by shafts.

@article{chudakov,
  author = {Чудаков, Д. А. and Жарнов, Э. М.},
  title  = {Об уравновешивании тракторных четырехцилиндровых дизелей},
}
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings

from kshm import solve
from kshm.engine.engine import Engine
from kshm.mechanics import balance, harmonics
from kshm.nomenclature.quantity import quantity
from tests.kshm.engines import basic_engines
from tests.textbook.book import beyond, checks, recorded, solution

PHI = np.arange(0, 721) * np.pi / 180
D50 = 19.2  # kg/m: 192 gf·cm/cm²
KGF = 98100.0  # Pa in kgf/cm² with the text's g = 981 cm/s²


def omega(rpm: float) -> float:
    return rpm * np.pi / 30


def test_constant_c_and_the_d50_at_1630() -> None:
    """c = 0.5π²/(900g) = 5.5893e-6; t_j2(192, 1630) = 2.851 kgf/cm²."""
    c = 0.5 * np.pi**2 / (900 * 981)
    assert c == pytest.approx(5.5893e-6, abs=5e-11)
    t_j = float(harmonics.inertia_second(np.array(D50), np.array(omega(1630)))) / KGF
    assert t_j == pytest.approx(2.851, abs=5e-4)
    assert t_j == pytest.approx(c * 192 * 1630**2 / 1000, rel=1e-12)


def test_suppression_at_1630_implies_the_gas_coefficient() -> None:
    """ψ = 0.4 at 1630 implies t_г2 = 1.71; ψ = 1 helps only above about 1790 rpm."""
    t_j = float(harmonics.inertia_second(np.array(D50), np.array(omega(1630))))
    gas = 1.71 * KGF
    best = harmonics.best_suppression(np.array(gas), np.array(t_j))
    assert float(best) == pytest.approx(0.4, abs=5e-3)
    assert 0.6 * t_j / KGF == pytest.approx(1.71, abs=5e-3)
    speeds = omega(np.arange(1200.0, 3001.0))
    t = harmonics.inertia_second(np.array(D50), speeds)
    helps = harmonics.residual(gas, t, 1.0) < harmonics.residual(gas, t, 0.0)
    assert np.arange(1200, 3001)[helps][0] == pytest.approx(1790, abs=5)
    assert float(harmonics.best_suppression(np.array(gas), t[helps][0])) == pytest.approx(
        0.5, abs=2e-3
    )


def test_numbers_of_the_text() -> None:
    """The second order, its phase and h = ψL; the rest rests on a curve that is not printed."""
    assert len(checks("chudakov_text")) == 7
    assert beyond("chudakov_text") == recorded("chudakov_text")
    assert {row for row, _ in beyond("chudakov_text")} == {
        "gamma_gas", "shaft_force", "psi_1630", "speed_helps",
    }  # fmt: skip


@pytest.mark.parametrize("psi", [0, 0.2, 0.4, 0.6, 0.8, 1])
def test_coefficient_of_the_d50_over_the_speed(psi: float) -> None:
    """Figure 4: without gases what is left is (1 - ψ) of t_j2."""
    rpm = np.arange(1200, 3001, 200)
    t_j = harmonics.inertia_second(np.array(D50), omega(rpm))
    expected = (1 - psi) * 0.5 * np.pi**2 / (900 * 981) * 192 * rpm**2 / 1000
    assert harmonics.residual(0.0, t_j, psi) / KGF == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("lam", [0.2, 0.25, 0.3])
def test_inertia_harmonics_of_the_two_term_motion(lam: float) -> None:
    """λ/4, −1/2, −3λ/4, −λ²/4 times m r²ω², and nothing else."""
    acceleration = np.cos(PHI) + lam * np.cos(2 * PHI)
    velocity = np.sin(PHI) + lam / 2 * np.sin(2 * PHI)
    orders = np.arange(1, 17) / 2
    actual = harmonics.analyse(-acceleration * velocity, 4 * np.pi, orders)
    expected = np.zeros(16)
    expected[[1, 3, 5, 7]] = harmonics.inertia_coefficients(lam)
    assert actual.sine == pytest.approx(expected, abs=1e-14)
    assert actual.cosine == pytest.approx(np.zeros(16), abs=1e-14)


@pytest.mark.parametrize("lam", [0.2, 0.3, 0.4])
def test_exact_second_order_is_half_and_a_thirty_second_of_lambda_to_the_fourth(lam: float) -> None:
    """0.5 + λ⁴/32 to the next power, from exact acceleration and exact velocity."""
    along = np.sqrt(1 / lam**2 - np.sin(PHI) ** 2)
    velocity = np.sin(PHI) * (1 + np.cos(PHI) / along)
    orders = np.arange(1, 60, dtype=float)
    j = sum(
        harmonics.acceleration_amplitude(lam, n) * np.cos(n * PHI) for n in (1, *range(2, 60, 2))
    )
    actual = harmonics.analyse(-j * velocity, 4 * np.pi, orders)
    assert actual.amplitude[1] == pytest.approx(0.5 + lam**4 / 32, abs=lam**6 / 16)
    assert actual.amplitude[1] > 0.5
    assert abs(actual.phase[1]) == pytest.approx(np.pi)


@settings(max_examples=20)
@given(basic_engines())
def test_harmonics_of_the_engine_are_the_cylinders_times_the_vector_sum(engine: Engine) -> None:
    """Amplitudes against a transform of the summed torque itself."""
    solved = solve(engine)
    table = solved.columns["torque_orders"]
    direct = harmonics.analyse(solved.columns["P4_2"]["Msum_Nm"], engine.period, table["order"])
    # On the grid a shift by the firing offset is exact only for offsets on the grid.
    shift = np.degrees(np.array(engine.firing_offsets)) / engine.step_deg
    if np.abs(shift - np.rint(shift)).max() < 1e-6:
        scale = max(1.0, float(np.abs(solved.columns["P4_2"]["Msum_Nm"]).max()))
        np.testing.assert_allclose(
            table["M_engine_order_Nm"], direct.amplitude, atol=1e-8 * scale * engine.cylinders
        )


def test_parseval_over_all_orders() -> None:
    """Mean square of the tangential force = mean² + half the sum of squared amplitudes."""
    engine = replace(solution("d-240").engine, step_deg=10)
    curve = solve(engine).columns["tangential"]["t_gas_MPa"]
    orders = np.arange(1, 36) / 2
    actual = harmonics.analyse(curve, 4 * np.pi, orders)
    body = curve[:-1]
    # The highest of 72 samples' orders (18) counts once.
    last = (body * (-1.0) ** np.arange(72)).mean()
    power = body.mean() ** 2 + (actual.amplitude**2).sum() / 2 + last**2
    assert (body**2).mean() == pytest.approx(power, rel=1e-12)


def test_order_two_of_four_cylinders_adds_up_and_order_one_vanishes() -> None:
    table = solution("d-240").columns["torque_orders"]
    sums = dict(zip(table["order"], table["cylinders_sum"], strict=True))
    assert sums[2.0] == pytest.approx(4, abs=1e-12)
    assert sums[4.0] == pytest.approx(4, abs=1e-12)
    for order in (0.5, 1.0, 1.5, 2.5, 3.0, 3.5):
        assert sums[order] < 1e-12


def test_gas_and_inertia_harmonics_of_a_diesel_oppose_each_other() -> None:
    """γ_j2 = 180°; the phase of a diesel's gas harmonic is a few degrees from zero."""
    scalars = solution("d-240").scalars
    assert scalars["gamma_inertia2_deg"] == pytest.approx(180, abs=1e-6)
    assert abs(scalars["gamma_gas2_deg"]) < 30
    assert scalars["t_inertia2"] == pytest.approx(scalars["t_j2"], rel=0.02)


def test_zones_and_suppression_of_an_engine() -> None:
    solved = solution("d-240")
    scalars, table = solved.scalars, solved.columns["suppression"]
    d_j = scalars["d_j"]
    for key, speed in (("t_gas2_idle", "n_zone1"), ("t_gas2", "n_zone2")):
        t_j = harmonics.inertia_second(np.array(d_j), np.array(omega(scalars[speed])))
        assert float(t_j) == pytest.approx(1e6 * scalars[key], rel=1e-9)
    rpm = solved.engine.speed_rpm
    expected = 1 + (rpm > scalars["n_zone1"]) + (rpm > scalars["n_zone2"])
    assert scalars["zone"] == expected
    assert (np.diff(table["psi_best"]) >= 0).all()
    assert (table["psi_best"][table["n_rpm"] < scalars["n_zone2"]] == 0).all()
    left = np.abs(scalars["t_gas2"] - (1 - table["psi_best"]) * table["t_j2_MPa"])
    assert left[table["psi_best"] > 0] == pytest.approx(0, abs=1e-12)
    assert (table["residual_vector_MPa"] >= table["residual_psi_MPa"] - 1e-12).all()


def test_shift_of_the_shafts_needs_half_the_force_on_each() -> None:
    """P_ц·h = ψ·M_j2 with P_ц = 0.5·λ m_j R ω² of one shaft gives h = ψL.

    The printed 0.5·P_ц = 0.5·λ m_j R ω² makes P_ц twice as great and h half of that.
    """
    engine = solution("d-240").engine
    actual = balance.cylinders_of(engine)
    force, _ = balance.reciprocating(engine, actual, 2)
    scalars = solution("d-240").scalars
    moment = 4 * 1e6 * scalars["t_j2"] * scalars["F_piston"] * scalars["r_crank"]
    psi = engine.balancing.suppression
    assert scalars["h_shafts"] / 1000 == pytest.approx(psi * scalars["L_rod"], rel=1e-12)
    assert psi * moment / (1000 * scalars["P_shafts"]) == pytest.approx(psi * scalars["L_rod"])
    # Two shafts hold the pistons' second-order force, exact up to λ²/4.
    lam = scalars["lam"]
    assert abs(force[0]) == pytest.approx(2 * 1000 * scalars["P_shafts"], rel=lam**2 / 3)


def test_unknowable_orders_are_refused() -> None:
    with pytest.raises(ValueError, match="orders must be"):
        harmonics.analyse(np.zeros(25), 4 * np.pi, np.array([6.0]))
    with pytest.raises(ValueError, match="orders must be"):
        harmonics.analyse(np.zeros(73), 4 * np.pi, np.array([0.3]))


def test_what_differs_has_symbols_that_differ():
    """Coefficients of the series, of two terms, of the article, in its unit: one list has all."""
    keys = ("t_inertia2", "t_j2", "t_j_order2", "d_j", "d_j_technical", "gas_phase_deg")
    collected = [quantity(key) for key in keys]
    assert len({q.symbol for q in collected}) == len({q.tex for q in collected}) == len(keys)
    assert collected[-1].tex.startswith(r"\gamma")  # as the text of the chapter has it
