"""Results of a cycle calculation by the keys of the nomenclature, SI units."""

from __future__ import annotations

from operator import attrgetter

import numpy as np

from kshm.arrays import Array, Scalars, Tables
from kshm.cycle.cycle import CycleRun
from kshm.cycle.diagram import diagram_at, isobar_angle
from kshm.cycle.governor import branch
from kshm.cycle.speed_characteristic import curve
from kshm.results.case import grid

# Key → where in the run its number stands.
_ALWAYS = {
    "cyc_L0": "cycle.inputs.fuel.stoichiometric_air",
    "cyc_M1": "cycle.mixture.fresh",
    "cyc_M2": "cycle.mixture.products",
    "cyc_mu0": "cycle.mixture.mu_0",
    "cyc_dHu": "cycle.mixture.heat_loss",
    "cyc_p_k": "cycle.charge.p_k",
    "cyc_T_k": "cycle.charge.t_k",
    "cyc_p_a": "cycle.charge.p_a",
    "cyc_p_r": "cycle.charge.p_r",
    "cyc_eta_v": "cycle.charge.eta_v",
    "cyc_gamma": "cycle.charge.gamma",
    "cyc_psi": "cycle.charge.psi",
    "cyc_T_a": "cycle.charge.t_a",
    "cyc_n1": "cycle.compression.n_1",
    "cyc_p_c": "cycle.compression.p_c",
    "cyc_T_c": "cycle.compression.t_c",
    "cyc_mu": "cycle.combustion.mu",
    "cyc_q": "cycle.combustion.heat",
    "cyc_lambda_p": "cycle.combustion.lambda_p",
    "cyc_T_z": "cycle.combustion.t_z",
    "cyc_p_z": "cycle.combustion.p_z",
    "cyc_rho": "cycle.combustion.rho",
    "cyc_delta": "cycle.combustion.delta",
    "cyc_n2": "cycle.expansion.n_2",
    "cyc_p_b": "cycle.expansion.p_b",
    "cyc_T_b": "cycle.expansion.t_b",
    "cyc_T_r_check": "cycle.t_residual_check",
    "cyc_p_theory": "cycle.indicated.p_theory",
    "cyc_p_i": "cycle.indicated.p_i",
    "cyc_g_i": "cycle.indicated.g_i",
    "cyc_eta_i": "cycle.indicated.eta_i",
    "bal_total": "balance.total",
    "bal_useful": "balance.useful",
    "bal_exhaust": "balance.exhaust",
    "bal_incomplete": "balance.incomplete",
    "bal_rest": "balance.rest",
    "cyc_p_m": "cycle.effective.p_m",
    "cyc_p_e": "cycle.effective.p_e",
    "cyc_eta_m": "cycle.effective.eta_m",
    "cyc_eta_e": "cycle.effective.eta_e",
    "cyc_g_e": "cycle.effective.g_e",
    "cyc_N_i": "cycle.effective.power_i",
    "cyc_N_gas": "gas_power",
    "cyc_N_e": "cycle.effective.power_e",
    "cyc_M_e": "cycle.effective.torque",
    "cyc_G_f": "cycle.effective.fuel_flow",
    "cyc_G_a": "cycle.effective.air_flow",
    "spd_a": "law.a",
    "spd_b": "law.b",
    "spd_c": "law.c",
    "spd_Kc": "law.x_torque",
    "spd_K": "law.adaptability",
}
_DESIGN = {
    "cyc_D_0": "design.bore_exact",
    "cyc_S_0": "design.stroke_exact",
    "cyc_D": "design.bore",
    "cyc_S": "design.stroke",
    "cyc_N_error": "design.power_error",
}
_TURBO = {
    "cyc_T_comp": "cycle.charge.t_compressor",
    "cyc_G_k": "cycle.turbo.compressor_flow",
    "cyc_N_k": "cycle.turbo.compressor_power",
    "cyc_G_t": "cycle.turbo.turbine_flow",
    "cyc_k_gas": "cycle.turbo.k_gas",
    "cyc_p_t": "cycle.turbo.p_t",
    "cyc_T_t": "cycle.turbo.t_t",
    "cyc_N_t": "cycle.turbo.turbine_power",
    "cyc_p_bal": "cycle.turbo.p_t_balance",
    "cyc_C2_bal": "cycle.turbo.c2_balance",
    "bal_cooler": "balance.cooler",
}
# Speeds of the characteristic as percent of the rated one: step, last; crank angles [deg].
SPEED_STEP = 5.0
_SPEED_LAST = {"diesel": 100.0, "petrol": 110.0}
DIAGRAM_STEP = 5.0


