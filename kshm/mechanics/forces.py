"""Forces on pin, rod and crank by vectors of the free bodies, Gots 2.5; torques, Gots 2.8."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from kshm.arrays import Array
from kshm.mechanics.kinematics import Position


@dataclass(frozen=True, slots=True)
class RodForces:
    """Forces N, S, K, T in the unit of the force along the cylinder axis."""

    N: Array
    S: Array
    K: Array
    T: Array


def decompose(axial: Array, at: Position) -> RodForces:
    """Split the axial force P_s [N or Pa] into N, S, K, T, elementwise, Gots (34)-(37).

    The rod pushes the crankpin along the line from the piston pin to the crankpin, S; the
    cylinder wall must carry its part across the cylinder, N.  K and T are the components
    of the push towards the crank axis and along the rotation.  Signs as in Gots 2.5.
    """
    thrust = axial / at.cos_beta
    side = thrust * at.sin_beta
    # The push has the components N to the side of rotation and P_s down the cylinder; the
    # crankpin stands at (sin φ, cos φ) and moves along (cos φ, −sin φ).
    return RodForces(
        N=side,
        S=thrust,
        K=axial * at.cos - side * at.sin,
        T=axial * at.sin + side * at.cos,
    )


def running_on_main(torque: Array) -> Array:
    """Torque running on to each main journal [N·m], Gots 2.8, tables 12 and П4.4.

    Args:
        torque: torque of each throw, shape (engines, throws, angles).

    Returns:
        Shape (engines, throws + 1, angles): zero on the first journal, the whole
        engine torque on the last.
    """
    engines, throws, angles = torque.shape
    running = np.zeros((engines, throws + 1, angles))
    np.cumsum(torque, axis=1, out=running[:, 1:])
    return running


def running_on_pin(before: Array, torque: Array) -> Array:
    """Torque running on to each crankpin [N·m] by the book's rule, Gots table 13.

    The torque on the main journal before plus half of the throw's own, both of shape
    (engines, throws, angles).
    """
    return before + torque / 2


def running_on_pin_statics(before: Array, tangential: Array, r: Array) -> Array:
    """Torque in the section through each crankpin [N·m] by statics, shape as ``before``.

    Gots 2.8 takes half of the throw's torque instead.

    Args:
        before: running-on torque on the main journal before the throw [N·m].
        tangential: tangential force that the left support's reaction and the
            centrifugal forces left of the pin put on the left half of the throw [N].
        r: crank radius [m].
    """
    return before + r * tangential


def gas_torque(
    p_gas: Array, phi: Array, r: Array, lam: Array, area: Array, k: float = 0.0
) -> Array:
    """Torque of the gas [N·m], elementwise, by virtual work, Gots (39).

    Args:
        p_gas: gas pressure over the one under the piston [Pa].
        phi: angle in the cycle of each cylinder [rad].
        r: crank radius [m].
        lam: λ [-].
        area: piston area [m²].
        k: relative offset e/r [-].
    """
    along = np.sqrt(1 / lam**2 - (np.sin(phi) - k) ** 2)
    torque: Array = p_gas * area * r * np.sin(phi) * (1 + np.cos(phi) / along)
    return torque - p_gas * area * r * k * np.cos(phi) / along
