"""Motion of pistons and rods: tables П3.1 and П3.2, offset, articulated rods, Gots chapter 1."""

from __future__ import annotations

import numpy as np

from kshm.arrays import Array, Columns, Scalars, Tables
from kshm.mechanics import articulated, kinematics
from kshm.results.case import Case

UNITS = ("mm", "m_s", "m_s2")  # how the keys of s, v and j end


def motion_tables(case: Case) -> Tables:
    """Motion over one turn in SI units."""
    return {"P3_1": _piston(case), "P3_2": _rod(case)}


def layout_motion_tables(case: Case) -> Tables:
    """Motion that only some layouts have, over one turn in SI units."""
    tables = {} if case.engine.geometry.is_central else {"offset": _offset(case)}
    return tables | _articulated(case)


def _piston(case: Case) -> Columns:
    parts = kinematics.two_term_motion(case.turn, *case.sizes[:2], case.omega, case.sizes[2])
    columns = {"phi_deg": case.turn}
    for (letter, (first, second, offset)), unit in zip(parts.items(), UNITS, strict=True):
        columns |= {f"{letter}1_{unit}": first, f"{letter}2_{unit}": second}
        total = first + second
        if not case.engine.geometry.is_central:
            columns[f"{letter}k_{unit}"] = offset
            total = total + offset
        columns[f"{letter}_{unit}"] = total
    return columns


def _rod(case: Case) -> Columns:
    phi, omega, (_, lam, k) = case.turn, case.omega, case.sizes
    speed = kinematics.rod_angular_velocity(phi, lam, omega, k)
    acceleration = kinematics.rod_angular_acceleration(phi, lam, omega, k)
    return {
        "phi_deg": phi,
        "beta_rad": kinematics.rod_angle(phi, lam, k),
        "omega_rod_exact_1_s": speed[0], "omega_rod_approx_1_s": speed[1],
        "eps_rod_exact_1_s2": acceleration[0], "eps_rod_approx_1_s2": acceleration[1],
    }  # fmt: skip


def _offset(case: Case) -> Columns:
    """Exact motion beside the two-term one of П3.1, and the central one, Gots figure 12."""
    phi, omega, (r, lam, k) = case.turn, case.omega, case.sizes
    exact = kinematics.exact_motion(phi, r, lam, omega, k)
    return {
        "phi_deg": phi,
        "x_exact_mm": exact["s"], "v_exact_m_s": exact["v"], "j_exact_m_s2": exact["j"],
        "j_central_m_s2": np.sum(kinematics.acceleration_orders(phi, r, lam, omega), axis=0),
    }  # fmt: skip


def _articulated(case: Case) -> Tables:
    """Motion of the first articulated rod and its piston over the angle of its cylinder."""
    rods, hung = case.raw.batch.articulated, case.raw.hung
    if rods is None or hung is None:
        return {}
    at, omega = (case.index, 0), case.engine.omega
    piston = articulated.motion(case.turn, rods.link)
    top = articulated.motion(hung.volume.tdc, rods.link).height[0]
    return {
        "articulated": {
            "phi_deg": case.turn,
            "beta_master_rad": piston.pin.beta[at],
            "across_mm": piston.pin.across[0][at],
            "along_mm": piston.pin.along[0][at],
            "beta_rad": piston.beta[at],
            "x_exact_mm": (top - piston.height[0])[at],
            "v_exact_m_s": -omega * piston.height[1][at],
            "j_exact_m_s2": -(omega**2) * piston.height[2][at],
        }
    }


def joints(case: Case, *, is_hung: bool) -> tuple[tuple[Array, Array], ...]:
    """Crankpin, pin of an articulated rod and piston pin [m] over one turn of the own crank.

    Each is (across, along) in the frame of the cylinder, its axis upwards; exact.
    """
    phi, geometry = case.turn, case.engine.geometry
    r, rod, offset = geometry.crank_radius, geometry.rod_length, geometry.offset
    crank = (r * np.sin(phi), r * np.cos(phi))
    rods, at = case.raw.batch.articulated, (case.index, 0)
    if rods is not None and is_hung:
        piston = articulated.motion(phi, rods.link)
        hung = (piston.pin.across[0][at], piston.pin.along[0][at])
        return crank, hung, (np.full(phi.shape, offset), piston.height[0][at])
    height = crank[1] + np.sqrt(rod**2 - (crank[0] - offset) ** 2)
    return crank, (np.full(phi.shape, offset), height)


def central_scalars(r: Array, lam: Array, omega: Array) -> dict[str, Array]:
    """Extremes of the central mechanism's two-term motion in closed form, SI, elementwise."""
    fastest, unit = kinematics.max_velocity(r, lam, omega), r * omega**2
    return {
        "phi_vmax_deg": kinematics.max_velocity_angle(lam),
        "v_max": fastest,
        "v_ratio": fastest / kinematics.mean_velocity(r, omega),
        "j_tdc": unit * (1 + lam),
        "j_bdc": -unit * (1 - lam),
        "beta_max_deg": np.arcsin(lam),
    }


def layout_motion_scalars(case: Case) -> Scalars:
    """Dead centres, strokes and extremes of an offset mechanism, Gots (9)-(17); volumes."""
    return _offset_scalars(case) | _articulated_scalars(case)


def _offset_scalars(case: Case) -> Scalars:
    geometry, omega, (r, lam, k) = case.engine.geometry, case.engine.omega, case.sizes
    if geometry.is_central:
        return {}
    tdc, bdc = (float(angle) for angle in kinematics.dead_centres(lam, k))
    down, up = bdc - tdc, 2 * np.pi - (bdc - tdc)
    at_90, at_270 = (float(np.arcsin(lam * (side - k))) for side in (1, -1))
    j_tdc, j_bdc = (
        float(
            kinematics.acceleration_two_term_at(
                kinematics.Position.at(np.array(angle), lam, k), r, lam, case.omega, k
            )
        )
        for angle in (tdc, bdc)
    )
    return {
        "e_offset": geometry.offset, "k_offset": geometry.relative_offset,
        "phi_tdc_deg": tdc, "phi_bdc_deg": bdc, "phi_down_deg": down, "phi_up_deg": up,
        "S_ratio": geometry.stroke / geometry.crank_radius,
        "c_down": geometry.stroke * omega / down, "c_up": geometry.stroke * omega / up,
        "j_tdc": j_tdc, "j_bdc": j_bdc,
        "beta_90_deg": at_90, "beta_270_deg": at_270,
        "beta_max_deg": max(abs(at_90), abs(at_270)),
    }  # fmt: skip


def _articulated_scalars(case: Case) -> Scalars:
    """Dead centres, stroke and volumes of the first articulated cylinder."""
    hung, geometry, first = case.raw.hung, case.engine.geometry, (case.index, 0, 0)
    if hung is None:
        return {}
    stroke = float(hung.stroke[first])
    swept = geometry.piston_area * stroke
    return {
        "S_art": stroke,
        "V_h_art": swept,
        "V_c_art": swept / (geometry.compression_ratio - 1),
        "phi_tdc_art_deg": float(hung.volume.tdc[first]),
        "phi_bdc_art_deg": float(hung.volume.bdc[first]),
    }
