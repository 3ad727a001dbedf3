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
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from kshm.engine.engine import RoundedGas, TabulatedGas
from kshm.mechanics.kinematics import displacement_exact

if TYPE_CHECKING:
    from kshm.chain.solve import BatchSolution
    from kshm.engine.engine import Engine, Geometry

Array = NDArray[np.float64]
Columns = dict[str, Array]
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
        """Value of the cubic through the two neighbouring points, by Hermite's polynomials."""
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
    """Slope at a point between two chords of widths ``left`` and ``right``; none at an extreme.

    The weighted harmonic mean of Fritsch and Butland never exceeds three times the flatter
    chord, so the cubic stays between its points.
    """
    one, two = 2 * right + left, right + 2 * left
    same = before * after > 0
    safe_before = np.where(same, before, 1.0)
    safe_after = np.where(same, after, 1.0)
    mean: Array = (one + two) / (one / safe_before + two / safe_after)
    return np.where(same, mean, 0.0)


def end_slope(wanted: Array, chord: Array) -> Array:
    """A given slope at an end, held within 0 and three times the chord."""
    low, high = np.minimum(0.0, 3 * chord), np.maximum(0.0, 3 * chord)
    return np.clip(wanted, low, high)


def periodic_nodes(x: Array, y: Array) -> Nodes:
    """Nodes of a closed diagram: the last point repeats the first one a period later."""
    width, chord = np.diff(x), np.diff(y) / np.diff(x)
    inner = middle_slope(chord[:-1], chord[1:], width[:-1], width[1:])
    seam = middle_slope(chord[-1:], chord[:1], width[-1:], width[:1])
    return Nodes(x, y, np.concatenate([seam, inner, seam]))


def compression(gas: RoundedGas, eps: float, ratio: Array) -> Array:
    """Polytrope from bottom dead centre [Pa]."""
    return gas.p_intake * (eps / ratio) ** gas.n_compression


def expansion(gas: RoundedGas, ratio: Array) -> Array:
    """Polytrope from the theoretical point z [Pa]."""
    return gas.p_max * (gas.rho / ratio) ** gas.n_expansion


def rounded_nodes(gas: RoundedGas, eps: float, ratio: Ratio) -> Nodes:
    """All points of the diagram: r, a', a, c', c'', z_д, the join, b', b'', r', r.

    Slopes at a, c', the join and b' serve the cubics that begin or end there.
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
    """Absolute pressure [Pa] at the angles ``phi`` [rad] of the cycle, Gots figure 22."""
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
    """Absolute pressure [Pa] of an engine whose diagram is given by points or rounded.

    Args:
        engine: gas by points or rounded.
        phi: angles in the cycle [rad], any shape.

    Raises:
        TypeError: the diagram is one of polytropes, see ``kshm.mechanics.polytropes``.
    """
    gas = engine.gas
    local = np.mod(phi, engine.period)
    if isinstance(gas, TabulatedGas):
        x, y = np.array(gas.angles), np.array(gas.pressures)
        return periodic_nodes(x, y).at(local) if gas.smooth else np.interp(local, x, y)
    if isinstance(gas, RoundedGas):
        return rounded_pressure(
            local, gas, engine.geometry.compression_ratio, volume_of(engine.geometry)
        )
    msg = "the diagram is one of polytropes"
    raise TypeError(msg)


def volume_of(geometry: Geometry) -> Ratio:
    """V/V_c at an angle, from the exact displacement, Gots (1)."""
    r, lam = np.array(geometry.crank_radius), np.array(geometry.lam)

    def ratio(phi: Array) -> Array:
        share: Array = displacement_exact(phi, r, lam) / geometry.stroke
        return 1 + (geometry.compression_ratio - 1) * share

    return ratio


def diagram_columns(engine: Engine) -> dict[str, Columns]:
    """Points of a smooth table with their slopes, SI units (slopes per degree)."""
    gas = engine.gas
    if not isinstance(gas, TabulatedGas) or not gas.smooth:
        return {}
    nodes = periodic_nodes(np.array(gas.angles), np.array(gas.pressures))
    width, chord = np.diff(nodes.x), np.diff(nodes.y) / np.diff(nodes.x)
    two = (3 * chord - 2 * nodes.slope[:-1] - nodes.slope[1:]) / width
    three = (nodes.slope[:-1] + nodes.slope[1:] - 2 * chord) / width**2

    def padded(values: Array) -> Array:
        return np.append(values, 0.0)

    return {
        "points": {
            "point": np.arange(1.0, len(nodes.x) + 1),
            "point_deg": nodes.x,
            "point_MPa": nodes.y,
            "point_step": padded(width),
            "point_chord": padded(chord) * DEGREE,
            "point_slope": nodes.slope * DEGREE,
            "point_two": padded(two) * DEGREE**2,
            "point_three": padded(three) * DEGREE**3,
        }
    }


def gas_work(engine: Engine, raw: BatchSolution, index: int) -> float:
    """∮p dV of cylinder 1 by trapezoids [J]."""
    volume = engine.geometry.piston_area * raw.displacement[index, 0]
    return float(np.trapezoid(raw.p[index, 0], volume))


def diagram_scalars(engine: Engine, work: float) -> dict[str, float]:
    """Mean indicated pressure from the area of the diagram and, of a rounded one, its points.

    Args:
        engine: the engine.
        work: ∮p dV of one cylinder [J].
    """
    geometry, gas = engine.geometry, engine.gas
    found = {"p_i_area": work / (geometry.piston_area * geometry.stroke)}
    if not isinstance(gas, RoundedGas):
        return found
    ratio, eps = volume_of(geometry), geometry.compression_ratio
    nodes = rounded_nodes(gas, eps, ratio)
    at_start, at_open = (
        float(ratio(np.array(angle))) for angle in (gas.combustion_start, gas.exhaust_open)
    )
    found |= {
        "phi_c_deg": gas.combustion_start, "phi_open_deg": gas.exhaust_open,
        "phi_close_deg": gas.exhaust_close, "phi_peak_deg": gas.peak, "phi_join_deg": gas.join,
        "x_start": at_start, "p_start": float(nodes.y[3]),
        "p_c_end": gas.p_intake * eps**gas.n_compression,
        "x_open": at_open, "p_open": float(nodes.y[7]),
        "p_b": float(expansion(gas, ratio(np.array(BDC)))),
    }  # fmt: skip
    for number, (x, y, slope) in enumerate(zip(nodes.x, nodes.y, nodes.slope, strict=True), 1):
        found |= {
            f"node_deg{number}": float(x),
            f"node_MPa{number}": float(y),
            f"node_slope{number}": float(slope) * DEGREE,
        }
    return found
