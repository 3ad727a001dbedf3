"""Gas pressure over the crank angle by the polytropic scheme of Dinn."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from kshm.arrays import Array, Mask
from kshm.mechanics.kinematics import Stroke

# Angles come from whole degrees: 1e-9 rad decides on which side of a switch a point lies.
SLACK = 1e-9

EVERYWHERE: Mask = np.array(True)


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
    timing = _Timing(phi, ratio, motion, eps, gas, 2 * np.pi * (strokes // 2))
    return _two_stroke(timing) if strokes == 2 else _four_stroke(timing)


def _power(base: Array, exponent: Array, where: Mask) -> Array:
    """Powers are dear: taken where they are asked for, 1 elsewhere."""
    result = np.ones(np.broadcast_shapes(base.shape, exponent.shape, where.shape))
    np.power(base, exponent, out=result, where=where)
    return result


class _Timing:
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
        """Polytrope n_1 from p_a at the ratio ``begin``; p_a where it is not asked for."""
        return self.gas.p_intake * _power(begin / ratio, self.gas.n_compression, where)

    def rise(self, angle: Array, begin: Array) -> Array:
        """Straight rise from the start of combustion, at most to p_z."""
        gas = self.gas
        at_start = self.compression(self.ratio_at(gas.combustion_start), begin)
        slope = (gas.p_max - at_start) / gas.ignition_advance
        return np.minimum(gas.p_max, at_start + slope * (angle - gas.combustion_start))

    def expansion(self, ratio: Array, where: Mask = EVERYWHERE) -> Array:
        """Isobar to ρV_c and polytrope n_2; p_z where it is not asked for."""
        gas = self.gas
        fall = _power(gas.rho / ratio, gas.n_expansion, where & (ratio > gas.rho))
        return gas.p_max * fall

    def line(self, begin: Array, from_: Array, end: Array, to: Array) -> Array:
        """Straight line of the pressure over the angle."""
        fraction = (self.angle - begin) / (end - begin)
        return from_ + (to - from_) * fraction


def _four_stroke(t: _Timing) -> Array:
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


def _two_stroke(t: _Timing) -> Array:
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
