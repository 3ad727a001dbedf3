"""Scalar results of one engine in SI units, keyed as in the nomenclature."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from kshm import inertia, kinematics
from kshm.cycle_summary import summarise_cycle
from kshm.engine import Engine, PolytropicGas
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
        **_masses(engine),
        **_gas(engine, raw),
        **_torque(engine, raw, index),
        **_pin(engine, raw, index),
        **_journals(engine, raw, index),
        **_running(raw, index),
        **_throws(raw, index),
        **(summarise_cycle(engine.cycle) if engine.cycle is not None else {}),
    }


def _geometry(engine: Engine) -> dict[str, float]:
    geometry, omega = engine.geometry, engine.omega
    r, lam = geometry.crank_radius, geometry.lam
    arrays = np.array(r), np.array(lam), np.array(omega)
    swept = geometry.piston_area * 2 * r
    fastest = float(kinematics.max_velocity(*arrays))
    mean = float(kinematics.mean_velocity(arrays[0], arrays[2]))
    unit = r * omega**2
    return {
        "r_crank": r,
        "L_rod": geometry.rod_length,
        "lam": lam,
        "S_stroke": 2 * r,
        "F_piston": geometry.piston_area,
        "V_h": swept,
        "V_c": swept / (geometry.compression_ratio - 1),
        "V_engine": swept * engine.cylinders,
        "omega": omega,
        "c_m": mean,
        "phi_vmax_deg": float(kinematics.max_velocity_angle(arrays[1])),
        "v_max": fastest,
        "v_ratio": fastest / mean,
        "j_tdc": unit * (1 + lam),
        "j_bdc": -unit * (1 - lam),
        "beta_max_deg": float(np.arcsin(lam)),
    }


def _masses(engine: Engine) -> dict[str, float]:
    m_j, m_2 = inertia.point_masses(engine.masses, engine.geometry.rod_length)
    m_k = inertia.throw_mass(engine.crankshaft.throws[0])
    unit = engine.geometry.crank_radius * engine.omega**2
    area = engine.geometry.piston_area
    return {
        "m_2": m_2,
        "m_j": m_j,
        "m_k": m_k,
        "m_r": m_k + m_2,
        "P_unit": m_j * unit / area,
        "K_r": (m_k + m_2) * unit,
        "K_r_spec": (m_k + m_2) * unit / area,
        "K_r_rod": m_2 * unit / area,
        "K_r_throw": m_k * unit / area,
    }


def _gas(engine: Engine, raw: BatchSolution) -> dict[str, float]:
    gas = engine.gas
    if not isinstance(gas, PolytropicGas):
        return {}
    geometry = engine.geometry
    r, lam = np.array(geometry.crank_radius), np.array(geometry.lam)

    def ratio(angle: float) -> float:
        share = kinematics.displacement_exact(np.array(angle), r, lam) / (2 * r)
        return float(1 + (geometry.compression_ratio - 1) * share)

    at_start, at_open = ratio(gas.combustion_start), ratio(gas.exhaust_open)
    eps = geometry.compression_ratio
    return {
        "phi_c_deg": gas.combustion_start,
        "phi_open_deg": gas.exhaust_open,
        "phi_close_deg": gas.exhaust_close,
        "x_start": at_start,
        "p_start": gas.p_intake * (eps / at_start) ** gas.n_compression,
        "p_c_end": gas.p_intake * eps**gas.n_compression,
        "x_open": at_open,
        "p_open": gas.p_max * min(1.0, (gas.rho / at_open) ** gas.n_expansion),
    }


def _torque(engine: Engine, raw: BatchSolution, index: int) -> dict[str, float]:
    total = raw.torque_sum[index]
    mean = float(total[:-1].mean())
    largest, at_largest = first_extreme(total, raw.phi)
    smallest, at_smallest = first_extreme(total, raw.phi, largest=False)
    geometry = engine.geometry
    lever = geometry.piston_area * geometry.crank_radius
    displaced = geometry.piston_area * 2 * geometry.crank_radius * engine.cylinders
    values = {
        "M_mean": mean,
        "M_max": largest,
        "phi_M_max_deg": at_largest,
        "M_min": smallest,
        "phi_M_min_deg": at_smallest,
        "M_e": mean * engine.mechanical_efficiency,
        "N_i_calc": mean * engine.omega,
        "p_i_calc": mean * engine.period / displaced,
        "T_mean": mean / lever,
    }
    if engine.indicated_power is not None:
        reference = engine.indicated_power / (engine.omega * lever * engine.fullness)
        values["T_ref"] = reference
        values["T_error"] = values["T_mean"] / reference - 1
    return values


def _pin(engine: Engine, raw: BatchSolution, index: int) -> dict[str, float]:
    load = raw.pin_load[index]
    mean = float(load[:-1].mean())
    largest, at_largest = first_extreme(load, raw.phi)
    smallest, at_smallest = first_extreme(load, raw.phi, largest=False)
    area = engine.geometry.piston_area
    projected = engine.crankshaft.pin_diameter * engine.crankshaft.pin_length
    ray, angle = least_loaded(raw.pin_wear[index])
    return {
        "Rpin_mean": mean,
        "Rpin_max": largest,
        "phi_Rpin_max_deg": at_largest,
        "Rpin_min": smallest,
        "phi_Rpin_min_deg": at_smallest,
        "Rpin_max_kN": largest * area,
        "Rpin_min_kN": smallest * area,
        "q_pin_mean": mean * area / projected,
        "q_pin_max": largest * area / projected,
        "hole_pin_ray": ray,
        "hole_pin_deg": angle,
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
