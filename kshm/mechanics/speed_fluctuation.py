"""Excess work, speed over the cycle, cyclic irregularity and the flywheel."""

from __future__ import annotations

import numpy as np

from kshm.arrays import Array


def excess_work(torque: Array, phi: Array) -> Array:
    """Work of the torque above its mean since the first angle [J], shape (angles,), Gots 2.8.

    It closes over the cycle.

    Args:
        torque: engine torque over the cycle [N·m], the last value repeats the first.
        phi: shaft angle [rad], shape (angles,).
    """
    steps = ((torque[1:] + torque[:-1]) / 2 - torque[:-1].mean()) * np.diff(phi)
    return np.concatenate([[0.0], np.cumsum(steps)])


def flywheel_inertia(work: Array, engine_inertia: float, omega: float, delta: float) -> float:
    """Flywheel [kg·m²] that keeps the irregularity at ``delta``, Gots 2.8; 0 if none is needed.

    ``work`` is the excess work [J], shape (angles,).
    """
    return max(0.0, float(np.ptp(work)) / (delta * omega**2) - engine_inertia)


def irregularity(work: Array, inertia: float, omega: float) -> float:
    """Coefficient of cyclic irregularity ΔA/(I·ω²) [-] of ``work`` of shape (angles,), Gots 2.8."""
    return float(np.ptp(work)) / (inertia * omega**2)


def speed(work: Array, inertia: Array, omega: float) -> Array:
    """Angular velocity over the cycle [rad/s], shape (angles,), by energy, Ilchenko (1).

    Args:
        work: excess work of the gas forces alone [J]: the inertia forces are in I(φ).
        inertia: reduced moment of inertia with the flywheel I(φ) [kg·m²].
        omega: mean angular velocity [rad/s], met to the order of the irregularity squared.
    """
    energy = inertia[:-1].mean() * omega**2 / 2 + work - work[:-1].mean()
    omegas: Array = np.sqrt(2 * energy / inertia)
    return omegas
