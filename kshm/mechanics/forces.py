"""Forces on the piston pin, rod and crank, Gots 2.5, by vectors of the free bodies."""

from __future__ import annotations

from dataclasses import dataclass

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
