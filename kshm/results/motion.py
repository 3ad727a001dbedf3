"""Motion of pistons and rods, Gots chapter 1; errors of the two-term formulas; Segal, Neiman."""

from __future__ import annotations

import numpy as np

from kshm.arrays import Array, Columns, Results, Scalars, Tables
from kshm.mechanics import articulated, dimensionless, harmonics, kinematics
from kshm.nomenclature.quantity import quantity
from kshm.results.case import Case, first_extreme, grid

UNITS = ("mm", "m_s", "m_s2")  # how the keys of s, v and j end
SERIES_ORDERS = (1, 2, 4, 6, 8)  # orders summed beside the exact curves
SHOWN_ORDERS = (1, 2, 4, 6)


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


def two_term_errors(case: Case) -> Results:
    """Exact and two-term motion and force over a turn, their differences and the greatest, SI."""
    geometry, phi, omega, (r, lam, k) = case.engine.geometry, case.turn, case.omega, case.sizes
    area = geometry.piston_area
    exact = kinematics.exact_motion(phi, r, lam, omega, k)
    parts = kinematics.two_term_motion(phi, r, lam, omega, k)
    approximate = {
        letter: first + second + offset for letter, (first, second, offset) in parts.items()
    }
    mass = case.inertia_unit / float(r * omega**2)
    for curves in (exact, approximate):
        curves["Pj"] = -mass * curves["j"] / area
    table, whole = {"phi_deg": phi}, {}
    for (letter, values), unit in zip(exact.items(), (*UNITS, "MPa"), strict=True):
        table[f"e{letter}_exact_{unit}"] = values
        table[f"e{letter}_two_{unit}"] = approximate[letter]
        table[f"e{letter}_{unit}"] = approximate[letter] - values
        whole[f"e{letter}_{unit}"] = float(np.abs(values).max())
    beta = kinematics.rod_angle(phi, lam, k)
    tangential = table["ePj_MPa"] * (np.sin(phi) + np.cos(phi) * np.tan(beta))
    table |= {
        "eN_MPa": table["ePj_MPa"] * np.tan(beta),
        "eT_MPa": tangential,
        "eM_Nm": tangential * area * float(r),
    }
    scalars: Scalars = {"k_two_term": geometry.relative_offset}
    for key in ("es_mm", "ev_m_s", "ej_m_s2", "ePj_MPa", "eN_MPa", "eT_MPa", "eM_Nm"):
        most, at = first_extreme(np.abs(table[key]), phi, floor=quantity(key).si)
        name = key.split("_", maxsplit=1)[0]
        scalars |= {f"{name}_max": most, f"phi_{name}_deg": at}
        if key in whole:
            scalars[f"{name}_rel"] = most / whole[key]
    return {"two_term": table}, scalars


def segal_results(case: Case) -> Results:
    """Tables ``segal_errors`` and ``segal_inverse`` and their extremes at the engine's λ, SI."""
    lam, fine = case.sizes[1], grid(0, 180, 2)
    exact, near = dimensionless.exact(fine, lam), dimensionless.two_term(fine, lam)
    errors: dict[str, Array] = {"alpha_deg": fine}
    scalars: Scalars = {}
    for letter in "svj":
        truth, approximate = getattr(exact, letter), getattr(near, letter)
        error = approximate - truth
        errors |= {
            f"{letter}_exact": truth, f"{letter}_two_term": approximate, f"d{letter}": error,
        }  # fmt: skip
        scalars[f"d{letter}_max"], scalars[f"alpha_d{letter}_deg"] = first_extreme(
            np.abs(error), fine
        )
    path = np.arange(1.0, 20.0) * 0.1
    angles = {
        "quadratic": dimensionless.angle_two_term(path, lam),
        "small": dimensionless.angle_small(path, lam),
        "exact": dimensionless.angle_exact(path, lam),
    }
    inverse = {"s_given": path, **{f"alpha_{name}_deg": each for name, each in angles.items()}}
    for name in ("quadratic", "small"):
        inverse[f"dalpha_{name}_deg"] = angles[name] - angles["exact"]
    return {"segal_errors": errors, "segal_inverse": inverse}, scalars | _extremes(lam)


def _extremes(lam: Array) -> Scalars:
    angles = np.array([0.0, np.pi / 2, np.pi])
    exact, approximate = dimensionless.exact(angles, lam), dimensionless.two_term(angles, lam)
    two_angle, two_value = dimensionless.min_acceleration_two_term(float(lam))
    angle, value = dimensionless.min_acceleration(float(lam))
    return {
        "s_error_quarter": float(approximate.s[1] / exact.s[1] - 1),
        "j_error_quarter": float(approximate.j[1] / exact.j[1] - 1),
        "j_rel_tdc": float(exact.j[0]),
        "j_rel_bdc": float(exact.j[2]),
        "j_rel_quarter": float(exact.j[1]),
        "j_two_term_min": two_value,
        "alpha_j_two_term_min_deg": two_angle,
        "j_exact_min": value,
        "alpha_j_exact_min_deg": angle,
    }


def neiman_results(case: Case) -> Results:
    """Table ``neiman_motion``, the coefficients of the series and the errors of its sum."""
    at = case.sizes[1]
    lam, alpha = float(at), grid(0, 360, 5)
    exact = dimensionless.exact(alpha, at)
    parts = {order: harmonics.motion(alpha, lam, order) for order in SERIES_ORDERS}
    columns: Columns = {"alpha_deg": alpha}
    scalars = {"neiman_k": harmonics.coefficient(lam, 0)}
    scalars |= {f"neiman_p{order}": harmonics.coefficient(lam, order) for order in harmonics.ORDERS}
    for derivative, letter in enumerate("svj"):
        truth = getattr(exact, letter)
        series = np.sum([part[derivative] for part in parts.values()], axis=0)
        if letter == "s":
            series = 1 + scalars["neiman_k"] + series
        columns[f"{letter}_exact"] = truth
        columns |= {f"{letter}_order{order}": parts[order][derivative] for order in SHOWN_ORDERS}
        columns[f"{letter}_series"] = series
        scalars[f"{letter}_series_error"] = float(np.abs(series - truth).max())
    on_pin, cos_beta = harmonics.rod_on_pin(alpha, at), np.sqrt(1 - (lam * np.sin(alpha)) ** 2)
    columns |= {
        "rod_speed_rel": on_pin - 1,
        "rod_acceleration_rel": -lam * (1 - lam**2) * np.sin(alpha) / cos_beta**3,
        "rod_on_pin_rel": on_pin,
    }
    return {"neiman_motion": columns}, scalars
