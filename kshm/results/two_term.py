"""Error of the two-term formulas by the crank angle and its greatest values, Gots 1.2, 1.4."""

from __future__ import annotations

import numpy as np

from kshm.arrays import Results, Scalars
from kshm.mechanics import kinematics
from kshm.nomenclature.quantity import quantity
from kshm.results.case import Case
from kshm.results.extremes import first_extreme
from kshm.results.motion import UNITS


def two_term_errors(case: Case) -> Results:
    """Exact and two-term motion and force over a turn, their differences and the greatest, SI."""
    geometry, phi, omega, (r, lam, k) = case.engine.geometry, case.turn, case.omega, case.sizes
    area = geometry.piston_area
    exact = kinematics.exact_motion(phi, r, lam, omega, k)
    parts = kinematics.two_term_motion(phi, r, lam, omega, k)
    near = {letter: first + second + offset for letter, (first, second, offset) in parts.items()}
    mass = case.inertia_unit / float(r * omega**2)
    for curves in (exact, near):
        curves["Pj"] = -mass * curves["j"] / area
    table, whole = {"phi_deg": phi}, {}
    for (letter, values), unit in zip(exact.items(), (*UNITS, "MPa"), strict=True):
        table[f"e{letter}_exact_{unit}"] = values
        table[f"e{letter}_two_{unit}"] = near[letter]
        table[f"e{letter}_{unit}"] = near[letter] - values
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
