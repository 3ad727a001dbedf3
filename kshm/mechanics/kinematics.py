"""Kinematics of the crank mechanism, Gots chapter 1: central and with an offset.

Every function works elementwise on arrays that broadcast (the crank angle on the last
axis) and returns SI values.  Angles are in radians.  φ = 0 where the crank is parallel
to the cylinder's axis: top dead centre of the central mechanism.  ``k`` = e/r is
the relative offset of Gots 1.4; zero gives the central mechanism bit for bit.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from kshm.arrays import Array
from kshm.engine.engine import Geometry

CENTRAL: Array = np.zeros(())


@dataclass(frozen=True, slots=True)
class Position:
    """Directions of crank and rod: sin φ, cos φ, sin β, cos β, all of one shape.

    They are the costly part of everything below and are the same for all of it.
    """

    sin: Array
    cos: Array
    sin_beta: Array
    cos_beta: Array

    @classmethod
    def at(cls, phi: Array, lam: Array, k: Array = CENTRAL) -> Position:
        """Return position at crank angle φ [rad], elementwise; β by Gots (2), (13), below 90°."""
        sin = np.sin(phi)
        sin_beta = lam * (sin - k)
        return cls(sin, np.cos(phi), sin_beta, np.sqrt(1 - sin_beta**2))


@dataclass(frozen=True, slots=True)
class Stroke:
    """When and how the volume of each cylinder changes, as arrays that broadcast.

    ``ratio`` gives V/V_c [-] at crank angles [rad] of the cylinder; ``tdc`` and ``bdc`` are
    its dead centres [rad], 0 and π in a central mechanism.
    """

    ratio: Callable[[Array], Array]
    tdc: Array
    bdc: Array


def sizes(geometry: Geometry) -> tuple[Array, Array, Array]:
    """R [m], λ and k [-] of one engine as arrays of shape (), Gots chapter 1."""
    g = geometry
    return np.array(g.crank_radius), np.array(g.lam), np.array(g.relative_offset)


def rod_angle(phi: Array, lam: Array, k: Array = CENTRAL) -> Array:
    """Rod angle β [rad], positive along rotation, elementwise, Gots (2), (7), (13), (17)."""
    return np.arcsin(lam * (np.sin(phi) - k))


def dead_centres(lam: Array, k: Array) -> tuple[Array, Array]:
    """Crank angles of TDC and BDC [rad], near 0 and π, elementwise, Gots (9), (10).

    φ_1 as printed; BDC stands at π − φ_2 with the sign of (10).
    """
    return np.arcsin(lam * k / (1 + lam)), np.pi + np.arcsin(lam * k / (1 - lam))


def volume_ratio(displacement: Array, stroke: Array, eps: Array) -> Array:
    """V/V_c [-] at a displacement [m], elementwise; V_c from the piston's own stroke, Gots 2.1."""
    return 1 + displacement * ((eps - 1) / stroke)


def stroke_of(r: Array, lam: Array, k: Array, stroke: Array, eps: Array) -> Stroke:
    """Volume and dead centres of cylinders with rods of their own, SI, elementwise, Gots (1)."""

    def ratio(phi: Array) -> Array:
        return volume_ratio(displacement_exact(phi, r, lam, k), stroke, eps)

    return Stroke(ratio, *dead_centres(lam, k))


def engine_stroke(geometry: Geometry) -> Stroke:
    """Volume and dead centres of one engine's cylinders with rods of their own, SI, Gots (1)."""
    eps = np.array(geometry.compression_ratio)
    return stroke_of(*sizes(geometry), np.array(geometry.stroke), eps)


def displacement_exact(phi: Array, r: Array, lam: Array, k: Array = CENTRAL) -> Array:
    """Piston displacement from TDC [m], exact, elementwise, Gots (1), (12)."""
    return displacement_at(Position.at(phi, lam, k), r, lam, k)


def displacement_at(at: Position, r: Array, lam: Array, k: Array = CENTRAL) -> Array:
    """Exact displacement [m] in a known position, elementwise, Gots (1), (12)."""
    rod = r / lam
    top = np.where(k == 0, r + rod, np.sqrt((r + rod) ** 2 - (k * r) ** 2))
    # Less the distance of the piston pin from the crank axis, straight from the triangle.
    return top - (r * at.cos + rod * at.cos_beta)


def displacement_orders(phi: Array, r: Array, lam: Array) -> tuple[Array, Array]:
    """First- and second-order displacement [m], elementwise, the two terms of Gots (3)."""
    return r * (1 - np.cos(phi)), r * lam / 2 * np.sin(phi) ** 2


def displacement_offset(phi: Array, r: Array, lam: Array, k: Array) -> Array:
    """Offset term of the two-term displacement [m], elementwise, Gots (14) less (3).

    (14) keeps the exact height of TDC, so the two-term s is slightly off zero there.
    """
    rod = 1 / lam
    top = np.sqrt((rod + 1) ** 2 - k**2) - (rod + 1)
    return r * (top + lam * k * (k / 2 - np.sin(phi)))


def velocity_exact(phi: Array, r: Array, lam: Array, omega: Array, k: Array = CENTRAL) -> Array:
    """Piston velocity [m/s], exact, elementwise, Gots 1.2 (instant centre of the rod)."""
    at = Position.at(phi, lam, k)
    return r * omega * (at.sin + at.sin_beta / at.cos_beta * at.cos)


def velocity_orders(phi: Array, r: Array, lam: Array, omega: Array) -> tuple[Array, Array]:
    """First- and second-order velocity [m/s], elementwise, the two terms of Gots (4)."""
    return r * omega * np.sin(phi), r * omega * lam * np.sin(phi) * np.cos(phi)


