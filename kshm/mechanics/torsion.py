"""Free torsional vibration of a train, phase sums, energy method, damper.

The symmetric problem J^(−1/2) K J^(−1/2) is solved by the singular values of its factor
√c (θ_{k+1} − θ_k)/√J: the frequencies themselves, not their squares, so low ones keep their
digits beside high ones.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from kshm.arrays import Array
from kshm.mechanics.torsional_train import Train

Complex = NDArray[np.complex128]
_STILL = 1e-9  # of the greatest angle


@dataclass(frozen=True, slots=True)
class Modes:
    """Angular frequencies [rad/s], shape (modes,), and forms with θ_1 = 1, (modes, masses).

    A free train's turning as a whole is left out.  A form that leaves the first mass all but
    still has its greatest angle as 1.
    """

    omega: Array
    forms: Array

    @property
    def hertz(self) -> Array:
        """Frequencies ω/2π [Hz], shape (modes,), by definition."""
        return self.omega / (2 * np.pi)


def modes_of(train: Train) -> Modes:
    """All elastic vibrations of a train, shapes (modes,) [rad/s], (modes, masses), as Holzer's."""
    root = np.sqrt(train.inertias)
    count = len(root)
    springs = np.concatenate([[train.left], train.stiffnesses, [train.right]])
    ends = np.arange(count)
    factor = np.zeros((count + 1, count))
    factor[ends, ends] = np.sqrt(springs[:-1]) / root
    factor[ends + 1, ends] = -np.sqrt(springs[1:]) / root
    _, values, vectors = np.linalg.svd(factor[springs > 0])
    omega = values[::-1]
    forms = vectors[len(values) - 1 :: -1] / root
    number = np.arange(len(forms))
    greatest = forms[number, np.abs(forms).argmax(axis=1)]
    moves = np.abs(forms[:, 0]) > _STILL * np.abs(greatest)
    return Modes(omega, forms / np.where(moves, forms[:, 0], greatest)[:, None])


def nodes(forms: Array) -> Array:
    """Place of the node within each shaft [masses from 1], NaN without one, by definition.

    Args:
        forms: shape (modes, masses).

    Returns:
        shape (modes, masses − 1).
    """
    left, right = forms[:, :-1], forms[:, 1:]
    crosses = (left < 0) != (right < 0)
    first = np.arange(1, forms.shape[1])
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(crosses, first + left / (left - right), np.nan)


def phase_sums(at_cylinders: Array, offsets: Array, orders: Array) -> Array:
    """Length of the vector sum |Σ a_k e^{−iνθ_k}| [-], shape (modes, orders), by definition.

    Args:
        at_cylinders: amplitudes of the forms at the cylinders' throws, (modes, cylinders).
        offsets: firing offsets θ_k [rad], (cylinders,).
        orders: ν per turn, (orders,).
    """
    turns = np.exp(-1j * np.outer(orders, offsets))
    sums: Array = np.abs(at_cylinders @ turns.T)
    return sums


def energy_resistance(train: Train, modes: Modes, damping: Array, loss_factor: float) -> Array:
    """Torque that damping takes from a form of 1 rad [N·m/rad], shape (modes,), conservation.

    ω Σ b_k a_k² + η Σ c_k (a_{k+1} − a_k)²; ``damping`` is b_k [N·m·s/rad], (masses,).
    """
    forms = modes.forms
    twist = (train.stiffnesses * np.diff(forms) ** 2).sum(axis=1)
    twist = twist + train.left * forms[:, 0] ** 2 + train.right * forms[:, -1] ** 2
    lost: Array = modes.omega * (damping * forms**2).sum(axis=1) + loss_factor * twist
    return lost


def form_stress(train: Train, modes: Modes) -> Array:
    """Greatest stress of a form of 1 rad M/W_p [Pa/rad], shape (modes,), statics."""
    if train.moduli is None:
        raise ValueError("the shafts have no sections")
    stress: Array = np.abs(train.stiffnesses * np.diff(modes.forms) / train.moduli).max(axis=1)
    return stress


def brought_inertia(train: Train, modes: Modes) -> Array:
    """Inertia of a form brought to the first mass Σ J a² [kg·m²], shape (modes,), definition."""
    brought: Array = (train.inertias * modes.forms**2).sum(axis=1)
    return brought


def best_tuning(share: float) -> tuple[float, float]:
    """Optimum of a tuned damper: κ = 1/(1 + μ) and ζ, ζ² = 3μ/(8(1+μ)³), Den Hartog.

    From memory.  κ is over the frequency without damper, ζ over 2 J_d ω_1.
    """
    return 1 / (1 + share), float(np.sqrt(3 * share / (8 * (1 + share) ** 3)))


def best_viscous(share: float) -> float:
    """Optimum ζ = 1/√(2(1 + μ)(2 + μ)) of a viscous damper over 2 J_d ω_1 [-], from memory."""
    return float(1 / np.sqrt(2 * (1 + share) * (2 + share)))
