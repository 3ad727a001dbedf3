"""Error of the two-term formulas by the crank angle and its greatest values, Gots 1.2, 1.4."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from kshm.mechanics import kinematics
from kshm.mechanics.masses import point_masses
from kshm.results.summary import first_extreme

if TYPE_CHECKING:
    from kshm.engine.engine import Engine

Array = NDArray[np.float64]
Columns = dict[str, Array]

_ERRORS = ("s_mm", "v_m_s", "j_m_s2", "Pj_MPa", "N_MPa", "T_MPa", "M_Nm")


def columns(engine: Engine) -> dict[str, Columns]:
    """Exact and two-term motion and force over a turn with their differences, SI units."""
    geometry = engine.geometry
    r, lam = np.array(geometry.crank_radius), np.array(geometry.lam)
    k, omega = np.array(geometry.relative_offset), np.array(engine.omega)
    phi = np.radians(np.arange(0.0, 360.0 + engine.step_deg, engine.step_deg))
    s = kinematics.displacement_exact(phi, r, lam, k)
    v = kinematics.velocity_exact(phi, r, lam, omega, k)
    j = kinematics.acceleration_exact(phi, r, lam, omega, k)
    near = {
        "s": sum(kinematics.displacement_orders(phi, r, lam))
        + kinematics.displacement_offset(phi, r, lam, k),
        "v": sum(kinematics.velocity_orders(phi, r, lam, omega))
        + kinematics.velocity_offset(phi, r, lam, omega, k),
        "j": sum(kinematics.acceleration_orders(phi, r, lam, omega))
        + kinematics.acceleration_offset(phi, r, lam, omega, k),
    }
    m_j, _ = point_masses(engine.masses, geometry.rod_length)
    force, near_force = (-m_j * a / geometry.piston_area for a in (j, near["j"]))
    d_force = near_force - force
    beta = kinematics.rod_angle(phi, lam, k)
    tangential = d_force * (np.sin(phi) + np.cos(phi) * np.tan(beta))
    table = {
        "phi_deg": phi,
        "es_exact_mm": s, "es_two_mm": near["s"], "es_mm": near["s"] - s,
        "ev_exact_m_s": v, "ev_two_m_s": near["v"], "ev_m_s": near["v"] - v,
        "ej_exact_m_s2": j, "ej_two_m_s2": near["j"], "ej_m_s2": near["j"] - j,
        "ePj_exact_MPa": force, "ePj_two_MPa": near_force, "ePj_MPa": d_force,
        "eN_MPa": d_force * np.tan(beta), "eT_MPa": tangential,
        "eM_Nm": tangential * geometry.piston_area * geometry.crank_radius,
    }  # fmt: skip
    return {"two_term": table}


def scalars(engine: Engine) -> dict[str, float]:
    """Greatest errors with the first angle at which each is reached, SI units."""
    from kshm.nomenclature.quantity import quantity

    table = columns(engine)["two_term"]
    found: dict[str, float] = {"k_two_term": engine.geometry.relative_offset}
    for error in _ERRORS:
        unit = quantity(f"e{error}").si
        name = error.split("_", maxsplit=1)[0]
        most, at = first_extreme(np.abs(table[f"e{error}"]) / unit, table["phi_deg"])
        found |= {f"e{name}_max": most * unit, f"phi_e{name}_deg": at}
        whole = table.get(f"e{name}_exact_{error.partition('_')[2]}")
        if whole is not None:
            found[f"e{name}_rel"] = most * unit / float(np.abs(whole).max())
    return found
