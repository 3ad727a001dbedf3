"""Scalar results of one engine in SI units, keyed as in the nomenclature."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from kshm import inertia, kinematics
from kshm.cycle_summary import summarise_cycle
from kshm.engine import Engine
from kshm.layout_columns import shown_pins
from kshm.layout_summary import (
    articulated_scalars,
    displaced,
    gas_scalars,
    offset_scalars,
)
from kshm.wear import ray_angles

if TYPE_CHECKING:
    from kshm.solver import BatchSolution

Array = NDArray[np.float64]

# Values this close to the extreme count as equal: the first angle or number is reported.
TIE = 1e-9


def first_extreme(values: Array, where: Array, *, largest: bool = True) -> tuple[float, float]:
    """Extreme of ``values`` and the first place where it is reached within rounding."""
    signed = values if largest else -values
    top = signed.max()
    reached = signed >= top - TIE * max(1.0, abs(top))
    return float(values.max() if largest else values.min()), float(where[np.argmax(reached)])


def summarise(engine: Engine, raw: BatchSolution, index: int) -> dict[str, float]:
    """All scalar results in SI units."""
    return {
        **_geometry(engine),
        **offset_scalars(engine),
        **articulated_scalars(engine, raw, index),
        **_masses(engine),
        **gas_scalars(engine),
        **_torque(engine, raw, index),
        **_pins(engine, raw, index),
        **_journals(engine, raw, index),
        **_running(raw, index),
        **_throws(raw, index),
        **(summarise_cycle(engine.cycle) if engine.cycle is not None else {}),
    }


def _geometry(engine: Engine) -> dict[str, float]:
    geometry, omega = engine.geometry, engine.omega
    r, lam = geometry.crank_radius, geometry.lam
    swept = geometry.piston_area * geometry.stroke
    mean = float(kinematics.mean_velocity(np.array(geometry.stroke / 2), np.array(omega)))
    values = {
        "r_crank": r,
        "L_rod": geometry.rod_length,
        "lam": lam,
        "S_stroke": geometry.stroke,
        "F_piston": geometry.piston_area,
        "V_h": swept,
        "V_c": swept / (geometry.compression_ratio - 1),
        "V_engine": displaced(engine),
        "omega": omega,
        "c_m": mean,
    }
    return values | (_central(engine, mean) if geometry.is_central else {})


def _central(engine: Engine, mean: float) -> dict[str, float]:
    """Extremes of the central mechanism's two-term motion, in closed form."""
    r, lam, omega = engine.geometry.crank_radius, engine.geometry.lam, engine.omega
    fastest = float(kinematics.max_velocity(np.array(r), np.array(lam), np.array(omega)))
    unit = r * omega**2
    return {
        "phi_vmax_deg": float(kinematics.max_velocity_angle(np.array(lam))),
        "v_max": fastest,
        "v_ratio": fastest / mean,
        "j_tdc": unit * (1 + lam),
        "j_bdc": -unit * (1 - lam),
        "beta_max_deg": float(np.arcsin(lam)),
    }


def _masses(engine: Engine) -> dict[str, float]:
    m_j, m_2 = inertia.point_masses(engine.masses, engine.geometry.rod_length)
    m_k = inertia.throw_mass(engine.crankshaft.throws[0])
    m_r = inertia.rotating_mass(engine)
    unit = engine.geometry.crank_radius * engine.omega**2
    area = engine.geometry.piston_area
    return {
        "m_2": m_2,
        "m_j": m_j,
        "m_k": m_k,
        "m_r": m_r,
        "P_unit": m_j * unit / area,
        "K_r": m_r * unit,
        "K_r_spec": m_r * unit / area,
        "K_r_rod": m_2 * unit / area,
        "K_r_throw": m_k * unit / area,
    }


def _torque(engine: Engine, raw: BatchSolution, index: int) -> dict[str, float]:
    total = raw.torque_sum[index]
    mean = float(total[:-1].mean())
    largest, at_largest = first_extreme(total, raw.phi)
    smallest, at_smallest = first_extreme(total, raw.phi, largest=False)
    geometry = engine.geometry
    lever = geometry.piston_area * geometry.crank_radius
    values = {
        "M_mean": mean,
        "M_max": largest,
        "phi_M_max_deg": at_largest,
        "M_min": smallest,
        "phi_M_min_deg": at_smallest,
        "M_e": mean * engine.mechanical_efficiency,
        "N_i_calc": mean * engine.omega,
        "p_i_calc": mean * engine.period / displaced(engine),
        "T_mean": mean / lever,
    }
    if engine.indicated_power is not None:
        reference = engine.indicated_power / (engine.omega * lever * engine.fullness)
        values["T_ref"] = reference
        values["T_error"] = values["T_mean"] / reference - 1
    return values


