"""Scalars of the chain of forces for the engines of a batch, SI units, shape (engines,)."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from kshm.arrays import Array
from kshm.chain.solve import ChainArrays
from kshm.engine.arrangement import rods_beside
from kshm.engine.engine import Engine
from kshm.mechanics import kinematics, masses
from kshm.mechanics.journals import rod_width
from kshm.results.case import first_number, least_loaded, mean_of, shown_pins, summary_of
from kshm.results.motion import central_scalars

Numbers = dict[str, Array]


class Engines:
    """The engines of a slice with their commonest values, shape (engines,)."""

    def __init__(self, raw: ChainArrays, at: slice) -> None:
        self.raw, self.at = raw, at
        self.engines = raw.batch.engines[at]
        self.first = self.engines[0]
        batch = raw.batch
        self.r, self.lam, self.omega, self.area, self.stroke = (
            values[at, 0, 0]
            for values in (batch.r, batch.lam, batch.omega, batch.area, batch.piston_stroke)
        )

    def each(self, get: Callable[[Engine], object]) -> Array:
        """Return a value, or several, of every engine."""
        return np.array([get(engine) for engine in self.engines], dtype=float)

    @property
    def displaced(self) -> Array:
        """Displacement of all cylinders [m³], those of articulated rods by their own strokes."""
        hung = self.raw.hung
        if hung is None:
            strokes = self.stroke * self.first.cylinders
        else:
            main_cylinders = self.first.cylinders - hung.stroke.shape[1]
            strokes = self.stroke * main_cylinders + hung.stroke[self.at, :, 0].sum(axis=1)
        return self.area * strokes


def chain_scalars(raw: ChainArrays, at: slice = slice(None)) -> Numbers:
    """Scalars of the chain of forces but for what only some layouts and gases have."""
    of = Engines(raw, at)
    return geometry_scalars(of) | mass_scalars(of) | load_scalars(of)


def geometry_scalars(of: Engines) -> Numbers:
    """Sizes, speeds and the motion's extremes in closed form, Gots chapter 1."""
    swept = of.area * of.stroke
    scalars = {
        "r_crank": of.r,
        "L_rod": of.each(lambda e: e.geometry.rod_length),
        "lam": of.lam,
        "S_stroke": of.stroke,
        "F_piston": of.area,
        "V_h": swept,
        "V_c": swept / (of.raw.batch.eps[of.at, 0, 0] - 1),
        "V_engine": of.displaced,
        "omega": of.omega,
        "c_m": kinematics.mean_velocity(of.stroke / 2, of.omega),
    }
    central = all(engine.geometry.is_central for engine in of.engines)
    return scalars | (central_scalars(of.r, of.lam, of.omega) if central else {})


def mass_scalars(of: Engines) -> Numbers:
    """Return moving masses and their inertia forces, Gots 2.2, 2.3."""
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


def load_scalars(of: Engines) -> Numbers:
    """Torque, loads of crankpins and journals, running-on torques, constant reactions."""
    return {**_torque(of), **_pins(of), **_journals(of), **_running(of), **_throws(of)}


def _torque(of: Engines) -> Numbers:
    summary = summary_of("M", of.raw.torque_sum[of.at], of.raw.phi)
    mean, lever = summary["M_mean"], of.area * of.r
    scalars = {
        **summary,
        "M_e": mean * of.each(lambda e: e.mechanical_efficiency),
        "N_i_calc": mean * of.omega,
        "p_i_calc": mean * of.first.period / of.displaced,
        "T_mean": mean / lever,
    }
    if all(engine.indicated_power is not None for engine in of.engines):
        power = of.each(lambda e: e.indicated_power)
        reference = power / (of.omega * lever * of.each(lambda e: e.fullness))
        scalars["T_ref"] = reference
        scalars["T_error"] = scalars["T_mean"] / reference - 1
    return scalars


