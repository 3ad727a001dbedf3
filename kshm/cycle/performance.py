"""Results of the cycle: indicated and effective figures, turbocharger, heat balance; SI units."""

from __future__ import annotations

import math
from dataclasses import dataclass

from kshm.cycle.fuel import AIR, R_GAS, ZERO_C, Mixture
from kshm.cycle.inputs import Boost, CycleInputs, FrictionLaw
from kshm.cycle.processes import Charge, Combustion, Compression, Expansion
from kshm.errors import CycleError, Remark

AIR_CP = 1005.0  # J/(kg·K)


@dataclass(frozen=True, slots=True)
class Indicated:
    """Indicated figures that do not depend on bore and stroke.

    ``p_theory`` is p_i' of the unrounded diagram [Pa], ``p_i`` = φ p_i';
    ``g_i`` [kg/J] (1 g/(kW·h) = 1/3.6e9 kg/J).
    """

    p_theory: float
    p_i: float
    g_i: float
    eta_i: float


@dataclass(frozen=True, slots=True)
class Effective:
    """Effective figures; powers [W], torque [N·m], flows [kg/s], volumes [m³]."""

    piston_area: float
    displacement: float  # V_h of one cylinder
    mean_piston_speed: float
    p_m: float
    p_e: float
    eta_m: float
    eta_e: float
    g_e: float
    power_i: float
    power_e: float
    torque: float
    fuel_flow: float
    air_flow: float


@dataclass(frozen=True, slots=True)
class Turbo:
    """Compressor and turbine; powers [W], flows [kg/s].

    ``p_t_balance`` is the pressure before the turbine [Pa] at which its power would
    just drive the compressor, ``c2_balance`` = p_t_balance/p_k the C2 to try;
    ``k_gas`` the exponent of the exhaust gas.
    """

    compressor_flow: float
    compressor_power: float
    turbine_flow: float
    p_t: float
    t_t: float
    k_gas: float
    turbine_power: float
    p_t_balance: float
    c2_balance: float


@dataclass(frozen=True, slots=True)
class Cycle:
    """A calculated cycle: inputs, stages in their order, and what needs a look.

    ``warnings`` are remarks; the numbers stand all the same.
    ``listing`` tells whether the peculiarities of the program were switched on.
    """

    inputs: CycleInputs
    mixture: Mixture
    charge: Charge
    compression: Compression
    combustion: Combustion
    expansion: Expansion
    indicated: Indicated
    effective: Effective
    turbo: Turbo | None
    t_residual_check: float
    warnings: tuple[Remark, ...] = ()
    listing: bool = False


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
    """Return indicated pressure, consumption and efficiency.

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


@dataclass(frozen=True, slots=True)
class HeatBalance:
    """Heat flows [W]; the parts add up to ``total``.

    The boundary is the cylinder: the charge enters at T_k, the gas leaves at T_r.
    ``rest`` (coolant, oil, friction, errors of the method) is the remainder.
    ``cooler`` is what the intercooler takes off outside this boundary.
    """

    total: float
    useful: float
    exhaust: float
    incomplete: float
    rest: float
    cooler: float

    @property
    def shares(self) -> dict[str, float]:
        """Shares of the total [-]; they add up to 1."""
        parts = {
            "useful": self.useful,
            "exhaust": self.exhaust,
            "incomplete": self.incomplete,
            "rest": self.rest,
        }
        return {name: value / self.total for name, value in parts.items()}


def heat_balance(cycle: Cycle) -> HeatBalance:
    """Heat balance Q_0 = N_e + Q_gas + Q_incomplete + Q_rest [W].

    Q_0 = H_u G_f; Q_gas = G_f (M_2 (c_v'' + R) t_r − M_1 (c_v + R) t_k) with mean heat
    capacities from 0 °C; Q_incomplete = ΔH_u G_f.
    """
    inputs, mixture, flow = cycle.inputs, cycle.mixture, cycle.effective.fuel_flow
    t_r, t_k = inputs.t_residual - ZERO_C, cycle.charge.t_k - ZERO_C
    out = mixture.products * (cycle.combustion.products.energy(t_r) + R_GAS * t_r)
    come = mixture.fresh * (AIR.energy(t_k) + R_GAS * t_k)
    total = inputs.fuel.heating_value * flow
    exhaust = 1e3 * (out - come) * flow
    incomplete = mixture.heat_loss * flow
    drop = inputs.boost.cooler_temperature_drop if inputs.boost is not None else 0.0
    useful = cycle.effective.power_e
    return HeatBalance(
        total=total,
        useful=useful,
        exhaust=exhaust,
        incomplete=incomplete,
        rest=total - useful - exhaust - incomplete,
        cooler=cycle.effective.air_flow * AIR_CP * drop,
    )