def cycle_scalars(run: CycleRun) -> Scalars:
    """All scalars of the cycle."""
    paths = dict(_ALWAYS)
    if run.design is not None:
        paths |= _DESIGN
    if run.cycle.turbo is not None:
        paths |= _TURBO
    _, torque, idle = run.points
    governed = Scalars()
    if run.governor is not None:
        governed = {
            "gov_delta": run.governor.irregularity, "gov_idle": run.governor.idle_fuel,
            "gov_n_max": run.governor.idling(run.cycle.inputs.omega),
            "gov_G_idle": run.governor.idle_fuel * run.cycle.effective.fuel_flow,
        }  # fmt: skip
    return governed | {
        **{key: attrgetter(path)(run) for key, path in paths.items()},
        **{f"bal_{name}_share": share for name, share in run.balance.shares.items()},
        "cyc_phi_z": isobar_angle(run.cycle),
        "reg_n_M": torque.omega,
        "reg_Me_M": torque.torque,
        "reg_Ne_M": torque.power,
        "reg_n_idle": idle.omega,
    }


def speed_rows(kind: str) -> Array:
    """Speeds [% of the rated speed]; petrol engines may run beyond their rated speed."""
    return np.arange(20.0, _SPEED_LAST[kind] + SPEED_STEP, SPEED_STEP)


def diagram_rows() -> Array:
    """Crank angles of the diagram's table [deg]: compression and expansion."""
    return np.arange(180.0, 540.0 + DIAGRAM_STEP, DIAGRAM_STEP)


def _governed(run: CycleRun) -> Tables:
    """Return the governor's branch of a diesel, eleven rows from the rated speed to idling."""
    if run.governor is None:
        return {}
    shares, figures = np.linspace(0.0, 1.0, 11), run.cycle.effective
    curves = branch(figures.power_e, run.cycle.inputs.omega, figures.fuel_flow, run.governor,
                    shares)  # fmt: skip
    return {
        "governor": {
            "gov_share": shares, "gov_n": curves.omega, "gov_Me": curves.torque,
            "gov_Ne": curves.power, "gov_Gf": curves.fuel_flow, "gov_ge": curves.consumption,
        }
    }  # fmt: skip


def cycle_tables(run: CycleRun) -> Tables:
    """Tables of the cycle by id: the speed characteristic and the indicator diagram."""
    inputs, figures = run.cycle.inputs, run.cycle.effective
    shares = speed_rows(inputs.kind) / 100
    speeds = curve(figures.power_e, inputs.omega, figures.g_e, run.law, shares * inputs.omega)
    phi = grid(180, 540, DIAGRAM_STEP)
    diagram = diagram_at(run.cycle, phi)
    clearance = figures.displacement / (inputs.compression_ratio - 1)
    return _governed(run) | {
        "speed": {
            "speed_percent": shares,
            "speed_n": speeds.omega,
            "speed_Ne": speeds.power,
            "speed_Me": speeds.torque,
            "speed_ge": speeds.consumption,
            "speed_Gf": speeds.fuel_flow,
        },
        "cycle_diagram": {
            "phi_deg": phi,
            "cd_s_mm": diagram.displacement,
            "cd_ratio": diagram.volume / clearance,
            "cd_V_dm3": diagram.volume,
            "cd_p_MPa": diagram.pressure,
            "cd_T_K": diagram.temperature,
        },
    }
