"""What the chain of forces gives for engines of one structure."""

from __future__ import annotations

from dataclasses import dataclass

from kshm.arrays import Array
from kshm.chain.stack import Batch
from kshm.mechanics import wear
from kshm.mechanics.articulated import Hung


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
