"""Tables П4 and of single journals from the arrays of a batch, for one engine or for many.

Every function takes the index of an engine or a slice of engines; columns are of shape
(angles,) or (engines, angles), SI units.
"""

from __future__ import annotations

import numpy as np

from kshm.arrays import Array, Columns, Results, Scalars, Tables
from kshm.chain.solve import ChainArrays
from kshm.engine.arrangement import hung, pins, throws
from kshm.engine.engine import Engine
from kshm.mechanics import journals
from kshm.mechanics.journals import in_throw_frame
from kshm.mechanics.kinematics import Position
from kshm.mechanics.wear import ray_angles
from kshm.nomenclature.quantity import UNITS, ray_key
from kshm.results.case import (
    UNLOADED,
    Case,
    first_extreme,
    has_single_rods,
    least_loaded,
    pin_table,
    rod_names,
    shown_pins,
    throw_torque_key,
    wear_table,
)

Index = int | slice
_MPA = UNITS["MPa"].si  # extremes are told apart as the tables show them


def force_tables(raw: ChainArrays, at: Index = slice(None)) -> Tables:
    """Return forces, torques, crankpins, journals and running-on torques."""
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
    """Return forces of one cylinder, Gots table П4.1."""
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
    loads = [raw.K[at, i] for i in pins(engine.arrangement)[pin]]
    side, up = raw.pin_side[at, pin], raw.pin_up[at, pin]
    columns = {
        "T_MPa": side,
        "K_MPa": np.sum(loads, axis=0),
        "Krod_MPa": -up,
        "Rpin_MPa": raw.pin_load[at, pin],
        "psi_deg": direction(side, -up),
    }
    if has_single_rods(engine):
        unit = batch.r[at, 0] * batch.omega[at, 0] ** 2
        throws = batch.throws
        loads = (throws.pin_mass + throws.web_mass.sum(axis=-1))[at, pin, None]
        throw = loads * unit / batch.area[at, 0]
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
    """Return forces of all rods on each throw in its frame, their sum and the throw's torque."""
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


def rod_bearing(case: Case) -> Results:
    """Load on the big-end bearing of cylinder 1 in the rod's axes, SI; no articulated rods."""
    raw, engine, first = case.raw, case.engine, (case.index, 0)
    if hung(engine.arrangement):
        return {}, {}
    area = engine.geometry.piston_area
    spin = raw.batch.pin_mass[first][0] * engine.geometry.crank_radius * engine.omega**2
    at = Position.at(raw.local_phi[first], *case.sizes[1:])
    x, y = journals.rod_bearing(raw.K[first] - spin / area, raw.T[first], at)
    load = np.hypot(x, y)
    most, where = first_extreme(load, raw.phi, floor=_MPA)
    scalars = {
        "B_mean": float(load[:-1].mean()),
        "B_max": most,
        "phi_B_max_deg": where,
        "B_min": float(load.min()),
    }
    table = {"phi_deg": raw.phi, "Bx_MPa": x, "By_MPa": y, "B_MPa": load}
    return {"rod_bearing": table}, scalars


def pin_bending(case: Case) -> Results:
    """Projections of R_к on planes of the pin and its bending in the oil hole's, SI; (42).

    Split pins have no common plane.
    """
    raw = case.raw
    if any(cylinder.pin_angle for cylinder in case.engine.arrangement):
        return {}, {}
    inward, ahead, lever = bending_forces(case, 0)
    angle, angles = oil_hole(case, 0), journals.plane_angles()
    force = journals.on_plane(inward, ahead, angle)
    planes = [journals.on_plane(inward, ahead, plane) for plane in angles]
    moment = force * lever
    swings = np.array([np.ptp(plane) * lever / 2 for plane in planes])
    least, best = first_extreme(swings, angles, largest=False)
    scalars: Scalars = {
        "alpha_oil_deg": angle,
        "Ralpha_max": float(force.max()),
        "Ralpha_min": float(force.min()),
        "Malpha_max": float(moment.max()),
        "Malpha_min": float(moment.min()),
        "Malpha_swing": float(np.ptp(moment)) / 2,
        "Malpha_mean": float(moment.max() + moment.min()) / 2,
        "alpha_best_deg": best,
        "Mbest_swing": least,
    }
    table = {"phi_deg": raw.phi, "Ralpha_MPa": force, "Malpha_Nm": moment}
    table |= {f"plane{number}_MPa": plane for number, plane in enumerate(planes, 1)}
    return {"pin_bending": table}, scalars


