"""Kinematics of the central crank mechanism, Gots chapter 1.

Every function takes arrays that broadcast (the crank angle on the last axis)
and returns SI values.  Angles are in radians, φ = 0 at top dead centre.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def rod_angle(phi: Array, lam: Array) -> Array:
    """Rod angle β [rad], positive in the direction of rotation, Gots (2), (7)."""
    return np.arcsin(lam * np.sin(phi))


def displacement_exact(phi: Array, r: Array, lam: Array) -> Array:
    """Piston displacement from TDC [m], exact, Gots (1)."""
    # Distance of the piston pin from the crank axis, straight from the triangle.
    rod = r / lam
    pin = r * np.cos(phi) + np.sqrt(rod**2 - (r * np.sin(phi)) ** 2)
    return r + rod - pin


def displacement_orders(phi: Array, r: Array, lam: Array) -> tuple[Array, Array]:
    """First- and second-order piston displacement [m], the two terms of Gots (3)."""
    return r * (1 - np.cos(phi)), r * lam / 2 * np.sin(phi) ** 2


def velocity_exact(phi: Array, r: Array, lam: Array, omega: Array) -> Array:
    """Piston velocity [m/s], exact, Gots 1.2 (instant centre of the rod)."""
    beta = rod_angle(phi, lam)
    velocity: Array = r * omega * (np.sin(phi) + np.tan(beta) * np.cos(phi))
    return velocity


def velocity_orders(phi: Array, r: Array, lam: Array, omega: Array) -> tuple[Array, Array]:
    """First- and second-order piston velocity [m/s], the two terms of Gots (4)."""
    return r * omega * np.sin(phi), r * omega * lam * np.sin(phi) * np.cos(phi)


def acceleration_exact(phi: Array, r: Array, lam: Array, omega: Array) -> Array:
    """Piston acceleration [m/s²], exact: the second derivative of Gots (1)."""
    beta = rod_angle(phi, lam)
    cos_b = np.cos(beta)
    shape = np.cos(phi + beta) / cos_b + lam * np.cos(phi) ** 2 / cos_b**3
    acceleration: Array = r * omega**2 * shape
    return acceleration


def acceleration_orders(phi: Array, r: Array, lam: Array, omega: Array) -> tuple[Array, Array]:
    """First- and second-order piston acceleration [m/s²], the two terms of Gots (6)."""
    centripetal = r * omega**2
    return centripetal * np.cos(phi), centripetal * lam * (2 * np.cos(phi) ** 2 - 1)


def rod_angular_velocity(phi: Array, lam: Array, omega: Array) -> tuple[Array, Array]:
    """Angular velocity of the rod [rad/s], exact and approximate, Gots (8)."""
    exact = omega * lam * np.cos(phi) / np.cos(rod_angle(phi, lam))
    return exact, omega * lam * np.cos(phi)


def rod_angular_acceleration(phi: Array, lam: Array, omega: Array) -> tuple[Array, Array]:
    """Angular acceleration of the rod [rad/s²], exact and approximate, Gots 1.3."""
    cos_b = np.cos(rod_angle(phi, lam))
    exact = -(omega**2) * lam * (1 - lam**2) * np.sin(phi) / cos_b**3
    return exact, -(omega**2) * lam * np.sin(phi)


def max_velocity_angle(lam: Array) -> Array:
    """Crank angle of the greatest two-term piston velocity [rad], Gots (5)."""
    quarter = 1 / (4 * lam)
    return np.arccos(np.sqrt(quarter**2 + 0.5) - quarter)


def max_velocity(r: Array, lam: Array, omega: Array) -> Array:
    """Greatest two-term piston velocity [m/s], Gots (4) at the angle of (5)."""
    first, second = velocity_orders(max_velocity_angle(lam), r, lam, omega)
    return first + second


def mean_velocity(r: Array, omega: Array) -> Array:
    """Mean piston speed c_m = 2rω/π [m/s], Gots 1.2."""
    return 2 * r * omega / np.pi


def reference_functions(phi: Array, lam: Array) -> dict[str, Array]:
    """Trigonometric factors of Gots tables 1, 2, 3, 5, 6, 7, 8, keyed by table id.

    Args:
        phi: crank angle [rad], any shape that broadcasts with ``lam``.
        lam: λ [-].
    """
    beta = rod_angle(phi, lam)
    cos_b = np.cos(beta)
    return {
        "table_1": (1 - np.cos(phi)) + lam / 4 * (1 - np.cos(2 * phi)),
        "table_2": np.sin(phi) + lam / 2 * np.sin(2 * phi),
        "table_3": np.cos(phi) + lam * np.cos(2 * phi),
        "table_5": np.tan(beta),
        "table_6": 1 / cos_b,
        "table_7": np.sin(phi + beta) / cos_b,
        "table_8": np.cos(phi + beta) / cos_b,
    }
