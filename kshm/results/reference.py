"""Tables 1-3 and 5-8 for any λ, figures 3-10 and 20 as numbers, Gots chapters 1 and 2.

Motions are divided by r, rω and rω², those of the rod by ω and ω².
"""

from __future__ import annotations

import numpy as np

from kshm.arrays import Array, Columns, Results
from kshm.mechanics import kinematics
from kshm.results.case import Case, grid

STEP_DEG = 10.0
FIGURE_6 = (0.1, 0.4, 0.01)  # first, last and step of λ
# λ for which the textbook prints its reference tables 1-3 and 5-8.
REFERENCE_LAMBDAS: tuple[tuple[str, float], ...] = tuple(
    (f"lambda_1/{value}", 1 / float(value)) for value in ("3.2", "3.4", "3.6", "3.8", "4.0", "4.2")
)
_ONE: Array = np.ones(())


def reference_results(case: Case) -> Results:
    """Figure 20 in SI units; reference tables and figure 5 where the input asks for them."""
    engine = case.engine
    lam, lambdas = engine.geometry.lam, np.array(engine.reference_lambdas)
    tables = {"vectors": _vectors(case)}
    scalars = {"C_vector": case.inertia_unit, "C2_vector": lam * case.inertia_unit}
    if not engine.reference_lambdas:
        return tables, scalars
    half = grid(0, 180, STEP_DEG)
    for name, values in kinematics.reference_functions(half[:, None], lambdas).items():
        tables[name.replace("table", "ref")] = {
            "phi_deg": half,
            **{f"ref_lambda{i + 1}": values[:, i] for i in range(len(lambdas))},
        }
    tables["ref_motion"] = _motion(grid(0, 360, STEP_DEG), np.array(lam))
    tables["ref_fig6"] = _figure_6()
    sin, cos = float(np.sin(engine.reference_angle)), float(np.cos(engine.reference_angle))
    lift = cos + float(np.sqrt(1 - (lam * sin) ** 2)) / lam
    return tables, scalars | {
        "draw_B_x": sin, "draw_B_y": cos, "draw_A_y": lift,
        # The rod's line from A through B meets the diameter across the cylinder axis at H.
        "draw_H_x": sin * lift / (lift - cos), "draw_beta_deg": float(np.arcsin(lam * sin)),
    }  # fmt: skip


def _motion(phi: Array, lam: Array) -> Columns:
    columns: Columns = {"phi_deg": phi}
    parts = kinematics.two_term_motion(phi, _ONE, lam, _ONE)
    for letter, (first, second, _) in parts.items():
        columns |= {
            f"{letter}1_rel": first, f"{letter}2_rel": second, f"{letter}_rel": first + second,
        }  # fmt: skip
    rod = kinematics.rod_angular_velocity(phi, lam, _ONE)
    turn = kinematics.rod_angular_acceleration(phi, lam, _ONE)
    return columns | {
        "omega_rod_rel": rod[0], "omega_rod_near_rel": rod[1],
        "eps_rod_rel": turn[0], "eps_rod_near_rel": turn[1],
    }  # fmt: skip


def _figure_6() -> Columns:
    """φ of the greatest speed and its ratio to the mean speed over λ, Gots (5), figure 6."""
    first, last, step = FIGURE_6
    lam: Array = np.arange(round(first / step), round(last / step) + 1, dtype=np.float64) * step
    one = np.ones_like(lam)
    fastest = kinematics.max_velocity(one, lam, one)
    mean = kinematics.mean_velocity(one, one)
    return {
        "lambda_value": lam,
        "phi_vmax_deg": kinematics.max_velocity_angle(lam),
        "vmax_rel": fastest,
        "v_ratio": fastest / mean,
        "v1_ratio": one / mean,
    }


def _vectors(case: Case) -> Columns:
    """Vectors C and λC and the forces that they project, Gots (31), figure 20."""
    phi, size, lam = case.turn, -case.inertia_unit, case.engine.geometry.lam
    columns: Columns = {"phi_deg": phi}
    ends, roses = Columns(), Columns()
    for order, length in ((1, size), (2, lam * size)):
        force = length * np.cos(order * phi)
        columns[f"Pj{order}_kN"] = force
        ends |= {f"C{order}_x_kN": length * np.sin(order * phi), f"C{order}_y_kN": force}
        roses |= {
            f"rose{order}_x_kN": force * np.sin(phi), f"rose{order}_y_kN": force * np.cos(phi),
        }  # fmt: skip
    return columns | ends | roses


def reference_tables(step_deg: int = 10) -> dict[str, dict[str, Array | list[str]]]:
    """Tables 1, 2, 3, 5-8 of the textbook in the shape in which it prints them.

    Values are printed without their sign; the sign stands in columns of its own,
    for φ and for its mirror 360° − φ.
    """
    degrees = np.arange(0.0, 180.0 + step_deg, step_deg)
    lambdas = np.array([value for _, value in REFERENCE_LAMBDAS])
    values = kinematics.reference_functions(np.radians(degrees)[:, None], lambdas)
    mirrored = {"table_2", "table_5", "table_7"}  # odd in φ
    tables: dict[str, dict[str, Array | list[str]]] = {}
    for name, rows in values.items():
        columns = {key: np.abs(rows[:, i]) for i, (key, _) in enumerate(REFERENCE_LAMBDAS)}
        mirror = {"phi_mirror_deg": 360 - degrees}
        if name == "table_1":
            tables[name] = {"phi_deg": degrees, **columns, **mirror}
            continue
        negative = rows[:, 0] < -1e-9
        flipped = ~negative if name in mirrored else negative
        tables[name] = {
            "phi_deg": degrees,
            "sign": ["-" if flag else "+" for flag in negative],
            **columns,
            "sign_mirror": ["-" if flag else "+" for flag in flipped],
            **mirror,
        }
    return tables
