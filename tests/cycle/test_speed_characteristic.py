"""External speed characteristic by Leiderman and the regimes derived from it."""

import math

import numpy as np
import pytest

from kshm.cycle.speed_characteristic import (
    LEIDERMAN,
    Leiderman,
    curve,
    from_adaptability,
    speed_points,
)
from kshm.errors import CycleError
from reports.inputs.to_si.cycle import text_of
from tests.cycle.refusals import refused

RATED = 4400 * math.pi / 30
POWER, G_E = 70e3, 263 / 3.6e9


@pytest.mark.parametrize("name", sorted(LEIDERMAN))
def test_rated_point_is_met(name):
    law = LEIDERMAN[name]
    actual = curve(POWER, RATED, G_E, law, np.array([RATED]))
    assert actual.power[0] == pytest.approx(POWER, rel=1e-12)
    assert actual.torque[0] == pytest.approx(POWER / RATED, rel=1e-12)
    assert actual.consumption[0] == pytest.approx(G_E, rel=1e-12)
    assert actual.fuel_flow[0] == pytest.approx(G_E * POWER, rel=1e-12)


@pytest.mark.parametrize("name", sorted(LEIDERMAN))
def test_torque_peaks_at_k_c_with_k(name):
    law = LEIDERMAN[name]
    actual = curve(POWER, RATED, G_E, law, np.linspace(0.2, 1.0, 8001) * RATED)
    best = int(np.argmax(actual.torque))
    assert actual.omega[best] / RATED == pytest.approx(actual.speed_ratio, abs=2e-4)
    assert actual.torque[best] * RATED / POWER == pytest.approx(actual.adaptability, rel=1e-7)
    assert np.allclose(actual.power, actual.torque * actual.omega)
    assert np.all(actual.consumption > 0)


def test_k_and_k_c_of_the_textbook():
    """Gots 2.9: K = 1.2 at least, n_M = 2400 of 4400."""
    law = from_adaptability(1.2, 2400 / 4400, LEIDERMAN["diesel"])
    assert law.adaptability == pytest.approx(1.2, rel=1e-12)
    assert law.x_torque == pytest.approx(0.5454545, rel=1e-6)
    assert law.a + law.b - law.c == pytest.approx(1, rel=1e-12)
    assert law.source == "derived"
    # The usual diesel falls a little short of the wanted 1.2
    assert LEIDERMAN["diesel"].adaptability == pytest.approx(1.189, abs=5e-4)
    assert LEIDERMAN["diesel"].x_torque == pytest.approx(0.565)


def test_from_adaptability_inverts():
    base = LEIDERMAN["petrol"]
    law = from_adaptability(base.adaptability, base.x_torque, base)
    assert (law.a, law.b, law.c) == pytest.approx((base.a, base.b, base.c), rel=1e-12)


@pytest.mark.parametrize(
    ("k", "k_c", "field"),
    [(1.0, 0.5, "adaptability"), (1.2, 1.0, "speed_ratio"), (1.9, 0.8, "adaptability")],
)
def test_impossible_k(k, k_c, field):
    with pytest.raises(CycleError) as caught:
        from_adaptability(k, k_c, LEIDERMAN["diesel"])
    assert caught.value.remark.field == field


def test_regimes_are_derived_and_marked():
    law = LEIDERMAN["diesel"]
    rated, torque, idle = speed_points(POWER, RATED, law, kind="diesel")
    assert not rated.derived
    assert torque.derived
    assert idle.derived
    assert torque.omega == pytest.approx(0.565 * RATED)
    assert torque.torque == pytest.approx(law.adaptability * rated.torque, rel=1e-12)
    assert torque.power == pytest.approx(torque.torque * torque.omega)
    assert idle.torque == 0


def test_given_regimes_are_kept():
    n_m, n_i = 2400 * math.pi / 30, 800 * math.pi / 30
    _, torque, idle = speed_points(
        POWER, RATED, LEIDERMAN["diesel"], kind="diesel", omega_torque=n_m, omega_idle=n_i
    )
    assert (torque.omega, idle.omega) == (n_m, n_i)
    assert not torque.derived
    assert not idle.derived


def test_regimes_out_of_order():
    with refused("возрастать"):
        speed_points(POWER, RATED, LEIDERMAN["diesel"], kind="diesel", omega_torque=2 * RATED)
    with refused("возрастать"):
        speed_points(POWER, RATED, LEIDERMAN["diesel"], kind="diesel", omega_idle=0.9 * RATED)


def test_curves_are_read_only():
    actual = curve(POWER, RATED, G_E, LEIDERMAN["petrol"], np.array([100.0, 200.0]))
    with pytest.raises(ValueError, match="read-only"):
        actual.torque[0] = 0


@pytest.mark.parametrize(
    ("name", "torque", "consumption"),
    [("petrol", 1.25, 0.85), ("diesel", 1.185, 1.025), ("diesel_swirl", 1.10, 1.025)],
)
def test_half_speed(name, torque, consumption):
    actual = curve(POWER, RATED, G_E, LEIDERMAN[name], np.array([RATED / 2]))
    assert actual.torque[0] * RATED / POWER == pytest.approx(torque, rel=1e-12)
    assert actual.consumption[0] / G_E == pytest.approx(consumption, rel=1e-12)
    assert actual.fuel_flow[0] / G_E / POWER == pytest.approx(torque * consumption / 2, rel=1e-12)


def test_torque_that_still_rises_at_the_rated_speed():
    law = Leiderman(0.2, 1.2, 0.4, (1.2, -1.2, 1.0), "memory")
    assert (law.x_torque, law.adaptability) == (1.0, pytest.approx(1.0))


@pytest.mark.parametrize(("kind", "share"), [("diesel", 0.20), ("petrol", 0.16)])
def test_idle_is_a_share_of_the_rated_speed(kind, share):
    _, _, idle = speed_points(POWER, RATED, LEIDERMAN[kind], kind=kind)
    assert idle.omega == pytest.approx(share * RATED)


def test_message_names_the_three_speeds():
    with pytest.raises(CycleError) as caught:
        speed_points(POWER, RATED, LEIDERMAN["diesel"], kind="diesel", omega_torque=2 * RATED)
    assert "880, наибольший момент 8800, номинал 4400 мин⁻¹" in text_of(caught.value.remark)
