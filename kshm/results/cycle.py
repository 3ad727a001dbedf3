"""Results of a cycle calculation by the keys of the nomenclature, SI units."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from kshm.cycle.diagram import diagram_at, isobar_angle
from kshm.cycle.inputs import CycleInputs
from kshm.cycle.run import CycleRun
from kshm.cycle.speed_characteristic import curve

Array = NDArray[np.float64]


def summarise_cycle(run: CycleRun) -> dict[str, float]:
    """All scalars of the cycle."""
    cycle, balance = run.cycle, run.balance
    charge, comb = cycle.charge, cycle.combustion
    values = {
        "cyc_L0": cycle.inputs.fuel.stoichiometric_air,
        "cyc_M1": cycle.mixture.fresh,
        "cyc_M2": cycle.mixture.products,
        "cyc_mu0": cycle.mixture.mu_0,
        "cyc_dHu": cycle.mixture.heat_loss,
        "cyc_p_k": charge.p_k,
        "cyc_T_k": charge.t_k,
        "cyc_p_a": charge.p_a,
        "cyc_p_r": charge.p_r,
        "cyc_eta_v": charge.eta_v,
        "cyc_gamma": charge.gamma,
        "cyc_psi": charge.psi,
        "cyc_T_a": charge.t_a,
        "cyc_n1": cycle.compression.n_1,
        "cyc_p_c": cycle.compression.p_c,
        "cyc_T_c": cycle.compression.t_c,
        "cyc_mu": comb.mu,
        "cyc_q": comb.heat,
        "cyc_lambda_p": comb.lambda_p,
        "cyc_T_z": comb.t_z,
        "cyc_p_z": comb.p_z,
        "cyc_rho": comb.rho,
        "cyc_delta": comb.delta,
        "cyc_phi_z": isobar_angle(cycle),
        "cyc_n2": cycle.expansion.n_2,
        "cyc_p_b": cycle.expansion.p_b,
        "cyc_T_b": cycle.expansion.t_b,
        "cyc_T_r_check": cycle.t_residual_check,
        "cyc_p_theory": cycle.indicated.p_theory,
        "cyc_p_i": cycle.indicated.p_i,
        "cyc_g_i": cycle.indicated.g_i,
        "cyc_eta_i": cycle.indicated.eta_i,
        "bal_total": balance.total,
        "bal_useful": balance.useful,
        "bal_exhaust": balance.exhaust,
        "bal_incomplete": balance.incomplete,
        "bal_rest": balance.rest,
    }
    values |= {f"bal_{name}_share": share for name, share in balance.shares.items()}
    return values | _effective(run) | _sizes(run) | _turbo(run) | _speed(run)


def _effective(run: CycleRun) -> dict[str, float]:
    figures = run.cycle.effective
    return {
        "cyc_p_m": figures.p_m,
        "cyc_p_e": figures.p_e,
        "cyc_eta_m": figures.eta_m,
        "cyc_eta_e": figures.eta_e,
        "cyc_g_e": figures.g_e,
        "cyc_N_i": figures.power_i,
        "cyc_N_gas": run.gas_power,
        "cyc_N_e": figures.power_e,
        "cyc_M_e": figures.torque,
        "cyc_G_f": figures.fuel_flow,
        "cyc_G_a": figures.air_flow,
    }


def _sizes(run: CycleRun) -> dict[str, float]:
    found = run.design
    if found is None:
        return {}
    return {
        "cyc_D_0": found.bore_exact,
        "cyc_S_0": found.stroke_exact,
        "cyc_D": found.bore,
        "cyc_S": found.stroke,
        "cyc_N_error": found.power_error,
    }


def _turbo(run: CycleRun) -> dict[str, float]:
    turbo = run.cycle.turbo
    if turbo is None:
        return {}
    return {
        "cyc_T_comp": run.cycle.charge.t_compressor,
        "cyc_G_k": turbo.compressor_flow,
        "cyc_N_k": turbo.compressor_power,
        "cyc_G_t": turbo.turbine_flow,
        "cyc_k_gas": turbo.k_gas,
        "cyc_p_t": turbo.p_t,
        "cyc_T_t": turbo.t_t,
        "cyc_N_t": turbo.turbine_power,
        "cyc_p_bal": turbo.p_t_balance,
        "cyc_C2_bal": turbo.c2_balance,
        "bal_cooler": run.balance.cooler,
    }


def _speed(run: CycleRun) -> dict[str, float]:
    law = run.law
    _, torque, idle = run.points
    return {
        "spd_a": law.a,
        "spd_b": law.b,
        "spd_c": law.c,
        "spd_Kc": law.x_torque,
        "spd_K": law.adaptability,
        "reg_n_M": torque.omega,
        "reg_Me_M": torque.torque,
        "reg_Ne_M": torque.power,
        "reg_n_idle": idle.omega,
    }


# Speeds of the characteristic as percent of the rated one: first, last, step
SPEED_STEP = 5.0
_SPEED_LAST = {"diesel": 100.0, "petrol": 110.0}


def speed_rows(kind: str) -> Array:
    """Speeds [% of the rated speed]; petrol engines may run beyond their rated speed."""
    return np.arange(20.0, _SPEED_LAST[kind] + SPEED_STEP, SPEED_STEP)


DIAGRAM_STEP = 5.0  # deg


def diagram_rows() -> Array:
    """Crank angles of the diagram's table [deg]: compression and expansion."""
    return np.arange(180.0, 540.0 + DIAGRAM_STEP, DIAGRAM_STEP)


def cycle_columns(run: CycleRun) -> dict[str, dict[str, Array]]:
    """Tables of the cycle by id: the speed characteristic and the indicator diagram."""
    inputs: CycleInputs = run.cycle.inputs
    figures = run.cycle.effective
    shares = speed_rows(inputs.kind) / 100
    speeds = curve(figures.power_e, inputs.omega, figures.g_e, run.law, shares * inputs.omega)
    degrees = diagram_rows()
    diagram = diagram_at(run.cycle, np.radians(degrees))
    clearance = figures.displacement / (inputs.compression_ratio - 1)
    return {
        "speed": {
            "speed_percent": shares,
            "speed_n": speeds.omega,
            "speed_Ne": speeds.power,
            "speed_Me": speeds.torque,
            "speed_ge": speeds.consumption,
            "speed_Gf": speeds.fuel_flow,
        },
        "cycle_diagram": {
            "phi_deg": np.radians(degrees),
            "cd_s_mm": diagram.displacement,
            "cd_ratio": diagram.volume / clearance,
            "cd_V_dm3": diagram.volume,
            "cd_p_MPa": diagram.pressure,
            "cd_T_K": diagram.temperature,
        },
    }
