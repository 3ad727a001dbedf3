"""Forced torsional vibration: all speeds and orders at once.

(−ω²J + iωB + K(1 + iη)) θ = T for each speed and order.  The matrices are tridiagonal, so the
elimination runs over the masses and every step takes all speeds and orders together.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from kshm.arrays import Array
from kshm.mechanics.torsion import Complex
from kshm.mechanics.torsional_train import Train

_SAMPLES = 16  # of the highest order over its period, for the sum in time


@dataclass(frozen=True, slots=True)
class Damper:
    """A ring at the first mass: inertia [kg·m²], spring [N·m/rad], damping [N·m·s/rad]."""

    inertia: float
    stiffness: float
    damping: float


@dataclass(frozen=True, slots=True)
class Response:
    """Complex amplitudes at ω = νΩ, shapes (masses or shafts, speeds, orders).

    ``angles`` [rad]; ``torques`` of the shafts between the masses [N·m]; ``work`` of the
    excitation and ``lost`` to damping in a period of each order [J], shape (speeds, orders).
    """

    angles: Complex
    torques: Complex
    work: Array
    lost: Array


def respond(
    train: Train,
    omega: Array,
    excitation: Complex,
    damping: Array,
    loss_factor: float,
    damper: Damper | None = None,
) -> Response:
    """Steady vibration under harmonic torques [rad], [N·m], conservation of momentum.

    Args:
        train: the train.
        omega: ω = νΩ [rad/s], shape (speeds, orders).
        excitation: torques at the masses [N·m], shape (masses, speeds, orders).
        damping: b of each mass [N·m·s/rad], shape (masses,).
        loss_factor: η of the shafts and of the ground.
        damper: at the first mass.
    """
    ring = 0 if damper is None else 1
    inertias, absolute = train.inertias, damping
    soft = 1 + 1j * loss_factor
    springs = [soft * value for value in train.stiffnesses]
    ground = np.zeros(len(inertias) + ring, dtype=complex)
    ground[ring] += soft * train.left
    ground[-1] += soft * train.right
    load = excitation
    if damper is not None:
        inertias = np.concatenate([[damper.inertia], inertias])
        absolute = np.concatenate([[0.0], absolute])
        springs.insert(0, damper.stiffness + 1j * omega * damper.damping)
        load = np.concatenate([np.zeros_like(excitation[:1]), excitation])
    angles = _solved(omega, inertias, absolute, springs, ground, load)
    twist = np.diff(angles, axis=0)
    size = np.abs(twist) ** 2
    lost = sum(np.imag(c) * each for c, each in zip(springs, size, strict=True))
    lost = lost + np.tensordot(np.imag(ground), np.abs(angles) ** 2, 1)
    lost = lost + omega * np.tensordot(absolute, np.abs(angles) ** 2, 1)
    return Response(
        angles[ring:],
        train.stiffnesses[:, None, None] * twist[ring:],
        np.pi * np.imag(load * np.conj(angles)).sum(axis=0),
        np.pi * lost,
    )


def _solved(
    omega: Array,
    inertias: Array,
    damping: Array,
    springs: list[complex] | list[Complex],
    ground: Complex,
    load: Complex,
) -> Complex:
    """Elimination down the train and back up, shape (masses, speeds, orders)."""
    square, count = omega**2, len(inertias)
    own: list[Complex] = []
    angles = np.array(load, dtype=complex)
    for k in range(count):
        diagonal = ground[k] - square * inertias[k] + 1j * omega * damping[k]
        diagonal = diagonal + (springs[k] if k < count - 1 else 0)
        if k:
            share = springs[k - 1] / own[k - 1]
            diagonal = diagonal + springs[k - 1] - springs[k - 1] * share
            angles[k] += share * angles[k - 1]
        own.append(diagonal)
    angles[-1] /= own[-1]
    for k in range(count - 2, -1, -1):
        angles[k] = (angles[k] + springs[k] * angles[k + 1]) / own[k]
    return angles


def sum_in_time(amplitudes: Complex, orders: Array, step: float) -> Array:
    """Greatest |Σ_ν A_ν e^{iνφ}| over the cycle [as A], shape (…,) of (…, orders), definition.

    Args:
        amplitudes: complex amplitudes by order.
        orders: ν per turn, multiples of ``step``.
        step: least order of the cycle: ½ of four strokes, 1 of two.
    """
    places = np.rint(orders / step).astype(int)
    samples = _SAMPLES * int(places.max())
    spectrum = np.zeros((*amplitudes.shape[:-1], samples // 2 + 1), dtype=complex)
    spectrum[..., places] = amplitudes * (samples / 2)
    greatest: Array = np.abs(np.fft.irfft(spectrum, samples)).max(axis=-1)
    return greatest


def stresses(train: Train, response: Response) -> Complex:
    """Torsional stress of the shafts M/W_p [Pa], shape (shafts, speeds, orders), statics."""
    if train.moduli is None:
        raise ValueError("the shafts have no sections")
    found: Complex = response.torques / train.moduli[:, None, None]
    return found
