"""Gas in the cylinders: table of the diagram, its points and corners, work, Gots 2.1."""

from __future__ import annotations

import numpy as np

from kshm.arrays import Array, Columns, Scalars, Tables
from kshm.engine.gas import PolytropicGas, RoundedGas, TabulatedGas
from kshm.mechanics.gas import BDC, DEGREE, expansion, periodic_nodes, rounded_nodes
from kshm.mechanics.kinematics import Stroke, engine_stroke
from kshm.results.case import Case


def gas_table(case: Case) -> Columns:
    """Displacement, volume and pressure of cylinder 1 over the cycle in SI units."""
    raw, geometry, first = case.raw, case.engine.geometry, (case.index, 0)
    ratio = raw.volume_ratio[first]
    swept = geometry.piston_area * geometry.stroke
    return {
        "phi_deg": raw.phi,
        "x_exact_mm": raw.displacement[first],
        "volume_ratio": ratio,
        "volume_dm3": ratio * (swept / (geometry.compression_ratio - 1)),
        "p_MPa": raw.p[first],
    }


def point_tables(case: Case) -> Tables:
    """Points of a smooth table with their slopes, SI units (slopes per degree)."""
    gas = case.engine.gas
    if not isinstance(gas, TabulatedGas) or not gas.smooth:
        return {}
    nodes = periodic_nodes(np.array(gas.angles), np.array(gas.pressures))
    width, chord = np.diff(nodes.x), np.diff(nodes.y) / np.diff(nodes.x)
    two = (3 * chord - 2 * nodes.slope[:-1] - nodes.slope[1:]) / width
    three = (nodes.slope[:-1] + nodes.slope[1:] - 2 * chord) / width**2

    def padded(values: Array) -> Array:
        return np.append(values, 0.0)  # the last point begins no piece

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


def gas_scalars(case: Case) -> Scalars:
    """Mean indicated pressure from the diagram's area, and corner points, SI units."""
    raw, geometry, gas = case.raw, case.engine.geometry, case.engine.gas
    volume = geometry.piston_area * raw.displacement[case.index, 0]
    work = float(np.trapezoid(raw.p[case.index, 0], volume))
    scalars = {"p_i_area": work / (geometry.piston_area * geometry.stroke)}
    return (_rounded_scalars(case, gas) if isinstance(gas, RoundedGas) else {}) | scalars


def peak_pressure(case: Case) -> float:
    """Largest pressure of the diagram itself [Pa], whatever the grid of angles meets, Gots 2.4."""
    gas, geometry = case.engine.gas, case.engine.geometry
    if isinstance(gas, TabulatedGas):
        return max(gas.pressures)  # no line or cubic between points goes beyond them
    if isinstance(gas, RoundedGas):
        ratio = engine_stroke(geometry).ratio
        return float(rounded_nodes(gas, geometry.compression_ratio, ratio).y.max())
    return max(gas.p_max, corner_scalars(case)["p_start"])


def corner_scalars(case: Case) -> Scalars:
    """Corner points of the polytropic diagram, of the first articulated cylinder too."""
    gas, hung = case.engine.gas, case.raw.hung
    if not isinstance(gas, PolytropicGas):
        return {}
    corners = _corners(case, gas, engine_stroke(case.engine.geometry), ())
    if hung is None:
        return corners
    others = _corners(case, gas, hung.volume, (case.index, 0, 0))
    return corners | {hung_key(key): value for key, value in others.items()}


def hung_key(key: str) -> str:
    """Key of a corner point for the articulated cylinders: ``phi_c_art_deg``, ``x_open_art``."""
    return key.removesuffix("_deg") + "_art" + ("_deg" if key.endswith("_deg") else "")


def _corners(case: Case, gas: PolytropicGas, volume: Stroke, at: tuple[int, ...]) -> Scalars:
    """Corner points of a cylinder, which stands at ``at`` in the arrays of ``volume``."""

    def ratio(angle: float) -> float:
        return float(volume.ratio(np.array(angle))[at])

    tdc, bdc = float(volume.tdc[at]), float(volume.bdc[at]) - np.pi
    start = gas.combustion_start + tdc
    opens, closes = gas.exhaust_open + bdc, gas.exhaust_close + bdc
    at_start, at_open = ratio(start), ratio(opens)
    corners = {"phi_c_deg": start, "phi_open_deg": opens}
    begin = case.engine.geometry.compression_ratio
    if case.engine.strokes == 2:
        begin = ratio(closes)
        corners |= {"phi_scavenge_deg": gas.scavenge_open + bdc, "x_close": begin}
    return corners | {
        "phi_close_deg": closes,
        "x_start": at_start,
        "p_start": gas.p_intake * (begin / at_start) ** gas.n_compression,
        "p_c_end": gas.p_intake * begin**gas.n_compression,
        "x_open": at_open,
        "p_open": gas.p_max * min(1.0, (gas.rho / at_open) ** gas.n_expansion),
    }


def _rounded_scalars(case: Case, gas: RoundedGas) -> Scalars:
    ratio, eps = engine_stroke(case.engine.geometry).ratio, case.engine.geometry.compression_ratio
    nodes = rounded_nodes(gas, eps, ratio)
    scalars = {
        "phi_c_deg": gas.combustion_start, "phi_open_deg": gas.exhaust_open,
        "phi_close_deg": gas.exhaust_close, "phi_peak_deg": gas.peak, "phi_join_deg": gas.join,
        "x_start": float(ratio(np.array(gas.combustion_start))), "p_start": float(nodes.y[3]),
        "p_c_end": gas.p_intake * eps**gas.n_compression,
        "x_open": float(ratio(np.array(gas.exhaust_open))), "p_open": float(nodes.y[7]),
        "p_b": float(expansion(gas, ratio(np.array(BDC)))),
    }  # fmt: skip
    for number, (x, y, slope) in enumerate(zip(nodes.x, nodes.y, nodes.slope, strict=True), 1):
        scalars |= {
            f"node_deg{number}": float(x),
            f"node_MPa{number}": float(y),
            f"node_slope{number}": float(slope) * DEGREE,
        }
    return scalars
