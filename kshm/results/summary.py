"""Scalar results of one engine in SI units, keyed as in the nomenclature."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from kshm.engine.engine import Engine
from kshm.mechanics import kinematics, masses
from kshm.mechanics.wear import ray_angles
from kshm.results.cycle import summarise_cycle
from kshm.results.layout_columns import shown_pins
from kshm.results.layout_summary import articulated_scalars, displaced, gas_scalars, offset_scalars

if TYPE_CHECKING:
    from kshm.chain.solve import BatchSolution

Array = NDArray[np.float64]

# Values this close to the extreme count as equal: the first angle or number is reported.
TIE = 1e-9


def first_extreme(values: Array, where: Array, *, largest: bool = True) -> tuple[float, float]:
    """Extreme of ``values`` and the first place where it is reached within rounding."""
    extreme, place = first_extremes(values[None], where, largest=largest)
    return float(extreme[0]), float(place[0])


def first_extremes(values: Array, where: Array, *, largest: bool = True) -> tuple[Array, Array]:
    """Extreme of each row and the first place where it is reached within rounding.

    Args:
        values: shape (..., places).
        where: the places, shape (places,).
        largest: the maximum, else the minimum.

    Returns:
        Extremes and places, both of shape (...,).
    """
    signed = values if largest else -values
    top = signed.max(axis=-1, keepdims=True)
    reached = signed >= top - TIE * np.maximum(1.0, np.abs(top))
    extreme = top[..., 0] if largest else -top[..., 0]
    return extreme, where[np.argmax(reached, axis=-1)]


def summarise(engine: Engine, raw: BatchSolution, index: int) -> dict[str, float]:
    """All scalar results in SI units."""
    of = _Engines(raw, slice(index, index + 1))

    def single(values: dict[str, Array]) -> dict[str, float]:
        return {key: float(each[0]) for key, each in values.items()}

    return {
        **single(_geometry(of)),
        **offset_scalars(engine),
        **articulated_scalars(engine, raw, index),
        **single(_masses(of)),
        **gas_scalars(engine),
        **single(_loads(of)),
        **(summarise_cycle(engine.cycle) if engine.cycle is not None else {}),
    }


def chain_scalars(raw: BatchSolution) -> dict[str, Array]:
    """Scalars of the chain of forces for all engines of a batch, SI units, shape (engines,).

    They are those of ``summarise`` but for what only some layouts and gases have.
    """
    of = _Engines(raw, slice(None))
    return {**_geometry(of), **_masses(of), **_loads(of)}


def _loads(of: _Engines) -> dict[str, Array]:
    raw, at = of.raw, of.at
    return {
        **_torque(of),
        **_pins(of),
        **_journals(of),
        **_running(raw, at),
        **_throws(raw, at),
    }


class _Engines:
    """The engines of a slice with their commonest values, shape (engines,)."""

    def __init__(self, raw: BatchSolution, at: slice) -> None:
        self.raw, self.at = raw, at
        self.engines = raw.batch.engines[at]
        self.first = self.engines[0]
        batch = raw.batch
        self.r, self.lam, self.omega, self.area = (
            values[at, 0, 0] for values in (batch.r, batch.lam, batch.omega, batch.area)
        )
        self.stroke = batch.piston_stroke[at, 0, 0]

    def each(self, get: Callable[[Engine], float]) -> Array:
        """A value of every engine."""
        return np.array([get(engine) for engine in self.engines], dtype=float)


def _geometry(of: _Engines) -> dict[str, Array]:
    swept = of.area * of.stroke
    mean = kinematics.mean_velocity(of.stroke / 2, of.omega)
    values = {
        "r_crank": of.r,
        "L_rod": of.each(lambda e: e.geometry.rod_length),
        "lam": of.lam,
        "S_stroke": of.stroke,
        "F_piston": of.area,
        "V_h": swept,
        "V_c": swept / (of.raw.batch.eps[of.at, 0, 0] - 1),
        "V_engine": of.each(displaced),
        "omega": of.omega,
        "c_m": mean,
    }
    return values | (_central(of, mean) if of.first.geometry.is_central else {})


def _central(of: _Engines, mean: Array) -> dict[str, Array]:
    """Extremes of the central mechanism's two-term motion, in closed form."""
    fastest = kinematics.max_velocity(of.r, of.lam, of.omega)
    unit = of.r * of.omega**2
    return {
        "phi_vmax_deg": kinematics.max_velocity_angle(of.lam),
        "v_max": fastest,
        "v_ratio": fastest / mean,
        "j_tdc": unit * (1 + of.lam),
        "j_bdc": -unit * (1 - of.lam),
        "beta_max_deg": np.arcsin(of.lam),
    }


def _masses(of: _Engines) -> dict[str, Array]:
    batch, at = of.raw.batch, of.at
    m_j, m_2, m_k = (values[at, 0, 0] for values in (batch.m_j, batch.m_2, batch.m_k))
    m_r = of.each(masses.rotating_mass)
    unit = of.r * of.omega**2
    return {
        "m_2": m_2,
        "m_j": m_j,
        "m_k": m_k,
        "m_r": m_r,
        "P_unit": m_j * unit / of.area,
        "K_r": m_r * unit,
        "K_r_spec": m_r * unit / of.area,
        "K_r_rod": m_2 * unit / of.area,
        "K_r_throw": m_k * unit / of.area,
    }


