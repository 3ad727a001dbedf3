"""Forced torsional vibration: openTorsion 0.3.2 on an equal model, energy, dampers, sums."""

from __future__ import annotations

import importlib.util
import os
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kshm.chain.solve import solve_batch
from kshm.mechanics import torsion
from kshm.mechanics.torsion import Damper, Train, respond
from kshm.results.case import Case
from kshm.results.torsion import TorsionStudy, forced_columns
from reports.inputs.to_si.engine import to_engine
from tests.conftest import sample
from tests.torsion.trains import MWM, stiffness_matrix, trains

RPM = np.pi / 30
SPEEDS = np.arange(1000, 2575, 25)  # those of openTorsion's examples/ICE_example.py


@pytest.fixture(scope="module")
def study() -> TorsionStudy:
    engine = to_engine(sample("mwm-6"))
    assert engine.torsion is not None
    return TorsionStudy(Case(engine, solve_batch([engine]), 0), engine.torsion)


def own_torque(study: TorsionStudy, rpm: float) -> np.ndarray:
    """Torque of cylinder 1 over its own cycle, written down again from the sample's numbers."""
    data = sample("mwm-6")
    phi = np.radians(np.arange(0, 720, data.calculation.step_deg))
    r, rod, area = 0.0685, 0.207, np.pi * 0.105**2 / 4
    angles, pressures = np.array(data.gas.points).T
    peaks = [(peak.speed_rpm, peak.pressure_mpa) for peak in data.torsion.peaks]
    curve = np.interp(np.degrees(phi), angles, pressures) - 0.1
    scale = np.interp(rpm, *zip(*peaks, strict=True)) / 15.1992  # the highest of the points
    beta = np.arcsin(r / rod * np.sin(phi))
    inertia = -2.521 * r * (rpm * RPM) ** 2 * (np.cos(phi) + r / rod * np.cos(2 * phi))
    return (1e6 * area * curve * scale + inertia) * np.sin(phi + beta) / np.cos(beta) * r


def own_excitation(study: TorsionStudy) -> np.ndarray:
    """Harmonics at the nodes by a sum over the angles, not by a transform; (9, speeds, 24)."""
    offsets = np.radians([0, 480, 240, 600, 120, 360])  # 1-5-3-6-2-4
    orders = np.arange(1, 25) / 2
    torque = np.array([own_torque(study, rpm) for rpm in SPEEDS])
    phi = np.linspace(0, 4 * np.pi, torque.shape[1], endpoint=False)
    first = 2 * torque @ np.exp(-1j * np.outer(phi, orders)) / len(phi)
    actual = np.zeros((9, len(SPEEDS), 24), dtype=complex)
    for cylinder, offset in enumerate(offsets):
        actual[2 + cylinder] = first * np.exp(-1j * orders * offset)
    return actual


def test_the_excitation_written_down_again(study: TorsionStudy) -> None:
    ours, theirs = study.excitation(SPEEDS * RPM), own_excitation(study)
    np.testing.assert_allclose(ours, theirs, rtol=0, atol=1e-6 * np.abs(theirs).max())


def test_opentorsion_gives_the_same_torques(study: TorsionStudy) -> None:
    """Equal models: steady state by its inverses at 63 speeds, 24 orders.

    Its example differs from the sample's results, and these are the differences of model:
    absolute pressure over 15.2 MPa in place of the pressure above the ambient over its own
    greatest value; a series of four terms for the acceleration; 500 points with the first
    one twice; the phases turned the other way; amplitudes of the orders added in place of
    the torques in time.
    """
    if importlib.util.find_spec("opentorsion") is None and os.environ.get("CI") != "true":
        pytest.skip("openTorsion не установлен: pip install opentorsion==0.3.2")
    import opentorsion as ot

    disks = [ot.Disk(k, j, c=2 if 2 <= k < 8 else 0) for k, j in enumerate(MWM.inertias)]
    shafts = [ot.Shaft(k, k + 1, None, None, k=c, I=0) for k, c in enumerate(MWM.stiffnesses)]
    assembly = ot.Assembly(shafts, disk_elements=disks)
    absolute = np.diag([2.0 if 2 <= k < 8 else 0.0 for k in range(9)])
    excitation = own_excitation(study)
    response = study.response(SPEEDS * RPM)
    for at, rpm in enumerate(SPEEDS):
        load = ot.PeriodicExcitation(9, study.orders * rpm * RPM)
        for node in range(2, 8):
            column = excitation[node, at]
            load.add_sines(node, load.omegas, np.abs(column), np.angle(column))
        torques, summed = assembly.vibratory_torque(
            load, C_func=lambda omega: absolute + 0.035 / omega * assembly.K
        )
        ours = response.torques[:, at]
        np.testing.assert_allclose(
            np.abs(ours), np.abs(torques), rtol=0, atol=1e-6 * np.abs(torques).max()
        )
        np.testing.assert_allclose(np.abs(ours).sum(axis=1), summed, rtol=1e-6)


def random_load(train: Train, speeds: int = 4, orders: int = 3) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(len(train.inertias))
    shape = (len(train.inertias), speeds, orders)
    load = rng.normal(size=shape) + 1j * rng.normal(size=shape)
    top = torsion.modes_of(train).omega[-1]
    return np.linspace(0.1, 1.1, speeds)[:, None] * top * np.arange(1, orders + 1) / orders, load


