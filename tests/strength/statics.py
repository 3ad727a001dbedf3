"""Plate, curved bar, straight beam and ring that the books' fits of the parts are held to."""

from __future__ import annotations

import numpy as np

from kshm.arrays import Array

_POISSON = 0.3
_POINTS = 20001  # of a quadrature


def crown_stress(pressure: float, radius: float, thickness: float) -> tuple[float, float]:
    """Greatest bending stress [Pa] of an even round plate under pressure [Pa]: clamped, resting.

    Timoshenko: 3/4 p(r/δ)² at the clamped edge, 3(3+ν)/8 p(r/δ)² in the middle of a resting one.
    """
    base = pressure * (radius / thickness) ** 2
    return 0.75 * base, 3 * (3 + _POISSON) / 8 * base


def curved_fibre(moment: float, force: float, mean: float, wall: float, length: float) -> float:
    """Stress [Pa] of the outer fibre of a curved bar of rectangular section, by Winkler's theory.

    Args:
        moment: lowers the curvature [N·m].
        force: draws [N].
        mean: radius of the middle [m].
        wall: thickness [m].
        length: along the axis [m].
    """
    neutral = wall / np.log((mean + wall / 2) / (mean - wall / 2))
    outer, gap = mean + wall / 2, mean - neutral
    return float(moment * (outer - neutral) / (wall * length * gap * outer) + force / wall / length)


def pin_bending(force: float, length: float, bosses: float, eye: float, modulus: float) -> float:
    """Greatest bending stress [Pa] of the pin: even load in the eye, triangles in the bosses.

    Args:
        force: on the pin [N].
        length: of the pin [m].
        bosses: between them [m].
        eye: length of the eye [m].
        modulus: of the section [m³].
    """
    x = np.linspace(0.0, length / 2, _POINTS)  # from the middle
    boss = (length - bosses) / 2
    down = np.where(x <= eye / 2, force / eye, 0.0)
    up = np.where(x >= bosses / 2, force / boss * (1 - (x - bosses / 2) / boss), 0.0)
    return (_whole(up * x, x) - _whole(down * x, x)) / modulus


def pin_shear(force: float, outer: float, inner: float) -> float:
    """Greatest shear stress [Pa] of a hollow round section under half the force: Q S/(J b)."""
    half = force / 2
    first = (outer**3 - inner**3) / 12
    second = np.pi / 64 * (outer**4 - inner**4)
    return float(half * first / (second * (outer - inner)))


def pin_oval(force: float, length: float, outer: float, inner: float, modulus: float) -> float:
    """Growth of the diameter [m] of a thin ring pressed by cos loads from above and below."""
    mean, wall = (outer + inner) / 4, (outer - inner) / 2
    stiffness = modulus * wall**3 / 12
    angle = np.linspace(0.0, np.pi / 2, _POINTS)  # from the line of the force
    # q = (2/π)(F/(l r)) cos over both quarters; second harmonic of the load does the most.
    load = 2 * force / (np.pi * length * mean) * np.cos(angle)
    second = 4 / np.pi * _whole(load * np.cos(2 * angle), angle)
    shift = second * mean**4 / (9 * stiffness)  # w₂ of a ring: q₂ r⁴/(EJ (n² − 1)²), n = 2
    return float(2 * shift)


def _whole(values: Array, angle: Array) -> float:
    """Integral by trapezes."""
    return float(np.sum((values[1:] + values[:-1]) / 2 * np.diff(angle)))
