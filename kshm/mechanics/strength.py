"""Strength of the parts from first principles: plate, curved and straight beams, thick rings.

The books' formulas of the same are fits; `docs/validation.md` tells how far they are from these.
"""

from __future__ import annotations

import numpy as np

from kshm.arrays import Array

POISSON = 0.3
_POINTS = 20001  # of a quadrature


def crown_stress(pressure: float, radius: float, thickness: float) -> tuple[float, float]:
    """Greatest bending stress [Pa] of an even round plate under pressure [Pa]: clamped, resting.

    Timoshenko: 3/4 p(r/δ)² at the clamped edge, 3(3+ν)/8 p(r/δ)² in the middle of a resting one.
    """
    base = pressure * (radius / thickness) ** 2
    return 0.75 * base, 3 * (3 + POISSON) / 8 * base


def eye_forces(embedding: float, *, drawn: bool) -> tuple[float, float]:
    """Force and moment in the top of the eye, over P and P·r; ``embedding`` [rad] from the top.

    A thin ring's half from its plane of symmetry to where it is embedded: neither a turn nor a
    shift aside at either end.  Drawn: an even load P/(2r) outwards over the upper half; pressed:
    2P/(πr)·cos over the lower half.

    Returns:
        N_0/P and M_0/(P r).
    """
    angle = np.linspace(0.0, embedding, _POINTS)
    own, lever = _of_load(angle, drawn=drawn), 1 - np.cos(angle)
    # Moment M_0 + N_0(1 − cos φ) + own; no turn: its integral is 0, no shift aside: with cos.
    ones = np.ones_like(angle)
    rows = [[_whole(ones * w, angle), _whole(lever * w, angle)] for w in (ones, np.cos(angle))]
    right = [-_whole(own * w, angle) for w in (ones, np.cos(angle))]
    moment, force = np.linalg.solve(np.array(rows), np.array(right))
    return float(force), float(moment)


def _of_load(angle: Array, *, drawn: bool) -> Array:
    """Moment of the load alone at each angle from the top, over P·r."""
    if drawn:
        upper = -0.5 * (1 - np.cos(np.minimum(angle, np.pi / 2)))
        return np.where(angle <= np.pi / 2, upper, -0.5 * (np.sin(angle) - np.cos(angle)))
    beyond = np.maximum(angle - np.pi / 2, 0.0)
    # A thread of 2P/(πr)·cos ψ over the lower half, ψ from the bottom.
    bracket = np.cos(beyond) / 2 - (beyond + np.pi / 2) / np.pi * np.cos(beyond)
    bracket += np.sin(beyond) / np.pi
    return -np.where(angle <= np.pi / 2, 0.0, bracket)


def _whole(values: Array, angle: Array) -> float:
    """Integral by trapezes."""
    return float(np.sum((values[1:] + values[:-1]) / 2 * np.diff(angle)))


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


def fit_pressure(
    gap: float, radii: tuple[float, float, float], moduli: tuple[float, float]
) -> float:
    """Pressure [Pa] between two thick rings put together, by Lamé.

    Args:
        gap: interference of the diameters [m].
        radii: inner of the bush, common, outer of the eye [m].
        moduli: of the bush and of the eye [Pa].
    """
    inner, common, outer = radii
    bush, eye = moduli
    # Radial shift of each ring's surface under a unit pressure: A r(1 − ν)/E + B(1 + ν)/(E r).
    widened, narrowed = _lame(common, outer, eye), _lame(common, inner, bush)
    return gap / 2 / (widened - narrowed)


def _lame(at: float, other: float, modulus: float) -> float:
    """Radial shift at a surface with unit pressure, the other free [m/Pa]."""
    rows = np.array([[1.0, -1 / at**2], [1.0, -1 / other**2]])
    a, b = np.linalg.solve(rows, np.array([-1.0, 0.0]))
    return float(((1 - POISSON) * a * at + (1 + POISSON) * b / at) / modulus)


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


def column_factor(limit: float, area: float, second: float, length: float, modulus: float) -> float:
    """Factor of the shank's stress for buckling: 1 + σ_в F/P_Euler, both ends on hinges."""
    return 1 + limit * area / (np.pi**2 * modulus * second / length**2)


def torsion_factor(ratio: float) -> float:
    """W/(b h²) of a rectangle under torsion by its sides' ratio, Saint-Venant's series."""
    odd = np.arange(1, 80, 2)
    alpha = 1 / 3 - 64 / np.pi**5 / ratio * np.sum(np.tanh(odd * np.pi * ratio / 2) / odd**5)
    slope = 1 - 8 / np.pi**2 * np.sum(1 / (odd**2 * np.cosh(odd * np.pi * ratio / 2)))
    return float(alpha / slope)


def safety(most: float, least: float, limits: tuple[float, float], k: float, mean: float) -> float:
    """Safety of a cycle: on the line of fatigue or that of yielding, whichever is met first.

    Args:
        most: greatest stress of the cycle.
        least: least one.
        limits: of endurance and of yielding.
        k: concentration over size and surface.
        mean: factor of the mean stress.
    """
    amplitude, middle = (most - least) / 2 * k, max((most + least) / 2, 0.0)
    endurance, yielding = limits
    # Limit lines over the mean stress: σ_−1 − ψσ_m and σ_т − σ_m; the ray of the cycle meets both.
    return min(endurance / (amplitude + mean * middle), yielding / (amplitude + middle))
