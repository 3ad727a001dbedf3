"""Power balance of the turbocharger."""

from __future__ import annotations

from kshm.cycle.heat import R_GAS, ZERO_C
from kshm.cycle.inputs import Boost, CycleInputs
from kshm.cycle.processes import Charge, Combustion, Expansion
from kshm.cycle.result import Effective, Turbo

AIR_CP = 1005.0  # J/(kg·K)


def exhaust_exponent(combustion: Combustion, expansion: Expansion) -> float:
    """Adiabatic exponent of the products k = 1 + R (T_z − T_b)/(U_z − U_b) [-].

    Taken over the expansion T_z…T_b; consistent with the printed T_t of the listing
    to 0.15 %, not proved by it.
    """
    heat = combustion.products
    fall = heat.energy(combustion.t_z - ZERO_C) - heat.energy(expansion.t_b - ZERO_C)
    return 1 + R_GAS * (combustion.t_z - expansion.t_b) / fall


def turbo_balance(
    inputs: CycleInputs,
    boost: Boost,
    charge: Charge,
    combustion: Combustion,
    expansion: Expansion,
    figures: Effective,
    *,
    compressor_power: float | None = None,
) -> Turbo:
    """Compressor and turbine power and the pressure at which they balance.

    N_k = G_k c_p (T_k' − T_0) with T_k' before the cooler (the rise already contains
    η_k); G_t = G_k + G_f; T_t = T_b (p_t/p_b)^e with e = (k − 1)/k, p_t = p_r;
    N_t = G_t c_pg T_t (1 − (p_out/p_t)^e) η_t, and 0 when p_t is below p_out.
    The balance N_t = N_k is closed form in p_t:
    p_t^e = p_out^e + N_k p_b^e/(G_t c_pg η_t T_b).

    Args:
        inputs: the engine.
        boost: its turbocharger.
        charge: state after charging.
        combustion: point z.
        expansion: point b.
        figures: effective figures (flows).
        compressor_power: N_k [W] in place of the formula (listing mode).
    """
    power = compressor_power
    if power is None:
        power = figures.air_flow * AIR_CP * (charge.t_compressor - inputs.t_ambient)
    flow = figures.air_flow + figures.fuel_flow
    k = exhaust_exponent(combustion, expansion)
    e = (k - 1) / k
    p_t, p_out = charge.p_r, boost.outlet_pressure_ratio * inputs.p_ambient
    t_t = expansion.t_b * (p_t / expansion.p_b) ** e
    stream = flow * boost.exhaust_cp * boost.turbine_efficiency
    turbine = stream * t_t * max(0.0, 1 - (p_out / p_t) ** e)
    p_balance = (p_out**e + power * expansion.p_b**e / (stream * expansion.t_b)) ** (1 / e)
    return Turbo(
        compressor_flow=figures.air_flow,
        compressor_power=power,
        turbine_flow=flow,
        p_t=p_t,
        t_t=t_t,
        k_gas=k,
        turbine_power=turbine,
        p_t_balance=p_balance,
        c2_balance=p_balance / charge.p_k,
    )