@given(trains(), st.floats(0.005, 0.2), st.floats(0, 5))
def test_the_equations_hold_for_any_train(train: Train, loss: float, absolute: float) -> None:
    omega, load = random_load(train)
    damping = np.full(len(train.inertias), absolute)
    response = respond(train, omega, load, damping, loss)
    stiffness = stiffness_matrix(train) * (1 + 1j * loss)
    for i, j in np.ndindex(omega.shape):
        dynamic = stiffness + np.diag(-(omega[i, j] ** 2) * train.inertias)
        dynamic = dynamic + np.diag(1j * omega[i, j] * damping)
        wanted = np.linalg.solve(dynamic, load[:, i, j])
        scale = np.abs(wanted).max()
        np.testing.assert_allclose(response.angles[:, i, j], wanted, atol=1e-7 * scale)


@given(trains(), st.floats(0.005, 0.2), st.floats(0, 5), st.booleans())
def test_the_work_done_is_what_damping_takes(
    train: Train, loss: float, absolute: float, damped: bool
) -> None:
    omega, load = random_load(train)
    damper = Damper(0.1, 1e4, 50.0) if damped else None
    response = respond(train, omega, load, np.full(len(train.inertias), absolute), loss, damper)
    np.testing.assert_allclose(response.work, response.lost, rtol=1e-6)


def test_without_damping_nothing_is_done() -> None:
    omega, load = random_load(MWM)
    bare = respond(MWM, omega, load.real + 0j, np.zeros(9), 0.0)
    size = (np.abs(load) * np.abs(bare.angles)).sum(axis=0)
    assert np.abs(bare.work / size).max() < 1e-9
    assert not bare.lost.any()


@pytest.mark.parametrize("kind", ["viscous", "tuned"])
def test_a_damper_levels_the_peaks_of_a_two_mass_train(kind: str) -> None:
    """One grounded mass under a constant torque: the peaks of Den Hartog's theory."""
    train = Train(np.array([1.0, 1e9]), np.array([1e6]))
    share, own = 0.2, 1000.0
    kappa, zeta = torsion.best_tuning(share)
    damping = 2 * (zeta if kind == "tuned" else torsion.best_viscous(share)) * share * own
    spring = share * (kappa * own) ** 2 if kind == "tuned" else 0.0
    omega = np.linspace(0.5, 1.4, 4001)[:, None] * own
    load = np.zeros((2, *omega.shape), dtype=complex)
    load[0] = 1e6
    response = respond(train, omega, load, np.zeros(2), 0.0, Damper(share, spring, damping))
    size = np.abs(response.angles[0, :, 0])
    peaks = size[1:-1][(size[1:-1] > size[:-2]) & (size[1:-1] > size[2:])]
    wanted = np.sqrt(1 + 2 / share) if kind == "tuned" else 1 + 2 / share
    assert len(peaks) == (2 if kind == "tuned" else 1)
    assert peaks == pytest.approx([wanted] * len(peaks), rel=0.02)


def test_orders_are_added_in_time() -> None:
    orders = np.arange(1, 25) / 2
    rng = np.random.default_rng(0)
    amplitudes = rng.normal(size=(3, 24)) + 1j * rng.normal(size=(3, 24))
    phi = np.linspace(0, 4 * np.pi, 20000)
    wanted = np.abs((amplitudes @ np.exp(1j * np.outer(orders, phi))).real).max(axis=1)
    actual = torsion.sum_in_time(amplitudes, orders, 0.5)
    assert actual == pytest.approx(wanted, rel=0.01)
    assert np.all(actual <= wanted * (1 + 1e-6))
    assert np.all(actual < np.abs(amplitudes).sum(axis=1))


def test_the_leading_order_is_that_of_whole_matrices(study: TorsionStudy) -> None:
    """Each speed and order by a dense system, added in time angle by angle, at the worst shaft."""
    train, loss = study.train, study.inputs.loss_factor
    load, springs = study.excitation(study.speeds), stiffness_matrix(train)
    assert train.moduli is not None
    turning = np.exp(1j * np.outer(study.orders, np.linspace(0, 4 * np.pi, 1500)))
    leading = []
    for at, speed in enumerate(study.speeds):
        collected = []
        for index, order in enumerate(study.orders):
            omega = speed * order
            system = (1 + 1j * loss) * springs + 1j * omega * np.diag(study.damping)
            angles = np.linalg.solve(
                system - omega**2 * np.diag(train.inertias), load[:, at, index]
            )
            collected.append(train.stiffnesses * np.diff(angles) / train.moduli)
        by_shaft = np.array(collected).T
        worst = np.abs((by_shaft @ turning).real).max(axis=1).argmax()
        leading.append(study.orders[np.abs(by_shaft[worst]).argmax()])
    assert forced_columns(study)["tor_lead_order"].tolist() == leading
    assert len(set(leading)) > 1


def test_the_energy_method_is_the_resonance_of_a_single_order(study: TorsionStudy) -> None:
    """At a resonance far from others both ways give one amplitude to some per cent."""
    only = replace(study.inputs, loss_factor=0.002, damping=0.0)
    light = TorsionStudy(study.case, only)
    speed = light.modes.omega[:1] / 6.0
    position = int(np.flatnonzero(light.orders == 6)[0])
    exact = np.abs(light.response(speed).angles[0, 0, position])
    from kshm.results.torsion import torsion_results

    engine = replace(study.case.engine, torsion=only)
    table = torsion_results(Case(engine, study.case.raw, 0))[0]["torsion_critical"]
    assert table["tor_A1_deg"][position] == pytest.approx(exact, rel=0.03)
