"""Numbers in the text of section 1.2; book: see ``book``."""

from __future__ import annotations

import numpy as np
import pytest

from kshm import kinematics

R = np.array(0.05)
QUARTER = np.array(0.25)
OMEGA = np.array(400.0)


def displacement(phi_deg: float, lam: float) -> float:
    first, second = kinematics.displacement_orders(np.radians(phi_deg), R, np.array(lam))
    return float(first + second)


def test_at_90_degrees_the_piston_has_gone_nine_eighths_of_r() -> None:
    """λ = 1/4: s = 9/8·r ≈ 0,56·S."""
    assert displacement(90, 0.25) / 0.05 == pytest.approx(9 / 8, rel=1e-12)
    assert round(displacement(90, 0.25) / 0.1, 2) == 0.56


@pytest.mark.parametrize("lam", [1 / 3.2, 0.25, 1 / 4.2])
def test_the_first_quarter_is_longer_by_half_lambda_r(lam: float) -> None:
    half, whole = displacement(90, lam), displacement(180, lam)
    assert whole == pytest.approx(0.1, rel=1e-12)
    assert half - (whole - half) == pytest.approx(0.05 * lam, rel=1e-12)


def test_greatest_speed_at_77_degrees_and_rod_square_to_crank_at_75_58() -> None:
    """λ = 1/4: 77° by (5), while φ + β = 90° at 75°58′."""
    fastest = float(np.degrees(kinematics.max_velocity_angle(QUARTER)))
    assert round(fastest) == 77
    square = np.degrees(np.arctan(1 / 0.25))
    assert divmod(round(square * 60), 60) == (75, 58)
    beta = kinematics.rod_angle(np.radians(square), QUARTER)
    assert square + np.degrees(beta) == pytest.approx(90, abs=1e-9)


def test_first_order_speed_is_1_57_of_the_mean() -> None:
    first = float(kinematics.velocity_orders(np.array(np.pi / 2), R, QUARTER, OMEGA)[0])
    assert round(first / float(kinematics.mean_velocity(R, OMEGA)), 2) == 1.57


@pytest.mark.parametrize("lam", [0.26, 1 / 3.2, 0.4])
def test_second_extreme_of_the_acceleration(lam: float) -> None:
    """At arccos(−1/4λ): −rω²(λ + 1/8λ), (4λ − 1)²/8λ beyond the one at 180°."""
    degrees = np.linspace(90, 180, 90001)
    fine = np.radians(degrees)
    first, second = kinematics.acceleration_orders(fine, R, np.array(lam), OMEGA)
    unit = 0.05 * 400.0**2
    values = (first + second) / unit
    at = degrees[int(values.argmin())]
    assert at == pytest.approx(np.degrees(np.arccos(-1 / (4 * lam))), abs=0.01)
    assert values.min() == pytest.approx(-(lam + 1 / (8 * lam)), abs=1e-8)
    difference = abs(values.min() - values[-1])
    assert difference == pytest.approx((4 * lam - 1) ** 2 / (8 * lam), abs=1e-8)


def test_zero_acceleration_where_the_speed_is_greatest() -> None:
    phi = kinematics.max_velocity_angle(QUARTER)
    total = sum(kinematics.acceleration_orders(phi, R, QUARTER, OMEGA))
    assert float(total) == pytest.approx(0, abs=1e-9 * 0.05 * 400**2)
