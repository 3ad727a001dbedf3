"""Numbers in the text of section 1.2; book: see ``book``."""

from __future__ import annotations

import numpy as np
import pytest

from kshm.mechanics import kinematics
from tests.textbook.book import beyond, checks, ours, recorded

R = np.array(0.05)
QUARTER = np.array(0.25)
OMEGA = np.array(400.0)


def displacement(phi_deg: float, lam: float) -> float:
    first, second = kinematics.displacement_orders(np.radians(phi_deg), R, np.array(lam))
    return float(first + second)


def test_numbers_of_the_text() -> None:
    """s = 9/8·r ≈ 0,56·S, 77° by (5), φ + β = 90° at 75°58′, 1,57 of the mean speed."""
    assert len(checks("text_1_2")) == 5
    assert beyond("text_1_2") == recorded("text_1_2") == set()
    assert {check.cell.units for check in checks("text_1_2").values()} == {0.5}


@pytest.mark.parametrize("lam", [1 / 3.2, 0.25, 1 / 4.2])
def test_the_first_quarter_is_longer_by_half_lambda_r(lam: float) -> None:
    half, whole = displacement(90, lam), displacement(180, lam)
    assert whole == pytest.approx(0.1, rel=1e-12)
    assert half - (whole - half) == pytest.approx(0.05 * lam, rel=1e-12)


def test_the_rod_is_square_to_the_crank_where_tan_phi_is_one_over_lambda() -> None:
    square = ours("text_1_2", "phi_square") / 60
    assert square == pytest.approx(np.degrees(np.arctan(4)), abs=1e-6)


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