def bending_forces(case: Case, number: int) -> tuple[Array, Array, float]:
    """R_к of a throw, from 0, inwards and ahead [Pa], shape (angles,); its bending lever [m³]."""
    raw, engine, index = case.raw, case.engine, case.index
    throw = engine.crankshaft.throws[number]
    unit = engine.geometry.crank_radius * engine.omega**2 / engine.geometry.piston_area
    carried = raw.batch.pin_mass[index, list(throws(engine.arrangement)[number]), 0].sum()
    mass = throw.pin_mass + throw.left_web.mass + throw.right_web.mass
    inward: Array = raw.throw_K[index, number] - (carried + mass) * unit
    lever = engine.geometry.piston_area * throw.length / 4
    return inward, raw.throw_T[index, number], lever


def oil_hole(case: Case, pin: int) -> float:
    """Angle of a pin's oil hole from the crank against rotation [rad]: given, or by the wear."""
    if case.engine.oil_hole is not None:
        return case.engine.oil_hole
    printed = min(pin, len(shown_pins(case.engine)) - 1)  # pins of one wear have one hole
    return float(least_loaded(case.raw.pin_wear[case.index, printed])[1])


def _applies(engine: Engine) -> bool:
    """Whether the shaft has inner supports and rods that pull at undivided pins."""
    whole = all(c.pin_angle == 0 and c.master is None for c in engine.arrangement)
    return len(engine.crankshaft.throws) > 1 and whole and engine.force_offsets is None


def continuous_results(case: Case) -> Results:
    """Moments and reactions over the cycle, their means and extremes against the split scheme's.

    SI units; nothing where the scheme does not apply.
    """
    engine, raw, index = case.engine, case.raw, case.index
    if not _applies(engine):
        return {}, {}
    shaft, area = engine.crankshaft, engine.geometry.piston_area
    moments, reactions = _reactions(case)
    table: Columns = {"phi_deg": raw.phi}
    for k in range(1, len(moments) - 1):
        table |= {f"Ms{axis}{k + 1}_Nm": moments[k, :, i] for i, axis in enumerate("xy")}
    scalars: Scalars = {}
    for k, (x, y) in enumerate(np.moveaxis(reactions, -1, 1), 1):
        load, split = np.hypot(x, y), raw.journal_load[index, k - 1]
        table |= {f"Rcx{k}_MPa": x, f"Rcy{k}_MPa": y, f"Rc{k}_MPa": load}
        mean, most = float(load[:-1].mean()), float(load.max())
        projected = shaft.main_diameters[k - 1] * shaft.main_lengths[k - 1]
        scalars |= {
            f"Rc{k}_mean": mean,
            f"Rc{k}_max": most,
            f"dRc{k}_mean": _over(mean, float(split[:-1].mean())),
            f"dRc{k}_max": _over(most, float(split.max())),
            f"qc{k}_max": most * area / projected,
        }
    return {"continuous": table}, scalars


def _over(load: float, split: float) -> float:
    """How much a load is over that of the split scheme [-]; none over a journal without load."""
    return load / split - 1 if split > UNLOADED else 0.0


def _reactions(case: Case) -> tuple[Array, Array]:
    """Moments [N·m] and specific reactions [Pa] of all supports, (journals, angles, 2)."""
    engine, raw, at = case.engine, case.raw, slice(case.index, case.index + 1)
    batch, area = raw.batch, engine.geometry.piston_area
    unit, throws = batch.r[:, :, 0] * batch.omega[:, :, 0] ** 2, batch.throws
    count, angles = throws.angle.shape[1], len(raw.phi)
    gamma, length = throws.angle[at, :, None], throws.places.length[at, :, None]
    ones = np.ones_like(throws.angle)
    loads = [
        journals.Load(*(part[at, :, None] for part in load))
        for load in journals.own_loads(throws, unit, ones, 0 * ones)
    ]
    spin = batch.pin_mass[at] * unit[at, :, None]
    for position in sorted(set(batch.rods.positions)):
        # The rods that stand there, each on its throw.
        here = (np.array(batch.rods.positions) == position)[:, None]
        left, up = (
            batch.rods.summed(force * here, count)
            for force in (-raw.T[at] * area, spin - raw.K[at] * area)
        )
        loads.append(journals.Load(throws.places.rod_at(position)[at, :, None], left, up))
    terms = journals.load_terms(loads, length, (1, count, angles))
    right, left = (
        np.stack(journals.to_shaft_axes(term[..., 0], term[..., 1], gamma), axis=-1)[0]
        for term in terms
    )
    ends = np.stack(
        [
            np.stack(journals.to_shaft_axes(load.left, load.up, throws.angle), axis=-1)[
                case.index, throw
            ] * -arm
            for load, arm, throw in zip(
                journals.end_loads(throws, unit), throws.end_arm[case.index], (0, -1), strict=True
            )
        ]
    )  # fmt: skip
    spans = throws.places.length[case.index]
    moments = journals.support_moments(
        spans, right, left, np.broadcast_to(ends[:, None], (2, angles, 2))
    )
    return moments, raw.journal[case.index] + journals.corrections(spans, moments) / area
