"""The processes of the cycle one by one: charging, compression, combustion, expansion.

Pressures in Pa, temperatures in K; heat per kmol of charge in kJ/kmol as the
empirical heat capacities need it.  Formulas: Grinevetsky-Mazing as the program
listing of Gots, appendix 2, proves them.

Passes for spreadsheets.  n_1 and n_2 are fixed points x = g(x) of x = n − 1.  Plain
substitution contracts by 0.08…0.16 (n_1) and 0.1…0.4, in the extreme 0.56 (n_2), and
would need 16 and up to 50 passes to 1e-12.  Newton's rule with the slope in closed form
needs 3 and 4 (measured over 10 000 random engines); `compression_pass` and
`expansion_pass` are one such pass each, reading only the pass before.  The constants
N1_PASSES and N2_PASSES leave two to spare.  T_z is a quadratic, `temperature_of`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from kshm.cycle.fuel import AIR, R_GAS, ZERO_C, HeatCapacity, Mixture, temperature_of
from kshm.cycle.inputs import CycleInputs
from kshm.errors import CycleError

N1_START = 1.37
N1_PASSES = 5
N2_START = 1.25
N2_PASSES = 6
N2_RANGE = (1.03, 1.60)  # nothing expands outside of this
CONVERGED = 1e-12  # relative step of n − 1 in the last pass


@dataclass(frozen=True, slots=True)
class Charge:
    """State of the cylinder charge at the start of compression.

    ``t_compressor`` is the temperature behind the compressor before the cooler.
    """

    p_k: float
    t_k: float
    t_compressor: float
    p_a: float
    p_r: float
    eta_v: float
    gamma: float
    psi: float
    t_a: float


@dataclass(frozen=True, slots=True)
class Compression:
    """End of compression; ``n_1`` from its own equation."""

    n_1: float
    p_c: float
    t_c: float


@dataclass(frozen=True, slots=True)
class Combustion:
    """End of visible combustion, point z.

    ``heat`` q = (H_u − ΔH_u)/(M_1 (1 + γ)) [kJ/kmol of charge]; ``products`` is the
    heat capacity of the products; ``lambda_p`` = p_z/p_c.  A petrol engine has ρ = 1.
    """

    mu: float
    heat: float
    products: HeatCapacity
    lambda_p: float
    p_z: float
    t_z: float
    rho: float
    delta: float


@dataclass(frozen=True, slots=True)
class Expansion:
    """End of expansion, point b; ``n_2`` from its own equation."""

    n_2: float
    p_b: float
    t_b: float


def molar_cp_ratio(alpha: float, t_residual: float, t_charge: float) -> float:
    """Ratio ψ of the molar heat capacities c_p of residual gas at T_r and fresh charge.

    Mazing's linear formulas in K, with α not below 1.  The form of ψ is inferred
    from the printed T_a; the listing needs 1.0784 where this gives 1.0767.
    """
    a = max(alpha, 1.0)
    residual = 20.2 + 0.92 / a + (15.5 + 13.8 / a) * 1e-4 * t_residual + R_GAS
    return residual / (20.16 + 1.738e-3 * t_charge + R_GAS)


def fill(inputs: CycleInputs, psi: float | None = None) -> Charge:
    """Charging: η_v, γ, T_a.

    p_k = p_0 π_k − Δp, T_k = T_0 (1 + (π_k^0.2857 − 1)/η_k) − ΔT_cooler,
    η_v = φ_rech (ε p_a − p_r)/((ε − 1) p_k)·T_k/(T_k + ΔT),
    γ = φ_scav p_r T_k/((ε − 1) p_k T_r η_v),
    T_a = (T_k + ΔT + ψ γ T_r)/(1 + ψ γ).

    Raises:
        CycleError: no charge gets in (p_r too high), or the cooler cools too far.
    """
    boost, eps = inputs.boost, inputs.compression_ratio
    p_k = inputs.p_ambient
    t_k = t_compressor = inputs.t_ambient
    if boost is not None:
        rise = (boost.pressure_ratio ** (0.4 / 1.4) - 1) / boost.compressor_efficiency
        t_compressor = inputs.t_ambient * (1 + rise)
        t_k = t_compressor - boost.cooler_temperature_drop
        p_k = inputs.p_ambient * boost.pressure_ratio - boost.cooler_pressure_loss
        if t_k < 220:
            raise CycleError("cooled_too_far", "boost.cooler_temperature_drop", t_k=t_k)
        if p_k < 0.5 * inputs.p_ambient:
            raise CycleError("cooler_loss_too_large", "boost.cooler_pressure_loss", p_k=p_k)
    heated = t_k + inputs.charge_heating
    p_a, p_r = inputs.intake_factor * p_k, inputs.exhaust_factor * p_k
    eta_v = inputs.recharge * (eps * p_a - p_r) / ((eps - 1) * p_k) * t_k / heated
    if not eta_v > 0.2:
        raise CycleError("hardly_filled", "exhaust_factor", eta_v=eta_v)
    gamma = inputs.scavenging * p_r * t_k / ((eps - 1) * p_k * inputs.t_residual * eta_v)
    if psi is None:
        psi = molar_cp_ratio(inputs.excess_air, inputs.t_residual, heated)
    t_a = (heated + psi * gamma * inputs.t_residual) / (1 + psi * gamma)
    return Charge(p_k, t_k, t_compressor, p_a, p_r, eta_v, gamma, psi, t_a)


def compression_pass(x: float, t_a: float, eps: float) -> float:
    """One pass for x = n_1 − 1, the root of x = g(x).

    g(x) = R/(20.6 + 0.002638 (t_a + t_c)), T_c = T_a ε^x, by Newton's rule
    x ← x + (g − x)/(1 + g² 0.002638 T_c ln ε/R).

    The denominator of g is the mean heat capacity of air between T_a and T_c, so the
    converged polytrope is the adiabat of air: no heat, R (T_c − T_a)/x = ΔU.
    """
    a, b, _ = AIR.lower
    t_c = t_a * math.pow(eps, x)
    g = R_GAS / (a + b * (t_a + t_c - 2 * ZERO_C))
    return x + (g - x) / (1 + g * g * b * t_c * math.log(eps) / R_GAS)


def compress(charge: Charge, eps: float) -> Compression:
    """Compression with converged n_1.

    5 passes of `compression_pass` from n_1 = 1.37: p_c = p_a ε^n_1,
    T_c = T_a ε^(n_1 − 1).

    Raises:
        CycleError: the passes do not settle to 1e-12.
    """
    x = previous = N1_START - 1
    for _ in range(N1_PASSES):
        previous, x = x, compression_pass(x, charge.t_a, eps)
    if not abs(x - previous) <= CONVERGED * x:
        raise CycleError("n1_not_found", "compression_ratio")
    return Compression(1 + x, charge.p_a * eps ** (1 + x), charge.t_a * eps**x)


def charge_energy(compression: Compression, gamma: float, products: HeatCapacity) -> float:
    """Return internal energy of the charge at T_c: air and γ kmol of residual gas [kJ/kmol]."""
    t_c = compression.t_c - ZERO_C
    return (AIR.energy(t_c) + gamma * products.energy(t_c)) / (1 + gamma)


def combustion_limit(
    inputs: CycleInputs, mu: float, heat: float, start: float, products: HeatCapacity
) -> float:
    """T_z [K] of combustion at constant volume: μ U(T_z) = ξ_z q + U_c.

    For a petrol engine this is point z.  For a diesel it gives the highest p_z,
    at which ρ = 1.
    """
    return temperature_of(products, inputs.xi_z * heat + start, mu, 0.0) + ZERO_C


def ignite(
    inputs: CycleInputs,
    mixture: Mixture,
    charge: Charge,
    compression: Compression,
    products: HeatCapacity,
) -> Combustion:
    """Visible combustion up to point z, closed form.

    Diesel, λ_p = p_z/p_c given (all terms in K and °C as they are due):
    ξ_z q + (c_vc + R λ_p) t_c + 273 R (λ_p − μ) = μ (c_vz + R) t_z, ρ = μ T_z/(λ_p T_c).
    Petrol: ξ_z q + c_vc t_c = μ c_vz t_z, λ_p = μ T_z/T_c, ρ = 1.

    Raises:
        CycleError: p_z not above p_c, so high that ρ < 1, or so low that the charge
            would still burn near the end of the stroke.
    """
    mu = (mixture.mu_0 + charge.gamma) / (1 + charge.gamma)
    heat = (inputs.fuel.heating_value - mixture.heat_loss) / 1e3
    heat /= mixture.fresh * (1 + charge.gamma)
    start = charge_energy(compression, charge.gamma, products)
    t_v = combustion_limit(inputs, mu, heat, start, products)
    limit = mu * t_v / compression.t_c
    eps, p_c = inputs.compression_ratio, compression.p_c
    if inputs.p_max is None:
        return Combustion(mu, heat, products, limit, limit * p_c, t_v, 1.0, eps)
    ratio = inputs.p_max / p_c
    if ratio <= 1:
        raise CycleError("p_max_below_compression", "p_max", p_max=inputs.p_max, p_c=p_c)
    if ratio > limit:
        raise CycleError("p_max_too_high", "p_max", p_max=inputs.p_max, largest=limit * p_c)
    t_c = compression.t_c - ZERO_C
    content = inputs.xi_z * heat + start + R_GAS * (ratio * t_c + ZERO_C * (ratio - mu))
    t_z = temperature_of(products, content, mu, R_GAS) + ZERO_C
    rho = mu * t_z / (ratio * compression.t_c)
    if rho > eps / 3:
        raise CycleError("burning_too_long", "p_max", rho=rho)
    return Combustion(mu, heat, products, ratio, inputs.p_max, t_z, rho, eps / rho)


def expansion_pass(
    x: float, t_z: float, ratio: float, released: float, products: HeatCapacity
) -> float:
    """One pass for x = n_2 − 1, the root of x h(x) = R.

    h = (Q + U_z − U_b)/(T_z − T_b), T_b = T_z/δ^x, where Q = (ξ_b − ξ_z) q/μ is the
    heat that still comes in during expansion; Newton's rule
    x ← x − (x h − R)/(h − x (h − c_b) T_b ln δ/(T_z − T_b)) with the true heat
    capacity c_b = dU/dt at T_b.

    Args:
        x: value of the pass before.
        t_z: T_z [K].
        ratio: expansion ratio δ.
        released: Q [kJ/kmol of products].
        products: heat capacity of the products.
    """
    t_b = t_z / math.pow(ratio, x)
    fall = products.energy(t_z - ZERO_C) - products.energy(t_b - ZERO_C)
    h = (released + fall) / (t_z - t_b)
    slope = x * (h - products.true(t_b - ZERO_C)) * t_b * math.log(ratio) / (t_z - t_b)
    return x - (x * h - R_GAS) / (h - slope)


def expand(combustion: Combustion, xi_z: float, xi_b: float) -> Expansion:
    """Expansion with converged n_2: 6 passes of `expansion_pass` from n_2 = 1.25.

    Raises:
        CycleError: the passes do not settle to 1e-12, or n_2 is no exponent of expansion.
    """
    released = (xi_b - xi_z) * combustion.heat / combustion.mu
    x = previous = N2_START - 1
    for _ in range(N2_PASSES):
        step = expansion_pass(x, combustion.t_z, combustion.delta, released, combustion.products)
        previous, x = x, step
        if not 0 < x < 1:
            break
    low, high = N2_RANGE
    if not (low < 1 + x < high and abs(x - previous) <= CONVERGED * x):
        key = "n2_not_found_heat_lost" if xi_b < xi_z else "n2_not_found_heat_added"
        raise CycleError(key, "xi_b", low=low, high=high)
    p_b = combustion.p_z / combustion.delta ** (1 + x)
    return Expansion(1 + x, p_b, combustion.t_z / combustion.delta**x)


def residual_temperature(expansion: Expansion, p_r: float) -> float:
    """Check of the residual gas temperature T_r = T_b/(p_b/p_r)^(1/3) [K]."""
    return math.cbrt(p_r / expansion.p_b) * expansion.t_b
