"""Dimensionless piston motion after Segal: exact, two-term, inverse and extremes.

@book{segal,
  author = {Сегаль, В. Ф.},
  title  = {Динамические расчеты двигателей внутреннего сгорания},
}

Displacement is divided by R, velocity by ωR and acceleration by ω²R.  Arrays
broadcast; angles are in radians from top dead centre.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

# λ of Segal's printed tables 2-5.
SEGAL_LAMBDAS = (0.16, 0.18, 0.2, 0.22, 0.24, 0.26, 0.28, 0.303)


def displacement(alpha: Array, lam: Array) -> Array:
    """Exact displacement s [-], Segal (1.17), from the triangle of crank and rod."""
    result: Array = 1 + 1 / lam - np.cos(alpha) - _rod_along_axis(alpha, lam)
    return result


def velocity(alpha: Array, lam: Array) -> Array:
    """Exact velocity v = ds/dα [-], Segal (1.18)."""
    sine, cosine = np.sin(alpha), np.cos(alpha)
    result: Array = sine + sine * cosine / _rod_along_axis(alpha, lam)
    return result


def acceleration(alpha: Array, lam: Array) -> Array:
    """Exact acceleration j = d²s/dα² [-], Segal (1.19)."""
    sine, cosine = np.sin(alpha), np.cos(alpha)
    along = _rod_along_axis(alpha, lam)
    result: Array = cosine + (cosine**2 - sine**2) / along + (sine * cosine) ** 2 / along**3
    return result


def _rod_along_axis(alpha: Array, lam: Array) -> Array:
    """Projection of the rod on the cylinder axis over R, cos β / λ."""
    along: Array = np.sqrt(1 / lam**2 - np.sin(alpha) ** 2)
    return along


def displacement_two_term(alpha: Array, lam: Array) -> Array:
    """Approximate displacement [-], Segal (1.8)."""
    result: Array = 1 - np.cos(alpha) + lam / 2 * np.sin(alpha) ** 2
    return result


def velocity_two_term(alpha: Array, lam: Array) -> Array:
    """Approximate velocity [-], Segal (1.14)."""
    result: Array = np.sin(alpha) * (1 + lam * np.cos(alpha))
    return result


def acceleration_two_term(alpha: Array, lam: Array) -> Array:
    """Approximate acceleration [-], Segal (1.14)."""
    result: Array = np.cos(alpha) + lam * (2 * np.cos(alpha) ** 2 - 1)
    return result


def angle_two_term(s: Array, lam: Array) -> Array:
    """Crank angle [rad] at the displacement s by the quadratic equation, Segal (1.11)."""
    # 1 − cos α = x solves x²·λ/2 − x·(1 + λ) + s = 0; half angles keep small s exact.
    x = 2 * s / (1 + lam + np.sqrt((1 + lam) ** 2 - 2 * lam * s))
    return 2 * np.arcsin(np.sqrt(np.clip(x / 2, 0, 1)))


def angle_small(s: Array, lam: Array) -> Array:
    """Crank angle [rad] at a small displacement s < 0.15, Segal (1.12)."""
    angle: Array = np.sqrt(2 * s / (1 + lam))
    return angle


def angle_exact(s: Array, lam: Array) -> Array:
    """Crank angle [rad] at the displacement 0 ≤ s ≤ 2, exact: half angle of the triangle."""
    rod = 1 / lam
    near, far = s * (2 * rod - s), (2 - s) * (2 * rod + 2 - s)
    return 2 * np.arctan2(np.sqrt(near), np.sqrt(far))


def min_acceleration_two_term(lam: float) -> tuple[float, float]:
    """Angle [rad] and value [-] of the smallest two-term acceleration; Segal p. 13.

    At bottom dead centre for λ ≤ 1/4, else at cos α = −1/(4λ).
    """
    cosine = max(-1.0, -1 / (4 * lam))
    angle = float(np.arccos(cosine))
    return angle, float(acceleration_two_term(np.array(angle), np.array(lam)))


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
    angle = float(np.arccos((low + high) / 2))
    return angle, float(acceleration(np.array(angle), np.array(lam)))


def _jerk_over_sine(cosine: float, lam: float) -> float:
    """(dj/dα)/sin α, the sign of which tells on which side of the minimum one stands."""
    sine2 = 1 - cosine**2
    along = (1 / lam**2 - sine2) ** 0.5
    double = 2 * cosine**2 - 1
    terms = 4 / along - 3 * double / along**3 - 3 * cosine**2 * sine2 / along**5
    return float(-(1 + cosine * terms))


def packed_minutes(angle: Array) -> Array:
    """Angle [rad] as degrees·100 + minutes, rounded to a minute: 9°13′ is 913."""
    minutes = np.floor(np.degrees(angle) * 60 + 0.5)
    packed: Array = np.floor(minutes / 60) * 100 + np.mod(minutes, 60)
    return packed
