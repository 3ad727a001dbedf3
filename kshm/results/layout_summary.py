"""Scalars that depend on the layout: offset, articulated rods, corner points of the diagram."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from kshm.engine.engine import Engine, PolytropicGas
from kshm.mechanics import articulated, kinematics

if TYPE_CHECKING:
    from kshm.chain.solve import BatchSolution

Array = NDArray[np.float64]


def displaced(engine: Engine) -> float:
    """Displacement of all cylinders [m³]."""
    own, geometry = engine.cylinders, engine.geometry
    total = 0.0
    if engine.articulated is not None:
        hung = sum(place.master is not None for place in engine.arrangement)
        own -= hung
        top, bottom = _extremes(engine)
        total = hung * geometry.piston_area * (top - bottom)
    return total + geometry.piston_area * geometry.stroke * own


def _link(engine: Engine) -> articulated.Linkage | None:
    from kshm.chain.stack import stack

    rods = stack([engine]).articulated
    return None if rods is None else rods.link


def _extremes(engine: Engine) -> tuple[float, float]:
    """Greatest and smallest height of the articulated piston's pin [m]."""
    link = _link(engine)
    if link is None:
        msg = "the engine has no articulated rods"
        raise ValueError(msg)
    found = [articulated.motion(at, link).height[0] for at in articulated.dead_centres(link)]
    return found[0].item(), found[1].item()


def offset_scalars(engine: Engine) -> dict[str, float]:
    """Dead centres, strokes and two-term extremes of an offset mechanism, Gots (9)-(17)."""
    geometry, omega = engine.geometry, engine.omega
    if geometry.is_central:
        return {}
    r, lam, k = (
        np.array(value) for value in (geometry.crank_radius, geometry.lam, geometry.relative_offset)
    )
    tdc, bdc = (float(angle) for angle in kinematics.dead_centres(lam, k))
    down = bdc - tdc
    at_90, at_270 = (float(np.arcsin(lam * (side - k))) for side in (1, -1))

    def acceleration(phi: float) -> float:
        at = np.array(phi), r, lam, np.array(omega)
        both = sum(kinematics.acceleration_orders(*at))
        return float(both + kinematics.acceleration_offset(*at, k))

    return {
        "e_offset": geometry.offset,
        "k_offset": geometry.relative_offset,
        "phi_tdc_deg": tdc,
        "phi_bdc_deg": bdc,
        "phi_down_deg": down,
        "phi_up_deg": 2 * np.pi - down,
        "S_ratio": geometry.stroke / geometry.crank_radius,
        "c_down": geometry.stroke * omega / down,
        "c_up": geometry.stroke * omega / (2 * np.pi - down),
        "j_tdc": acceleration(tdc),
        "j_bdc": acceleration(bdc),
        "beta_90_deg": at_90,
        "beta_270_deg": at_270,
        "beta_max_deg": max(abs(at_90), abs(at_270)),
    }


def articulated_scalars(engine: Engine, raw: BatchSolution, index: int) -> dict[str, float]:
    """Dead centres, stroke and volumes of the articulated cylinders."""
    hung = raw.hung
    if hung is None:
        return {}
    geometry = engine.geometry
    piston_stroke = hung.stroke[index, 0, 0]
    swept = geometry.piston_area * piston_stroke
    values = {
        "S_art": piston_stroke,
        "V_h_art": swept,
        "V_c_art": swept / (geometry.compression_ratio - 1),
        "phi_tdc_art_deg": hung.tdc[index, 0, 0],
        "phi_bdc_art_deg": hung.bdc[index, 0, 0],
    }
    return {key: float(value) for key, value in values.items()}


def gas_scalars(engine: Engine) -> dict[str, float]:
    """Corner points of the polytropic diagram, of the articulated cylinders too."""
    gas, geometry = engine.gas, engine.geometry
    if not isinstance(gas, PolytropicGas):
        return {}
    r, lam, k = (
        np.array(value) for value in (geometry.crank_radius, geometry.lam, geometry.relative_offset)
    )
    eps = geometry.compression_ratio

    def ratio(angle: float) -> float:
        moved = kinematics.displacement_exact(np.array(angle), r, lam, k)
        return float(1 + (eps - 1) * moved / geometry.stroke)

    tdc, bdc = (float(angle) for angle in kinematics.dead_centres(lam, k))
    values = _corners(engine, gas, ratio, tdc, bdc - np.pi)
    link = _link(engine)
    if link is None:
        return values
    top, bottom = _extremes(engine)

    def hung_ratio(angle: float) -> float:
        height = articulated.motion(np.array(angle), link).height[0].item()
        return 1 + (eps - 1) * (top - height) / (top - bottom)

    upper, lower = (angle.item() for angle in articulated.dead_centres(link))
    others = _corners(engine, gas, hung_ratio, upper, lower - np.pi)
    return values | {hung_key(key): value for key, value in others.items()}


def hung_key(key: str) -> str:
    """Key of a corner point for the articulated cylinders: ``phi_c_art_deg``, ``x_open_art``."""
    return key.removesuffix("_deg") + "_art" + ("_deg" if key.endswith("_deg") else "")


def _corners(
    engine: Engine, gas: PolytropicGas, ratio: Callable[[float], float], tdc: float, bdc: float
) -> dict[str, float]:
    """Corner points for a cylinder whose dead centres lie ``tdc`` and ``bdc`` late [rad]."""
    eps, start = engine.geometry.compression_ratio, gas.combustion_start + tdc
    opens, closes = gas.exhaust_open + bdc, gas.exhaust_close + bdc
    at_start, at_open = ratio(start), ratio(opens)
    values = {"phi_c_deg": start, "phi_open_deg": opens}
    begin = eps
    if engine.strokes == 2:
        begin = ratio(closes)
        values |= {"phi_scavenge_deg": gas.scavenge_open + bdc, "x_close": begin}
    return values | {
        "phi_close_deg": closes,
        "x_start": at_start,
        "p_start": gas.p_intake * (begin / at_start) ** gas.n_compression,
        "p_c_end": gas.p_intake * begin**gas.n_compression,
        "x_open": at_open,
        "p_open": gas.p_max * min(1.0, (gas.rho / at_open) ** gas.n_expansion),
    }
