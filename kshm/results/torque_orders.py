"""Torque harmonics of one engine and Chudakov's coefficients."""

from __future__ import annotations

import numpy as np

from kshm.arrays import Array, Columns, Results, Scalars
from kshm.engine.gas import TabulatedGas
from kshm.mechanics import torque_harmonics
from kshm.mechanics.kinematics import Position
from kshm.mechanics.masses import point_masses
from kshm.results.case import Case

LAST_ORDER = 8.0
SECOND = np.array([2.0])
_NOTHING = 1e-6  # of a vector sum of unit vectors
# Results for an engine whose torque has a second order.
_OF_SHAFTS = frozenset(
    ("n_zone1", "n_zone2", "zone", "psi_best_nominal", "h_shafts", "h_shafts_best", "P_shafts")
)


def torque_order_results(case: Case) -> Results:
    """Tangential forces, their orders and, of four-stroke engines, what shafts suppress; SI.

    Shafts are for engines whose torque has a second order: four cylinders have, three not.

    Chudakov's zones compare with a cycle of compression alone, which ports do not give, and
    with the inertia forces of a central mechanism.
    """
    curves = _tangential(case)
    tables = {
        "tangential": {"phi_deg": case.raw.phi, **curves},
        "torque_orders": _orders(case, curves),
    }
    if not _has_motored(case):
        return tables, {}
    scalars = _coefficients(case, curves)
    if not _has_second_order(case):
        return tables, {key: value for key, value in scalars.items() if key not in _OF_SHAFTS}
    return tables | {"suppression": _suppression(case, scalars)}, scalars


def _has_motored(case: Case) -> bool:
    """Whether a cycle of compression alone is compared with."""
    return case.engine.strokes == 4 and case.engine.geometry.offset == 0


def _has_second_order(case: Case) -> bool:
    """Whether the torque of the engine has a second order that shafts could take away."""
    together = np.exp(-2j * np.array(case.engine.firing_offsets)).sum()
    return bool(np.abs(together) > _NOTHING)


def _tangential(case: Case) -> Columns:
    """Specific tangential force of cylinder 1 from gas, inertia and the motored cycle [Pa]."""
    raw, first = case.raw, (case.index, 0)
    at = Position.at(raw.local_phi[first], *case.sizes[1:])
    shape = at.sin + at.sin_beta / at.cos_beta * at.cos
    curves = {"t_gas_MPa": raw.p_gas[first] * shape, "t_inertia_MPa": raw.p_inertia[first] * shape}
    if _has_motored(case):
        curves["t_motored_MPa"] = (_motored(case) - case.engine.gas.p_ambient) * shape
    return curves


def _motored(case: Case) -> Array:
    """Gas pressure without combustion [Pa]: the compression, mirrored about TDC."""
    raw, first, gas = case.raw, (case.index, 0), case.engine.gas
    phi, pressure = raw.local_phi[first], raw.p[first]
    between = (phi > np.pi + 1e-9) & (phi < 3 * np.pi - 1e-9)
    if isinstance(gas, TabulatedGas):
        row = np.arange(len(phi))
        mirrored = pressure[np.minimum(row, row[::-1])]
    else:
        eps = case.engine.geometry.compression_ratio
        mirrored = gas.p_intake * (eps / raw.volume_ratio[first]) ** gas.n_compression
    cold: Array = np.where(between, mirrored, pressure)
    return cold


def _orders(case: Case, curves: Columns) -> Columns:
    """Orders 1/2, 1, … 8 of a four-stroke engine, 1 … 8 of a two-stroke one, up to the grid's."""
    engine = case.engine
    orders = case.orders(LAST_ORDER)
    gas, inertia = (
        torque_harmonics.analyse(curves[key], engine.period, orders)
        for key in ("t_gas_MPa", "t_inertia_MPa")
    )
    total = torque_harmonics.Harmonics(orders, gas.cosine + inertia.cosine, gas.sine + inertia.sine)
    together = np.abs(np.exp(-1j * orders[:, None] * np.array(engine.firing_offsets)).sum(axis=1))
    lever = engine.geometry.piston_area * engine.geometry.crank_radius
    table: Columns = {"order": orders}
    for name, part in (("gas", gas), ("inertia", inertia), ("total", total)):
        table |= {
            f"{name}_cos_MPa": part.cosine,
            f"{name}_sin_MPa": part.sine,
            f"{name}_amplitude_MPa": part.amplitude,
            f"{name}_phase_deg": part.phase,
        }
    table["cylinders_sum"] = together
    table["M_engine_order_Nm"] = total.amplitude * lever * together
    return table


