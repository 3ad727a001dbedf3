"""Listing mode: the program DIZDN with its peculiarities, for validation only.

What the printed digits of Gots, appendix 2, show about the program: n_1 stops after
two passes from 1.35, T_c takes the first and p_c the second of them; the end of the
isobar moves to the whole degree below, and T_b, p_b count from there, while p_i counts
from ρ; N uses 0.00833 for 1/120, air 14.46 kg/kg, g_i 8.314; the compressor power
divides by η_k again and takes T_k behind the cooler; angles use 0.017453 for π/180.

Two numbers are fitted, not explained: ψ = 1.0784 and n_2 = 1.227745 (they put all 55
temperatures of the printed diagram on the printed digit).  Without them
ψ comes from the formula and n_2 from ξ_b = 0.94 with the fuel term not divided by μ;
the printed ξ_b = 0.85 gives 1.27 and cannot be what the program used.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from kshm.cycle.fuel import AIR, R_GAS, ZERO_C, burn, mixture_heat
from kshm.cycle.inputs import CycleInputs, check_inputs
from kshm.cycle.performance import (
    AIR_CP,
    Cycle,
    effective,
    indicate,
    theoretical_pressure,
    turbo_balance,
)
from kshm.cycle.processes import (
    N2_PASSES,
    Charge,
    Combustion,
    Compression,
    Expansion,
    expansion_pass,
    fill,
    ignite,
    residual_temperature,
)
from kshm.errors import CycleError

DEGREE = 0.017453  # the program's π/180
POWER_FACTOR = 0.00833
AIR_MASS = 14.46
R_CONSUMPTION = 8.314


@dataclass(frozen=True, slots=True)
class Listing:
    """Numbers fitted to the listing; None takes the formula instead.

    ``xi_b`` replaces the input when ``n_2`` is None.
    """

    psi: float | None = 1.0784
    n_2: float | None = 1.227745
    xi_b: float = 0.94


def plain_exponent(n_1: float, t_a: float, eps: float) -> float:
    """One plain substitution for n_1, as the program does it."""
    a, b, _ = AIR.lower
    return 1 + R_GAS / (a + b * (t_a * (1 + math.pow(eps, n_1 - 1)) - 2 * ZERO_C))


def listing_compression(charge: Charge, eps: float) -> Compression:
    """Two passes from 1.35: T_c by the first exponent, p_c and n_1 by the second."""
    first = plain_exponent(1.35, charge.t_a, eps)
    second = plain_exponent(first, charge.t_a, eps)
    return Compression(second, charge.p_a * eps**second, charge.t_a * eps ** (first - 1))


def displacement_ratio(degrees: float, lam: float) -> float:
    """Piston displacement over crank radius s/r [-] at an angle in degrees, exact."""
    phi = degrees * DEGREE
    return 1 + 1 / lam - math.cos(phi) - math.sqrt(1 / lam**2 - math.sin(phi) ** 2)


def volume_ratio(degrees: float, lam: float, eps: float) -> float:
    """Cylinder volume over clearance volume V/V_c [-] at an angle in degrees."""
    return 1 + (eps - 1) / 2 * displacement_ratio(degrees, lam)


def isobar_end(rho: float, lam: float, eps: float) -> int:
    """Whole degree of the isobar's end, counted from intake TDC, not after V = ρ V_c [°]."""
    s = 2 * (rho - 1) / (eps - 1)  # s/r
    pin = 1 + 1 / lam - s
    cosine = (1 + pin**2 - 1 / lam**2) / (2 * pin)
    return 360 + math.floor(math.acos(cosine) / DEGREE)


def listing_expansion(
    inputs: CycleInputs, combustion: Combustion, listing: Listing
) -> tuple[Expansion, int]:
    """Expansion from the whole degree; returns it and that degree."""
    degree = isobar_end(combustion.rho, inputs.lam, inputs.compression_ratio)
    ends = [volume_ratio(phi, inputs.lam, inputs.compression_ratio) for phi in (540, degree)]
    ratio = ends[0] / ends[1]
    n_2 = listing.n_2
    if n_2 is None:
        released = (listing.xi_b - inputs.xi_z) * combustion.heat
        x = 0.25
        for _ in range(N2_PASSES):
            x = expansion_pass(x, combustion.t_z, ratio, released, combustion.products)
        n_2 = 1 + x
    p_b = combustion.p_z / ratio**n_2
    return Expansion(n_2, p_b, combustion.t_z / ratio ** (n_2 - 1)), degree


def listing_cycle(inputs: CycleInputs, listing: Listing) -> Cycle:
    """Return the cycle as the program calculates it, Gots appendix 2.

    Raises:
        CycleError: not a turbocharged diesel, or the inputs give no cycle.
    """
    check_inputs(inputs)
    boost = inputs.boost
    if inputs.kind != "diesel" or boost is None:
        raise CycleError("listing_is_for_turbo_diesels", "kind")
    mixture = burn(inputs.fuel, inputs.excess_air, external=False)
    eps = inputs.compression_ratio
    charge = fill(inputs, listing.psi)
    compression = listing_compression(charge, eps)
    combustion = ignite(inputs, mixture, charge, compression, mixture_heat(mixture.shares))
    expansion, _ = listing_expansion(inputs, combustion, listing)
    p_theory = theoretical_pressure(eps, compression, combustion, expansion, charge.t_a)
    indicated = indicate(inputs, mixture, charge, p_theory, r_gas=R_CONSUMPTION)
    figures = effective(inputs, indicated, air_ratio=AIR_MASS, power_factor=POWER_FACTOR)
    rise = charge.t_k - inputs.t_ambient
    power = figures.air_flow * AIR_CP * rise / boost.compressor_efficiency
    turbo = turbo_balance(
        inputs, boost, charge, combustion, expansion, figures, compressor_power=power
    )
    return Cycle(
        inputs=inputs,
        mixture=mixture,
        charge=charge,
        compression=compression,
        combustion=combustion,
        expansion=expansion,
        indicated=indicated,
        effective=figures,
        turbo=turbo,
        t_residual_check=residual_temperature(expansion, charge.p_r),
        listing=True,
    )
