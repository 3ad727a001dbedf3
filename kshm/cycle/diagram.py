"""Indicator diagram of the calculated cycle, and the gas pressure it gives the dynamics.

φ = 0 is TDC before intake, so compression runs from 180° to 360°, combustion and
expansion from 360° to 540°.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from kshm.arrays import Array
from kshm.cycle.dizdn_listing import DEGREE, isobar_end
from kshm.cycle.performance import Cycle
from kshm.engine.gas import PolytropicGas
from kshm.errors import CycleError
from kshm.mechanics.kinematics import displacement_exact

# Width of a vertical line of the diagram where a function of φ is needed [rad]
EDGE = 1e-7


@dataclass(frozen=True, slots=True)
class IndicatorDiagram:
    """Points of the diagram from 180° to 540°, all of shape (points,), read-only.

    ``phi`` [rad], ``displacement`` s [m], ``volume`` [m³], ``pressure`` [Pa],
    ``temperature`` [K].  A vertical line is two points at the same angle.
    """

    phi: Array
    displacement: Array
    volume: Array
    pressure: Array
    temperature: Array


def isobar_angle(cycle: Cycle) -> float:
    """Crank angle of point z [rad], counted from intake TDC; 2π for petrol.

    From the triangle of the mechanism: s_z = S (ρ − 1)/(ε − 1), exact.
    """
    lam, eps = cycle.inputs.lam, cycle.inputs.compression_ratio
    s = 2 * (cycle.combustion.rho - 1) / (eps - 1)  # s/r
    pin = 1 + 1 / lam - s
    # By the half angle: (1 − cos φ)/2 = s (2/λ − s)/(4 pin) is exact also where s is near 0.
    half = max(0.0, s * (2 / lam - s) / (4 * pin))
    return 2 * math.pi + 2 * math.asin(min(1.0, math.sqrt(half)))


def _points(cycle: Cycle, phi: Array, radians: Array, rising: int, z: float) -> IndicatorDiagram:
    """Return the diagram at the angles: the first ``rising`` points belong to compression.

    ``radians`` are the angles as the formulas take them, ``z`` the angle [rad] at which
    expansion starts.
    """
    stroke, eps = cycle.inputs.stroke, cycle.inputs.compression_ratio
    if stroke is None:
        raise CycleError("diagram_needs_stroke", "stroke")
    r, lam = np.asarray(stroke / 2), np.asarray(cycle.inputs.lam)
    clearance = cycle.effective.displacement / (eps - 1)
    s = displacement_exact(radians, r, lam)
    v = clearance + cycle.effective.piston_area * s
    v_z = clearance + cycle.effective.piston_area * displacement_exact(np.asarray(z), r, lam)
    comp, comb, exp = cycle.compression, cycle.combustion, cycle.expansion
    squeeze, growth, fall = clearance / v, np.minimum(v / v_z, 1.0), np.minimum(v_z / v, 1.0)
    p_up, t_up = comp.p_c * squeeze**comp.n_1, comp.t_c * squeeze ** (comp.n_1 - 1)
    p_down, t_down = comb.p_z * fall**exp.n_2, comb.t_z * growth * fall ** (exp.n_2 - 1)
    compressing = np.arange(phi.size) < rising
    p, t = np.where(compressing, p_up, p_down), np.where(compressing, t_up, t_down)
    rows = np.vstack([phi, s, v, p, t])
    rows.setflags(write=False)
    return IndicatorDiagram(*rows)


def indicator_diagram(cycle: Cycle, step_deg: int = 1) -> IndicatorDiagram:
    """Points of the diagram on a grid of whole degrees, with the corners z' and z.

    Compression p = p_c (V_c/V)^n_1; isobar to z with T = T_z V/V_z; expansion
    p = p_z (V_z/V)^n_2.  A cycle in listing mode gets the program's own grid (10°,
    1° on the isobar) and its π/180 = 0.017453.

    Args:
        cycle: calculated with bore and stroke.
        step_deg: grid step [°], a divisor of 180.

    Raises:
        CycleError: a step that does not divide 180.
    """
    if cycle.listing:
        end = isobar_end(cycle.combustion.rho, cycle.inputs.lam, cycle.inputs.compression_ratio)
        first = -(-(end + 1) // 10) * 10
        parts = [np.arange(180, 361, 10), np.arange(361, end + 1), np.arange(first, 541, 10)]
        degrees = np.concatenate(parts).astype(np.float64)
        return _points(cycle, np.radians(degrees), degrees * DEGREE, parts[0].size, end * DEGREE)
    if step_deg < 1 or 180 % step_deg:
        raise CycleError("step_must_divide", "step_deg", step=step_deg)
    z = isobar_angle(cycle)
    up = np.radians(np.arange(180, 361, step_deg))
    grid = np.radians(np.arange(360 + step_deg, 541, step_deg))
    burning = [np.array([2 * np.pi, z])] if z > 2 * np.pi else [np.array([2 * np.pi])]
    down = np.unique(np.concatenate([*burning, grid]))
    phi = np.concatenate([up, down])
    return _points(cycle, phi, phi, up.size, z)


def diagram_at(cycle: Cycle, phi: Array) -> IndicatorDiagram:
    """Points of the unrounded diagram at given angles [rad] from π to 3π, rising, shape (points,).

    Polytropes of Grinevetsky and Mazing, Gots appendix 2; pressures [Pa], volumes [m³].

    At 2π stands the start of the isobar z', not the end of compression c.

    Raises:
        CycleError: the cycle has no stroke.
    """
    rising = int(np.searchsorted(phi, 2 * np.pi - EDGE))
    return _points(cycle, phi, phi, rising, isobar_angle(cycle))


def polytropic_gas(
    cycle: Cycle,
    *,
    ignition_advance: float,
    combustion_start: float,
    exhaust_open: float,
    exhaust_close: float,
) -> PolytropicGas:
    """Return the scheme of Dinn with p_a, p_r, p_z, n_1, n_2 and ρ of this cycle.

    The angles [rad] are those of `kshm.engine.engine.PolytropicGas`; they round the diagram,
    which the cycle itself does not.
    """
    return PolytropicGas(
        p_ambient=cycle.inputs.p_ambient,
        p_intake=cycle.charge.p_a,
        p_residual=cycle.charge.p_r,
        p_max=cycle.combustion.p_z,
        n_compression=cycle.compression.n_1,
        n_expansion=cycle.expansion.n_2,
        rho=cycle.combustion.rho,
        combustion_start=combustion_start,
        ignition_advance=ignition_advance,
        exhaust_open=exhaust_open,
        exhaust_close=exhaust_close,
    )
