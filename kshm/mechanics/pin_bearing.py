"""Big-end bearing of the rod and bending of the crankpin in its oil hole's plane, Gots 2.6."""

from __future__ import annotations

import numpy as np

from kshm.arrays import Array
from kshm.mechanics.kinematics import Position

PLANES = 18  # planes through the pin's axis, every 10°


def rod_bearing(inward: Array, ahead: Array, at: Position) -> tuple[Array, Array]:
    """Load on the big-end bearing in the rod's axes [Pa], shape (angles,), Gots 2.6.

    The load is the opposite of the force on the pin, turned into axes along the rod (y,
    towards the piston pin) and across it (x, in the direction of rotation at the pin).

    Args:
        inward: force of the rod on the pin towards the shaft with m_2's [Pa].
        ahead: force along the rotation [Pa].
        at: position of crank and rod.
    """
    across = inward * at.sin - ahead * at.cos  # on the bearing, in the cylinder's axes
    along = inward * at.cos + ahead * at.sin
    return (
        across * at.cos_beta + along * at.sin_beta,
        along * at.cos_beta - across * at.sin_beta,
    )


def on_plane(inward: Array, ahead: Array, angle: float) -> Array:
    """Projection of R_к on a plane of the pin [Pa], shape (angles,), Gots 2.6, (42).

    Args:
        inward: K_Σ towards the shaft with all centrifugal forces [Pa].
        ahead: T along the rotation [Pa].
        angle: of the plane from the crank against rotation [rad].
    """
    projection: Array = inward * np.cos(angle) + ahead * np.sin(angle)
    return projection


def plane_angles() -> Array:
    """Angles of the planes from the crank against rotation [rad], shape (planes,), Gots 2.6."""
    return np.pi / PLANES * np.arange(PLANES, dtype=np.float64)
