"""From engines to all results: the chain of Gots chapters 1 and 2 in one vectorised pass."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from kshm.chain.pins import pin_forces, throw_forces
from kshm.chain.stack import Batch, stack
from kshm.engine.engine import Engine
from kshm.mechanics import cubic_diagrams, forces, journals, kinematics, polytropes, torque, wear
from kshm.mechanics.articulated import Hung, hang
from kshm.results.solution import Solution

Array = NDArray[np.float64]

_CHUNK_VALUES = 2**17  # cylinders × angles of the engines in a chunk
_KEPT_BYTES = 24 * 2**20  # above 32 MB the C library does not learn


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
    journal_wear: Array
    constants: tuple[Array, Array]  # centrifugal reactions left, right [N]
    hung: Hung | None  # the articulated rods

    def pin_rays(self, engine: int, pin: int) -> Array:
        """Force on a crankpin counted at each ray [Pa], (angles, rays), Gots table 14."""
        up, side = self.pin_up[engine, pin], self.pin_side[engine, pin]
        return wear.ray_loads(up, -side, self.batch.rays)

    def journal_rays(self, engine: int, journal: int) -> Array:
        """Reaction on a main journal counted at each ray [Pa], (angles, rays)."""
        vector = self.journal[engine, journal]
        return wear.ray_loads(vector[:, 1], vector[:, 0], self.batch.rays)


def solve_batch(engines: Sequence[Engine]) -> BatchSolution:
    """Solve engines of one structure together; see ``Batch`` for the shapes."""
    return solve_stacked(stack(engines))


def solve_chunks(engines: Iterable[Engine], size: int | None = None) -> Iterator[BatchSolution]:
    """Solve any number of engines of one structure, a chunk at a time, in their order.

    Only one chunk is held; drop each before asking for the next.

    Args:
        engines: as many as there are, read as they are needed.
        size: engines in a chunk; without it as many as fit the processor's cache.

    Raises:
        ValueError: the engines of a chunk differ in structure.
    """
    # The C library gives freed arrays back to the system and takes them again page by page,
    # which costs more than the arithmetic; once a great block was freed, it keeps them.
    np.empty(_KEPT_BYTES, np.uint8)
    rest = iter(engines)
    while first := list(islice(rest, 1)):
        count = size or chunk_size(first[0])
        yield solve_batch([*first, *islice(rest, count - 1)])


def chunk_size(engine: Engine) -> int:
    """How many engines of its structure make a chunk that the processor's cache holds."""
    angles = engine.strokes * 180 // engine.step_deg + 1
    return max(1, _CHUNK_VALUES // (engine.cylinders * angles))


def solve(engine: Engine) -> Solution:
    """Solve one engine: kinematics, forces, torques, journal loads and wear, Gots (1)-(60)."""
    return Solution(engine, solve_batch([engine]))


def _pressure(batch: Batch, phi: Array, ratio: Array, motion: polytropes.Stroke) -> Array:
    if batch.gas is not None:
        strokes = batch.engines[0].strokes
        return polytropes.polytropic_pressure(
            phi, ratio, motion, batch.eps, batch.gas, strokes=strokes
        )
    rows = []
    for engine, angles in zip(
        batch.engines, np.broadcast_to(phi, (len(batch.engines), *phi.shape[1:])), strict=True
    ):
        rows.append(cubic_diagrams.engine_pressure(engine, angles))
    return np.stack(rows)


def _ratio(batch: Batch, displacement: Array) -> Array:
    return polytropes.volume_ratio(displacement, batch.piston_stroke, batch.eps)


def _motion(batch: Batch) -> polytropes.Stroke:
    """Volume over the crank angle and dead centres of every cylinder with its own rod."""

    def ratio(phi: Array) -> Array:
        return _ratio(batch, kinematics.displacement_exact(phi, batch.r, batch.lam, batch.k))

    return polytropes.Stroke(ratio, *kinematics.dead_centres(batch.lam, batch.k))


@dataclass(frozen=True, slots=True)
class CylinderForces:
    """Displacement [m], pressure and specific forces [Pa], (engines, cylinders, angles)."""

    displacement: Array
    volume_ratio: Array
    p: Array
    p_gas: Array
    p_inertia: Array
    p_sum: Array
    rod: forces.RodForces
    hung: Hung | None


def _cylinder_forces(batch: Batch, phi: Array) -> CylinderForces:
    """Gas pressure and specific forces of each cylinder at its own angle ``phi``."""
    r, lam, k = batch.r, batch.lam, batch.k
    at = kinematics.Position.at(phi, lam, k)
    displacement = kinematics.displacement_at(at, r, lam, k)
    ratio = _ratio(batch, displacement)
    pressure = _pressure(batch, phi, ratio, _motion(batch))
    inertia = (-batch.m_j / batch.area) * _acceleration(batch, at)
    p_gas = pressure - batch.p_ambient
    p_sum = p_gas + inertia
    found = CylinderForces(
        displacement=displacement,
        volume_ratio=ratio,
        p=pressure,
        p_gas=p_gas,
        p_inertia=inertia,
        p_sum=p_sum,
        rod=forces.decompose(p_sum, at),
        hung=None,
    )
    return found if batch.articulated is None else _with_articulated(batch, phi, found)


def _acceleration(batch: Batch, at: kinematics.Position) -> Array:
    """Acceleration of the pistons by the method of each engine [m/s²]."""
    values = batch.r, batch.lam, batch.omega
    if batch.exact.all():
        return kinematics.acceleration_exact_at(at, *values)
    two_term = kinematics.acceleration_two_term_at(at, *values, batch.k)
    if not batch.exact.any():
        return two_term
    return np.where(batch.exact, kinematics.acceleration_exact_at(at, *values), two_term)


def _with_articulated(batch: Batch, phi: Array, own: CylinderForces) -> CylinderForces:
    """The cylinders of articulated rods in place of those computed as if on the pin."""
    rods = batch.articulated
    if rods is None:
        return own
    at = list(rods.cylinders)
    hung = hang(
        rods, phi[:, at], batch.eps,
        lambda ratio, motion: _pressure(batch, phi[:, at], ratio, motion),
        batch.p_ambient, batch.omega, batch.area,
    )  # fmt: skip

    def put(values: Array, new: Array) -> Array:
        result = np.array(values)
        result[:, at] = new
        return result

    return CylinderForces(
        displacement=put(own.displacement, hung.displacement),
        volume_ratio=put(own.volume_ratio, hung.volume_ratio),
        p=put(own.p, hung.p),
        p_gas=put(own.p_gas, hung.p - batch.p_ambient),
        p_inertia=put(own.p_inertia, hung.p_inertia),
        p_sum=put(own.p_sum, hung.p - batch.p_ambient + hung.p_inertia),
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


def solve_stacked(batch: Batch) -> BatchSolution:
    """The whole chain for engines that are stacked already, Gots (1)-(60)."""
    period = batch.engines[0].period
    local = np.mod(batch.phi - batch.theta, period)
    found = _cylinder_forces(batch, local)
    rod = found.rod
    M = rod.T * (batch.area * batch.r)
    rods, throws = _rods(batch), batch.throws
    count = throws.angle.shape[1]
    throw_torque = rods.summed(M, count)
    running_main = torque.running_on_main(throw_torque)

    unit = batch.r * batch.omega**2
    pins = pin_forces(batch, rod, unit)
    own_K, own_T = journals.in_throw_frame(rod.K, rod.T, batch.pin_angle)
    on_throws = throw_forces(batch, rods, own_K, own_T, unit)

    r, omega = batch.r[:, :, 0], batch.omega[:, :, 0]
    constants = journals.centrifugal_reactions(throws, r, omega, rods)
    forced = _journal_forces(batch, period, rod)
    K, T = journals.in_throw_frame(forced.K, forced.T, batch.pin_angle)
    steady = (constants[0] / batch.area, constants[1] / batch.area)
    journal, before, after = journals.main_reactions(K, T, throws, rods, steady)
    side = journals.side_forces_left_of_pin(throws, r, omega)
    place = journals.positions(throws)
    length = place.length[:, list(rods.throw)]
    left_share = 1 - journals.right_share(rods.places(place), length)
    tangential = rods.summed((left_share[..., None] * batch.area) * own_T, count)
    tangential = tangential + (constants[0][..., 0] + side)[..., None]

    pin_load = _length(pins.up, pins.side)
    journal_load = _length(journal[..., 0], journal[..., 1])
    result = BatchSolution(
        batch=batch,
        phi=batch.phi[0, 0],
        local_phi=np.broadcast_to(local, M.shape),
        displacement=found.displacement,
        volume_ratio=found.volume_ratio,
        p=found.p,
        p_gas=found.p_gas,
        p_inertia=found.p_inertia,
        p_sum=found.p_sum,
        N=rod.N,
        S=rod.S,
        K=rod.K,
        T=rod.T,
        torque=M,
        torque_sum=M.sum(axis=1),
        running_main=running_main,
        running_pin=torque.running_on_pin(running_main[:, :-1], throw_torque),
        running_pin_statics=torque.running_on_pin_statics(
            running_main[:, :-1], tangential, batch.r
        ),
        pin_up=pins.up,
        pin_side=pins.side,
        pin_load=pin_load,
        throw_K=on_throws.K,
        throw_T=on_throws.T,
        throw_load=on_throws.load,
        throw_torque=throw_torque,
        journal=journal,
        journal_before=before,
        journal_after=after,
        journal_load=journal_load,
        pin_wear=wear.ray_sums(pins.up, -pins.side, pin_load, batch.rays),
        journal_wear=wear.ray_sums(journal[..., 1], journal[..., 0], journal_load, batch.rays),
        constants=constants,
        hung=found.hung,
    )
    for value in (getattr(result, name) for name in BatchSolution.__dataclass_fields__):
        if isinstance(value, np.ndarray):
            value.flags.writeable = False
    return result


def _length(x: Array, y: Array) -> Array:
    """Length of vectors of moderate size: faster than hypot, which guards against overflow."""
    length: Array = np.sqrt(x**2 + y**2)
    return length


def _journal_forces(batch: Batch, period: float, rod: forces.RodForces) -> forces.RodForces:
    """Rod forces for the main journals; with other phases only where the input asks for them."""
    if np.array_equal(batch.theta, batch.force_theta):
        return rod
    return _cylinder_forces(batch, np.mod(batch.phi - batch.force_theta, period)).rod
