"""Results of the companion sources for one engine as named columns and scalars."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from kshm.engine.engine import Engine
from kshm.engine.masses import mass_scalars
from kshm.mechanics import balance, continuous_beam, harmonics
from kshm.mechanics import dimensionless as segal
from kshm.nomenclature.quantity import quantity
from kshm.results import balance as balance_results
from kshm.results import inertia, pin_bearing, reference, torque_orders, two_term

if TYPE_CHECKING:
    from kshm.chain.solve import BatchSolution

Array = NDArray[np.float64]
Columns = dict[str, Array]

SERIES_ORDERS = (1, 2, 4, 6, 8)  # orders summed beside the exact curves
SHOWN_ORDERS = (1, 2, 4, 6)


def companion_columns(engine: Engine, raw: BatchSolution, index: int) -> dict[str, Columns]:
    """Table id → column key → values in the units of the tables.

    Most follow the series of a central mechanism and take no articulated rods.
    """
    always = {table: in_units(values) for table, values in _chapters(engine, raw, index)}
    if not balance.is_balanced_by_orders(engine):
        return always
    others = {
        **balance_results.columns(engine),
        **inertia.columns(engine, raw, index),
        **torque_orders.columns(engine, raw, index),
    }
    return {
        **_segal(engine),
        **_neiman(engine),
        **{table: in_units(columns) for table, columns in others.items()},
        **always,
    }


def _chapters(engine: Engine, raw: BatchSolution, index: int) -> list[tuple[str, Columns]]:
    """Tables of chapters 1 and 2 beside the chain itself, for engines of every layout."""
    tables = {
        **reference.columns(engine),
        **pin_bearing.columns(engine, raw, index),
        **continuous_beam.columns(engine, raw, index),
        **two_term.columns(engine),
    }
    return list(tables.items())


def companion_scalars(engine: Engine, raw: BatchSolution, index: int) -> dict[str, float]:
    """All scalars of the companion sources in SI units; see ``companion_columns``."""
    always = {
        **mass_scalars(engine),
        **reference.scalars(engine),
        **pin_bearing.scalars(engine, raw, index),
        **continuous_beam.scalars(engine, raw, index),
        **two_term.scalars(engine),
    }
    if not balance.is_balanced_by_orders(engine):
        return always
    return {
        **_segal_scalars(engine),
        **_neiman_scalars(engine),
        **balance_results.scalars(engine),
        **inertia.scalars(engine, raw, index),
        **torque_orders.scalars(engine, raw, index),
        **always,
    }


def in_units(columns: Columns) -> Columns:
    """SI columns in the units of the tables."""
    return {key: values / quantity(key).si for key, values in columns.items()}


def grid(first: float, last: float, step: float) -> Array:
    """Values from ``first`` to ``last`` inclusive."""
    values: Array = first + step * np.arange(round((last - first) / step) + 1.0)
    return values


def _segal(engine: Engine) -> dict[str, Columns]:
    lam = engine.geometry.lam
    fine = np.radians(grid(0, 180, 2))
    at = np.array(lam)
    exact = segal.displacement(fine, at), segal.velocity(fine, at), segal.acceleration(fine, at)
    s, v, j = exact
    s_2, v_2, j_2 = _two_term(fine, at)
    given = grid(0.1, 1.9, 0.1)
    angles = {
        "alpha_quadratic_deg": segal.angle_two_term(given, at),
        "alpha_small_deg": segal.angle_small(given, at),
        "alpha_exact_deg": segal.angle_exact(given, at),
    }
    angles["dalpha_quadratic_deg"] = angles["alpha_quadratic_deg"] - angles["alpha_exact_deg"]
    angles["dalpha_small_deg"] = angles["alpha_small_deg"] - angles["alpha_exact_deg"]
    return {
        "segal_errors": in_units(
            {
                "alpha_deg": fine,
                "s_exact": s, "s_two_term": s_2, "ds": s_2 - s,
                "v_exact": v, "v_two_term": v_2, "dv": v_2 - v,
                "j_exact": j, "j_two_term": j_2, "dj": j_2 - j,
            }
        ),
        "segal_inverse": in_units({"s_given": given, **angles}),
    }  # fmt: skip


def _two_term(alpha: Array, lam: Array) -> tuple[Array, Array, Array]:
    return (
        segal.displacement_two_term(alpha, lam),
        segal.velocity_two_term(alpha, lam),
        segal.acceleration_two_term(alpha, lam),
    )


def _segal_scalars(engine: Engine) -> dict[str, float]:
    lam = np.array(engine.geometry.lam)
    fine, quarter = np.radians(grid(0, 180, 2)), np.array(np.pi / 2)
    exact = segal.displacement(fine, lam), segal.velocity(fine, lam), segal.acceleration(fine, lam)
    values: dict[str, float] = {}
    for letter, truth, near in zip("svj", exact, _two_term(fine, lam), strict=True):
        error = np.abs(near - truth)
        first = np.argmax(error >= error.max() - 1e-9)
        values[f"d{letter}_max"] = float(error.max())
        values[f"alpha_d{letter}_deg"] = float(fine[first])
    s, j = segal.displacement(quarter, lam), segal.acceleration(quarter, lam)
    two_angle, two_value = segal.min_acceleration_two_term(engine.geometry.lam)
    angle, value = segal.min_acceleration(engine.geometry.lam)
    return values | {
        "s_error_quarter": float(segal.displacement_two_term(quarter, lam) / s - 1),
        "j_error_quarter": float(segal.acceleration_two_term(quarter, lam) / j - 1),
        "j_rel_tdc": float(segal.acceleration(np.array(0.0), lam)),
        "j_rel_bdc": float(segal.acceleration(np.array(np.pi), lam)),
        "j_rel_quarter": float(j),
        "j_two_term_min": two_value,
        "alpha_j_two_term_min_deg": two_angle,
        "j_exact_min": value,
        "alpha_j_exact_min_deg": angle,
    }


def _neiman(engine: Engine) -> dict[str, Columns]:
    return {"neiman_motion": _neiman_motion(engine.geometry.lam)}


def _neiman_motion(lam: float) -> Columns:
    degrees = grid(0, 360, 5)
    alpha, at = np.radians(degrees), np.array(lam)
    columns: Columns = {"alpha_deg": degrees}
    exact = segal.displacement(alpha, at), segal.velocity(alpha, at), segal.acceleration(alpha, at)
    parts = {order: harmonics.motion(alpha, lam, order) for order in SERIES_ORDERS}
    constants = (1 + harmonics.coefficient(lam, 0), 0.0, 0.0)
    for at_letter, letter in enumerate("svj"):
        columns[f"{letter}_exact"] = exact[at_letter]
        for order in SHOWN_ORDERS:
            columns[f"{letter}_order{order}"] = parts[order][at_letter]
        total = np.sum([part[at_letter] for part in parts.values()], axis=0)
        columns[f"{letter}_series"] = constants[at_letter] + total
    beta = np.arcsin(lam * np.sin(alpha))
    columns["rod_speed_rel"] = harmonics.rod_on_pin(alpha, at) - 1
    columns["rod_acceleration_rel"] = -lam * (1 - lam**2) * np.sin(alpha) / np.cos(beta) ** 3
    columns["rod_on_pin_rel"] = harmonics.rod_on_pin(alpha, at)
    return columns


def _neiman_scalars(engine: Engine) -> dict[str, float]:
    lam = engine.geometry.lam
    motion = _neiman_motion(lam)
    return {
        "neiman_k": harmonics.coefficient(lam, 0),
        **{f"neiman_p{order}": harmonics.coefficient(lam, order) for order in harmonics.ORDERS},
        **{
            f"{letter}_series_error": float(
                np.abs(motion[f"{letter}_series"] - motion[f"{letter}_exact"]).max()
            )
            for letter in "svj"
        },
    }
