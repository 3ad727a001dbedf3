"""Columns that only some layouts have: offset, two rods on a throw, articulated rods."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from kshm.engine.arrangement import pins, throws
from kshm.engine.engine import Engine
from kshm.mechanics import articulated, kinematics
from kshm.mechanics.journals import in_throw_frame
from kshm.nomenclature.quantity import quantity

if TYPE_CHECKING:
    from kshm.chain.solve import BatchSolution

Array = NDArray[np.float64]
Columns = dict[str, Array]


def has_single_rods(engine: Engine) -> bool:
    """Whether every throw carries one rod, as in line and in opposed engines."""
    return all(len(group) == 1 for group in throws(engine.arrangement))


def shown_pins(engine: Engine) -> tuple[tuple[int, ...], ...]:
    """Crankpins with loads of their own; pins with one rod each differ in phase only."""
    groups = pins(engine.arrangement)
    return groups[:1] if all(len(group) == 1 for group in groups) else groups


def pin_table(number: int) -> str:
    """Id of the table with the loads on a crankpin, counted from 0."""
    return "crankpin" if number == 0 else f"crankpin_{number + 1}"


def wear_table(number: int) -> str:
    """Id of the table with the wear of a crankpin, counted from 0."""
    return "table_14" if number == 0 else f"table_14_pin_{number + 1}"


def throw_torque_key(engine: Engine, throw: int) -> str:
    """Column of the torque of a throw, from 0: its cylinder's where it has only one."""
    group = throws(engine.arrangement)[throw]
    return f"M{group[0] + 1}_Nm" if len(group) == 1 else f"Mthrow{throw + 1}_Nm"


def layout_columns(engine: Engine, raw: BatchSolution, index: int) -> dict[str, Columns]:
    """Tables of the engine's layout in the units of the tables; none for a basic engine."""
    cycle, turn = _degrees(180 * engine.strokes, engine), _degrees(360, engine)
    tables: dict[str, Columns] = {}
    if not engine.geometry.is_central:
        tables["offset"] = _offset(engine)
    if raw.batch.articulated is not None:
        tables["articulated"] = _articulated_motion(engine, raw, index)
    if not has_single_rods(engine):
        for number, group in enumerate(throws(engine.arrangement)):
            tables[f"rods_{number + 1}"] = _rods(engine, raw, index, number, group)
    return {
        table: {
            "phi_deg": cycle if table.startswith("rods") else turn,
            **{key: values / quantity(key).si for key, values in columns.items()},
        }
        for table, columns in tables.items()
    }


def _degrees(last: float, engine: Engine) -> Array:
    return np.arange(0.0, last + engine.step_deg, engine.step_deg)


def _turn(engine: Engine) -> Array:
    return np.radians(_degrees(360, engine))


def _offset(engine: Engine) -> Columns:
    """Exact motion beside the two-term one of П3.1, and the central one, Gots figure 12."""
    phi, geometry = _turn(engine), engine.geometry
    r, lam, omega, k = (
        np.array(value)
        for value in (
            geometry.crank_radius, geometry.lam, engine.omega, geometry.relative_offset,
        )
    )  # fmt: skip
    return {
        "x_exact_mm": kinematics.displacement_exact(phi, r, lam, k),
        "v_exact_m_s": kinematics.velocity_exact(phi, r, lam, omega, k),
        "j_exact_m_s2": kinematics.acceleration_exact(phi, r, lam, omega, k),
        "j_central_m_s2": np.sum(kinematics.acceleration_orders(phi, r, lam, omega), axis=0),
    }


def _articulated_motion(engine: Engine, raw: BatchSolution, index: int) -> Columns:
    """Motion of the articulated rod and its piston over the angle of its cylinder."""
    phi, rods = _turn(engine), raw.batch.articulated
    if rods is None or raw.hung is None:
        return {}
    found = articulated.motion(phi, rods.link)
    top = articulated.motion(raw.hung.tdc, rods.link).height[0]
    omega = engine.omega
    return {
        "beta_master_rad": found.pin.beta[index, 0],
        "across_mm": found.pin.across[0][index, 0],
        "along_mm": found.pin.along[0][index, 0],
        "beta_rad": found.beta[index, 0],
        "x_exact_mm": (top - found.height[0])[index, 0],
        "v_exact_m_s": -omega * found.height[1][index, 0],
        "j_exact_m_s2": -(omega**2) * found.height[2][index, 0],
    }


def articulated_columns(raw: BatchSolution, index: int | slice, cylinder: int) -> Columns:
    """What an articulated rod does to the master piston and rod; nothing for other rods."""
    rods, hung = raw.batch.articulated, raw.hung
    if rods is None or hung is None or cylinder not in rods.cylinders:
        return {}
    at = index, rods.cylinders.index(cylinder)
    area = raw.batch.area[index, 0]
    return {"Nadd_MPa": hung.on_pin.N_added[at], "Mrod_Nm": hung.on_pin.moment[at] * area}


def _rods(
    engine: Engine, raw: BatchSolution, index: int, throw: int, group: tuple[int, ...]
) -> Columns:
    """Forces of both rods on one throw in its frame, their sum and the throw's torque."""
    columns: Columns = {}
    for side, cylinder in zip(("left", "right"), group, strict=True):
        at = (index, cylinder)
        K, T = in_throw_frame(raw.K[at], raw.T[at], raw.batch.pin_angle[at])
        columns |= {f"T{side}_MPa": T, f"K{side}_MPa": K}
    at = (index, throw)
    return columns | {
        "T_MPa": raw.throw_T[at],
        "K_MPa": raw.throw_K[at],
        "Rthrow_MPa": raw.throw_load[at],
        "Mthrow_Nm": raw.throw_torque[at],
    }


def direction(side: Array, along: Array) -> Array:
    """Angle of a vector from its ``along`` axis [rad] in (−π, π], steady where side ≈ 0.

    Components below 1e-9 MPa are rounding noise of zero and count as zero, else
    the angle would jump between −180° and 180°.
    """
    clean = np.where(np.abs(side) < 1e-3, 0.0, side)
    return np.arctan2(clean, along)
