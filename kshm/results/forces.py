"""Tables П4 and of single journals from the arrays of a batch, for one engine or for many.

Every function takes the index of an engine or a slice of engines; columns are of shape
(angles,) or (engines, angles), SI units.
"""

from __future__ import annotations

import numpy as np

from kshm.arrays import Array, Columns, Tables
from kshm.chain.result import ChainArrays
from kshm.engine.arrangement import pins, throws
from kshm.mechanics.journals import in_throw_frame
from kshm.mechanics.wear import ray_angles
from kshm.nomenclature.quantity import ray_key
from kshm.results.case import Case
from kshm.results.extremes import UNLOADED
from kshm.results.layout import (
    has_single_rods,
    pin_table,
    rod_names,
    shown_pins,
    throw_torque_key,
    wear_table,
)

Index = int | slice


def force_tables(raw: ChainArrays, at: Index = slice(None)) -> Tables:
    """Forces, torques, crankpins, journals and running-on torques."""
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
    return {table: {"phi_deg": raw.phi, **columns} for table, columns in tables.items()}


def cylinder_columns(raw: ChainArrays, at: Index, cylinder: int) -> Columns:
    """Forces of one cylinder, Gots table П4.1."""
    return {
        "Pg_MPa": raw.p_gas[at, cylinder], "Pj_MPa": raw.p_inertia[at, cylinder],
        "Ps_MPa": raw.p_sum[at, cylinder],
        "N_MPa": raw.N[at, cylinder], "S_MPa": raw.S[at, cylinder],
        "T_MPa": raw.T[at, cylinder], "K_MPa": raw.K[at, cylinder],
        "M_Nm": raw.torque[at, cylinder],
    }  # fmt: skip


def _further(raw: ChainArrays, at: Index, cylinder: int) -> Columns:
    columns = {
        "phase_deg": raw.local_phi[at, cylinder],
        "volume_ratio": raw.volume_ratio[at, cylinder],
        "p_MPa": raw.p[at, cylinder],
        **cylinder_columns(raw, at, cylinder),
    }
    rods, hung = raw.batch.articulated, raw.hung
    if rods is not None and hung is not None and cylinder in rods.cylinders:
        # What the rod does to the master piston and rod.
        row, area = rods.cylinders.index(cylinder), raw.batch.area[at, 0]
        columns["Nadd_MPa"] = hung.on_pin.N_added[at, row]
        columns["Mrod_Nm"] = hung.on_pin.moment[at, row] * area
    return columns


def _torques(raw: ChainArrays, at: Index) -> Columns:
    each = {f"M{i + 1}_Nm": raw.torque[at, i] for i in range(raw.torque.shape[1])}
    return each | {"Msum_Nm": raw.torque_sum[at]}


def _crankpin(raw: ChainArrays, at: Index, pin: int) -> Columns:
    batch = raw.batch
    engine = batch.engines[0]
    own = [raw.K[at, i] for i in pins(engine.arrangement)[pin]]
    side, up = raw.pin_side[at, pin], raw.pin_up[at, pin]
    columns = {
        "T_MPa": side,
        "K_MPa": np.sum(own, axis=0),
        "Krod_MPa": -up,
        "Rpin_MPa": raw.pin_load[at, pin],
        "psi_deg": direction(side, -up),
    }
    if has_single_rods(engine):
        unit = batch.r[at, 0] * batch.omega[at, 0] ** 2
        throws = batch.throws
        own = (throws.pin_mass + throws.web_mass.sum(axis=-1))[at, pin, None]
        throw = own * unit / batch.area[at, 0]
        columns |= {"Ksum_MPa": -up - throw, "Rthrow_MPa": raw.throw_load[at, pin]}
    return columns


