"""The mobility map and its orbits against printed tables and a referee of another make."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from kshm import solve
from kshm.mechanics.oil_orbit import MobilityMap, orbits, squeeze_force
from reports.inputs.load import load_toml
from reports.inputs.to_si.engine import engine_and_cycle
from tests.bearings.reynolds import carried, moved
from tests.bearings.test_oil_film import ATTITUDE, PHI, ROTATION, SQUEEZE, WIDTHS, sinusoid
from tests.cover import ALL, examples

ROOT = Path(__file__).parents[2]
WIDE = {float(b): k for k, b in enumerate(WIDTHS)}


@pytest.mark.parametrize("width", WIDE)
@pytest.mark.parametrize("e", [0.1, 0.5, 0.9, 0.95])
def test_the_referee_prints_what_the_tables_print(e: float, width: float) -> None:
    """With oil fed at the widest gap, which a journal that wanders has not."""
    force = carried(e, 1j * e / 2, width, fed=True)
    assert abs(force) == pytest.approx(ROTATION[e][WIDE[width]], rel=5e-3)
    if e in ATTITUDE:
        assert np.degrees(np.angle(force)) == pytest.approx(ATTITUDE[e][WIDE[width]], abs=0.15)


@pytest.mark.parametrize("width", WIDE)
def test_the_steady_table_falls_out_of_the_map(width: float) -> None:
    """Free to begin where it likes, a wide film of small ε reaches behind the widest gap."""
    e = np.array(list(ROTATION))
    force = squeeze_force(e, np.full(len(e), np.pi / 2), width) * e / 2
    printed = np.array(list(ROTATION.values()))[:, WIDE[width]]
    off = np.abs(np.abs(force) / printed - 1)
    assert off[1:].max() < 0.01
    assert off[0] < (0.022 if width == 1 else 0.005)
    e = np.array(list(ATTITUDE))
    force = squeeze_force(e, np.full(len(e), np.pi / 2), width)
    turned = np.degrees(np.angle(force)) - np.array(list(ATTITUDE.values()))[:, WIDE[width]]
    assert np.abs(turned[2:]).max() < 0.35  # under load, from ε = 0.9
    assert np.abs(turned).max() < {1.0: 4.5, 0.5: 1.5, 0.25: 0.4}[width]


@pytest.mark.parametrize("width", WIDE)
def test_the_printed_squeeze_falls_out_of_the_map(width: float) -> None:
    signed = np.array(list(SQUEEZE))
    e, gamma = np.abs(signed), np.where(signed < 0, np.pi, 0.0)
    printed = np.array(list(SQUEEZE.values()))[:, WIDE[width]]
    np.testing.assert_allclose(np.abs(squeeze_force(e, gamma, width)), printed, rtol=5e-3)
    bearing = MobilityMap.of(np.array([width]))
    load = np.where(signed < 0, -1, 1) + 0j
    speed = bearing.velocity(e, load)
    np.testing.assert_allclose(speed, load / printed, rtol=1e-2)


@pytest.mark.parametrize("width", [0.2, 0.5, 1.0])
@pytest.mark.parametrize("e", [0.1, 0.6, 0.9, 0.97])
def test_the_map_and_the_referee_carry_the_same(e: float, width: float) -> None:
    for degrees in (0, 45, 90, 135, 178):
        gamma = np.radians(degrees)
        (ours,) = squeeze_force(np.array([e]), np.array([gamma]), width)
        theirs = carried(e, np.exp(1j * gamma), width)
        assert abs(ours / theirs - 1) < 0.01, degrees


@pytest.mark.parametrize("width", [0.1, 0.3, 0.7, 1.0])
def test_the_velocity_of_a_force_is_the_velocity_that_made_it(width: float) -> None:
    rng = np.random.default_rng(3)
    count = examples(200, 1000)
    e = 0.98 * rng.uniform(0, 1, count) ** 0.4
    gamma = np.arctan2(
        rng.normal(size=count) * 10 ** rng.uniform(0, 1, count), rng.normal(size=count)
    )
    force = squeeze_force(e, np.abs(gamma), width)
    force = np.where(gamma < 0, force.conj(), force)
    actual = MobilityMap.of(np.array([width])).velocity(e, 7 * force) / 7
    off = np.abs(actual / np.exp(1j * gamma) - 1)
    assert np.median(off) < 2e-3
    assert off.max() < 0.02


def test_bearings_of_several_widths_have_their_own_maps() -> None:
    width, e = np.array([0.5, 0.2, 0.5, 1.0]), np.array([0.3, 0.9, 0.95, 0.6])
    load = np.array([1 + 1j, -2 + 0.1j, 3 - 1j, -1j])
    actual = MobilityMap.of(width).velocity(np.array([e, e]), np.array([load, load]))
    alone = [
        MobilityMap.of(width[k : k + 1]).velocity(e[k : k + 1], load[k : k + 1])[0]
        for k in range(4)
    ]
    np.testing.assert_allclose(actual, [alone, alone], rtol=1e-12)


def test_a_load_that_turns_at_half_the_speed_leads_to_contact() -> None:
    load = 0.5 * np.exp(0.5j * PHI)[None]
    start = orbits(PHI, load, np.full(load.shape, 0.5), np.array([0.5]), 1)
    sizes = np.abs(orbits(PHI, load, np.full(load.shape, 0.5), np.array([0.5]), 20).centre[0])
    assert (np.diff(sizes) > 0).all()
    assert 1 - sizes[-1] < 0.5 * (1 - np.abs(start.centre[0, -1]))


def finely(load: np.ndarray, half: np.ndarray, width: float, times: int) -> tuple[np.ndarray, ...]:
    """Angles, load and speed on straight lines between the rows, and the orbit there."""
    fine = np.linspace(PHI[0], PHI[-1], times * (len(PHI) - 1) + 1)
    load = np.interp(fine, PHI, load.real) + 1j * np.interp(fine, PHI, load.imag)
    half = np.interp(fine, PHI, half)
    centre = orbits(fine, load[None], half[None], np.array([width])).centre[0]
    return fine, load, half, centre


@pytest.mark.parametrize("width", [0.2, 0.5, 1.0])
def test_forces_balance_along_the_orbit(width: float) -> None:
    load = sinusoid({0.2: 0.6, 0.5: 3.0, 1.0: 6.0}[width])
    fine, load, half, centre = finely(load, np.full(PHI.shape, 0.5), width, 40)
    speed = np.gradient(centre, fine) - 1j * half * centre
    places = np.arange(100, len(fine) - 1, len(fine) // 9)
    thin = int(np.abs(centre).argmax())
    open_ = [abs(carried(centre[k], speed[k], width) / load[k] - 1) for k in (*places, thin)]
    assert np.median(open_) < 0.01
    assert max(open_) < 0.03


def least_gaps(
    fine: np.ndarray, load: np.ndarray, half: np.ndarray, centre: np.ndarray, width: float
) -> tuple[float, float]:
    """Least gaps over the clearance around the thinnest film: the orbit's and the referee's."""
    thin, pitch = int(np.abs(centre).argmax()), fine[1] - fine[0]
    before, after = (round(np.radians(angle) / pitch) for angle in (60, 15))
    span = range(max(thin - before, 0), min(thin + after, len(fine) - 1))
    here, least = centre[span[0]], 1.0
    for k in span:
        middle = [(each[k] + each[k + 1]) / 2 for each in (load, half)]
        here = moved(here, *middle, pitch, width, centre[k + 1], lines=120, points=12)
        least = min(least, 1 - abs(here))
    return 1 - np.abs(centre[span]).max(), least


@pytest.mark.parametrize("width", [0.2, 0.5, 1.0] if ALL else [0.5])
def test_an_orbit_against_a_direct_solution(width: float) -> None:
    load = sinusoid({0.2: 2.0, 0.5: 9.0, 1.0: 20.0}[width])
    ours, theirs = least_gaps(*finely(load, np.full(PHI.shape, 0.5), width, 5), width)
    assert theirs < 0.1
    assert ours == pytest.approx(theirs, rel=0.03)


# By the referee's direct solution with steps of 2°: row of the sheet and least film [µm].
ENGINES = {
    "samples/d-240-bearings.toml": {0: 3.629, 1: 2.084, 4: 5.058},
    "tests/bearings/film-orbit.toml": {0: 1.847, 1: 1.191},
}


@pytest.mark.parametrize("name", ENGINES)
def test_the_orbit_of_an_engine_is_that_of_a_direct_solution(name: str) -> None:
    """Rows of the table stand 5 or 10° apart: the thinnest film may lie between two."""
    model = load_toml(ROOT / name).model
    actual = solve(*engine_and_cycle(model)).columns["oil_orbits"]["oil_orb_h_um"]
    for row, film in ENGINES[name].items():
        assert actual[row] == pytest.approx(film, rel=5e-3)