def _pins(of: Engines) -> Numbers:
    groups, raw = shown_pins(of.first), of.raw
    scalars: Numbers = {}
    for pin, group in enumerate(groups):
        number = "" if pin == 0 else str(pin + 1)
        load, wear = raw.pin_load[of.at, pin], raw.pin_wear[of.at, pin]
        scalars |= _bearing(of, f"pin{number}", load, wear)
        scalars |= _rod_pressure(of, number, load, group[0])
    if len(groups) > 1:
        peaks = raw.pin_load[of.at, : len(groups)].max(axis=-1)
        scalars["worst_pin_load"] = first_number(peaks)
    return scalars


def _rod_pressure(of: Engines, number: str, load: Array, cylinder: int) -> Numbers:
    """Pressures of a rod's bearing: its own rod's force, of the projected area of its width."""
    scalars: Numbers = {}
    if rods_beside(of.first.arrangement, cylinder) > 1:
        raw, at = of.raw, (of.at, cylinder)
        spin = raw.batch.pin_mass[at] * (of.r * of.omega**2 / of.area)[:, None]
        load = np.hypot(raw.K[at] - spin, raw.T[at])
        scalars = {f"Rrod{number}_mean": mean_of(load), f"Rrod{number}_max": load.max(axis=-1)}
    throw = of.first.arrangement[cylinder].throw
    projected = of.each(lambda e: e.crankshaft.pin_diameters[throw] * rod_width(e, cylinder))
    return scalars | {
        f"q_pin{number}_mean": mean_of(load) * of.area / projected,
        f"q_pin{number}_max": load.max(axis=-1) * of.area / projected,
    }


def _journals(of: Engines) -> Numbers:
    raw, scalars = of.raw, dict[str, Array]()
    size = of.each(lambda e: (e.crankshaft.main_diameters, e.crankshaft.main_lengths)).prod(axis=1)
    for k in range(raw.journal_load.shape[1]):
        load, wear = raw.journal_load[of.at, k], raw.journal_wear[of.at, k]
        name, force = f"main{k + 1}", of.area / size[:, k]
        scalars |= _bearing(of, name, load, wear)
        scalars[f"q_{name}_mean"] = scalars[f"R{name}_mean"] * force
        scalars[f"q_{name}_max"] = scalars[f"R{name}_max"] * force
    peaks = raw.journal_load[of.at].max(axis=-1)
    return scalars | {"worst_main_load": first_number(peaks)}


def _bearing(of: Engines, name: str, load: Array, wear: Array) -> Numbers:
    """Specific load, force and oil hole of one journal."""
    scalars = summary_of(f"R{name}", load, of.raw.phi)
    scalars[f"R{name}_max_kN"] = scalars[f"R{name}_max"] * of.area
    if name.startswith("pin"):
        scalars[f"R{name}_min_kN"] = scalars[f"R{name}_min"] * of.area
    ray, angle = least_loaded(wear)
    return scalars | {f"hole_{name}_ray": ray, f"hole_{name}_deg": angle}


def _running(of: Engines) -> Numbers:
    main, pin = (np.ptp(each[of.at], axis=-1) for each in (of.raw.running_main, of.raw.running_pin))
    scalars = {f"dM_main{k + 1}": main[:, k] for k in range(1, main.shape[1])}
    scalars |= {f"dM_pin{k + 1}": pin[:, k] for k in range(pin.shape[1])}
    return scalars | {
        "worst_main_torque": first_number(main),
        "worst_pin_torque": first_number(pin),
    }


def _throws(of: Engines) -> Numbers:
    """Constant reactions of each throw's supports to centrifugal forces [N]."""
    sides = tuple(zip("LP", of.raw.constants, strict=True))
    return {
        f"throw{i + 1}_R{letter}C{side}": values[of.at][:, i, axis]
        for i in range(of.raw.constants[0].shape[1])
        for side, values in sides
        for axis, letter in enumerate("TK")
    }
