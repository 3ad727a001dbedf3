"""What must hold for every engine, whatever its numbers."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from hypothesis import given, settings

from kshm import kinematics, solve
from kshm.engine import EndMass, Engine
from kshm.journals import positions
from kshm.solver import solve_batch
from tests.kshm.engines import engines


def gas_work(engine: Engine, step_deg: int = 1) -> float:
    """Closed integral of p dV of one cylinder over the cycle [J], trapezoidal."""
    raw = solve_batch([replace(engine, step_deg=step_deg)])
    p = raw.p[0, 0]
    volume = raw.displacement[0, 0] * engine.geometry.piston_area
    return float(np.sum((p[1:] + p[:-1]) / 2 * np.diff(volume)))


@settings(max_examples=60)
@given(engines(step_deg=1))
def test_work_of_the_torque_is_the_work_of_the_gas(engine: Engine) -> None:
    """4π times the mean of ΣM equals ∮p dV over the cylinders, Gots 2.8.

    Two-term accelerations do no work on the exact linkage either (readings,
    8).  Both sums carry the quadrature error of a one-degree grid, largest at
    the corners of the diagram.
    """
    raw = solve_batch([engine])
    work = 4 * np.pi * raw.torque_sum[0, :-1].mean()
    gas = engine.gas
    swept = engine.geometry.piston_area * 2 * engine.geometry.crank_radius
    inertia = np.abs(raw.p_inertia).max() * swept
    scale = engine.cylinders * (
        gas.p_max * swept / (engine.geometry.compression_ratio - 1) + inertia * 1e-9
    )
    assert abs(work - engine.cylinders * gas_work(engine)) <= 0.02 * scale


@settings(max_examples=60)
@given(engines())
def test_last_running_torque_is_the_engine_torque(engine: Engine) -> None:
    raw = solve_batch([engine])
    np.testing.assert_allclose(
        raw.running_main[0, -1], raw.torque_sum[0], rtol=1e-12, atol=1e-9 * np.abs(raw.torque).max()
    )


@settings(max_examples=60)
@given(engines())
def test_reactions_balance_the_loads_of_the_cranks(engine: Engine) -> None:
    """Force and moment of all bearings answer all forces on the shaft, from vectors alone."""
    raw = solve_batch([engine])
    batch, shaft = raw.batch, engine.crankshaft
    area = engine.geometry.piston_area
    unit = engine.geometry.crank_radius * engine.omega**2
    m_2 = float(batch.m_2[0, 0, 0])
    place = positions(batch.throws)
    force = np.zeros((2, raw.phi.size))
    moment = np.zeros_like(force)
    start, bearings = 0.0, [0.0]

    def add(z: float, x: np.ndarray | float, y: np.ndarray | float) -> None:
        for axis, part in enumerate((x, y)):
            force[axis] += part
            moment[axis] += z * np.asarray(part)

    for i, throw in enumerate(shaft.throws):
        g = throw.angle
        out = np.array([-np.sin(g), np.cos(g)])  # along the crank: x left, y up, clockwise
        along = np.array([-np.cos(g), -np.sin(g)])  # direction of rotation at the crank
        K, T = raw.K[0, i] * area, raw.T[0, i] * area
        rod = start + place.rod[0, i]
        add(rod, -K * out[0] + T * along[0], -K * out[1] + T * along[1])
        add(rod, *(m_2 * unit * out))
        add(start + place.pin[0, i], *(throw.pin_mass * unit * out))
        sides = ((throw.left_web, place.left_web), (throw.right_web, place.right_web))
        for web, where in sides:
            a, c = web.angle, web.counterweight_angle
            z = start + where[0, i]
            add(z, *(web.mass * unit * (np.cos(a) * out - np.sin(a) * along)))
            add(z, *(web.counterweight_mass * unit * (-np.cos(c) * out - np.sin(c) * along)))
        if i == 0:
            nose = shaft.nose
            turned = np.cos(nose.angle) * out + np.sin(nose.angle) * along
            add(start - nose.arm, *(nose.mass * unit * turned))
        start += place.length[0, i]
        bearings.append(start)
        if i == len(shaft.throws) - 1:
            rear: EndMass = shaft.rear
            turned = np.cos(rear.angle) * out - np.sin(rear.angle) * along
            add(start + rear.arm, *(rear.mass * unit * turned))
    reactions = raw.journal[0] * area
    scale = np.abs(reactions).max() + np.abs(force).max()
    np.testing.assert_allclose(reactions.sum(axis=0).T, -force, atol=1e-10 * scale)
    turning = np.einsum("k,kad->da", np.array(bearings), reactions)
    np.testing.assert_allclose(turning, -moment, atol=1e-10 * scale * max(1.0, start + 0.3))


@settings(max_examples=40)
@given(engines(method="exact"))
def test_exact_acceleration_is_the_second_derivative(engine: Engine) -> None:
    r, lam = engine.geometry.crank_radius, np.array(engine.geometry.lam)
    omega = np.array(engine.omega)
    phi = np.linspace(0, 2 * np.pi, 181)
    h = 1e-4

    def moved(by: float) -> np.ndarray:
        return kinematics.displacement_exact(phi + by, np.array(r), lam)

    second = (moved(h) - 2 * moved(0) + moved(-h)) / h**2 * engine.omega**2
    first = (moved(h) - moved(-h)) / (2 * h) * engine.omega
    exact = kinematics.acceleration_exact(phi, np.array(r), lam, omega)
    unit = r * engine.omega**2
    np.testing.assert_allclose(exact, second, atol=3e-6 * unit)
    velocity = kinematics.velocity_exact(phi, np.array(r), lam, omega)
    np.testing.assert_allclose(velocity, first, atol=1e-6 * r * engine.omega)


@settings(max_examples=40)
@given(engines())
def test_the_cycle_closes_and_its_end_counts_once(engine: Engine) -> None:
    """0° and 720° are one angle: rows equal, means and wear without the repeated row."""
    solution = solve(engine)
    for name, columns in solution.columns.items():
        if name.startswith(("P3", "gas")) or "phi_deg" not in columns:
            continue
        for key, values in columns.items():
            if key in ("phi_deg", "block_x_MPa", "block_y_MPa"):
                continue
            scale = max(1.0, float(np.abs(values).max()))
            assert abs(values[0] - values[-1]) <= 1e-9 * scale, (name, key)
    torque = solution.columns["P4_2"]["Msum_Nm"]
    assert np.isclose(solution.scalars["M_mean"], torque[:-1].mean(), rtol=1e-12, atol=1e-9)
    ray = solution.columns["table_14"]["ray_I_MPa"]
    assert np.isclose(solution.raw.pin_wear[0, 0] / 1e6, ray[:-1].sum(), rtol=1e-12)


@settings(max_examples=30)
@given(engines(step_deg=10))
def test_a_batch_gives_what_single_engines_give(engine: Engine) -> None:
    other = replace(engine, omega=engine.omega * 1.3)
    together = solve_batch([engine, other])
    for index, one in enumerate((engine, other)):
        alone = solve_batch([one])
        np.testing.assert_array_equal(together.journal[index], alone.journal[0])
        np.testing.assert_array_equal(together.torque_sum[index], alone.torque_sum[0])


@settings(max_examples=30)
@given(engines())
def test_forces_of_one_throw_are_the_forces_on_its_rod(engine: Engine) -> None:
    """S² = N² + P_s² = K² + T², and the overturning moment answers the torque."""
    raw = solve_batch([engine])
    scale = np.abs(raw.S).max() ** 2
    np.testing.assert_allclose(raw.S**2, raw.N**2 + raw.p_sum**2, atol=1e-12 * scale)
    np.testing.assert_allclose(raw.S**2, raw.K**2 + raw.T**2, atol=1e-12 * scale)
    lam = engine.geometry.lam
    phi = raw.local_phi
    height = engine.geometry.crank_radius * (np.cos(phi) + np.sqrt(1 / lam**2 - np.sin(phi) ** 2))
    overturning = -raw.N * engine.geometry.piston_area * height
    np.testing.assert_allclose(overturning, -raw.torque, atol=1e-9 * np.abs(raw.torque).max())