def _torque(of: _Engines) -> dict[str, Array]:
    total, phi = of.raw.torque_sum[of.at], of.raw.phi
    mean = total[:, :-1].mean(axis=-1)
    largest, at_largest = first_extremes(total, phi)
    smallest, at_smallest = first_extremes(total, phi, largest=False)
    lever = of.area * of.r
    values = {
        "M_mean": mean,
        "M_max": largest,
        "phi_M_max_deg": at_largest,
        "M_min": smallest,
        "phi_M_min_deg": at_smallest,
        "M_e": mean * of.each(lambda e: e.mechanical_efficiency),
        "N_i_calc": mean * of.omega,
        "p_i_calc": mean * of.first.period / of.each(displaced),
        "T_mean": mean / lever,
    }
    powers = [e.indicated_power for e in of.engines]
    given = [power for power in powers if power is not None]
    if len(given) == len(powers):
        reference = np.array(given) / (of.omega * lever * of.each(lambda e: e.fullness))
        values["T_ref"] = reference
        values["T_error"] = values["T_mean"] / reference - 1
    return values


def _pins(of: _Engines) -> dict[str, Array]:
    values: dict[str, Array] = {}
    count = len(shown_pins(of.first))
    projected = of.each(lambda e: e.crankshaft.pin_diameter * e.crankshaft.pin_length)
    for pin in range(count):
        values |= _pin(of, pin, projected)
    if count > 1:
        peaks = of.raw.pin_load[of.at, :count].max(axis=-1)
        values["worst_pin_load"] = _first_number(peaks)
    return values


def _pin(of: _Engines, pin: int, projected: Array) -> dict[str, Array]:
    load, n, phi = of.raw.pin_load[of.at, pin], "" if pin == 0 else str(pin + 1), of.raw.phi
    mean = load[:, :-1].mean(axis=-1)
    largest, at_largest = first_extremes(load, phi)
    smallest, at_smallest = first_extremes(load, phi, largest=False)
    ray, angle = least_loaded(of.raw.pin_wear[of.at, pin])
    return {
        f"Rpin{n}_mean": mean,
        f"Rpin{n}_max": largest,
        f"phi_Rpin{n}_max_deg": at_largest,
        f"Rpin{n}_min": smallest,
        f"phi_Rpin{n}_min_deg": at_smallest,
        f"Rpin{n}_max_kN": largest * of.area,
        f"Rpin{n}_min_kN": smallest * of.area,
        f"q_pin{n}_mean": mean * of.area / projected,
        f"q_pin{n}_max": largest * of.area / projected,
        f"hole_pin{n}_ray": ray,
        f"hole_pin{n}_deg": angle,
    }


def _journals(of: _Engines) -> dict[str, Array]:
    values: dict[str, Array] = {}
    raw, phi = of.raw, of.raw.phi
    diameter = of.each(lambda e: e.crankshaft.main_diameter)
    peaks = []
    for k in range(raw.journal_load.shape[1]):
        load, number = raw.journal_load[of.at, k], k + 1
        largest, at_largest = first_extremes(load, phi)
        smallest, at_smallest = first_extremes(load, phi, largest=False)
        lengths = np.array([e.crankshaft.main_lengths[k] for e in of.engines])
        projected = diameter * lengths
        mean = load[:, :-1].mean(axis=-1)
        ray, angle = least_loaded(raw.journal_wear[of.at, k])
        peaks.append(largest)
        values |= {
            f"Rmain{number}_mean": mean,
            f"Rmain{number}_max": largest,
            f"phi_Rmain{number}_max_deg": at_largest,
            f"Rmain{number}_min": smallest,
            f"phi_Rmain{number}_min_deg": at_smallest,
            f"Rmain{number}_max_kN": largest * of.area,
            f"q_main{number}_mean": mean * of.area / projected,
            f"q_main{number}_max": largest * of.area / projected,
            f"hole_main{number}_ray": ray,
            f"hole_main{number}_deg": angle,
        }
    values["worst_main_load"] = _first_number(np.stack(peaks, axis=-1))
    return values


def _running(raw: BatchSolution, at: slice) -> dict[str, Array]:
    main, pin = np.ptp(raw.running_main[at], axis=-1), np.ptp(raw.running_pin[at], axis=-1)
    values = {f"dM_main{k + 1}": main[:, k] for k in range(1, main.shape[1])}
    values |= {f"dM_pin{k + 1}": pin[:, k] for k in range(pin.shape[1])}
    values["worst_main_torque"] = _first_number(main)
    values["worst_pin_torque"] = _first_number(pin)
    return values


def _throws(raw: BatchSolution, at: slice) -> dict[str, Array]:
    """Constant reactions of each throw's supports to centrifugal forces [N]."""
    left, right = (side[at] for side in raw.constants)
    values: dict[str, Array] = {}
    for i in range(left.shape[1]):
        values |= {
            f"throw{i + 1}_RTCL": left[:, i, 0],
            f"throw{i + 1}_RKCL": left[:, i, 1],
            f"throw{i + 1}_RTCP": right[:, i, 0],
            f"throw{i + 1}_RKCP": right[:, i, 1],
        }
    return values


def _first_number(values: Array) -> Array:
    """Number, from 1, of the first value of each row that equals its largest within rounding."""
    return first_extremes(values, np.arange(1.0, values.shape[-1] + 1))[1]


def least_loaded(sums: Array) -> tuple[Array, Array]:
    """Number of the ray with the smallest sum and the place of the oil hole [rad].

    Rays are directions of the force on the journal; the journal is touched on
    the side from which the force comes, half a turn away.  Shape of both (...,)
    for ``sums`` of shape (..., rays).
    """
    count = sums.shape[-1]
    ray = first_extremes(sums, np.arange(1.0, count + 1), largest=False)[1]
    place = np.mod(ray_angles(count)[ray.astype(int) - 1] + np.pi, 2 * np.pi)
    return ray, place
