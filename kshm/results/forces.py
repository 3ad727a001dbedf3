"""Tables П4 and of single journals from the arrays of a batch, for one engine or for many.

Every function takes the index of an engine or a slice of engines; columns are of shape
(angles,) or (engines, angles).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from kshm.engine.arrangement import pins
from kshm.nomenclature.quantity import quantity
from kshm.results.layout_columns import (
    articulated_columns,
    direction,
    has_single_rods,
    pin_table,
    shown_pins,
    throw_torque_key,
)

if TYPE_CHECKING:
    from kshm.chain.solve import BatchSolution
    from kshm.engine.engine import Engine

Array = NDArray[np.float64]
Columns = dict[str, Array]
Index = int | slice


def force_tables(raw: BatchSolution, at: Index = slice(None)) -> dict[str, Columns]:
    """Forces, torques, crankpins, journals, running-on torques in the units of the tables."""
    engine = raw.batch.engines[0]
    tables = {
        "P4_1": cylinder_columns(raw, at, 0),
        **{f"cylinder_{i + 1}": _further(raw, at, i) for i in range(1, engine.cylinders)},
        "P4_2": _torques(raw, at),
        **{pin_table(n): _crankpin(raw, at, n) for n in range(len(shown_pins(engine)))},
        **{f"P4_3_{k + 1}": _journal(raw, at, k) for k in range(raw.journal.shape[1])},
        "P4_4": _running(raw, at, "Mmain", raw.running_main[at, 1:], 2),
        "P4_5": _running(raw, at, "Mpin", raw.running_pin[at], 1),
        "P4_5s": {
            f"Mpins{i + 1}_Nm": raw.running_pin_statics[at, i]
            for i in range(raw.running_pin_statics.shape[1])
        },
    }
    degrees = np.arange(0.0, engine.strokes * 180 + engine.step_deg, engine.step_deg)
    return {
        table: {"phi_deg": degrees}
        | {key: values / quantity(key).si for key, values in columns.items()}
        for table, columns in tables.items()
    }


def cylinder_columns(raw: BatchSolution, at: Index, cylinder: int) -> Columns:
    """Forces of one cylinder in SI units, Gots table П4.1."""
    return {
        "Pg_MPa": raw.p_gas[at, cylinder], "Pj_MPa": raw.p_inertia[at, cylinder],
        "Ps_MPa": raw.p_sum[at, cylinder],
        "N_MPa": raw.N[at, cylinder], "S_MPa": raw.S[at, cylinder],
        "T_MPa": raw.T[at, cylinder], "K_MPa": raw.K[at, cylinder],
        "M_Nm": raw.torque[at, cylinder],
    }  # fmt: skip


def _further(raw: BatchSolution, at: Index, cylinder: int) -> Columns:
    hung = articulated_columns(raw, at, cylinder)
    return {
        "phase_deg": raw.local_phi[at, cylinder],
        "volume_ratio": raw.volume_ratio[at, cylinder],
        "p_MPa": raw.p[at, cylinder],
        **cylinder_columns(raw, at, cylinder),
        **hung,
    }


def _torques(raw: BatchSolution, at: Index) -> Columns:
    each = {f"M{i + 1}_Nm": raw.torque[at, i] for i in range(raw.torque.shape[1])}
    return each | {"Msum_Nm": raw.torque_sum[at]}


def _crankpin(raw: BatchSolution, at: Index, pin: int) -> Columns:
    batch = raw.batch
    engine = batch.engines[0]
    own = [raw.K[at, i] for i in pins(engine.arrangement)[pin]]
    side, up = raw.pin_side[at, pin], raw.pin_up[at, pin]
    values = {
        "T_MPa": side,
        "K_MPa": np.sum(own, axis=0),
        "Krod_MPa": -up,
        "Rpin_MPa": raw.pin_load[at, pin],
        "psi_deg": direction(side, -up),
    }
    if has_single_rods(engine):
        unit = batch.r[at, 0] * batch.omega[at, 0] ** 2
        throw = batch.m_k[at, 0] * unit / batch.area[at, 0]
        values |= {"Ksum_MPa": -up - throw, "Rthrow_MPa": raw.throw_load[at, pin]}
    return values


def _journal(raw: BatchSolution, at: Index, journal: int) -> Columns:
    angles = raw.batch.throws.angle
    values: Columns = {}
    sides = (("a", journal - 1, raw.journal_before), ("b", journal, raw.journal_after))
    for side, throw, vectors in sides:
        if not 0 <= throw < angles.shape[1]:
            continue
        vector = vectors[at, journal]
        turn = angles[at, throw, None]
        cos, sin = np.cos(turn), np.sin(turn)
        # Back from the shaft axes to the frame of the throw.
        across = vector[..., 0] * cos + vector[..., 1] * sin
        along = -vector[..., 0] * sin + vector[..., 1] * cos
        values |= {
            f"{side}T_MPa": across, f"{side}Tcos_MPa": across * cos,
            f"{side}Tsin_MPa": across * sin,
            f"{side}K_MPa": along, f"{side}Kcos_MPa": along * cos,
            f"{side}Ksin_MPa": along * sin,
        }  # fmt: skip
    x, y = raw.journal[at, journal][..., 0], raw.journal[at, journal][..., 1]
    phi = raw.phi
    values |= {
        "Rx_MPa": x,
        "Ry_MPa": y,
        "R_MPa": raw.journal_load[at, journal],
        "psiR_deg": direction(x, y),
        # The load on the bearing is the opposite of the reaction; the shaft has turned
        # clockwise by φ, from "up" away from "left".
        "block_x_MPa": -(x * np.cos(phi) - y * np.sin(phi)),
        "block_y_MPa": -(x * np.sin(phi) + y * np.cos(phi)),
    }
    return values


def _running(raw: BatchSolution, at: Index, family: str, moments: Array, first: int) -> Columns:
    """Torques on journals or pins from throw 1 on, with the throws' own between them."""
    engine: Engine = raw.batch.engines[0]
    values = {f"{family}{first}_Nm": moments[..., 0, :]}
    for throw in range(1, raw.throw_torque.shape[1]):
        values[throw_torque_key(engine, throw)] = raw.throw_torque[at, throw]
        values[f"{family}{throw + first}_Nm"] = moments[..., throw, :]
    return values
