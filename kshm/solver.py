"""From engines to all results: the chain of Gots chapters 1 and 2 in one vectorised pass."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from kshm import diagram, forces, gas, journals, kinematics, torque, wear
from kshm.batch import Batch, stack
from kshm.engine import Engine
from kshm.solution import Solution

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class BatchSolution:
    """Results as arrays (engines, cylinders, throws or journals, angles), SI units.

    Specific forces are forces over the piston area [Pa]; all arrays are read-only.
    """

    batch: Batch
    phi: Array  # (angles,)
    local_phi: Array  # angle in the cycle of each cylinder, (engines, cylinders, angles)
    displacement: Array
    p: Array  # absolute gas pressure [Pa]
    p_gas: Array  # over the pressure under the piston
    p_inertia: Array
    p_sum: Array
    N: Array
    S: Array
    K: Array
    T: Array
    torque: Array  # [N·m] of each cylinder
    torque_sum: Array  # (engines, angles)
    running_main: Array
    running_pin: Array
    running_pin_statics: Array
    pin_up: Array  # specific force on crankpin 1 along the crank outwards, (engines, angles)
    pin_load: Array
    throw_load: Array  # R_к: with the throw's own rotating mass
    journal: Array  # specific reactions (engines, journals, angles, 2)
    journal_before: Array
    journal_after: Array
    journal_load: Array
    pin_wear: Array  # (engines, rays)
    pin_rays: Array
    journal_wear: Array
    journal_rays: Array
    constants: tuple[Array, Array]  # centrifugal reactions left, right [N]


def solve_batch(engines: Sequence[Engine]) -> BatchSolution:
    """Solve engines of one structure together; see ``Batch`` for the shapes."""
    if not all(engine.is_basic for engine in engines):
        msg = "only four-stroke in-line engines with a central mechanism are solved yet"
        raise NotImplementedError(msg)
    batch = stack(engines)
    return _chain(batch)


def solve(engine: Engine) -> Solution:
    """Solve one engine: kinematics, forces, torques, journal loads and wear, Gots (1)-(60)."""
    return Solution(engine, solve_batch([engine]))


def _pressure(batch: Batch, phi: Array) -> Array:
    if batch.gas is not None:
        return gas.polytropic_pressure(phi, batch.r, batch.lam, batch.eps, batch.gas)
    rows = []
    for engine, angles in zip(
        batch.engines, np.broadcast_to(phi, (len(batch.engines), *phi.shape[1:])), strict=True
    ):
        rows.append(diagram.engine_pressure(engine, angles))
    return np.stack(rows)


def _cylinder_forces(batch: Batch, phi: Array) -> tuple[Array, Array, Array, forces.RodForces]:
    """Gas pressure and specific forces of each cylinder at its own angle ``phi``."""
    pressure = _pressure(batch, phi)
    two_term = sum(kinematics.acceleration_orders(phi, batch.r, batch.lam, batch.omega))
    exact = kinematics.acceleration_exact(phi, batch.r, batch.lam, batch.omega)
    acceleration = np.where(batch.exact, exact, two_term)
    inertia = -batch.m_j * acceleration / batch.area
    p_gas = pressure - batch.p_ambient
    return pressure, p_gas, inertia, forces.decompose(p_gas + inertia, phi, batch.lam)


def _chain(batch: Batch) -> BatchSolution:
    period = batch.engines[0].period
    local = np.mod(batch.phi - batch.theta, period)
    p, p_gas, p_inertia, rod = _cylinder_forces(batch, local)
    M = rod.T * batch.area * batch.r
    running_main = torque.running_on_main(M)

    unit = batch.r * batch.omega**2
    pin_up = (batch.m_2 * unit / batch.area - rod.K)[:, 0]
    throw_up = pin_up + (batch.m_k * unit / batch.area)[:, 0]

    r, omega, area = batch.r[:, :, 0], batch.omega[:, :, 0], batch.area[:, :, :, None]
    constants = journals.centrifugal_reactions(batch.throws, r, omega, batch.m_2[:, :, 0])
    K, T = _journal_forces(batch, period, rod)
    K, T = K * batch.area, T * batch.area
    total, before, after = journals.main_reactions(K, T, batch.throws, constants)
    side = journals.side_forces_left_of_pin(batch.throws, r, omega)
    place = journals.positions(batch.throws)
    left_share = 1 - journals.right_share(place.rod, place.length)
    tangential = (
        left_share[..., None] * rod.T * batch.area + (constants[0][..., 0] + side)[..., None]
    )

    journal = total / area
    pin_rays = wear.ray_loads(pin_up, -rod.T[:, 0], batch.rays)
    journal_rays = wear.ray_loads(journal[..., 1], journal[..., 0], batch.rays)
    result = BatchSolution(
        batch=batch,
        phi=batch.phi[0, 0],
        local_phi=local,
        displacement=kinematics.displacement_exact(local, batch.r, batch.lam),
        p=p,
        p_gas=p_gas,
        p_inertia=p_inertia,
        p_sum=p_gas + p_inertia,
        N=rod.N,
        S=rod.S,
        K=rod.K,
        T=rod.T,
        torque=M,
        torque_sum=M.sum(axis=1),
        running_main=running_main,
        running_pin=torque.running_on_pin(M),
        running_pin_statics=torque.running_on_pin_statics(
            running_main[:, :-1], tangential, batch.r
        ),
        pin_up=pin_up,
        pin_load=np.hypot(pin_up, rod.T[:, 0]),
        throw_load=np.hypot(throw_up, rod.T[:, 0]),
        journal=journal,
        journal_before=before / area,
        journal_after=after / area,
        journal_load=np.hypot(journal[..., 0], journal[..., 1]),
        pin_wear=wear.ray_sums(pin_rays),
        pin_rays=pin_rays,
        journal_wear=wear.ray_sums(journal_rays),
        journal_rays=journal_rays,
        constants=constants,
    )
    for value in (getattr(result, name) for name in BatchSolution.__dataclass_fields__):
        if isinstance(value, np.ndarray):
            value.flags.writeable = False
    return result


def _journal_forces(batch: Batch, period: float, rod: forces.RodForces) -> tuple[Array, Array]:
    """K and T at the throws; with other phases only where the input asks for them."""
    if np.array_equal(batch.theta, batch.force_theta):
        return rod.K, rod.T
    other = _cylinder_forces(batch, np.mod(batch.phi - batch.force_theta, period))[3]
    return other.K, other.T