def velocity_offset(phi: Array, r: Array, lam: Array, omega: Array, k: Array) -> Array:
    """Offset term of the two-term velocity [m/s], elementwise, Gots (15) less (4)."""
    return -r * omega * lam * k * np.cos(phi)


def acceleration_exact(phi: Array, r: Array, lam: Array, omega: Array, k: Array = CENTRAL) -> Array:
    """Acceleration [m/s²], elementwise: the second derivative of Gots (1), (12)."""
    return acceleration_exact_at(Position.at(phi, lam, k), r, lam, omega)


def acceleration_exact_at(at: Position, r: Array, lam: Array, omega: Array) -> Array:
    """Exact acceleration [m/s²] in a known position, elementwise, from Gots (1), (12)."""
    # cos(φ + β)/cos β, and what the turning of the rod adds.
    shape = at.cos - at.sin * at.sin_beta / at.cos_beta + lam * at.cos**2 / at.cos_beta**3
    return r * omega**2 * shape


def acceleration_orders(phi: Array, r: Array, lam: Array, omega: Array) -> tuple[Array, Array]:
    """First- and second-order acceleration [m/s²], elementwise, the two terms of Gots (6)."""
    return _orders(np.cos(phi), r * omega**2, lam)


def _orders(cos: Array, centripetal: Array, lam: Array) -> tuple[Array, Array]:
    return centripetal * cos, centripetal * lam * (2 * cos**2 - 1)


def acceleration_offset(phi: Array, r: Array, lam: Array, omega: Array, k: Array) -> Array:
    """Offset term of the two-term acceleration [m/s²], elementwise, Gots (16) less (6)."""
    return r * omega**2 * lam * k * np.sin(phi)


def acceleration_two_term_at(
    at: Position, r: Array, lam: Array, omega: Array, k: Array = CENTRAL
) -> Array:
    """Two-term acceleration [m/s²] in a known position, elementwise, Gots (6), (16)."""
    centripetal = r * omega**2
    first, second = _orders(at.cos, centripetal, lam)
    both = first + second
    return both + centripetal * lam * k * at.sin if np.any(k) else both


def exact_motion(
    phi: Array, r: Array, lam: Array, omega: Array, k: Array = CENTRAL
) -> dict[str, Array]:
    """Exact s [m], v [m/s] and j [m/s²] by their letters, elementwise, Gots (1), (12)."""
    return {
        "s": displacement_exact(phi, r, lam, k),
        "v": velocity_exact(phi, r, lam, omega, k),
        "j": acceleration_exact(phi, r, lam, omega, k),
    }


def two_term_motion(
    phi: Array, r: Array, lam: Array, omega: Array, k: Array = CENTRAL
) -> dict[str, tuple[Array, Array, Array]]:
    """Orders 1 and 2 and an offset's part of s [m], v [m/s], j [m/s²], elementwise, Gots (3)-(16).

    By their letters; the two-term motion is the sum.
    """
    return {
        "s": (*displacement_orders(phi, r, lam), displacement_offset(phi, r, lam, k)),
        "v": (*velocity_orders(phi, r, lam, omega), velocity_offset(phi, r, lam, omega, k)),
        "j": (*acceleration_orders(phi, r, lam, omega), acceleration_offset(phi, r, lam, omega, k)),
    }


def rod_angular_velocity(
    phi: Array, lam: Array, omega: Array, k: Array = CENTRAL
) -> tuple[Array, Array]:
    """Angular velocity of the rod [rad/s], exact and near, elementwise, Gots (8), (18), (18a)."""
    exact = omega * lam * np.cos(phi) / np.cos(rod_angle(phi, lam, k))
    return exact, omega * lam * np.cos(phi)


def rod_angular_acceleration(
    phi: Array, lam: Array, omega: Array, k: Array = CENTRAL
) -> tuple[Array, Array]:
    """Angular acceleration of the rod [rad/s²], exact and near, elementwise, Gots (19), (19a).

    (19a) is printed without its minus.
    """
    beta = rod_angle(phi, lam, k)
    cos_b = np.cos(beta)
    central = -(omega**2) * lam * (1 - lam**2) * np.sin(phi) / cos_b**3
    # From cosβ·β'' = sinβ·β'² − λ sinφ, the relation (13) differentiated twice.
    turning = lam * np.cos(phi) / cos_b
    exact = omega**2 * (np.sin(beta) * turning**2 - lam * np.sin(phi)) / cos_b
    return np.where(k == 0, central, exact), -(omega**2) * lam * np.sin(phi)


def max_velocity_angle(lam: Array) -> Array:
    """Crank angle of the greatest two-term velocity [rad], elementwise, Gots (5)."""
    quarter = 1 / (4 * lam)
    return np.arccos(np.sqrt(quarter**2 + 0.5) - quarter)


def max_velocity(r: Array, lam: Array, omega: Array) -> Array:
    """Greatest two-term piston velocity [m/s], elementwise, Gots (4) at the angle of (5)."""
    first, second = velocity_orders(max_velocity_angle(lam), r, lam, omega)
    return first + second


def mean_velocity(r: Array, omega: Array) -> Array:
    """Mean piston speed c_m = 2rω/π [m/s], elementwise, Gots 1.2; r is half the stroke."""
    return 2 * r * omega / np.pi


def reference_functions(phi: Array, lam: Array) -> dict[str, Array]:
    """Trigonometric factors [-] of Gots tables 1, 2, 3, 5, 6, 7, 8, keyed by table id.

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
