"""What must hold for every engine, whatever its numbers."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from kshm import solve
from kshm.chain.solve import ChainArrays, solve_batch
from kshm.chain.stack import stack
from kshm.engine.crankshaft import EndMass
from kshm.engine.engine import Engine
from kshm.mechanics import articulated, kinematics
from tests.kshm.engines import engines

Array = NDArray[np.float64]


def gas_work(raw: ChainArrays, engine: Engine) -> float:
    """Closed integral of p dV of all cylinders over the cycle [J], trapezoidal."""
    p, volume = raw.p[0], raw.displacement[0] * engine.geometry.piston_area
    return float(np.sum((p[:, 1:] + p[:, :-1]) / 2 * np.diff(volume)))


@settings(max_examples=80)
@given(engines(step_deg=1))
def test_work_of_the_torque_is_the_work_of_the_gas(engine: Engine) -> None:
    """The mean of ΣM over a cycle equals ∮p dV over all cylinders, Gots 2.8.

    Two-term accelerations do no work on the exact central linkage either, but they do with
    an offset (readings, 8): there the exact method is taken.  Both sums carry the quadrature
    error of a one-degree grid, largest at the corners of the diagram.
    """
    if engine.geometry.offset:
        engine = replace(engine, method="exact")
    raw = solve_batch([engine])
    work = engine.period * raw.torque_sum[0, :-1].mean()
    gas = engine.gas
    swept = engine.geometry.piston_area * engine.geometry.stroke
    inertia = np.abs(raw.p_inertia).max() * swept
    scale = engine.cylinders * (
        gas.p_max * swept / (engine.geometry.compression_ratio - 1) + inertia * 1e-9
    )
    assert abs(work - gas_work(raw, engine)) <= 0.02 * scale


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
    position = batch.throws.places
    force = np.zeros((2, raw.phi.size))
    moment = np.zeros_like(force)
    start, bearings = 0.0, [0.0]

    def add(z: float, x: np.ndarray | float, y: np.ndarray | float) -> None:
        for axis, part in enumerate((x, y)):
            force[axis] += part
            moment[axis] += z * np.asarray(part)

    def directions(angle: float) -> tuple[np.ndarray, np.ndarray]:
        """Along a crank and in its direction of rotation: x left, y up, clockwise."""
        out = np.array([-np.sin(angle), np.cos(angle)])
        return out, np.array([-np.cos(angle), -np.sin(angle)])

    for i, throw in enumerate(shaft.throws):
        carried = [n for n, c in enumerate(engine.arrangement) if c.throw == i]
        for n in carried:
            cylinder = engine.arrangement[n]
            out, along = directions(throw.angle + cylinder.pin_angle)
            K, T = raw.K[0, n] * area, raw.T[0, n] * area
            rod = start + position.rod_at(cylinder.rod_place)[0, i]
            add(rod, -K * out[0] + T * along[0], -K * out[1] + T * along[1])
            add(rod, *(m_2 * unit * out * (cylinder.master is None)))
            add(start + position.pin[0, i], *(throw.pin_mass / len(carried) * unit * out))
        out, along = directions(throw.angle)
        sides = ((throw.left_web, position.left_web), (throw.right_web, position.right_web))
        for web, where in sides:
            a, c = web.angle, web.counterweight_angle
            z = start + where[0, i]
            add(z, *(web.mass * unit * (np.cos(a) * out - np.sin(a) * along)))
            add(z, *(web.counterweight_mass * unit * (-np.cos(c) * out - np.sin(c) * along)))
        if i == 0:
            nose = shaft.nose
            turned = np.cos(nose.angle) * out + np.sin(nose.angle) * along
            add(start - nose.arm, *(nose.mass * unit * turned))
        start += position.length[0, i]
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


@settings(max_examples=60)
@given(engines(method="exact"))
def test_exact_motion_is_the_derivative_of_the_exact_displacement(engine: Engine) -> None:
    geometry = engine.geometry
    r, lam, k = (
        np.array(v) for v in (geometry.crank_radius, geometry.lam, geometry.relative_offset)
    )
    omega = np.array(engine.omega)
    phi = np.linspace(0, 2 * np.pi, 181)

    def close(of: Callable[[Array], Array], values: Array, unit: Array, h: float = 1e-4) -> None:
        change = (of(phi + h) - of(phi - h)) / (2 * h) * omega
        np.testing.assert_allclose(values, change, atol=1e-6 * float(unit))

    velocity = kinematics.velocity_exact(phi, r, lam, omega, k)
    close(lambda at: kinematics.displacement_exact(at, r, lam, k), velocity, r * omega)
    acceleration = kinematics.acceleration_exact(phi, r, lam, omega, k)
    close(lambda at: kinematics.velocity_exact(at, r, lam, omega, k), acceleration, r * omega**2)
    turning = kinematics.rod_angular_velocity(phi, lam, omega, k)[0]
    close(lambda at: kinematics.rod_angle(at, lam, k), turning, omega)
    turned = kinematics.rod_angular_acceleration(phi, lam, omega, k)[0]
    close(lambda at: kinematics.rod_angular_velocity(at, lam, omega, k)[0], turned, omega**2)


@settings(max_examples=40)
@given(engines(layouts=("articulated",)))
def test_articulated_motion_is_the_derivative_of_its_height(engine: Engine) -> None:
    rods = stack([engine]).articulated
    phi, h = np.linspace(0, 2 * np.pi, 181), 1e-4

    def heights(by: float) -> tuple[Array, Array, Array]:
        return articulated.motion(phi + by, rods.link).height

    unit = engine.geometry.crank_radius
    for order in (0, 1):
        change = (heights(h)[order] - heights(-h)[order]) / (2 * h)
        np.testing.assert_allclose(heights(0)[order + 1], change, atol=2e-6 * unit)
    top, bottom = articulated.dead_centres(rods.link)
    for at, sign in ((top, 1), (bottom, -1)):
        extreme = articulated.motion(at, rods.link).height[0]
        assert np.all(sign * (extreme - heights(0)[0]) >= -1e-12 * unit)


@settings(max_examples=30)
@given(engines(layouts=("articulated",)), st.integers(-90, 90))
def test_a_row_turned_round_the_shaft_moves_as_before(engine: Engine, turn: int) -> None:
    """Its master, what hangs on it and their firing turned together: as in a staggered radial."""
    last, by = engine.arrangement[-1].throw, np.radians(turn)
    assume(last > 0)  # cylinder 1 is where angles are counted from
    there = [position.throw == last for position in engine.arrangement]
    turned = replace(
        engine,
        arrangement=tuple(
            replace(position, axis=position.axis + by * own)
            for position, own in zip(engine.arrangement, there, strict=True)
        ),
        firing_offsets=tuple(
            (offset + by * own) % engine.period
            for offset, own in zip(engine.firing_offsets, there, strict=True)
        ),
    )
    phi = np.linspace(0, 2 * np.pi, 37)
    before, after = (
        articulated.motion(phi, stack([each]).articulated.link).height[0]
        for each in (engine, turned)
    )
    np.testing.assert_allclose(after, before, atol=1e-12 * engine.geometry.crank_radius)


@settings(max_examples=40)
@given(engines())
def test_the_cycle_closes_and_its_end_counts_once(engine: Engine) -> None:
    """0° and 720° are one angle: rows equal, means and wear without the repeated row."""
    solution = solve(engine)
    for name, columns in solution.columns.items():
        if name.startswith(("P3", "gas", "offset", "articulated")) or "phi_deg" not in columns:
            continue
        for key, values in columns.items():
            if key in ("phi_deg", "block_x_MPa", "block_y_MPa"):
                continue
            scale = max(1.0, float(np.abs(values).max()))
            assert abs(values[0] - values[-1]) <= 1e-9 * scale, (name, key)
    torque = solution.columns["P4_2"]["Msum_Nm"]
    assert np.isclose(solution.scalars["M_mean"], torque[:-1].mean(), rtol=1e-12, atol=1e-9)
    ray = solution.columns["table_14"]["ray_I_MPa"]
    assert np.isclose(solution.raw.pin_wear[0, 0, 0] / 1e6, ray[:-1].sum(), rtol=1e-12)


@settings(max_examples=30)
@given(engines(step_deg=10))
def test_a_batch_gives_what_single_engines_give(engine: Engine) -> None:
    other = replace(engine, omega=engine.omega * 1.3)
    together = solve_batch([engine, other])
    for index, one in enumerate((engine, other)):
        alone = solve_batch([one])
        np.testing.assert_array_equal(together.journal[index], alone.journal[0])
        np.testing.assert_array_equal(together.torque_sum[index], alone.torque_sum[0])


@settings(max_examples=60)
@given(engines())
def test_forces_of_a_rod_are_those_on_its_piston(engine: Engine) -> None:
    """S² = N² + P_s² and, on a rod of its own, = K² + T²."""
    raw = solve_batch([engine])
    scale = np.abs(raw.S).max() ** 2
    np.testing.assert_allclose(raw.S**2, raw.N**2 + raw.p_sum**2, atol=1e-12 * scale)
    own = [i for i, c in enumerate(engine.arrangement) if c.master is None]
    np.testing.assert_allclose(
        raw.S[:, own] ** 2, (raw.K**2 + raw.T**2)[:, own], atol=1e-12 * scale
    )


@settings(max_examples=60)
@given(engines())
def test_torque_is_the_moment_of_what_acts_on_pistons_and_rods(engine: Engine) -> None:
    """Moments about the shaft: M = N·h + e·P_s of each cylinder, Gots (39) with an offset.

    An articulated rod adds its share of the side force at the master piston and the inertia
    of the mass on its pin.
    """
    raw = solve_batch([engine])
    area, geometry = engine.geometry.piston_area, engine.geometry
    e, rod = geometry.offset, geometry.rod_length
    total = np.zeros(raw.phi.size)
    for n in range(engine.cylinders):
        phi = raw.local_phi[0, n]
        sine = (geometry.crank_radius * np.sin(phi) - e) / rod
        height = geometry.crank_radius * np.cos(phi) + rod * np.sqrt(1 - sine**2)
        N = raw.N[0, n]
        if engine.arrangement[n].master is not None:
            rods, hung = raw.batch.articulated, raw.hung
            row = rods.cylinders.index(n)
            motion = hung.motion
            alpha = phi + engine.arrangement[n].axis
            sine = (geometry.crank_radius * np.sin(alpha) - e) / rod
            of_master = geometry.crank_radius * np.cos(alpha) + rod * np.sqrt(1 - sine**2)
            total += hung.on_pin.N_added[0, row] * of_master * area
            inertia = -engine.articulated[0].big_end * engine.omega**2
            along, across = motion.pin.along, motion.pin.across
            total += inertia * (along[0] * across[2] - across[0] * along[2])[0, row]
            height = motion.height[0][0, row]
        total += (N * height + e * raw.p_sum[0, n]) * area
    np.testing.assert_allclose(total, raw.torque_sum[0], atol=1e-9 * np.abs(raw.torque).max())


@settings(max_examples=60)
@given(engines())
def test_crankpins_carry_what_pistons_and_walls_put_on_the_rods(engine: Engine) -> None:
    """Vectors in the block's axes: K and T of all rods against P_s, N and inertia forces."""
    raw = solve_batch([engine])
    total, scale = np.zeros((2, raw.phi.size)), np.abs(raw.S).max() + np.abs(raw.K).max()

    def turned(angle: float, side: Array, up: Array) -> Array:
        """Components to the side of rotation and up of an axis at a clockwise angle."""
        cos, sin = np.cos(angle), np.sin(angle)
        return np.stack([side * cos + up * sin, up * cos - side * sin])

    for n, index in enumerate(engine.arrangement):
        pin = turned(0.0, np.sin(raw.local_phi[0, n]), np.cos(raw.local_phi[0, n]))
        along = np.stack([pin[1], -pin[0]])
        on_pin = -raw.K[0, n] * pin + raw.T[0, n] * along
        total += turned(index.axis, *on_pin)
        total -= turned(index.axis, raw.N[0, n], -raw.p_sum[0, n])
        if index.master is not None:
            row = raw.batch.articulated.cylinders.index(n)
            pin_path = raw.hung.motion.pin
            unit = engine.articulated[0].big_end * engine.omega**2 / engine.geometry.piston_area
            inertia = (-unit * part[2][0, row] for part in (pin_path.across, pin_path.along))
            total -= turned(index.axis, *inertia)
            total[0] -= raw.hung.on_pin.N_added[0, row]
    np.testing.assert_allclose(total, 0, atol=1e-11 * scale * engine.cylinders)
