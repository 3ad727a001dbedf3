"""Indicator diagrams without overshoot: the rounded real diagram and smooth points.

The rounded diagram follows Gots figure 22: compression to c' where combustion becomes
visible, c'' at top dead centre, z_д where the pressure is greatest, the expansion line
to b', b'' at bottom dead centre, r where the free exhaust ends.  Between these points the
pressure is a cubic whose slopes keep it from overshooting (Fritsch and Butland); where it
leaves a polytrope it has the slope of the polytrope over the last degree.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from kshm.arrays import Array
from kshm.engine.engine import Engine
from kshm.engine.gas import RoundedGas, TabulatedGas
from kshm.mechanics.kinematics import engine_stroke

Ratio = Callable[[Array], Array]  # V/V_c at an angle [rad]

DEGREE = np.pi / 180
FIRING = 2 * np.pi
BDC = 3 * np.pi
SLACK = 1e-9  # rad, see ``kshm.mechanics.polytropes``


@dataclass(frozen=True, slots=True)
class Nodes:
    """Points of a piecewise cubic and its slopes there, arrays of one length."""

    x: Array
    y: Array
    slope: Array

    def at(self, x: Array) -> Array:
        """Value [Pa] of the cubic at ``x`` [rad], elementwise, by Hermite's polynomials.

        Slopes are those of Fritsch and Butland.
        """
        row = np.clip(np.searchsorted(self.x, x, side="right") - 1, 0, len(self.x) - 2)
        width = self.x[row + 1] - self.x[row]
        t = (x - self.x[row]) / width
        value: Array = (
            self.y[row] * (1 + 2 * t) * (1 - t) ** 2
            + self.slope[row] * width * t * (1 - t) ** 2
            + self.y[row + 1] * t**2 * (3 - 2 * t)
            - self.slope[row + 1] * width * t**2 * (1 - t)
        )
        return value


def middle_slope(before: Array, after: Array, left: Array, right: Array) -> Array:
    """Slope at a point between chords of widths ``left`` and ``right``, elementwise, SI.

    The weighted harmonic mean of Fritsch and Butland never exceeds three times the flatter
    chord, so the cubic stays between its points; at an extreme the slope is zero.
    """
    one, two = 2 * right + left, right + 2 * left
    same = before * after > 0
    safe_before = np.where(same, before, 1.0)
    safe_after = np.where(same, after, 1.0)
    mean: Array = (one + two) / (one / safe_before + two / safe_after)
    return np.where(same, mean, 0.0)


def end_slope(wanted: Array, chord: Array) -> Array:
    """A given slope [Pa/rad] at an end, within 0 and three chords, elementwise, Fritsch-Butland."""
    low, high = np.minimum(0.0, 3 * chord), np.maximum(0.0, 3 * chord)
    return np.clip(wanted, low, high)


def periodic_nodes(x: Array, y: Array) -> Nodes:
    """Nodes of a closed diagram [rad, Pa], shape (points,), slopes by Fritsch and Butland.

    The last point repeats the first one a period later.
    """
    width, chord = np.diff(x), np.diff(y) / np.diff(x)
    inner = middle_slope(chord[:-1], chord[1:], width[:-1], width[1:])
    seam = middle_slope(chord[-1:], chord[:1], width[-1:], width[:1])
    return Nodes(x, y, np.concatenate([seam, inner, seam]))


def compression(gas: RoundedGas, eps: float, ratio: Array) -> Array:
    """Polytrope from bottom dead centre [Pa], elementwise over V/V_c, Gots 2.1."""
    return gas.p_intake * (eps / ratio) ** gas.n_compression


def expansion(gas: RoundedGas, ratio: Array) -> Array:
    """Polytrope from the theoretical point z [Pa], elementwise over V/V_c, Gots 2.1."""
    return gas.p_max * (gas.rho / ratio) ** gas.n_expansion


def rounded_nodes(gas: RoundedGas, eps: float, ratio: Ratio) -> Nodes:
    """All points of the diagram [rad, Pa], shape (11,), Gots figure 22.

    They are r, a', a, c', c'', z_д, the join, b', b'', r', r; slopes at a, c', the join
    and b' serve the cubics that begin or end there.
    """

    def squeezed(angle: float) -> float:
        return float(compression(gas, eps, ratio(np.array(angle))))

    def expanded(angle: float) -> float:
        return float(expansion(gas, ratio(np.array(angle))))

    start, join, opens = gas.combustion_start, gas.join, gas.exhaust_open
    x = np.array(
        [0.0, gas.settle, np.pi, start, FIRING, gas.peak, join, opens, BDC, gas.exhaust_close,
         2 * FIRING]
    )  # fmt: skip
    y = np.array(
        [
            gas.p_residual,
            gas.p_intake,
            gas.p_intake,
            squeezed(start),
            gas.tdc_rise * gas.p_intake * eps**gas.n_compression,
            gas.peak_share * gas.p_max,
            expanded(join),
            expanded(opens),
            (expanded(BDC) + gas.p_residual) / 2,
            gas.p_residual,
            gas.p_residual,
        ]
    )
    width, chord = np.diff(x), np.diff(y) / np.diff(x)
    slope = np.zeros_like(x)
    slope[3] = end_slope(np.array((y[3] - squeezed(start - DEGREE)) / DEGREE), chord[3])
    slope[6] = end_slope(np.array((expanded(join + DEGREE) - y[6]) / DEGREE), chord[5])
    slope[7] = end_slope(np.array((y[7] - expanded(opens - DEGREE)) / DEGREE), chord[7])
    for node in (4, 8):
        slope[node] = middle_slope(chord[node - 1], chord[node], width[node - 1], width[node])
    return Nodes(x, y, slope)


def rounded_pressure(phi: Array, gas: RoundedGas, eps: float, ratio: Ratio) -> Array:
    """Absolute pressure [Pa] at the angles ``phi`` [rad], elementwise, Gots figure 22."""
    nodes = rounded_nodes(gas, eps, ratio)
    volume = ratio(phi)
    smooth = nodes.at(phi)
    conditions = [
        phi <= gas.settle + SLACK,
        phi <= np.pi + SLACK,
        phi <= gas.combustion_start + SLACK,
        phi <= gas.join + SLACK,
        phi <= gas.exhaust_open + SLACK,
        phi <= gas.exhaust_close + SLACK,
    ]
    values = [
        smooth,
        np.full_like(phi, gas.p_intake),
        compression(gas, eps, volume),
        smooth,
        expansion(gas, volume),
        smooth,
    ]
    return np.select(conditions, values, default=gas.p_residual)


def engine_pressure(engine: Engine, phi: Array) -> Array:
    """Absolute pressure [Pa] of a diagram by points or rounded, Gots figure 22.

    Args:
        engine: gas by points or rounded.
        phi: angles in the cycle [rad], any shape, which the result has.

    Raises:
        TypeError: the diagram is one of polytropes, see ``kshm.mechanics.polytropes``.
    """
    gas = engine.gas
    local = np.mod(phi, engine.period)
    if isinstance(gas, TabulatedGas):
        x, y = np.array(gas.angles), np.array(gas.pressures)
        return periodic_nodes(x, y).at(local) if gas.smooth else np.interp(local, x, y)
    if isinstance(gas, RoundedGas):
        eps, ratio = engine.geometry.compression_ratio, engine_stroke(engine.geometry).ratio
        return rounded_pressure(local, gas, eps, ratio)
    raise TypeError("the diagram is one of polytropes")
