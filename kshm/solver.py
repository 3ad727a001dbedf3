"""From engines to all results: the chain of Gots chapters 1 and 2 in one vectorised pass."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from kshm import diagram, forces, gas, journals, kinematics, torque, wear
from kshm.articulated import Hung, hang
from kshm.batch import Batch, stack
from kshm.engine import Engine
from kshm.pins import pin_forces, throw_forces
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
    volume_ratio: Array  # V/V_c
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
    pin_up: Array  # specific force on each crankpin along it outwards, (engines, pins, angles)
    pin_side: Array  # and along the rotation
    pin_load: Array
    throw_K: Array  # all rods of a throw in its frame, (engines, throws, angles)
    throw_T: Array
    throw_load: Array  # R_к: with the throw's own rotating mass
    throw_torque: Array  # [N·m]
    journal: Array  # specific reactions (engines, journals, angles, 2)
    journal_before: Array
    journal_after: Array
    journal_load: Array
    pin_wear: Array  # (engines, pins, rays)
    pin_rays: Array
    journal_wear: Array
    journal_rays: Array
    constants: tuple[Array, Array]  # centrifugal reactions left, right [N]
    hung: Hung | None  # the articulated rods


def solve_batch(engines: Sequence[Engine]) -> BatchSolution:
    """Solve engines of one structure together; see ``Batch`` for the shapes."""
    return _chain(stack(engines))


def solve(engine: Engine) -> Solution:
    """Solve one engine: kinematics, forces, torques, journal loads and wear, Gots (1)-(60)."""
    return Solution(engine, solve_batch([engine]))


def _pressure(batch: Batch, phi: Array, motion: gas.Stroke) -> Array:
    if batch.gas is not None:
        strokes = batch.engines[0].strokes
        return gas.polytropic_pressure(phi, motion, batch.eps, batch.gas, strokes=strokes)
    rows = []
    for engine, angles in zip(
        batch.engines, np.broadcast_to(phi, (len(batch.engines), *phi.shape[1:])), strict=True
    ):
        rows.append(diagram.engine_pressure(engine, angles))
    return np.stack(rows)


def _motion(batch: Batch) -> gas.Stroke:
    """Volume over the crank angle and dead centres of every cylinder with its own rod."""

    def ratio(phi: Array) -> Array:
        moved = kinematics.displacement_exact(phi, batch.r, batch.lam, batch.k)
        return gas.volume_ratio(moved, batch.piston_stroke, batch.eps)

    return gas.Stroke(ratio, *kinematics.dead_centres(batch.lam, batch.k))


@dataclass(frozen=True, slots=True)
class CylinderForces:
    """Displacement [m], pressure and specific forces [Pa], (engines, cylinders, angles)."""

    displacement: Array
    volume_ratio: Array
    p: Array
    p_gas: Array
    p_inertia: Array
    rod: forces.RodForces
    hung: Hung | None


def _cylinder_forces(batch: Batch, phi: Array) -> CylinderForces:
    """Gas pressure and specific forces of each cylinder at its own angle ``phi``."""
    motion = _motion(batch)
    pressure = _pressure(batch, phi, motion)
    r, lam, omega, k = batch.r, batch.lam, batch.omega, batch.k
    two_term = sum(kinematics.acceleration_orders(phi, r, lam, omega))
    two_term = two_term + kinematics.acceleration_offset(phi, r, lam, omega, k)
    exact = kinematics.acceleration_exact(phi, r, lam, omega, k)
    acceleration = np.where(batch.exact, exact, two_term)
    inertia = -batch.m_j * acceleration / batch.area
    p_gas = pressure - batch.p_ambient
    found = CylinderForces(
        displacement=kinematics.displacement_exact(phi, r, lam, k),
        volume_ratio=motion.ratio(phi),
        p=pressure,
        p_gas=p_gas,
        p_inertia=inertia,
        rod=forces.decompose(p_gas + inertia, phi, lam, k),
        hung=None,
    )
    return found if batch.articulated is None else _with_articulated(batch, phi, found)


def _with_articulated(batch: Batch, phi: Array, own: CylinderForces) -> CylinderForces:
    """The cylinders of articulated rods in place of those computed as if on the pin."""
    rods = batch.articulated
    if rods is None:
        return own
    at = list(rods.cylinders)
    hung = hang(
        rods, phi[:, at], batch.eps, lambda motion: _pressure(batch, phi[:, at], motion),
        batch.p_ambient, batch.omega, batch.area,
    )  # fmt: skip

    def put(values: Array, new: Array) -> Array:
        result = np.array(np.broadcast_to(values, phi.shape))
        result[:, at] = new
        return result

    return CylinderForces(
        displacement=put(own.displacement, hung.displacement),
        volume_ratio=put(own.volume_ratio, hung.volume_ratio),
        p=put(own.p, hung.p),
        p_gas=put(own.p_gas, hung.p - batch.p_ambient),
        p_inertia=put(own.p_inertia, hung.p_inertia),
        rod=forces.RodForces(
            N=put(own.rod.N, hung.N),
            S=put(own.rod.S, hung.S),
            K=put(own.rod.K, hung.on_pin.K),
            T=put(own.rod.T, hung.on_pin.T),
        ),
        hung=hung,
    )


def _rods(batch: Batch) -> journals.Rods:
    return journals.Rods(
        throw=tuple(c.throw for c in batch.arrangement),
        place=tuple(c.rod_place for c in batch.arrangement),
        turn=batch.pin_angle[:, :, 0],
        mass=batch.pin_mass[:, :, 0],
    )


def _chain(batch: Batch) -> BatchSolution:
    period = batch.engines[0].period
    local = np.mod(batch.phi - batch.theta, period)
    found = _cylinder_forces(batch, local)
    rod = found.rod
    M = rod.T * batch.area * batch.r
    rods, throws = _rods(batch), batch.throws
    count = throws.angle.shape[1]
    throw_torque = rods.summed(M, count)
    running_main = torque.running_on_main(throw_torque)

    unit = batch.r * batch.omega**2
    pins = pin_forces(batch, rod, unit)
    on_throws = throw_forces(batch, rods, rod, unit)

    r, omega, area = batch.r[:, :, 0], batch.omega[:, :, 0], batch.area[:, :, :, None]
    constants = journals.centrifugal_reactions(throws, r, omega, rods)
    forced = _journal_forces(batch, period, rod)
    K, T = journals.in_throw_frame(forced.K, forced.T, batch.pin_angle)
    total, before, after = journals.main_reactions(
        K * batch.area, T * batch.area, throws, rods, constants
    )
    journal = total / area
    side = journals.side_forces_left_of_pin(throws, r, omega)
    place = journals.positions(throws)
    length = place.length[:, list(rods.throw)]
    left_share = 1 - journals.right_share(rods.places(place), length)
    own_T = journals.in_throw_frame(rod.K, rod.T, batch.pin_angle)[1]
    tangential = rods.summed(left_share[..., None] * own_T * batch.area, count)
    tangential = tangential + (constants[0][..., 0] + side)[..., None]

    pin_rays = wear.ray_loads(pins.up, -pins.side, batch.rays)
    journal_rays = wear.ray_loads(journal[..., 1], journal[..., 0], batch.rays)
    result = BatchSolution(
        batch=batch,
        phi=batch.phi[0, 0],
        local_phi=local,
        displacement=found.displacement,
        volume_ratio=found.volume_ratio,
        p=found.p,
        p_gas=found.p_gas,
        p_inertia=found.p_inertia,
        p_sum=found.p_gas + found.p_inertia,
        N=rod.N,
        S=rod.S,
        K=rod.K,
        T=rod.T,
        torque=M,
        torque_sum=M.sum(axis=1),
        running_main=running_main,
        running_pin=torque.running_on_pin(throw_torque),
        running_pin_statics=torque.running_on_pin_statics(
            running_main[:, :-1], tangential, batch.r
        ),
        pin_up=pins.up,
        pin_side=pins.side,
        pin_load=np.hypot(pins.up, pins.side),
        throw_K=on_throws.K,
        throw_T=on_throws.T,
        throw_load=on_throws.load,
        throw_torque=throw_torque,
        journal=journal,
        journal_before=before / area,
        journal_after=after / area,
        journal_load=np.hypot(journal[..., 0], journal[..., 1]),
        pin_wear=wear.ray_sums(pin_rays),
        pin_rays=pin_rays,
        journal_wear=wear.ray_sums(journal_rays),
        journal_rays=journal_rays,
        constants=constants,
        hung=found.hung,
    )
    for value in (getattr(result, name) for name in BatchSolution.__dataclass_fields__):
        if isinstance(value, np.ndarray):
            value.flags.writeable = False
    return result


def _journal_forces(batch: Batch, period: float, rod: forces.RodForces) -> forces.RodForces:
    """Rod forces for the main journals; with other phases only where the input asks for them."""
    if np.array_equal(batch.theta, batch.force_theta):
        return rod
    return _cylinder_forces(batch, np.mod(batch.phi - batch.force_theta, period)).rod
