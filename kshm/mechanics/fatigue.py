"""Safety of journals against fatigue: nominal stresses, Serensen and Kinasoshvili, class rule."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from kshm.arrays import Array
from kshm.nomenclature.quantity import UNITS

_MPA = UNITS["MPa"].si


@dataclass(frozen=True, slots=True)
class Swing:
    """Amplitude and mean of a stress [Pa], any shape."""

    amplitude: Array
    mean: Array

    @classmethod
    def of(cls, largest: Array, smallest: Array, modulus: Array) -> Swing:
        """From the extremes of a moment [N·m] and the modulus [m³], elementwise, statics."""
        return cls((largest - smallest) / 2 / modulus, (largest + smallest) / 2 / modulus)


def polar_modulus(diameter: Array, bore: Array) -> Array:
    """W_p = π(D⁴ − d⁴)/(16D) [m³], elementwise, statics; half of it resists bending."""
    modulus: Array = np.pi / 16 * diameter**3 * (1 - (bore / diameter) ** 4)
    return modulus


def concentration(shape: float, sensitivity: float) -> float:
    """Effective concentration k = 1 + q(α − 1) [-], definition."""
    return 1 + sensitivity * (shape - 1)


def safety(swing: Swing, limit: float, factor: float, of_mean: float) -> Array:
    """N = σ_−1/(kσ_a/(ε ε_п) + ψ|σ_m|) [-], shape of the stresses, Serensen, Kinasoshvili.

    Args:
        swing: the stress.
        limit: σ_−1 or τ_−1 [Pa].
        factor: k/(ε ε_п) [-].
        of_mean: ψ [-].
    """
    acting = factor * swing.amplitude + of_mean * np.abs(swing.mean)
    with np.errstate(divide="ignore"):
        found: Array = limit / acting
    return found


def together(bending: Array, torsion: Array) -> Array:
    """N = n_σ n_τ/√(n_σ² + n_τ²) [-], elementwise, Serensen, Kinasoshvili."""
    joined: Array = 1 / np.sqrt(1 / bending**2 + 1 / torsion**2)
    return joined


def class_strength(tensile: Array, diameter: Array, radius: Array, making: float) -> Array:
    """Fatigue strength of a crankpin [Pa], elementwise, IACS UR M53, from memory.

    K(0.42σ_B + 39.3)(0.264 + 1.073 D^−0.2 + (785 − σ_B)/4900 + 196/σ_B √(1/R)) in N/mm², mm.

    Args:
        tensile: σ_B [Pa].
        diameter: D [m].
        radius: R of the fillet, or half of the oil hole [m].
        making: K of the forging.
    """
    sigma, big, small = tensile / _MPA, 1000 * diameter, 1000 * radius
    shape = 0.264 + 1.073 * big**-0.2 + (785 - sigma) / 4900 + 196 / sigma * np.sqrt(1 / small)
    strength: Array = _MPA * making * (0.42 * sigma + 39.3) * shape
    return strength
