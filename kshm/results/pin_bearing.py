"""Big-end bearing of the rod and bending of the crankpin in its oil hole's plane, Gots 2.6."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from kshm.engine.arrangement import throws as throws_of
from kshm.results.summary import first_extreme

if TYPE_CHECKING:
    from kshm.chain.solve import BatchSolution
    from kshm.engine.engine import Engine

Array = NDArray[np.float64]
Columns = dict[str, Array]

PLANES = 18  # planes through the pin's axis, every 10°
TIE = 1e-9


def rod_bearing(engine: Engine, raw: BatchSolution, index: int) -> Columns:
    """Load on the big-end bearing of cylinder 1 in the rod's axes [Pa], Gots 2.6.

    The load is the opposite of the force on the pin, turned into axes along the rod (y,
    towards the piston pin) and across it (x, in the direction of rotation at the pin).
    """
    spin = raw.batch.pin_mass[index, 0, 0] * engine.geometry.crank_radius * engine.omega**2
    inward = raw.K[index, 0] - spin / engine.geometry.piston_area
    ahead = raw.T[index, 0]
    local = raw.local_phi[index, 0]
    geometry = engine.geometry
    beta = np.arcsin(geometry.lam * (np.sin(local) - geometry.relative_offset))
    along, across = np.array([-np.sin(beta), np.cos(beta)]), np.array([np.cos(beta), np.sin(beta)])
    out = np.array([np.sin(local), np.cos(local)])
    turn = np.array([np.cos(local), -np.sin(local)])
    force = inward * out - ahead * turn  # on the bearing
    x, y = (force * across).sum(axis=0), (force * along).sum(axis=0)
    return {"phi_deg": raw.phi, "Bx_MPa": x, "By_MPa": y, "B_MPa": np.hypot(x, y)}


def pin_bending(engine: Engine, raw: BatchSolution, index: int) -> Columns:
    """Projections of R_к on planes of the pin [Pa] and the moment in the oil hole's [N·m]."""
    inward, ahead = _throw_forces(engine, raw, index)
    area, length = engine.geometry.piston_area, engine.crankshaft.throws[0].length
    angle = oil_hole(engine, raw, index)
    force = inward * np.cos(angle) + ahead * np.sin(angle)
    planes = {
        f"plane{i + 1}_MPa": inward * np.cos(turn) + ahead * np.sin(turn)
        for i, turn in enumerate(np.pi / PLANES * np.arange(PLANES))
    }
    moment = force * area * length / 4
    return {"phi_deg": raw.phi, "Ralpha_MPa": force, "Malpha_Nm": moment, **planes}


def _throw_forces(engine: Engine, raw: BatchSolution, index: int) -> tuple[Array, Array]:
    """K_Σ towards the shaft and T of throw 1 with all centrifugal forces [Pa], Gots (42)."""
    unit = engine.geometry.crank_radius * engine.omega**2 / engine.geometry.piston_area
    group = throws_of(engine.arrangement)[0]
    carried = sum(float(raw.batch.pin_mass[index, rod, 0]) for rod in group)
    m_k = float(raw.batch.m_k[index, 0, 0])
    return raw.throw_K[index, 0] - (carried + m_k) * unit, raw.throw_T[index, 0]


def oil_hole(engine: Engine, raw: BatchSolution, index: int) -> float:
    """Angle of the oil hole from the crank against rotation [rad]: given, or by the wear."""
    if engine.oil_hole is not None:
        return engine.oil_hole
    sums = raw.pin_wear[index, 0]
    least = sums.min() / 1e6
    ray = int(np.argmax(sums / 1e6 <= least + TIE * max(1.0, least)))
    return float(np.mod(2 * np.pi * ray / engine.rays + np.pi, 2 * np.pi))


def columns(engine: Engine, raw: BatchSolution, index: int) -> dict[str, Columns]:
    """Tables of the big-end bearing and of the pin's bending in SI units."""
    tables = {}
    if all(c.master is None for c in engine.arrangement):
        tables["rod_bearing"] = rod_bearing(engine, raw, index)
    if all(c.pin_angle == 0 for c in engine.arrangement):
        tables["pin_bending"] = pin_bending(engine, raw, index)
    return tables


def scalars(engine: Engine, raw: BatchSolution, index: int) -> dict[str, float]:
    """Extremes of both tables in SI units."""
    tables = columns(engine, raw, index)
    values: dict[str, float] = {}
    if "rod_bearing" in tables:
        load = tables["rod_bearing"]["B_MPa"]
        most, at = first_extreme(load / 1e6, raw.phi)
        values |= {
            "B_mean": float(load[:-1].mean()),
            "B_max": most * 1e6,
            "phi_B_max_deg": at,
            "B_min": float(load.min()),
        }
    if "pin_bending" in tables:
        values |= _bending_scalars(engine, raw, index, tables["pin_bending"])
    return values


def _bending_scalars(
    engine: Engine, raw: BatchSolution, index: int, table: Columns
) -> dict[str, float]:
    lever = engine.geometry.piston_area * engine.crankshaft.throws[0].length / 4
    spans = np.array([np.ptp(table[f"plane{i}_MPa"]) * lever / 2 for i in range(1, PLANES + 1)])
    best = int(np.argmax(spans <= spans.min() + TIE * max(1.0, spans.min())))
    force, moment = table["Ralpha_MPa"], table["Malpha_Nm"]
    return {
        "alpha_oil_deg": oil_hole(engine, raw, index),
        "Ralpha_max": float(force.max()),
        "Ralpha_min": float(force.min()),
        "Malpha_max": float(moment.max()),
        "Malpha_min": float(moment.min()),
        "Malpha_swing": float(np.ptp(moment)) / 2,
        "Malpha_mean": float(moment.max() + moment.min()) / 2,
        "alpha_best_deg": np.pi / PLANES * best,
        "Mbest_swing": float(spans[best]),
    }
