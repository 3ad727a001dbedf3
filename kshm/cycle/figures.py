"""Indicated and effective figures of the cycle."""

from __future__ import annotations

import math

from kshm.cycle.errors import CycleError
from kshm.cycle.fuel import Mixture
from kshm.cycle.heat import R_GAS
from kshm.cycle.inputs import CycleInputs, FrictionLaw
from kshm.cycle.processes import Charge, Combustion, Compression, Expansion
from kshm.cycle.result import Effective, Indicated


def theoretical_pressure(
    eps: float, compression: Compression, combustion: Combustion, expansion: Expansion, t_a: float
) -> float:
    """Mean indicated pressure of the unrounded diagram p_i' [Pa].

    p_i' = p_c/(ε − 1)·[λ_p (ρ − 1) + λ_p ρ/(n_2 − 1)·(1 − δ^(1 − n_2))
    − (1 − T_a/T_c)/(n_1 − 1)]; ρ = 1 for petrol.
    """
    x_1, x_2 = compression.n_1 - 1, expansion.n_2 - 1
    lam, rho, delta = combustion.lambda_p, combustion.rho, combustion.delta
    work = lam * (rho - 1) + lam * rho / x_2 * (1 - math.pow(delta, -x_2))
    work -= (1 - t_a / compression.t_c) / x_1
    return compression.p_c / (eps - 1) * work


def indicate(
    inputs: CycleInputs, mixture: Mixture, charge: Charge, p_theory: float, *, r_gas: float = R_GAS
) -> Indicated:
    """Indicated pressure, consumption and efficiency.

    g_i = η_v p_k/(R T_k M_1 p_i) [kg/J], M_1 = α L_0 (petrol + 1/m_f);
    η_i = 1/(g_i H_u).  The pumping term p_r − p_a is subtracted only on request.

    Raises:
        CycleError: the cycle does no work.
    """
    p_i = inputs.fullness * p_theory
    if inputs.subtract_pumping:
        p_i -= charge.p_r - charge.p_a
    if not p_i > 0:
        raise CycleError("no_work", "xi_z", p_i=p_i)
    density = charge.eta_v * charge.p_k / (1e3 * r_gas * charge.t_k)  # kmol/m³
    g_i = density / (mixture.fresh * p_i)
    return Indicated(p_theory, p_i, g_i, 1 / (g_i * inputs.fuel.heating_value))


def friction_pressure(mechanical: float | FrictionLaw, p_i: float, speed: float) -> float:
    """Mean pressure of mechanical losses p_m [Pa]: (1 − η_m) p_i or A + B c_m."""
    if isinstance(mechanical, FrictionLaw):
        return mechanical.a + mechanical.b * speed
    return (1 - mechanical) * p_i


def effective(
    inputs: CycleInputs,
    indicated: Indicated,
    *,
    air_ratio: float | None = None,
    power_factor: float | None = None,
) -> Effective:
    """Effective figures of the engine with the given bore and stroke.

    p_e = p_i − p_m, N = p V_h n i/(30 τ), M = N_e/ω, c_m = S n/30, G_f = g_e N_e,
    G_a = α l_0 G_f.

    Args:
        inputs: with bore and stroke.
        indicated: indicated figures.
        air_ratio: l_0 [kg/kg] instead of the fuel's own (listing mode).
        power_factor: number in place of 1/(30 τ) (listing mode).

    Raises:
        CycleError: bore or stroke is missing, or friction eats the indicated work.
    """
    bore, stroke = inputs.bore, inputs.stroke
    if bore is None or stroke is None:
        raise CycleError("sizes_missing", "bore" if bore is None else "stroke")
    area = math.pi * bore**2 / 4
    speed = stroke * inputs.omega / math.pi
    p_m = friction_pressure(inputs.mechanical, indicated.p_i, speed)
    p_e = indicated.p_i - p_m
    if not p_e > 0:
        raise CycleError("friction_eats_all", "mechanical", p_m=p_m, p_i=indicated.p_i)
    eta_m = p_e / indicated.p_i
    factor = 1 / (30 * inputs.strokes) if power_factor is None else power_factor
    swept = area * stroke * inputs.cylinders * inputs.speed_rpm * factor
    ratio = inputs.fuel.stoichiometric_air_mass if air_ratio is None else air_ratio
    fuel_flow = indicated.g_i / eta_m * p_e * swept
    return Effective(
        piston_area=area,
        displacement=area * stroke,
        mean_piston_speed=speed,
        p_m=p_m,
        p_e=p_e,
        eta_m=eta_m,
        eta_e=indicated.eta_i * eta_m,
        g_e=indicated.g_i / eta_m,
        power_i=indicated.p_i * swept,
        power_e=p_e * swept,
        torque=p_e * swept / inputs.omega,
        fuel_flow=fuel_flow,
        air_flow=inputs.excess_air * ratio * fuel_flow,
    )
