"""Tables 1-3 and 5-8 for any λ, figures 3-10 and 20 as numbers, Gots chapters 1 and 2.

Motions are divided by r, rω and rω², those of the rod by ω and ω².
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from kshm.mechanics import kinematics, masses

if TYPE_CHECKING:
    from kshm.engine.engine import Engine

Array = NDArray[np.float64]
Columns = dict[str, Array]

STEP_DEG = 10.0
FIGURE_6 = (0.1, 0.4, 0.01)  # first, last and step of λ


def columns(engine: Engine) -> dict[str, Columns]:
    """Reference tables in SI units; none unless the input asks for them."""
    tables = {"vectors": _vectors(engine)}
    if not engine.reference_lambdas:
        return tables
    lambdas = np.array(engine.reference_lambdas)
    half = np.radians(np.arange(0.0, 180.0 + STEP_DEG, STEP_DEG))
    for name, values in kinematics.reference_functions(half[:, None], lambdas).items():
        number = name.removeprefix("table_")
        tables[f"ref_{number}"] = {
            "phi_deg": half,
            **{f"ref_lambda{i + 1}": values[:, i] for i in range(len(lambdas))},
        }
    turn = np.radians(np.arange(0.0, 360.0 + STEP_DEG, STEP_DEG))
    tables["ref_motion"] = _motion(turn, np.array(engine.geometry.lam))
    tables["ref_fig6"] = _figure_6()
    return tables


def _motion(phi: Array, lam: Array) -> Columns:
    one = np.array(1.0)
    s = kinematics.displacement_orders(phi, one, lam)
    v = kinematics.velocity_orders(phi, one, lam, one)
    j = kinematics.acceleration_orders(phi, one, lam, one)
    rod = kinematics.rod_angular_velocity(phi, lam, one)
    turn = kinematics.rod_angular_acceleration(phi, lam, one)
    found: Columns = {"phi_deg": phi}
    for letter, (first, second) in (("s", s), ("v", v), ("j", j)):
        found |= {
            f"{letter}1_rel": first, f"{letter}2_rel": second, f"{letter}_rel": first + second,
        }  # fmt: skip
    return found | {
        "omega_rod_rel": rod[0], "omega_rod_near_rel": rod[1],
        "eps_rod_rel": turn[0], "eps_rod_near_rel": turn[1],
    }  # fmt: skip


def _figure_6() -> Columns:
    """φ of the greatest speed and its ratio to the mean speed over λ, Gots (5), figure 6."""
    first, last, step = FIGURE_6
    lam: Array = np.arange(round(first / step), round(last / step) + 1, dtype=np.float64) * step
    one = np.ones_like(lam)
    fastest = kinematics.max_velocity(one, lam, one)
    return {
        "lambda_value": lam,
        "phi_vmax_deg": kinematics.max_velocity_angle(lam),
        "vmax_rel": fastest,
        "v_ratio": fastest / kinematics.mean_velocity(one, one),
        "v1_ratio": one / kinematics.mean_velocity(one, one),
    }


def _vectors(engine: Engine) -> Columns:
    """Vectors C and λC and the forces that they project, Gots (31), figure 20."""
    m_j, _ = masses.point_masses(engine.masses, engine.geometry.rod_length)
    size = -m_j * engine.geometry.crank_radius * engine.omega**2
    lam = engine.geometry.lam
    phi = np.radians(np.arange(0.0, 360.0 + engine.step_deg, engine.step_deg))
    first, second = size * np.cos(phi), lam * size * np.cos(2 * phi)
    return {
        "phi_deg": phi,
        "Pj1_kN": first,
        "Pj2_kN": second,
        "C1_x_kN": size * np.sin(phi), "C1_y_kN": size * np.cos(phi),
        "C2_x_kN": lam * size * np.sin(2 * phi), "C2_y_kN": lam * size * np.cos(2 * phi),
        "rose1_x_kN": first * np.sin(phi), "rose1_y_kN": first * np.cos(phi),
        "rose2_x_kN": second * np.sin(phi), "rose2_y_kN": second * np.cos(phi),
    }  # fmt: skip


def scalars(engine: Engine) -> dict[str, float]:
    """Points of the drawn mechanism of figures 5 and 9 and the axes of figure 20."""
    m_j, _ = masses.point_masses(engine.masses, engine.geometry.rod_length)
    size = m_j * engine.geometry.crank_radius * engine.omega**2
    found = {"C_vector": size, "C2_vector": engine.geometry.lam * size}
    if not engine.reference_lambdas:
        return found
    lam, phi = engine.geometry.lam, engine.reference_angle
    sin_b = lam * np.sin(phi)
    lift = float(np.cos(phi) + np.sqrt(1 - sin_b**2) / lam)
    # The rod's line from A through B meets the diameter across the cylinder axis at H.
    cut = float(np.sin(phi) * lift / (lift - np.cos(phi)))
    return found | {
        "draw_B_x": float(np.sin(phi)), "draw_B_y": float(np.cos(phi)), "draw_A_y": lift,
        "draw_H_x": cut, "draw_beta_deg": float(np.arcsin(sin_b)),
    }  # fmt: skip
