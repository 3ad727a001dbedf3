"""Torque harmonics of one engine and Chudakov's coefficients as columns and scalars."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from kshm.engine.engine import Engine, PolytropicGas, RoundedGas
from kshm.mechanics import kinematics, torque_harmonics
from kshm.mechanics.masses import point_masses

if TYPE_CHECKING:
    from kshm.chain.solve import BatchSolution

Array = NDArray[np.float64]
Columns = dict[str, Array]

LAST_ORDER = 8.0


def orders(step_deg: int, strokes: int = 4) -> Array:
    """Orders 1/2, 1, … 8 of a four-stroke engine, 1 … 8 of a two-stroke one, up to the grid's."""
    step = 2 / strokes
    last = min(LAST_ORDER, 180 / step_deg - step)
    found: Array = np.arange(1.0, round(last / step) + 1) * step
    return found


def tangential(engine: Engine, raw: BatchSolution, index: int) -> Columns:
    """Specific tangential force of cylinder 1 from gas, inertia and the motored cycle [Pa]."""
    phi, lam = raw.phi, engine.geometry.lam
    beta = np.arcsin(lam * np.sin(phi))
    shape = np.sin(phi) + np.tan(beta) * np.cos(phi)
    curves = {
        "t_gas_MPa": raw.p_gas[index, 0] * shape,
        "t_inertia_MPa": raw.p_inertia[index, 0] * shape,
    }
    if engine.strokes == 4:
        curves["t_motored_MPa"] = (motored(engine, raw, index) - engine.gas.p_ambient) * shape
    return curves


def motored(engine: Engine, raw: BatchSolution, index: int) -> Array:
    """Gas pressure without combustion [Pa]: the compression, mirrored about TDC."""
    phi = raw.phi
    pressure = raw.p[index, 0]
    between = (phi > np.pi + 1e-9) & (phi < 3 * np.pi - 1e-9)
    if isinstance(engine.gas, PolytropicGas | RoundedGas):
        geometry = engine.geometry
        r, lam = np.array(geometry.crank_radius), np.array(geometry.lam)
        share = kinematics.displacement_exact(phi, r, lam) / (2 * r)
        eps = geometry.compression_ratio
        ratio = 1 + (eps - 1) * share
        mirrored = engine.gas.p_intake * (eps / ratio) ** engine.gas.n_compression
    else:
        mirrored = pressure[np.minimum(np.arange(len(phi)), len(phi) - 1 - np.arange(len(phi)))]
    cold: Array = np.where(between, mirrored, pressure)
    return cold


def _second(curve: Array, period: float) -> tuple[float, float]:
    found = torque_harmonics.analyse(curve, period, np.array([2.0]))
    return float(found.amplitude[0]), float(found.phase[0])


def columns(engine: Engine, raw: BatchSolution, index: int) -> dict[str, Columns]:
    """Tables ``tangential``, ``torque_orders`` and ``suppression`` in SI units."""
    curves = tangential(engine, raw, index)
    found = orders(engine.step_deg, engine.strokes)
    gas, inertia = (
        torque_harmonics.analyse(curves[key], engine.period, found)
        for key in ("t_gas_MPa", "t_inertia_MPa")
    )
    total = torque_harmonics.Harmonics(found, gas.cosine + inertia.cosine, gas.sine + inertia.sine)
    offsets = np.array(engine.firing_offsets)
    together = np.abs(np.exp(-1j * found[:, None] * offsets).sum(axis=1))
    lever = engine.geometry.piston_area * engine.geometry.crank_radius
    table: Columns = {"order": found}
    for name, part in (("gas", gas), ("inertia", inertia), ("total", total)):
        table[f"{name}_cos_MPa"] = part.cosine
        table[f"{name}_sin_MPa"] = part.sine
        table[f"{name}_amplitude_MPa"] = part.amplitude
        table[f"{name}_phase_deg"] = part.phase
    table["cylinders_sum"] = together
    table["M_engine_order_Nm"] = total.amplitude * lever * together
    tables = {"tangential": {"phi_deg": raw.phi, **curves}, "torque_orders": table}
    if engine.strokes == 4:
        tables |= {"suppression": _suppression(engine, raw, index)}
    return tables


