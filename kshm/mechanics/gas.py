"""Gas pressure over the crank angle: polytropic scheme of Dinn, rounded diagram, points.

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

from kshm.arrays import Array, Mask
from kshm.engine.engine import Engine
from kshm.engine.gas import RoundedGas, TabulatedGas
from kshm.errors import InputError
from kshm.mechanics.kinematics import Stroke, engine_stroke

# Angles come from whole degrees: 1e-9 rad decides on which side of a switch a point lies.
SLACK = 1e-9

EVERYWHERE: Mask = np.array(True)
Ratio = Callable[[Array], Array]  # V/V_c at an angle [rad]
DEGREE = np.pi / 180
FIRING = 2 * np.pi
BDC = 3 * np.pi


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
    scavenge_open: Array


def polytropic_pressure(
    phi: Array, ratio: Array, motion: Stroke, eps: Array, gas: PolytropicArrays, *,
    strokes: int = 4,
) -> Array:  # fmt: skip
    """Absolute gas pressure [Pa] at the angles ``phi`` [rad] of the cycle, Gots 2.1, Dinn.

    All arrays broadcast to the result's shape; ``ratio`` is V/V_c [-] at ``phi``.

    The timing is counted from the dead centres that the mechanism has: an offset moves
    them, and the angles of ``gas`` with them.
    """
    timing = _DiagramAngles(phi, ratio, motion, eps, gas, 2 * np.pi * (strokes // 2))
    return _two_stroke(timing) if strokes == 2 else _four_stroke(timing)


def _power(base: Array, exponent: Array, where: Mask) -> Array:
    """Power where wanted, 1 elsewhere; powers are slow."""
    result = np.ones(np.broadcast_shapes(base.shape, exponent.shape, where.shape))
    np.power(base, exponent, out=result, where=where)
    return result


class _DiagramAngles:
    """Angles from the piston's TDC and the curves that both kinds of cycle share."""

    def __init__(
        self, phi: Array, ratio: Array, motion: Stroke, eps: Array, gas: PolytropicArrays,
        period: float,
    ) -> None:  # fmt: skip
        # TDC of a central mechanism stands at 0, and its angles within the cycle as they are.
        self.angle = np.mod(phi - motion.tdc, period) if np.any(motion.tdc) else phi
        self.ratio = ratio
        self.half = motion.bdc - motion.tdc
        self.eps, self.gas, self._motion = eps, gas, motion

    def ratio_at(self, angle: Array) -> Array:
        """V/V_c at an angle from TDC."""
        return self._motion.ratio(angle + self._motion.tdc)

    def from_bdc(self, angle: Array) -> Array:
        """Angle of the input, meant for a BDC half a turn after TDC, from this TDC."""
        return angle + (self.half - np.pi)

    def compression(self, ratio: Array, begin: Array, where: Mask = EVERYWHERE) -> Array:
        """Polytrope n_1 from p_a at the ratio ``begin``; p_a outside ``where``."""
        return self.gas.p_intake * _power(begin / ratio, self.gas.n_compression, where)

    def rise(self, angle: Array, begin: Array) -> Array:
        """Straight rise from the start of combustion, at most to p_z."""
        gas = self.gas
        at_start = self.compression(self.ratio_at(gas.combustion_start), begin)
        slope = (gas.p_max - at_start) / gas.ignition_advance
        return np.minimum(gas.p_max, at_start + slope * (angle - gas.combustion_start))

    def expansion(self, ratio: Array, where: Mask = EVERYWHERE) -> Array:
        """Isobar to ρV_c and polytrope n_2; p_z outside ``where``."""
        gas = self.gas
        fall = _power(gas.rho / ratio, gas.n_expansion, where & (ratio > gas.rho))
        return gas.p_max * fall

    def line(self, begin: Array, from_: Array, end: Array, to: Array) -> Array:
        """Straight line of the pressure over the angle."""
        fraction = (self.angle - begin) / (end - begin)
        return from_ + (to - from_) * fraction


