"""Numbers in the text of section 1.4 and figures 11 and 12; book: see ``book``."""

from __future__ import annotations

import numpy as np
import pytest

from kshm.engine.engine import Geometry
from kshm.mechanics import kinematics
from tests.textbook.book import beyond, checks, recorded

THIRD, FIFTH = np.array(1 / 3), np.array(0.2)

# Figures 11 and 12: λ = 1/4, k = 0.2, n = 3600 min⁻¹, r = 0.055 m.
R, LAM, K = np.array(0.055), np.array(0.25), np.array(0.2)
OMEGA = np.array(3600 * np.pi / 30)


def test_numbers_of_the_text_but_for_the_dead_centre_angles() -> None:
    """λ = 1/3, k = 0.2: the sines, S = 2,005 r; the angles are misprinted."""
    assert len(checks("text_1_4")) == 6
    assert beyond("text_1_4") == recorded("text_1_4") == {("phi_1", ""), ("phi_2", "")}


def test_dead_centre_angles_are_misprinted() -> None:
    """Printed 1°50' and 5°50'; arcsin 0.05 and arcsin 0.1 are 2°52' and 5°44'."""
    tdc, bdc = (float(np.degrees(angle)) for angle in kinematics.dead_centres(THIRD, FIFTH))
    assert np.sin(np.radians(bdc)) == pytest.approx(-0.1, abs=1e-12)  # without its sign in print
    assert tdc == pytest.approx(2 + 52 / 60, abs=0.5 / 60)
    assert bdc - 180 == pytest.approx(5 + 44 / 60, abs=0.5 / 60)


def test_down_stroke_takes_more_than_half_a_turn() -> None:
    tdc, bdc = kinematics.dead_centres(THIRD, FIFTH)
    assert np.degrees(bdc - tdc) == pytest.approx(182.87, abs=0.005)


def test_extreme_rod_angles_lie_at_90_and_270_degrees() -> None:
    angles = kinematics.rod_angle(np.radians([90.0, 270.0]), LAM, K)
    np.testing.assert_allclose(np.sin(angles), [0.25 - 0.05, -0.25 - 0.05], rtol=1e-12)
    assert kinematics.rod_angle(np.arcsin(K), LAM, K) == pytest.approx(0, abs=1e-15)


def test_rod_acceleration_at_90_and_270_degrees() -> None:
    """∓λω²/[1 − λ²(sin φ − k)²]^(1/2), at 270° with (1 + k)² (readings, 12)."""
    exact, near = kinematics.rod_angular_acceleration(np.radians([90.0, 270.0]), LAM, OMEGA, K)
    unit = 0.25 * OMEGA**2
    expected = [
        -unit / np.sqrt(1 - 0.0625 * (1 - 0.2) ** 2),
        unit / np.sqrt(1 - 0.0625 * (1 + 0.2) ** 2),
    ]
    np.testing.assert_allclose(exact, expected, rtol=1e-12)
    np.testing.assert_allclose(near, [-unit, unit], rtol=1e-12)  # (19a) with its minus


def accelerations() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    phi = np.radians(np.arange(0.0, 361.0, 10.0))
    central = np.sum(kinematics.acceleration_orders(phi, R, LAM, OMEGA), axis=0)
    return phi, central, central + kinematics.acceleration_offset(phi, R, LAM, OMEGA, K)


def test_figure_12_is_above_the_central_curve_in_the_first_half_turn() -> None:
    phi, central, shifted = accelerations()
    first = (phi > 1e-9) & (phi < np.pi - 1e-9)
    second = (phi > np.pi + 1e-9) & (phi < 2 * np.pi - 1e-9)
    assert np.all(shifted[first] > central[first])
    assert np.all(shifted[second] < central[second])


def test_figure_12_in_numbers() -> None:
    """rω² = 7817 m/s²: 9771 at 0, the offset adds at most rω²λk = 391."""
    phi, central, shifted = accelerations()
    assert float(R * OMEGA**2) == pytest.approx(7816.7, abs=0.1)
    assert shifted[0] == pytest.approx(9770.9, abs=0.1)
    assert shifted[9] == pytest.approx(-1954.2 + 390.8, abs=0.1)
    assert np.abs(shifted - central).max() == pytest.approx(390.8, abs=0.1)
    exact = kinematics.acceleration_exact(phi, R, LAM, OMEGA, K)
    assert np.abs(exact - shifted).max() / exact.max() < 0.04


def test_figure_11_displacement_between_the_true_dead_centres() -> None:
    tdc, bdc = kinematics.dead_centres(LAM, K)
    moved = kinematics.displacement_exact(np.array([tdc, bdc]), R, LAM, K)
    geometry = Geometry(0.08, float(R), float(R / LAM), 10.0, crank_offset=float(K * R))
    np.testing.assert_allclose(moved, [0, geometry.stroke], atol=1e-15)
    two_term = sum(kinematics.displacement_orders(tdc, R, LAM))
    two_term += kinematics.displacement_offset(tdc, R, LAM, K)
    assert two_term == pytest.approx(0, abs=1e-5)  # (14) is slightly off zero
    assert two_term != 0