def _pins(engine: Engine, raw: BatchSolution, index: int) -> dict[str, float]:
    values: dict[str, float] = {}
    count = len(shown_pins(engine))
    for pin in range(count):
        values |= _pin(engine, raw, index, pin)
    if count > 1:
        values["worst_pin_load"] = _first_number(raw.pin_load[index, :count].max(axis=-1))
    return values


def _pin(engine: Engine, raw: BatchSolution, index: int, pin: int) -> dict[str, float]:
    load, n = raw.pin_load[index, pin], "" if pin == 0 else str(pin + 1)
    mean = float(load[:-1].mean())
    largest, at_largest = first_extreme(load, raw.phi)
    smallest, at_smallest = first_extreme(load, raw.phi, largest=False)
    area = engine.geometry.piston_area
    projected = engine.crankshaft.pin_diameter * engine.crankshaft.pin_length
    ray, angle = least_loaded(raw.pin_wear[index, pin])
    return {
        f"Rpin{n}_mean": mean,
        f"Rpin{n}_max": largest,
        f"phi_Rpin{n}_max_deg": at_largest,
        f"Rpin{n}_min": smallest,
        f"phi_Rpin{n}_min_deg": at_smallest,
        f"Rpin{n}_max_kN": largest * area,
        f"Rpin{n}_min_kN": smallest * area,
        f"q_pin{n}_mean": mean * area / projected,
        f"q_pin{n}_max": largest * area / projected,
        f"hole_pin{n}_ray": ray,
        f"hole_pin{n}_deg": angle,
    }


def _journals(engine: Engine, raw: BatchSolution, index: int) -> dict[str, float]:
    values: dict[str, float] = {}
    area, shaft = engine.geometry.piston_area, engine.crankshaft
    peaks = []
    for k, load in enumerate(raw.journal_load[index]):
        number = k + 1
        largest, at_largest = first_extreme(load, raw.phi)
        smallest, at_smallest = first_extreme(load, raw.phi, largest=False)
        projected = shaft.main_diameter * shaft.main_lengths[k]
        mean = float(load[:-1].mean())
        ray, angle = least_loaded(raw.journal_wear[index, k])
        peaks.append(largest)
        values |= {
            f"Rmain{number}_mean": mean,
            f"Rmain{number}_max": largest,
            f"phi_Rmain{number}_max_deg": at_largest,
            f"Rmain{number}_min": smallest,
            f"phi_Rmain{number}_min_deg": at_smallest,
            f"Rmain{number}_max_kN": largest * area,
            f"q_main{number}_mean": mean * area / projected,
            f"q_main{number}_max": largest * area / projected,
            f"hole_main{number}_ray": ray,
            f"hole_main{number}_deg": angle,
        }
    values["worst_main_load"] = _first_number(np.array(peaks))
    return values


def _running(raw: BatchSolution, index: int) -> dict[str, float]:
    main, pin = np.ptp(raw.running_main[index], axis=-1), np.ptp(raw.running_pin[index], axis=-1)
    values = {f"dM_main{k + 1}": float(main[k]) for k in range(1, len(main))}
    values |= {f"dM_pin{k + 1}": float(value) for k, value in enumerate(pin)}
    values["worst_main_torque"] = _first_number(main)
    values["worst_pin_torque"] = _first_number(pin)
    return values


def _throws(raw: BatchSolution, index: int) -> dict[str, float]:
    """Constant reactions of each throw's supports to centrifugal forces [N]."""
    left, right = (side[index] for side in raw.constants)
    values: dict[str, float] = {}
    for i in range(len(left)):
        values |= {
            f"throw{i + 1}_RTCL": float(left[i, 0]),
            f"throw{i + 1}_RKCL": float(left[i, 1]),
            f"throw{i + 1}_RTCP": float(right[i, 0]),
            f"throw{i + 1}_RKCP": float(right[i, 1]),
        }
    return values


def _first_number(values: Array) -> float:
    """Number, from 1, of the first value that equals the largest within rounding."""
    return first_extreme(values, np.arange(1.0, len(values) + 1))[1]


def least_loaded(sums: Array) -> tuple[float, float]:
    """Number of the ray with the smallest sum and the place of the oil hole [rad].

    Rays are directions of the force on the journal; the journal is touched on
    the side from which the force comes, half a turn away.
    """
    ray = first_extreme(sums, np.arange(1.0, len(sums) + 1), largest=False)[1]
    place = np.mod(ray_angles(len(sums))[int(ray) - 1] + np.pi, 2 * np.pi)
    return ray, float(place)
