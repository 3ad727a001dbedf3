"""Series of the piston motion after Neiman at the engine's λ."""

from __future__ import annotations

import numpy as np

from kshm.arrays import Columns, Results
from kshm.mechanics import dimensionless, harmonics
from kshm.results.case import Case, grid

SERIES_ORDERS = (1, 2, 4, 6, 8)  # orders summed beside the exact curves
SHOWN_ORDERS = (1, 2, 4, 6)


def neiman_results(case: Case) -> Results:
    """Table ``neiman_motion``, the coefficients of the series and the errors of its sum."""
    at = case.sizes[1]
    lam, alpha = float(at), grid(0, 360, 5)
    exact = dimensionless.exact(alpha, at)
    parts = {order: harmonics.motion(alpha, lam, order) for order in SERIES_ORDERS}
    columns: Columns = {"alpha_deg": alpha}
    scalars = {"neiman_k": harmonics.coefficient(lam, 0)}
    scalars |= {f"neiman_p{order}": harmonics.coefficient(lam, order) for order in harmonics.ORDERS}
    for place, letter in enumerate("svj"):
        truth = getattr(exact, letter)
        series = np.sum([part[place] for part in parts.values()], axis=0)
        if letter == "s":
            series = 1 + scalars["neiman_k"] + series
        columns[f"{letter}_exact"] = truth
        columns |= {f"{letter}_order{order}": parts[order][place] for order in SHOWN_ORDERS}
        columns[f"{letter}_series"] = series
        scalars[f"{letter}_series_error"] = float(np.abs(series - truth).max())
    on_pin, cos_beta = harmonics.rod_on_pin(alpha, at), np.sqrt(1 - (lam * np.sin(alpha)) ** 2)
    columns |= {
        "rod_speed_rel": on_pin - 1,
        "rod_acceleration_rel": -lam * (1 - lam**2) * np.sin(alpha) / cos_beta**3,
        "rod_on_pin_rel": on_pin,
    }
    return {"neiman_motion": columns}, scalars