def _journal(raw: ChainArrays, at: Index, journal: int) -> Columns:
    angles = raw.batch.throws.angle
    columns: Columns = {}
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
        for letter, part in (("T", across), ("K", along)):
            columns |= {
                f"{side}{letter}_MPa": part,
                f"{side}{letter}cos_MPa": part * cos,
                f"{side}{letter}sin_MPa": part * sin,
            }
    x, y = raw.journal[at, journal][..., 0], raw.journal[at, journal][..., 1]
    cos, sin = np.cos(raw.phi), np.sin(raw.phi)
    return columns | {
        "Rx_MPa": x,
        "Ry_MPa": y,
        "R_MPa": raw.journal_load[at, journal],
        "psiR_deg": direction(x, y),
        # The load on the bearing is the opposite of the reaction; the shaft has turned
        # clockwise by φ, from "up" away from "left".
        "block_x_MPa": -(x * cos - y * sin),
        "block_y_MPa": -(x * sin + y * cos),
    }


def _running(raw: ChainArrays, at: Index, family: str, moments: Array, first: int) -> Columns:
    """Torques on journals or pins from throw 1 on, with the throws' own between them."""
    engine = raw.batch.engines[0]
    columns = {f"{family}{first}_Nm": moments[..., 0, :]}
    for throw in range(1, raw.throw_torque.shape[1]):
        columns[throw_torque_key(engine, throw)] = raw.throw_torque[at, throw]
        columns[f"{family}{throw + first}_Nm"] = moments[..., throw, :]
    return columns


def rod_tables(case: Case) -> Tables:
    """Forces of all rods on each throw in its frame, their sum and the throw's torque."""
    if has_single_rods(case.engine):
        return {}
    return {
        f"rods_{throw + 1}": _rods(case, throw, group)
        for throw, group in enumerate(throws(case.engine.arrangement))
    }


def _rods(case: Case, throw: int, group: tuple[int, ...]) -> Columns:
    raw, columns = case.raw, {"phi_deg": case.raw.phi}
    for name, cylinder in zip(rod_names(len(group)), group, strict=True):
        at = (case.index, cylinder)
        K, T = in_throw_frame(raw.K[at], raw.T[at], raw.batch.pin_angle[at])
        columns |= {f"T{name}_MPa": T, f"K{name}_MPa": K}
    at = (case.index, throw)
    return columns | {
        "T_MPa": raw.throw_T[at],
        "K_MPa": raw.throw_K[at],
        "Rthrow_MPa": raw.throw_load[at],
        "Mthrow_Nm": raw.throw_torque[at],
    }


def wear_tables(case: Case) -> Tables:
    """Forces counted at the rays of every crankpin shown and of the main journals, table 14."""
    raw, index = case.raw, case.index
    tables = {
        wear_table(n): raw.pin_rays(index, n) for n in range(len(shown_pins(case.engine)))
    } | {f"table_14_main_{k + 1}": raw.journal_rays(index, k) for k in range(raw.journal.shape[1])}
    return {
        name: {"phi_deg": raw.phi, **{ray_key(i + 1): loads[:, i] for i in range(raw.batch.rays)}}
        for name, loads in tables.items()
    }


def direction(side: Array, along: Array) -> Array:
    """Angle of a vector from its ``along`` axis [rad] in (−π, π], steady where side ≈ 0.

    Components below 1e-9 MPa are rounding noise of zero and count as zero, else
    the angle would jump between −180° and 180°.
    """
    return np.arctan2(*(np.where(np.abs(part) < UNLOADED, 0.0, part) for part in (side, along)))


def wear_sums(case: Case) -> Tables:
    """Sums of the forces at the rays over the cycle, what the wear diagrams are drawn from."""
    raw, index = case.raw, case.index
    sums = {wear_table(n): raw.pin_wear[index, n] for n in range(len(shown_pins(case.engine)))}
    sums |= {f"table_14_main_{k + 1}": row for k, row in enumerate(raw.journal_wear[index])}
    angles = ray_angles(raw.batch.rays)
    return {f"{name}_sums": {"ray_deg": angles, "ray_sum": row} for name, row in sums.items()}
