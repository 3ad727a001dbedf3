"""Forces on the piston pin, rod and crank, Gots 2.5, by vectors of the free bodies."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from kshm.kinematics import CENTRAL

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class RodForces:
    """Forces N, S, K, T in the unit of the force along the cylinder axis."""

    N: Array
    S: Array
    K: Array
    T: Array


def decompose(axial: Array, phi: Array, lam: Array, k: Array = CENTRAL) -> RodForces:
    """Split the axial force P_s into N, S, K, T with the exact rod angle, Gots (34)-(37).

    The rod pushes the crankpin along the unit vector from the piston pin to the
    crankpin; K and T are its components towards the crank axis and along the
    rotation, N is what the cylinder wall must carry.  Signs as in Gots 2.5.
    """
    # Plane with x along the rotation at TDC and y up the cylinder axis; lengths over L.
    pin_x, pin_y = lam * np.sin(phi), lam * np.cos(phi)
    rod_x = pin_x - lam * k  # the piston pin stands at the offset
    rod_y = -np.sqrt(1 - rod_x**2)
    thrust = -axial / rod_y
    force_x, force_y = thrust * rod_x, thrust * rod_y
    radial = (force_x * pin_x + force_y * pin_y) / lam
    tangential = (force_x * pin_y - force_y * pin_x) / lam
    return RodForces(N=force_x, S=thrust, K=-radial, T=tangential)
