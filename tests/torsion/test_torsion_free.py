"""Free torsional vibration: printed frequencies, forms, and what must hold of any train."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kshm.mechanics import torsion
from kshm.mechanics.torsion import Train
from tests.torsion.trains import MWM, MWM_FORM, MWM_HZ, TWO_DISCS, stiffness_matrix, trains


def holzer(train: Train, omega: float):
    """Holzer's chain at an angular frequency [rad/s]: angles with θ_1 = 1, torques, what is left.

    Returns:
        θ_k [rad], shape (masses,); torque of each shaft between [N·m], shape (masses − 1,);
        torque left over at the last mass [N·m], zero at a frequency of the train.
    """
    angle, torque = 1.0, -train.left
    angles, torques = [angle], []
    for inertia, spring in zip(train.inertias[:-1], train.stiffnesses, strict=True):
        torque += omega**2 * inertia * angle
        angle -= torque / spring
        torques.append(torque)
        angles.append(angle)
    rest = torque + omega**2 * train.inertias[-1] * angle - train.right * angle
    return np.array(angles), np.array(torques), float(rest)


def test_two_discs_to_every_digit() -> None:
    modes = torsion.modes_of(TWO_DISCS)
    assert modes.hertz == pytest.approx([176.0767], abs=5e-5)
    assert round(float(modes.hertz[0]), 1) == 176.1
    assert modes.forms[0] == pytest.approx([1, -25.46988], abs=5e-6)


def test_the_diesel_to_every_digit() -> None:
    modes = torsion.modes_of(MWM)
    assert modes.hertz == pytest.approx(MWM_HZ, abs=5e-5)
    assert modes.forms[0] == pytest.approx(MWM_FORM, abs=5e-6)


@given(st.floats(0.01, 100), st.floats(0.01, 100), st.floats(1e3, 1e8))
def test_two_masses_by_the_closed_formula(first: float, second: float, spring: float) -> None:
    train = Train(np.array([first, second]), np.array([spring]))
    wanted = np.sqrt(spring * (first + second) / (first * second))
    assert torsion.modes_of(train).omega == pytest.approx([wanted], rel=1e-12)


@pytest.mark.parametrize("masses", [2, 3, 5, 9, 20])
def test_equal_masses_on_equal_shafts_by_the_closed_formulas(masses: int) -> None:
    """ω = 2√(c/J) sin(...) of a chain with free ends, with one end grounded, with both."""
    j, c = 0.37, 4.2e5
    inertias, shafts = np.full(masses, j), np.full(masses - 1, c)
    k, most = np.arange(1, masses + 1), 2 * np.sqrt(c / j)
    cases = (
        (Train(inertias, shafts), np.sin(k[:-1] * np.pi / (2 * masses))),
        (Train(inertias, shafts, left=c), np.sin((2 * k - 1) * np.pi / (4 * masses + 2))),
        (Train(inertias, shafts, right=c), np.sin((2 * k - 1) * np.pi / (4 * masses + 2))),
        (Train(inertias, shafts, left=c, right=c), np.sin(k * np.pi / (2 * masses + 2))),
    )
    for train, wanted in cases:
        assert torsion.modes_of(train).omega == pytest.approx(most * wanted, rel=1e-12)


@given(trains())
def test_forms_are_orthogonal_in_both_matrices(train: Train) -> None:
    modes = torsion.modes_of(train)
    unit = modes.forms / np.sqrt((train.inertias * modes.forms**2).sum(axis=1, keepdims=True))
    count = len(modes.omega)
    np.testing.assert_allclose((unit * train.inertias) @ unit.T, np.eye(count), atol=1e-9)
    square = unit @ stiffness_matrix(train) @ unit.T
    scale = modes.omega[-1] ** 2
    np.testing.assert_allclose(square, np.diag(modes.omega**2), atol=1e-9 * scale)
    assert np.all(np.diff(modes.omega) >= 0)


@given(trains(free=True))
def test_a_free_form_turns_nothing_as_a_whole(train: Train) -> None:
    modes = torsion.modes_of(train)
    moments = train.inertias * modes.forms
    np.testing.assert_allclose(moments.sum(axis=1) / np.abs(moments).max(axis=1), 0, atol=1e-9)
    assert len(modes.omega) == len(train.inertias) - 1


@given(trains(most=8))
def test_holzer_s_chain_leaves_nothing_at_the_lowest_frequency(train: Train) -> None:
    modes = torsion.modes_of(train)
    angles, torques, rest = holzer(train, float(modes.omega[0]))
    size = max(np.abs(torques).max(), train.left, train.right * abs(angles[-1]))
    assert abs(rest) <= 1e-6 * size
    np.testing.assert_allclose(angles, modes.forms[0], atol=1e-6 * np.abs(angles).max())


@given(trains())
def test_holzer_s_residual_passes_through_zero_at_every_frequency(train: Train) -> None:
    """Of any length: one more form on the other side, and the sign of the rest turns."""
    omega = torsion.modes_of(train).omega
    gaps = np.diff(omega, prepend=0, append=np.inf)
    for m in np.flatnonzero((gaps[:-1] > 1e-6 * omega) & (gaps[1:] > 1e-6 * omega)):
        sides = [holzer(train, float(omega[m]) * (1 + s)) for s in (-1e-7, 1e-7)]
        below, above = (rest for _, _, rest in sides)
        assert below * above < 0


@given(trains(), st.data(), st.floats(1.01, 3))
def test_every_frequency_falls_as_an_inertia_rises(
    train: Train, data: st.DataObject, factor: float
) -> None:
    mass = data.draw(st.integers(0, len(train.inertias) - 1))
    heavier = train.with_inertia(mass, factor * train.inertias[mass])
    before, after = torsion.modes_of(train).omega, torsion.modes_of(heavier).omega
    assert np.all(after <= before * (1 + 1e-12))
    stiffer = replace(train, stiffnesses=factor * train.stiffnesses)
    assert np.all(torsion.modes_of(stiffer).omega >= before * (1 - 1e-12))


@given(trains())
def test_the_form_of_a_frequency_has_as_many_nodes_as_lower_ones(train: Train) -> None:
    modes = torsion.modes_of(train)
    # Frequencies that all but meet share their forms: only clear ones are counted.
    clear = np.diff(modes.omega, prepend=0, append=np.inf) > 1e-3 * modes.omega.max()
    number = np.arange(len(modes.omega)) + (1 if train.is_free else 0)
    actual = np.isfinite(torsion.nodes(modes.forms)).sum(axis=1)
    small = np.abs(modes.forms).min(axis=1) < 1e-6 * np.abs(modes.forms).max(axis=1)
    for m in np.flatnonzero(clear[:-1] & clear[1:] & ~small):
        assert actual[m] == number[m]


def test_phase_sums_of_a_rigid_form_are_those_of_the_firing() -> None:
    offsets = np.radians([0, 480, 240, 600, 120, 360])
    sums = torsion.phase_sums(np.ones((1, 6)), offsets, np.array([0.5, 1, 2.5, 3, 6]))
    np.testing.assert_allclose(sums, [[0, 0, 0, 6, 6]], atol=1e-12)


@given(st.floats(0.02, 0.5))
def test_the_two_peaks_over_a_tuned_damper_are_equal(share: float) -> None:
    """Den Hartog: at the best tuning both fixed points lie at √(1 + 2/μ)."""
    kappa, zeta = torsion.best_tuning(share)
    g = np.linspace(0.3, 1.6, 20001)
    spring = kappa**2 + 2j * zeta * g
    factor = 1 / (1 - g**2 - share * g**2 * spring / (spring - g**2))
    size = np.abs(factor)
    peaks = size[1:-1][(size[1:-1] > size[:-2]) & (size[1:-1] > size[2:])]
    assert len(peaks) == 2
    assert peaks[0] == pytest.approx(peaks[1], rel=0.02)
    assert size.max() == pytest.approx(np.sqrt(1 + 2 / share), rel=0.02)
    roots = np.roots([1 + share / 2, 0, -(1 + kappa**2 * (1 + share)), 0, kappa**2])
    fixed = np.sort(roots.real[roots.real > 0])
    at = np.interp(fixed, g, size)
    assert at == pytest.approx([np.sqrt(1 + 2 / share)] * 2, rel=1e-3)


@given(st.floats(0.02, 0.5))
def test_the_best_viscous_damper_peaks_at_its_fixed_point(share: float) -> None:
    zeta = torsion.best_viscous(share)
    g = np.linspace(0.3, 1.6, 20001)
    ring = 2j * zeta * g
    size = np.abs(1 / (1 - g**2 - share * g**2 * ring / (ring - g**2)))
    assert size.max() == pytest.approx(1 + 2 / share, rel=1e-3)
