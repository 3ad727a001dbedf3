"""From engines to all arrays: the chain of Gots chapters 1 and 2 in one vectorised pass."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, fields
from itertools import islice

import numpy as np

from kshm.arrays import Array, Columns
from kshm.chain.stack import Batch, stack
from kshm.engine.arrangement import pins
from kshm.engine.checks import check_kind
from kshm.engine.engine import Engine
from kshm.mechanics import forces, gas, journals, kinematics, wear
from kshm.mechanics.articulated import Hung, hang
from kshm.mechanics.journals import pin_directions

_CHUNK_VALUES = 2**17  # cylinders × angles of the engines in a chunk
KEPT_BYTES = 24 * 2**20  # above 32 MB the C library does not learn


@dataclass(frozen=True, slots=True)
class ChainArrays:
    """Read-only arrays in SI units; specific forces are forces over the piston area [Pa].

    The last axis runs over the crank angles of the cycle unless said otherwise.
    """

    batch: Batch  # the engines
    phi: Array  # crank angle [rad], (angles,)
    local_phi: Array  # angle in the cycle of each cylinder [rad], (engines, cylinders, angles)
    displacement: Array  # of each piston from its TDC [m], (engines, cylinders, angles)
    volume_ratio: Array  # V/V_c [-], (engines, cylinders, angles)
    p: Array  # absolute gas pressure [Pa], (engines, cylinders, angles)
    p_gas: Array  # over the pressure under the piston [Pa], (engines, cylinders, angles)
    p_inertia: Array  # specific inertia force [Pa], (engines, cylinders, angles)
    p_sum: Array  # their sum [Pa], (engines, cylinders, angles)
    N: Array  # side force on the cylinder wall [Pa], (engines, cylinders, angles)
    S: Array  # force along the rod [Pa], (engines, cylinders, angles)
    K: Array  # force towards the crank axis [Pa], (engines, cylinders, angles)
    T: Array  # force along the rotation [Pa], (engines, cylinders, angles)
    torque: Array  # of each cylinder [N·m], (engines, cylinders, angles)
    torque_sum: Array  # of the engine [N·m], (engines, angles)
    running_main: Array  # torque running on to each main journal [N·m], (engines, journals, angles)
    running_pin: Array  # and to each crankpin by the book's rule [N·m], (engines, throws, angles)
    running_pin_statics: Array  # the same by statics [N·m], (engines, throws, angles)
    pin_up: Array  # force on each crankpin along it outwards [Pa], (engines, pins, angles)
    pin_side: Array  # and along the rotation [Pa], (engines, pins, angles)
    pin_load: Array  # and its length [Pa], (engines, pins, angles)
    throw_K: Array  # all rods of a throw in its frame [Pa], (engines, throws, angles)
    throw_T: Array  # the same along the rotation [Pa], (engines, throws, angles)
    throw_load: Array  # R_к: with the throw's own rotating mass [Pa], (engines, throws, angles)
    throw_torque: Array  # of each throw [N·m], (engines, throws, angles)
    journal: Array  # reactions x, y of main bearings [Pa], (engines, journals, angles, 2)
    journal_before: Array  # of the throw before it [Pa], (engines, journals, angles, 2)
    journal_after: Array  # of the throw after it [Pa], (engines, journals, angles, 2)
    journal_load: Array  # length of the reaction [Pa], (engines, journals, angles)
    pin_wear: Array  # sums of the forces at the rays [Pa], (engines, pins, rays)
    journal_wear: Array  # the same of main journals [Pa], (engines, journals, rays)
    constants: tuple[Array, Array]  # centrifugal reactions left, right [N], (engines, throws, 2)
    hung: Hung | None  # the articulated rods

    def pin_rays(self, engine: int, pin: int) -> Array:
        """Force on a crankpin counted at each ray [Pa], shape (angles, rays), Gots table 14."""
        up, side = self.pin_up[engine, pin], self.pin_side[engine, pin]
        return wear.ray_loads(up, -side, self.batch.rays)

    def journal_rays(self, engine: int, journal: int) -> Array:
        """Reaction on a main journal counted at each ray [Pa], shape (angles, rays), Gots 2.6."""
        vector = self.journal[engine, journal]
        return wear.ray_loads(vector[:, 1], vector[:, 0], self.batch.rays)


@dataclass(frozen=True, slots=True)
class CrankpinForces:
    """Specific force on each crankpin in its frame [Pa], (engines, pins, angles)."""

    up: Array  # outwards along the crank
    side: Array  # along the rotation


@dataclass(frozen=True, slots=True)
class ThrowForces:
    """Specific forces of all rods on each throw in its frame [Pa], (engines, throws, angles)."""

    K: Array
    T: Array
    load: Array  # R_к with the centrifugal forces of the rods, the pin and the webs


def crankpin_forces(batch: Batch, K: Array, T: Array, unit: Array) -> CrankpinForces:
    """Sum of K, T and the centrifugal forces of the rods on every crankpin [Pa], Gots (40).

    As in Gots 2.6 the distance between the rods along the pin is left out.  The parts of
    a split pin are pins of their own.

    Args:
        batch: the engines.
        K: specific force of each rod towards the crank axis [Pa], shape
            (engines, cylinders, angles).
        T: specific force of each rod along the rotation, same shape.
        unit: rω² [m/s²], shape (engines, 1, 1).
    """
    up = batch.pin_mass * unit / batch.area - K
    groups = [list(group) for group in pins(batch.arrangement)]
    if groups == [[rod] for rod in range(up.shape[1])]:
        return CrankpinForces(up, T)

    def summed(values: Array) -> Array:
        return np.stack([values[:, group].sum(axis=1) for group in groups], axis=1)

    return CrankpinForces(summed(up), summed(T))


def throw_forces(batch: Batch, K: Array, T: Array, unit: Array) -> ThrowForces:
    """Sum over the rods of every throw and the force R_к on it [Pa], Gots (42).

    The throw's own mass is m_к of Gots (28), both webs taken along the crank.

    Args:
        batch: the engines.
        K: specific force of each rod towards the crank axis in its throw's frame [Pa],
            shape (engines, cylinders, angles).
        T: specific force of each rod along the rotation in its throw's frame, same shape.
        unit: rω² [m/s²], shape (engines, 1, 1).
    """
    throws, rods = batch.throws, batch.rods
    count = throws.angle.shape[1]
    K, T = rods.summed(K, count), rods.summed(T, count)
    shares = pin_directions(rods, count)
    along, ahead = (
        rods.summed(rods.mass * part, count) + throws.pin_mass * share
        for part, share in zip((np.cos(rods.turn), np.sin(rods.turn)), shares, strict=True)
    )
    centrifugal = unit / batch.area
    up = (along + throws.web_mass.sum(axis=-1))[..., None] * centrifugal - K
    side = T + ahead[..., None] * centrifugal
    return ThrowForces(K, T, np.sqrt(up**2 + side**2))


def solve_batch(engines: Sequence[Engine]) -> ChainArrays:
    """Solve engines of one structure together; see ``ChainArrays`` for the shapes."""
    return solve_stacked(stack(engines))


def solve_chunks(engines: Iterable[Engine], size: int | None = None) -> Iterator[ChainArrays]:
    """Solve any number of engines of one structure, a chunk at a time, in their order.

    Only one chunk is held; drop each before asking for the next.

    Args:
        engines: as many as there are, read as they are needed.
        size: engines in a chunk; without it as many as fit the processor's cache.

    Returns:
        Arrays of Gots (1)-(60) in SI, shape (engines, cylinders, angles) and the like.

    Raises:
        InputError: the engines of a chunk differ in structure.

    With ``engine`` as in the example of ``kshm.in_line``:

    >>> from dataclasses import replace
    >>> study = (replace(engine, omega=speed) for speed in (200.0, 250.0, 300.0))
    >>> [chunk.torque.shape for chunk in solve_chunks(study)]  # engines, cylinders, angles
    [(3, 4, 73)]
    """
    # The C library gives freed arrays back to the system and takes them again page by page,
    # which costs more than the arithmetic; once a great block was freed, it keeps them.
    np.empty(KEPT_BYTES, np.uint8)
    check_kind("engines", engines, Iterable)
    check_kind("size", size, int | None)
    remaining = iter(engines)
    while first := list(islice(remaining, 1)):
        check_kind("engines", first[0], Engine)
        count = size or chunk_size(first[0])
        yield solve_batch([*first, *islice(remaining, count - 1)])


def chunk_size(engine: Engine) -> int:
    """Return the number of engines of this structure in a chunk that fits the processor's cache."""
    angles = engine.strokes * 180 // engine.step_deg + 1
    return max(1, _CHUNK_VALUES // (engine.cylinders * angles))


def _pressure(batch: Batch, phi: Array, ratio: Array, volume: kinematics.Stroke) -> Array:
    engines = batch.engines
    if batch.gas is not None:
        strokes = engines[0].strokes
        return gas.polytropic_pressure(phi, ratio, volume, batch.eps, batch.gas, strokes=strokes)
    angles = np.broadcast_to(phi, (len(engines), *phi.shape[1:]))
    return np.stack([gas.engine_pressure(e, at) for e, at in zip(engines, angles, strict=True)])


def _in_cylinders(batch: Batch, phi: Array) -> tuple[Columns, Hung | None]:
    """Displacement, pressure and specific forces of each cylinder at its own angle ``phi``.

    By the names of ``ChainArrays``.
    """
    r, lam, k = batch.r, batch.lam, batch.k
    at = kinematics.Position.at(phi, lam, k)
    displacement = kinematics.displacement_at(at, r, lam, k)
    ratio = kinematics.volume_ratio(displacement, batch.piston_stroke, batch.eps)
    volume = kinematics.stroke_of(r, lam, k, batch.piston_stroke, batch.eps)
    p = _pressure(batch, phi, ratio, volume)
    p_inertia = (-batch.m_j / batch.area) * _acceleration(batch, at)
    p_gas = p - batch.p_ambient
    p_sum = p_gas + p_inertia
    rod = forces.decompose(p_sum, at)
    by_name = {
        "displacement": displacement, "volume_ratio": ratio,
        "p": p, "p_gas": p_gas, "p_inertia": p_inertia, "p_sum": p_sum,
        "N": rod.N, "S": rod.S, "K": rod.K, "T": rod.T,
    }  # fmt: skip
    hung = _hung(batch, phi)
    if hung is not None and batch.articulated is not None:
        # The cylinders of articulated rods in place of those computed as if on the pin.
        p_gas = hung.p - batch.p_ambient
        theirs = {
            "displacement": hung.displacement, "volume_ratio": hung.volume_ratio,
            "p": hung.p, "p_gas": p_gas, "p_inertia": hung.p_inertia,
            "p_sum": p_gas + hung.p_inertia,
            "N": hung.N, "S": hung.S, "K": hung.on_pin.K, "T": hung.on_pin.T,
        }  # fmt: skip
        for name, values in theirs.items():
            by_name[name] = np.array(by_name[name])
            by_name[name][:, batch.articulated.cylinders] = values
    return by_name, hung


def _hung(batch: Batch, phi: Array) -> Hung | None:
    rods = batch.articulated
    if rods is None:
        return None
    phases = phi[:, rods.cylinders]
    return hang(
        rods, phases, batch.eps, lambda ratio, volume: _pressure(batch, phases, ratio, volume),
        batch.p_ambient, batch.omega, batch.area,
    )  # fmt: skip


def _acceleration(batch: Batch, at: kinematics.Position) -> Array:
    """Acceleration of the pistons by the method of each engine [m/s²]."""
    values = batch.r, batch.lam, batch.omega
    if batch.exact.all():
        return kinematics.acceleration_exact_at(at, *values)
    two_term = kinematics.acceleration_two_term_at(at, *values, batch.k)
    if not batch.exact.any():
        return two_term
    return np.where(batch.exact, kinematics.acceleration_exact_at(at, *values), two_term)


def solve_stacked(batch: Batch) -> ChainArrays:
    """Return the whole chain for engines that are stacked already, Gots (1)-(60)."""
    period = batch.engines[0].period
    local = np.mod(batch.phi - batch.theta, period)
    in_cylinders, hung = _in_cylinders(batch, local)
    K, T = in_cylinders["K"], in_cylinders["T"]
    M = T * (batch.area * batch.r)
    rods, throws = batch.rods, batch.throws
    count = throws.angle.shape[1]
    throw_torque = rods.summed(M, count)
    running_main = forces.running_on_main(throw_torque)

    unit = batch.r * batch.omega**2
    pins = crankpin_forces(batch, K, T, unit)
    own_K, own_T = journals.in_throw_frame(K, T, batch.pin_angle)
    on_throws = throw_forces(batch, own_K, own_T, unit)

    constants = journals.centrifugal_reactions(throws, unit[:, :, 0], rods)
    forced = in_cylinders
    if not np.array_equal(batch.theta, batch.force_theta):
        # Other phases for the main journals only, where the input asks for them.
        forced, _ = _in_cylinders(batch, np.mod(batch.phi - batch.force_theta, period))
    on_journals = journals.in_throw_frame(forced["K"], forced["T"], batch.pin_angle)
    steady = (constants[0] / batch.area, constants[1] / batch.area)
    journal, before, after = journals.main_reactions(*on_journals, throws, rods, steady)
    left_share = 1 - rods.shares(throws.places)
    tangential = rods.summed((left_share[..., None] * batch.area) * own_T, count)
    side = journals.side_forces_left_of_pin(throws, unit[:, :, 0])
    tangential = tangential + (constants[0][..., 0] + side)[..., None]

    pin_load = _length(pins.up, pins.side)
    journal_load = _length(journal[..., 0], journal[..., 1])
    result = ChainArrays(
        batch=batch,
        phi=batch.phi[0, 0],
        local_phi=np.broadcast_to(local, M.shape),
        **in_cylinders,
        torque=M,
        torque_sum=M.sum(axis=1),
        running_main=running_main,
        running_pin=forces.running_on_pin(running_main[:, :-1], throw_torque),
        running_pin_statics=forces.running_on_pin_statics(
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
        hung=hung,
    )
    for field in fields(ChainArrays):
        value = getattr(result, field.name)
        if isinstance(value, np.ndarray):
            value.flags.writeable = False
    return result


def _length(x: Array, y: Array) -> Array:
    """Length of vectors of moderate size: faster than hypot, which guards against overflow."""
    return np.sqrt(x**2 + y**2)
