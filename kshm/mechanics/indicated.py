"""What a diagram by points says of itself: its work and the exponents of its polytropes."""

from __future__ import annotations

import numpy as np

from kshm.arrays import Array


def mean_pressure(pressure: Array, ratio: Array, compression_ratio: float) -> float:
    """Mean indicated pressure [the pressure's unit]: ∮p dV over the swept volume, Gots 2.1.

    Args:
        pressure: absolute pressures over the closed cycle, (points,).
        ratio: V/V_c there [-], (points,).
        compression_ratio: ε [-].
    """
    return float(np.trapezoid(pressure, ratio) / (compression_ratio - 1))


def polytropic_exponent(pressure: Array, ratio: Array) -> float:
    """Exponent n [-] of pVⁿ = const by least squares of ln p over ln V, (points,), definition.

    Raises:
        ValueError: fewer than two points.
    """
    if len(pressure) < 2:
        raise ValueError("two points or more are needed")
    x = np.log(ratio)
    x = x - x.mean()
    return float(-(x @ np.log(pressure)) / (x @ x))