def _coefficients(case: Case, curves: Columns) -> Scalars:
    """Second-order coefficients of gas and inertia, zones of speed, shafts; Chudakov (5)-(8)."""
    engine, geometry, lam = case.engine, case.engine.geometry, case.engine.geometry.lam
    second = {
        key: torque_harmonics.analyse(curve, engine.period, SECOND) for key, curve in curves.items()
    }
    amplitude = {key: float(each.amplitude[0]) for key, each in second.items()}
    gas, cold = amplitude["t_gas_MPa"], amplitude["t_motored_MPa"]
    # Between the motored and the working cycle the harmonic is taken linear in p_i; at idle
    # all of p_i goes into friction.
    idle = cold + (gas - cold) * (1 - engine.mechanical_efficiency)
    unit = case.inertia_unit / geometry.piston_area
    m_j, _ = point_masses(engine.masses, geometry.rod_length)
    d_j = torque_harmonics.specific_imbalance(m_j, geometry.crank_radius, geometry.piston_area)
    t_j = float(torque_harmonics.inertia_second(d_j, case.omega))
    bounds = sorted(torque_harmonics.speed_of(t_gas, d_j) for t_gas in (idle, gas))
    best = float(torque_harmonics.best_suppression(np.array(gas), np.array(t_j)))
    psi, rod = engine.balancing.suppression, geometry.rod_length
    scalars = {
        **{f"t_j_order{n}": value * unit
           for n, value in enumerate(torque_harmonics.inertia_coefficients(lam), 1)},
        "d_j": d_j,
        "d_j_technical": d_j,
        "t_gas2": gas,
        "gamma_gas2_deg": float(second["t_gas_MPa"].phase[0]),
        "t_inertia2": amplitude["t_inertia_MPa"],
        "gamma_inertia2_deg": float(second["t_inertia_MPa"].phase[0]) % (2 * np.pi),
        "t_j2": t_j,
        "t_motored2": cold,
        "t_gas2_idle": idle,
        "n_zone1": bounds[0],
        "n_zone2": bounds[1],
        "zone": 1.0 + (engine.omega > bounds[0]) + (engine.omega > bounds[1]),
        "psi_best_nominal": best,
        "h_shafts": torque_harmonics.shaft_offset(psi, rod),
        "h_shafts_best": torque_harmonics.shaft_offset(best, rod),
    }  # fmt: skip
    if engine.is_in_line:
        scalars["P_shafts"] = 0.5 * lam * unit * geometry.piston_area * engine.cylinders
    return scalars


def _suppression(case: Case, scalars: Scalars) -> Columns:
    """What balance shafts leave of the second order over the speed, Chudakov (6)."""
    engine = case.engine
    ratio = np.linspace(0.3, 1.2, 10)
    omega: Array = ratio * engine.omega
    t_j = torque_harmonics.inertia_second(scalars["d_j"], omega)
    nominal, idle = np.array(scalars["t_gas2"]), np.array(scalars["t_gas2_idle"])
    psi = engine.balancing.suppression
    best = torque_harmonics.best_suppression(nominal, t_j)
    return {
        "speed_share": ratio,
        "n_rpm": omega,
        "t_j2_MPa": t_j,
        "residual_bare_MPa": torque_harmonics.residual(nominal, t_j, 0.0),
        "residual_psi_MPa": torque_harmonics.residual(nominal, t_j, psi),
        "residual_vector_MPa": torque_harmonics.residual_vector(
            nominal, scalars["gamma_gas2_deg"], t_j, psi
        ),
        "psi_best": best,
        "psi_best_idle": torque_harmonics.best_suppression(idle, t_j),
        "h_best_mm": best * engine.geometry.rod_length,
    }