def _four_stroke(t: _DiagramAngles) -> Array:
    """Intake at p_a, compression from BDC, combustion, expansion, exhaust.

    φ = 0 is TDC before intake.  Compression by the polytrope n_1, from φ_c a straight
    rise towards p_z that would end after the injection advance, then the isobar to ρV_c
    and the polytrope n_2, a straight line from the start of the exhaust to its end, p_r
    afterwards (and at φ = 0).
    """
    gas, angle = t.gas, t.angle
    opens, closes = t.from_bdc(gas.exhaust_open), t.from_bdc(gas.exhaust_close)
    at_open = t.expansion(t.ratio_at(opens))
    taken_in = angle <= t.half + SLACK
    compressed = angle <= gas.combustion_start + SLACK
    burning = angle <= 2 * np.pi + SLACK
    expanded = angle <= opens + SLACK
    conditions = [angle <= SLACK, taken_in, compressed, burning, expanded, angle <= closes + SLACK]
    values = [
        gas.p_residual,
        gas.p_intake,
        t.compression(t.ratio, t.eps, compressed & ~taken_in),
        t.rise(angle, t.eps),
        t.expansion(t.ratio, expanded & ~burning),
        t.line(opens, at_open, closes, gas.p_residual),
    ]
    return np.select(conditions, values, default=gas.p_residual)


def _two_stroke(t: _DiagramAngles) -> Array:
    """Expansion, free exhaust, scavenging, compression, combustion: one turn.

    φ = 0 = 360° is TDC of combustion.  Where the ports are open the scheme of Dinn has
    nothing to say: here straight lines over the angle, from the expansion curve at the
    opening of the exhaust to p_r at the opening of the scavenging ports (free exhaust) and
    on to p_a where the exhaust closes; compression begins there by the polytrope n_1.
    """
    gas, angle = t.gas, t.angle
    opens, closes = t.from_bdc(gas.exhaust_open), t.from_bdc(gas.exhaust_close)
    scavenge = t.from_bdc(gas.scavenge_open)
    begin = t.ratio_at(closes)
    at_open = t.expansion(t.ratio_at(opens))
    turn = np.full_like(angle, 2 * np.pi)
    conditions = [
        angle <= SLACK,
        angle <= opens + SLACK,
        angle <= scavenge + SLACK,
        angle <= closes + SLACK,
        angle <= gas.combustion_start + SLACK,
    ]
    values = [
        t.rise(turn, begin),
        t.expansion(t.ratio),
        t.line(opens, at_open, scavenge, gas.p_residual),
        t.line(scavenge, gas.p_residual, closes, gas.p_intake),
        t.compression(t.ratio, begin),
    ]
    return np.select(conditions, values, default=t.rise(angle, begin))


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


def end_slope(slope: Array, chord: Array) -> Array:
    """A given slope [Pa/rad] at an end, within 0 and three chords, elementwise, Fritsch-Butland."""
    low, high = np.minimum(0.0, 3 * chord), np.maximum(0.0, 3 * chord)
    return np.clip(slope, low, high)


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
        TypeError: the diagram is one of polytropes, see ``kshm.mechanics.gas``.
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


def mean_pressure(pressure: Array, ratio: Array, compression_ratio: float) -> float:
    """Mean indicated pressure [the pressure's unit]: ∮p dV over the swept volume, Gots 2.1.

    Args:
        pressure: absolute pressures over the closed cycle, shape (points,).
        ratio: V/V_c there [-], (points,).
        compression_ratio: ε [-].
    """
    return float(np.trapezoid(pressure, ratio) / (compression_ratio - 1))


def polytropic_exponent(pressure: Array, ratio: Array) -> float:
    """Exponent n [-] of pVⁿ = const by least squares of ln p, shape (points,), definition.

    Raises:
        InputError: fewer than two points.
    """
    if len(pressure) < 2:
        raise InputError("two points or more are needed")
    x = np.log(ratio)
    x = x - x.mean()
    return float(-(x @ np.log(pressure)) / (x @ x))
