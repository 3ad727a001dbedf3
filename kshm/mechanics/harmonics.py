"""Fourier series of the piston motion after Neiman; harmonics of the torque after Chudakov.

@book{neiman,
  author    = {Нейман, И. Ш.},
  title     = {Динамика авиационных двигателей},
  publisher = {Оборонгиз},
  year      = {1940},
}

    s/R = 1 + k − cos α − p₂ cos 2α + p₄ cos 4α − p₆ cos 6α + …,  Neiman (23)

The powers of λ in the printed (21) are one too high; (20) divided by λ gives the
coefficients used here, which are those of the printed table 1.

@article{chudakov,
  author = {Чудаков, Д. А. and Жарнов, Э. М.},
  title  = {Об уравновешивании тракторных четырехцилиндровых дизелей},
}

A harmonic of order k of the torque is A·sin(kφ + γ); φ runs from TDC before intake.
Specific coefficients are moments over F_п·R, that is harmonics of the specific tangential
force [Pa].
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from kshm.arrays import Array
from kshm.errors import InputError

ORDERS = (2, 4, 6, 8, 10, 12)
_CUT_OF_THE_TEXT = 4  # powers of sin²: the text keeps terms up to sin⁸


def coefficient(lam: float, order: int, terms: int | None = None) -> float:
    """Coefficient of the even ``order`` in Neiman (21); order 0 gives k.

    Args:
        lam: λ < 1.
        order: 0, 2, 4, …
        terms: powers of sin²α kept of the binomial series; None for all that count.

    Raises:
        InputError: the order is odd or negative.
    """
    if order < 0 or order % 2:
        raise InputError(f"the series has even orders only, not {order}")
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
    """Return harmonic of one order in s, v, j over R [-], elementwise, Neiman (23), (28), (36)."""
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


@dataclass(frozen=True, slots=True)
class Harmonics:
    """Sine and cosine parts of each order; amplitude and phase of A·sin(kφ + γ)."""

    orders: Array
    cosine: Array
    sine: Array

    @property
    def amplitude(self) -> Array:
        """A, in the unit of the curve."""
        return np.hypot(self.cosine, self.sine)

    @property
    def phase(self) -> Array:
        """γ [rad] in (−π, π]; zero where the harmonic vanishes against the largest one."""
        small = self.amplitude < 1e-9 * self.amplitude.max(initial=1e-300)
        # Rounding noise of a zero cosine would turn 180° into −180°.
        noise = np.abs(self.cosine) < 1e-9 * self.amplitude.max(initial=1e-300)
        return np.where(small, 0.0, np.arctan2(np.where(noise, 0.0, self.cosine), self.sine))


def analyse(values: Array, period: float, orders: Array) -> Harmonics:
    """Harmonics of a curve over its period by Fourier's transform, in its unit, Chudakov (1).

    Args:
        values: equidistant values, the last repeating the first, shape (angles,) [any unit].
        period: length of the curve [rad]: 4π or 2π.
        orders: orders per turn, multiples of 2π/period below the half of the samples.

    Raises:
        InputError: an order that the samples cannot tell.
    """
    body = values[:-1]
    index = np.rint(orders * period / (2 * np.pi)).astype(int)
    if np.any(np.abs(index * 2 * np.pi / period - orders) > 1e-9) or np.any(2 * index >= len(body)):
        msg = "orders must be multiples of the cycle's and below half of the number of samples"
        raise InputError(msg)
    spectrum = np.fft.rfft(body)[index] * 2 / len(body)
    return Harmonics(np.asarray(orders, dtype=float), spectrum.real, -spectrum.imag)


def inertia_coefficients(lam: float) -> tuple[float, float, float, float]:
    """Sine amplitudes of orders 1-4 of M_j/(m_j r² ω²) with two-term motion.

    λ/4, −1/2, −3λ/4, −λ²/4: the product of the two-term acceleration and velocity.
    """
    return lam / 4, -1 / 2, -3 * lam / 4, -(lam**2) / 4


def specific_imbalance(m_j: float, r: float, area: float) -> float:
    """Conditional specific imbalance d_j = m_j r/F [kg/m], Chudakov under (5)."""
    return m_j * r / area


def inertia_second(d_j: float, omega: Array) -> Array:
    """Inertia coefficient t_j2 = d_j ω²/2 [Pa], elementwise, Chudakov (5)."""
    return d_j * omega**2 / 2


def speed_of(t_gas: float, d_j: float) -> float:
    """Angular velocity [rad/s] at which t_j2 equals a gas coefficient: bound of a zone."""
    return float(np.sqrt(2 * t_gas / d_j))


def residual(t_gas: Array, t_inertia: Array, psi: float) -> Array:
    """|t_г2 − (1 − ψ)·t_j2| [Pa] with shafts that suppress ψ, elementwise, Chudakov (6)."""
    return np.abs(t_gas - (1 - psi) * t_inertia)


def residual_vector(t_gas: Array, gamma: float, t_inertia: Array, psi: float) -> Array:
    """Return same [Pa] as vectors with the true phase γ of the gas, elementwise, Chudakov (6)."""
    left: Array = np.abs(t_gas * np.exp(1j * gamma) - (1 - psi) * t_inertia)
    return left


def best_suppression(t_gas: Array, t_inertia: Array) -> Array:
    """ψ_опт [-] that makes Chudakov (6) zero, elementwise; none where it would be negative."""
    return np.maximum(0.0, 1 - t_gas / t_inertia)


def shaft_offset(psi: float, rod_length: float) -> float:
    """Vertical shift of the balance shafts h = ψ·L [m], Chudakov (8).

    The weights of one shaft give P_ц = 0.5·λ m_j R ω² for each cylinder; the printed
    0.5·P_ц = 0.5·λ m_j R ω² would make the shift half of that.
    """
    return psi * rod_length
