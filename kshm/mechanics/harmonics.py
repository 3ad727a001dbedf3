"""Fourier series of the piston motion after Neiman, to any even order.

@book{neiman,
  author    = {Нейман, И. Ш.},
  title     = {Динамика авиационных двигателей},
  publisher = {Оборонгиз},
  year      = {1940},
}

    s/R = 1 + k − cos α − p₂ cos 2α + p₄ cos 4α − p₆ cos 6α + …,  Neiman (23)

The powers of λ in the printed (21) are one too high; (20) divided by λ gives the
coefficients used here, which are those of the printed table 1.
"""

from __future__ import annotations

import math

import numpy as np

from kshm.arrays import Array

ORDERS = (2, 4, 6, 8, 10, 12)
_CUT_OF_THE_TEXT = 4  # powers of sin²: the text keeps terms up to sin⁸


def coefficient(lam: float, order: int, terms: int | None = None) -> float:
    """Coefficient of the even ``order`` in Neiman (21); order 0 gives k.

    Args:
        lam: λ < 1.
        order: 0, 2, 4, …
        terms: powers of sin²α kept of the binomial series; None for all that count.

    Raises:
        ValueError: the order is odd or negative.
    """
    if order < 0 or order % 2:
        raise ValueError(f"the series has even orders only, not {order}")
    half = order // 2
    if terms is None:
        terms = half + 8 + math.ceil(18 / max(1e-3, -2 * math.log10(lam)))
    total = 0.0
    for m in range(max(1, half), terms + 1):
        # sqrt(1 − x) = 1 − Σ c_m x^m with c_m = C(2m, m)/((2m − 1)·4^m).
        logarithm = (
            math.lgamma(2 * m + 1) - 2 * math.lgamma(m + 1) - math.log(2 * m - 1)
            + math.lgamma(2 * m + 1) - math.lgamma(m - half + 1) - math.lgamma(m + half + 1)
            - 2 * m * math.log(4) + (2 * m - 1) * math.log(lam)
        )  # fmt: skip
        total += math.exp(logarithm) * (2 if half else 1)
    return total


def printed_coefficient(lam: float, order: int) -> float:
    """Coefficient as the text computes its table 1: cut after sin⁸."""
    return coefficient(lam, order, _CUT_OF_THE_TEXT)


def signed(lam: float, order: int) -> float:
    """Amplitude of cos(order·α) in cos α + cos β/λ; 1 for order 1, zero for other odd orders."""
    if order == 1:
        return 1.0
    if order % 2:
        return 0.0
    return coefficient(lam, order) * (1 if order % 4 == 2 else -1)


def acceleration_amplitude(lam: float, order: int) -> float:
    """Amplitude of cos(order·α) in j/(ω²R), Neiman (36)."""
    return order**2 * signed(lam, order)


def motion(alpha: Array, lam: float, order: int) -> tuple[Array, Array, Array]:
    """The harmonic of one order in s, v, j over R [-], elementwise, Neiman (23), (28), (36)."""
    amplitude = signed(lam, order)
    cosine, sine = np.cos(order * alpha), np.sin(order * alpha)
    return -amplitude * cosine, order * amplitude * sine, order**2 * amplitude * cosine


def max_velocity(lam: Array) -> tuple[Array, Array]:
    """Angle [rad] of the greatest two-term velocity, its ratio to the mean, elementwise.

    Neiman (32), (33).
    """
    # Solved for the cosine without the cancellation of the printed difference of roots.
    cosine = 2 * lam / (1 + np.sqrt(1 + 8 * lam**2))
    angle = np.arccos(cosine)
    return angle, np.pi / 2 * np.sin(angle) * (1 + lam * cosine)


def rod_on_pin(alpha: Array, lam: Array) -> Array:
    """Angular velocity of the rod on the crankpin over ω [-], elementwise, Neiman (12)."""
    along = np.sqrt(1 / lam**2 - np.sin(alpha) ** 2)
    speed: Array = 1 + np.cos(alpha) / along
    return speed
