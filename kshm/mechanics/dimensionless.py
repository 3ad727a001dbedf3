"""Dimensionless piston motion after Segal: exact, two-term, inverse and extremes.

@book{segal,
  author = {Сегаль, В. Ф.},
  title  = {Динамические расчеты двигателей внутреннего сгорания},
}

Displacement is divided by R, velocity by ωR and acceleration by ω²R.  Everything is
elementwise on arrays that broadcast; angles are in radians from top dead centre.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from kshm.arrays import Array
from kshm.mechanics import kinematics

_ONE: Array = np.ones(())


@dataclass(frozen=True, slots=True)
class DimensionlessMotion:
    """Displacement, velocity and acceleration [-], arrays of one shape."""

    s: Array
    v: Array
    j: Array


def exact(alpha: Array, lam: Array) -> DimensionlessMotion:
    """Exact s, v = ds/dα, j = d²s/dα² [-], elementwise, Segal (1.17)-(1.19)."""
    return DimensionlessMotion(**kinematics.exact_motion(alpha, _ONE, lam, _ONE))


def two_term(alpha: Array, lam: Array) -> DimensionlessMotion:
    """Approximate s, v, j [-], elementwise, Segal (1.8), (1.14)."""
    parts = kinematics.two_term_motion(alpha, _ONE, lam, _ONE)
    return DimensionlessMotion(
        **{letter: first + second for letter, (first, second, _) in parts.items()}
    )


def angle_two_term(s: Array, lam: Array) -> Array:
    """Crank angle [rad] at the displacement s, elementwise, by the quadratic, Segal (1.11)."""
    # 1 − cos α = x solves x²·λ/2 − x·(1 + λ) + s = 0; half angles keep small s exact.
    x = 2 * s / (1 + lam + np.sqrt((1 + lam) ** 2 - 2 * lam * s))
    return 2 * np.arcsin(np.sqrt(np.clip(x / 2, 0, 1)))


def angle_small(s: Array, lam: Array) -> Array:
    """Crank angle [rad] at a small displacement s < 0.15, elementwise, Segal (1.12)."""
    return np.sqrt(2 * s / (1 + lam))


def angle_exact(s: Array, lam: Array) -> Array:
    """Crank angle [rad] at 0 ≤ s ≤ 2, elementwise: half angle of Segal's triangle (1.17)."""
    rod = 1 / lam
    closer, far = s * (2 * rod - s), (2 - s) * (2 * rod + 2 - s)
    return 2 * np.arctan2(np.sqrt(closer), np.sqrt(far))


def min_acceleration_two_term(lam: float) -> tuple[float, float]:
    """Angle [rad] and value [-] of the smallest two-term acceleration; Segal p. 13.

    At bottom dead centre for λ ≤ 1/4, else at cos α = −1/(4λ).
    """
    angle = np.arccos(max(-1.0, -1 / (4 * lam)))
    return float(angle), float(two_term(angle, np.array(lam)).j)


def min_acceleration(lam: float) -> tuple[float, float]:
    """Angle [rad] and value [-] of the smallest exact acceleration, by bisection of dj/dα."""
    low, high = -1.0, 0.0
    if _jerk_over_sine(low, lam) <= 0:
        return float(np.pi), -(1 - lam)
    for _ in range(200):
        middle = (low + high) / 2
        if _jerk_over_sine(middle, lam) > 0:
            low = middle
        else:
            high = middle
    angle = np.arccos((low + high) / 2)
    return float(angle), float(exact(angle, np.array(lam)).j)


def _jerk_over_sine(cosine: float, lam: float) -> float:
    """(dj/dα)/sin α; its sign changes at the minimum."""
    sine2 = 1 - cosine**2
    along = (1 / lam**2 - sine2) ** 0.5
    double = 2 * cosine**2 - 1
    terms = 4 / along - 3 * double / along**3 - 3 * cosine**2 * sine2 / along**5
    return float(-(1 + cosine * terms))
