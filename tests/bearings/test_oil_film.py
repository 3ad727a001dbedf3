"""Closed forms of the film against the printed tables, and orbits whose end is known."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kshm.mechanics import bearings
from kshm.mechanics.oil_orbit import orbits, squeeze_force
from tests.cover import examples

# Printed in the companions' note: rows ε, columns B/D 1, 1/2, 1/4.
WIDTHS = np.array([1.0, 0.5, 0.25])
ROTATION = {
    0.1: (0.1196, 0.0368, 0.0098), 0.3: (0.4091, 0.1304, 0.0354), 0.5: (0.8903, 0.3124, 0.0888),
    0.7: (2.0432, 0.8595, 0.2708), 0.8: (3.5663, 1.7339, 0.6043), 0.9: (8.4352, 5.0881, 2.1595),
    0.95: (18.7895, 13.3083, 6.9248), 0.99: (107.7868, 93.7881, 70.0359),
}  # fmt: skip
ATTITUDE = {
    0.1: (79.41, 81.767, 82.481), 0.5: (56.705, 54.993, 54.069), 0.9: (26.482, 23.566, 21.79),
    0.95: (19.45, 17.265, 15.632), 0.99: (9.416, 8.587, 7.703),
}  # fmt: skip
SQUEEZE = {
    -0.9: (0.5518, 0.1466, 0.0376), -0.5: (0.971, 0.2664, 0.0688), 0.0: (2.4076, 0.7224, 0.1919),
    0.5: (9.7319, 3.675, 1.0715), 0.9: (160.25, 104.75, 46.559),
}  # fmt: skip
# Raimondi and Boyd 1958, from memory: ε: (Sommerfeld's S, attitude in degrees), by B/D.
RAIMONDI = {
    1.0: {0.1: (1.33, 79.5), 0.2: (0.631, 74.02), 0.4: (0.264, 63.1), 0.6: (0.121, 50.58),
          0.8: (0.0446, 36.24), 0.9: (0.0188, 26.45), 0.97: (0.00474, 15.47)},
    0.5: {0.1: (4.31, 81.62), 0.2: (2.03, 74.94), 0.4: (0.779, 61.45), 0.6: (0.319, 48.14),
          0.8: (0.0923, 33.31), 0.9: (0.0313, 23.66), 0.97: (0.00609, 13.75)},
    0.25: {0.1: (16.2, 82.31), 0.2: (7.57, 75.18), 0.4: (2.83, 60.86), 0.6: (1.07, 46.72),
           0.8: (0.261, 31.04), 0.9: (0.0736, 21.85), 0.97: (0.0101, 12.22)},
}  # fmt: skip
PHI = np.linspace(0, 4 * np.pi, 73)
STILL = np.full(PHI.shape, 0.5)


def errors(form, table) -> np.ndarray:
    item = np.array([form(np.full(3, e), WIDTHS) for e in table])
    return np.abs(item - np.array(list(table.values())))


def test_the_printed_numbers_are_met_as_the_note_says() -> None:
    rotation = errors(bearings.rotation_number, ROTATION) / np.array(list(ROTATION.values()))
    assert np.median(rotation) < 0.030
    assert rotation.max() < 0.068
    turn = np.degrees(errors(bearings.attitude, {e: np.radians(v) for e, v in ATTITUDE.items()}))
    assert np.median(turn) < 1.0
    assert turn.max() < 2.4


@pytest.mark.parametrize("width", RAIMONDI)
def test_other_published_bearings_are_met(width: float) -> None:
    """So = 1/(2πS): another solution of the same equation, by another author."""
    for e, (number, turn) in RAIMONDI[width].items():
        load = np.array(1 / (2 * np.pi * number))
        assert bearings.rotation_number(np.array(e), np.array(width)) == pytest.approx(
            load, rel=0.068
        )
        actual = bearings.steady_eccentricity(load, np.array(width))
        assert actual == pytest.approx(e, abs=0.01)
        assert np.degrees(bearings.attitude(np.array(e), np.array(width))) == pytest.approx(
            turn, abs=2.4
        )


def test_the_short_bearing_alone_would_be_wrong_near_contact() -> None:
    actual = float(bearings.rotation_number(np.array(0.9), np.array(0.5)))
    assert actual == pytest.approx(5.09, rel=0.068)


def run(load, half_speed=None, width=0.5, cycles=12):
    load = np.atleast_2d(np.asarray(load, dtype=complex))
    load = np.broadcast_to(load, (len(load), *PHI.shape))
    speed = np.broadcast_to(STILL if half_speed is None else half_speed, load.shape)
    return orbits(PHI, load, np.array(speed), np.full(len(load), width), cycles)


@pytest.mark.parametrize("width", [0.25, 0.5, 1.0])
@pytest.mark.parametrize("e", [0.3, 0.6, 0.9, 0.97])
def test_a_steady_load_ends_where_the_journal_stands_still(e: float, width: float) -> None:
    """In axes that turn at half the speed a journal at rest moves sideways at ε/2."""
    (force,) = squeeze_force(np.array([e]), np.array([np.pi / 2]), width) * e / 2
    actual = run(abs(force) * np.exp(0.7j), width=width, cycles=20)
    centre = actual.centre[0, -1]
    assert abs(centre) == pytest.approx(e, abs=2e-3)
    assert np.angle(centre) == pytest.approx(0.7 + np.angle(force), abs=5e-3)
    assert actual.closed.all()


def test_a_load_at_half_speed_has_no_wedge() -> None:
    actual = run(0.5 * np.exp(0.5j * PHI), cycles=3)
    sizes = np.abs(actual.centre[0])
    assert np.all(np.diff(sizes) > 0)
    slower = run(0.5 * np.exp(0.25j * PHI) * 1.0, cycles=2)
    assert sizes[-1] > np.abs(slower.centre[0]).max()


def test_at_rest_the_journal_sinks_in_the_integral_of_so_v() -> None:
    actual = run(0.2, half_speed=np.zeros(PHI.shape), cycles=1)
    start, end = np.abs(actual.centre[0, [0, -1]])
    e = np.linspace(start, end, 101)
    wanted = np.trapezoid(np.abs(squeeze_force(e, 0 * e, 0.5)), e)
    assert 0.2 * (PHI[-1] - PHI[0]) == pytest.approx(wanted, rel=2e-3)
    assert np.angle(actual.centre[0]) == pytest.approx(0, abs=1e-9)


def sinusoid(size: float = 3.0) -> np.ndarray:
    return size * (np.cos(PHI) + 0.4j * np.sin(PHI / 2) + 0.3)


@settings(max_examples=examples(5, 10), deadline=None)
@given(st.floats(0.3, 3), st.floats(0, 6.28))
def test_turning_and_scaling_the_load(scale: float, turn: float) -> None:
    """The orbit turns with the load; load, viscosity and ψ² enter as one number only."""
    load = sinusoid(scale)
    plain, turned = run(load).centre, run(load * np.exp(1j * turn)).centre
    np.testing.assert_allclose(np.abs(turned), np.abs(plain), atol=2e-3)


def random_bearings(count: int):
    rng = np.random.default_rng(5)
    orders = np.arange(0, 7) / 2
    parts = rng.normal(size=(count, len(orders))) + 1j * rng.normal(size=(count, len(orders)))
    waves = np.exp(1j * orders[:, None] * PHI) + np.exp(-1j * orders[:, None] * PHI)
    size = 10 ** rng.uniform(-2, 0.5, count)
    return (parts @ waves) * size[:, None], np.round(rng.uniform(0.2, 1.0, count), 1)


def test_random_bearings_close_within_their_clearance() -> None:
    load, width = random_bearings(examples(30, 200))
    actual = orbits(PHI, load, np.broadcast_to(STILL, load.shape).copy(), width)
    assert np.isfinite(actual.centre).all()
    assert np.abs(actual.centre).max() < 1
    assert actual.closed.mean() > 0.99


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_numbers_that_are_none_are_refused(bad: float) -> None:
    with pytest.raises(ValueError, match="finite"):
        run(bad)


@pytest.mark.parametrize("width", [0.05, 1.2, np.nan])
def test_widths_without_a_table_are_refused(width: float) -> None:
    with pytest.raises(ValueError, match="width over the diameter"):
        run(1.0, width=width)


def test_the_steady_eccentricity_is_the_inverse() -> None:
    e = np.array([0.05, 0.5, 0.9, 0.99])
    b = np.full(4, 0.5)
    actual = bearings.steady_eccentricity(bearings.rotation_number(e, b), b)
    np.testing.assert_allclose(actual, e, rtol=1e-9)


def test_a_centred_journal_rubs_as_petroff_says() -> None:
    """2πηωRL·R/c on the journal: torque over R."""
    d, width, eta, omega, psi = 0.06, 0.03, 0.01, 200.0, 0.001
    force = bearings.friction_force(
        np.array(0.0), np.array(width * d * eta * omega), np.array(0.0), np.array(psi)
    )
    petroff = 2 * np.pi * eta * omega * (d / 2) * width * (d / 2) / (psi * d / 2)
    assert float(force) == pytest.approx(petroff)