def _suppression(engine: Engine, raw: BatchSolution, index: int) -> Columns:
    values = _coefficients(engine, raw, index)
    ratio = np.linspace(0.3, 1.2, 10)
    omega: Array = ratio * engine.omega
    t_j = torque_harmonics.inertia_second(np.array(values["d_j"]), omega)
    nominal, idle = np.array(values["t_gas2"]), np.array(values["t_gas2_idle"])
    psi = engine.balancing.suppression
    best = torque_harmonics.best_suppression(nominal, t_j)
    return {
        "speed_share": ratio,
        "n_rpm": omega,
        "t_j2_MPa": t_j,
        "residual_bare_MPa": torque_harmonics.residual(nominal, t_j, 0.0),
        "residual_psi_MPa": torque_harmonics.residual(nominal, t_j, psi),
        "residual_vector_MPa": torque_harmonics.residual_vector(
            nominal, values["gamma_gas2"], t_j, psi
        ),
        "psi_best": best,
        "psi_best_idle": torque_harmonics.best_suppression(idle, t_j),
        "h_best_mm": best * engine.geometry.rod_length,
    }


def _coefficients(engine: Engine, raw: BatchSolution, index: int) -> dict[str, float]:
    geometry = engine.geometry
    m_j, _ = point_masses(engine.masses, geometry.rod_length)
    curves = tangential(engine, raw, index)
    gas, gamma = _second(curves["t_gas_MPa"], engine.period)
    cold, _ = _second(curves["t_motored_MPa"], engine.period)
    # Between the motored and the working cycle the harmonic is taken linear in p_i; at idle
    # all of p_i goes into friction.
    idle = cold + (gas - cold) * (1 - engine.mechanical_efficiency)
    d_j = torque_harmonics.specific_imbalance(m_j, geometry.crank_radius, geometry.piston_area)
    return {"d_j": d_j, "t_gas2": gas, "gamma_gas2": gamma, "t_motored2": cold,
            "t_gas2_idle": idle}  # fmt: skip


def scalars(engine: Engine, raw: BatchSolution, index: int) -> dict[str, float]:
    """Scalars of the torque harmonics in SI units; none for two-stroke engines.

    Chudakov's zones compare with a cycle of compression alone, which ports do not give.
    """
    if engine.strokes != 4:
        return {}
    values = _coefficients(engine, raw, index)
    geometry, psi = engine.geometry, engine.balancing.suppression
    curves = tangential(engine, raw, index)
    inertia, gamma_j = _second(curves["t_inertia_MPa"], engine.period)
    d_j = values["d_j"]
    t_j = float(torque_harmonics.inertia_second(np.array(d_j), np.array(engine.omega)))
    unit = 2 * t_j  # m_j r ω²/F
    bounds = [torque_harmonics.speed_of(values[key], d_j) for key in ("t_gas2_idle", "t_gas2")]
    best = float(torque_harmonics.best_suppression(np.array(values["t_gas2"]), np.array(t_j)))
    lam = geometry.lam
    found = {
        **{f"t_j_order{n}": value * unit
           for n, value in enumerate(torque_harmonics.inertia_coefficients(lam), 1)},
        "d_j": d_j,
        "d_j_technical": d_j,
        "t_gas2": values["t_gas2"],
        "gamma_gas2_deg": values["gamma_gas2"],
        "t_inertia2": inertia,
        "gamma_inertia2_deg": gamma_j % (2 * np.pi),
        "t_j2": t_j,
        "t_motored2": values["t_motored2"],
        "t_gas2_idle": values["t_gas2_idle"],
        "n_zone1": min(bounds),
        "n_zone2": max(bounds),
        "zone": 1.0 + (engine.omega > min(bounds)) + (engine.omega > max(bounds)),
        "psi_best_nominal": best,
        "h_shafts": torque_harmonics.shaft_offset(psi, geometry.rod_length),
        "h_shafts_best": torque_harmonics.shaft_offset(best, geometry.rod_length),
    }  # fmt: skip
    if engine.is_in_line:
        found["P_shafts"] = 0.5 * lam * unit * geometry.piston_area * engine.cylinders
    return found
