"""Gas pressure over the crank angle: the polytropic scheme of Dinn and a table of points."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from kshm.kinematics import displacement_exact

Array = NDArray[np.float64]

FULL = 4 * np.pi  # four-stroke cycle [rad]
# Angles come from whole degrees: 1e-9 rad decides on which side of a switch a point lies.
SLACK = 1e-9


@dataclass(frozen=True, slots=True)
class PolytropicArrays:
    """Parameters of the polytropic diagram as arrays that broadcast; Pa and rad."""

    p_intake: Array
    p_residual: Array
    p_max: Array
    n_compression: Array
    n_expansion: Array
    rho: Array
    combustion_start: Array
    ignition_advance: Array
    exhaust_open: Array
    exhaust_close: Array


def volume_ratio(phi: Array, r: Array, lam: Array, eps: Array) -> Array:
    """Cylinder volume over clearance volume V/V_c [-] from the exact displacement."""
    return 1 + (eps - 1) * displacement_exact(phi, r, lam) / (2 * r)


def polytropic_pressure(
    phi: Array, r: Array, lam: Array, eps: Array, gas: PolytropicArrays
) -> Array:
    """Absolute gas pressure [Pa] at the angles ``phi`` [rad] taken modulo 4π.

    φ = 0 is TDC before intake.  Intake at p_a, compression from BDC by the
    polytrope n_1, from φ_c a straight rise towards p_z that would end after the
    injection advance, then the isobar to ρV_c and the polytrope n_2, a straight
    line from the start of the exhaust to its end, p_r afterwards (and at φ = 0).
    """
    angle = np.mod(phi, FULL)
    ratio = volume_ratio(angle, r, lam, eps)

    compression = gas.p_intake * (eps / ratio) ** gas.n_compression
    start_ratio = volume_ratio(gas.combustion_start, r, lam, eps)
    at_start = gas.p_intake * (eps / start_ratio) ** gas.n_compression
    slope = (gas.p_max - at_start) / gas.ignition_advance
    rise = np.minimum(gas.p_max, at_start + slope * (angle - gas.combustion_start))
    expansion = gas.p_max * np.minimum(1.0, (gas.rho / ratio) ** gas.n_expansion)

    open_ratio = volume_ratio(gas.exhaust_open, r, lam, eps)
    at_open = gas.p_max * np.minimum(1.0, (gas.rho / open_ratio) ** gas.n_expansion)
    fraction = (angle - gas.exhaust_open) / (gas.exhaust_close - gas.exhaust_open)
    release = at_open + (gas.p_residual - at_open) * fraction

    intake = np.broadcast_to(gas.p_intake, ratio.shape)
    residual = np.broadcast_to(gas.p_residual, ratio.shape)
    conditions = [
        angle <= SLACK,
        angle <= np.pi + SLACK,
        angle <= gas.combustion_start + SLACK,
        angle <= 2 * np.pi + SLACK,
        angle <= gas.exhaust_open + SLACK,
        angle <= gas.exhaust_close + SLACK,
    ]
    values = [residual, intake, compression, rise, expansion, release]
    return np.select(conditions, values, default=residual)


def tabulated_pressure(phi: Array, angles: Array, pressures: Array) -> Array:
    """Absolute gas pressure [Pa] by straight lines between the given points.

    Straight lines cannot overshoot.  ``angles`` [rad] rise from 0 to 4π.
    """
    return np.interp(np.mod(phi, FULL), angles, pressures)
