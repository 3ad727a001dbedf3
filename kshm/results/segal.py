"""Dimensionless motion of the engine after Segal: errors, the inverse problem, extremes."""

from __future__ import annotations

import numpy as np

from kshm.arrays import Array, Results, Scalars
from kshm.mechanics import dimensionless
from kshm.results.case import Case, grid
from kshm.results.extremes import first_extreme


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
    given = np.arange(1.0, 20.0) * 0.1
    angles = {
        "quadratic": dimensionless.angle_two_term(given, lam),
        "small": dimensionless.angle_small(given, lam),
        "exact": dimensionless.angle_exact(given, lam),
    }
    inverse = {"s_given": given, **{f"alpha_{name}_deg": each for name, each in angles.items()}}
    for name in ("quadratic", "small"):
        inverse[f"dalpha_{name}_deg"] = angles[name] - angles["exact"]
    return {"segal_errors": errors, "segal_inverse": inverse}, scalars | _extremes(lam)


def _extremes(lam: Array) -> Scalars:
    places = np.array([0.0, np.pi / 2, np.pi])
    exact, near = dimensionless.exact(places, lam), dimensionless.two_term(places, lam)
    two_angle, two_value = dimensionless.min_acceleration_two_term(float(lam))
    angle, value = dimensionless.min_acceleration(float(lam))
    return {
        "s_error_quarter": float(near.s[1] / exact.s[1] - 1),
        "j_error_quarter": float(near.j[1] / exact.j[1] - 1),
        "j_rel_tdc": float(exact.j[0]),
        "j_rel_bdc": float(exact.j[2]),
        "j_rel_quarter": float(exact.j[1]),
        "j_two_term_min": two_value,
        "alpha_j_two_term_min_deg": two_angle,
        "j_exact_min": value,
        "alpha_j_exact_min_deg": angle,
    }
