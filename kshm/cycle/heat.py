"""Mean molar heat capacities from 0 °C and the temperature that they give.

The empirical formulas are kept in their own units: t in °C, kJ/(kmol·K).  They
reproduce n_1 and T_z of the program listing, Gots appendix 2, to the printed digit.

The two ranges of the formulas do not meet: at 1500 °C the internal energy jumps by
up to 1 % (H2O).  A jump can leave an equation without a solution, so between 1400 and
1500 °C the lower formula passes linearly into the upper one.  Outside these 100 K,
and in everything the listing needs, the formulas are the printed ones.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

R_GAS = 8.315  # kJ/(kmol·K), the constant of the method
ZERO_C = 273.0  # K, the method's 0 °C: 8.315·273 = 2270
UPPER_START = 1500.0  # °C
BLEND = 100.0  # K
TEMPERATURE_PASSES = 6


@dataclass(frozen=True, slots=True)
class HeatCapacity:
    """Mean molar heat capacity at constant volume from 0 °C [kJ/(kmol·K)].

    ``lower`` = (a, b, c): a + b t + c t² up to 1500 °C; ``upper`` = (a, b) above.
    """

    lower: tuple[float, float, float]
    upper: tuple[float, float]

    def mean(self, t: float) -> float:
        """Mean heat capacity between 0 °C and ``t`` [°C]."""
        a, b, c = self.lower
        low = a + b * t + c * t * t
        weight = min(1.0, max(0.0, (t - UPPER_START + BLEND) / BLEND))
        if weight == 0:
            return low
        return (1 - weight) * low + weight * (self.upper[0] + self.upper[1] * t)

    def energy(self, t: float) -> float:
        """Internal energy above 0 °C U = c_v t [kJ/kmol]."""
        return self.mean(t) * t

    def true(self, t: float) -> float:
        """True heat capacity dU/dt at ``t`` [kJ/(kmol·K)]."""
        a, b, c = self.lower
        a_up, b_up = self.upper
        weight = min(1.0, max(0.0, (t - UPPER_START + BLEND) / BLEND))
        slope = (1 - weight) * (a + 2 * b * t + 3 * c * t * t) + weight * (a_up + 2 * b_up * t)
        if 0 < weight < 1:
            slope += t * (a_up + b_up * t - a - b * t - c * t * t) / BLEND
        return slope


SPECIES: dict[str, HeatCapacity] = {
    "air": HeatCapacity((20.600, 0.002638, 0.0), (22.387, 0.001449)),
    "O2": HeatCapacity((20.930, 0.004641, -0.84e-6), (23.723, 0.001550)),
    "N2": HeatCapacity((20.398, 0.002500, 0.0), (21.951, 0.001457)),
    "H2": HeatCapacity((20.684, 0.000206, 0.588e-6), (19.678, 0.001758)),
    "CO": HeatCapacity((20.597, 0.002670, 0.0), (22.490, 0.001430)),
    "CO2": HeatCapacity((27.941, 0.019, -5.487e-6), (39.123, 0.003349)),
    "H2O": HeatCapacity((24.953, 0.005359, 0.0), (26.670, 0.004438)),
}
AIR = SPECIES["air"]


def mixture_heat(shares: Mapping[str, float]) -> HeatCapacity:
    """Heat capacity of a mixture by the molar shares of its species."""
    parts = [(SPECIES[name], share) for name, share in shares.items()]
    lower = [sum(part.lower[k] * share for part, share in parts) for k in range(3)]
    upper = [sum(part.upper[k] * share for part, share in parts) for k in range(2)]
    return HeatCapacity((lower[0], lower[1], lower[2]), (upper[0], upper[1]))


def temperature_of(heat: HeatCapacity, content: float, mu: float, extra: float) -> float:
    """Temperature t [°C] from μ (c_v(t) + k) t = H.

    From 1500 °C on, c_v = a + b t and the equation is the quadratic
    μ b t² + μ (a + k) t − H = 0, solved in closed form.  Only when its root is below
    1500 °C (very lean mixtures) Newton's passes
    t ← t − (μ (c_v + k) t − H)/(μ (dU/dt + k)) run from that root; 3 reach 1e-13.

    Args:
        heat: heat capacity of the products.
        content: H [kJ/kmol].
        mu: coefficient of molecular change μ.
        extra: k: R for combustion at constant pressure, 0 at constant volume.
    """
    a, b = heat.upper
    linear = mu * (a + extra)
    t = (math.sqrt(linear * linear + 4 * mu * b * content) - linear) / (2 * mu * b)
    if t >= UPPER_START:
        return t
    for _ in range(TEMPERATURE_PASSES):
        t -= (mu * (heat.mean(t) + extra) * t - content) / (mu * (heat.true(t) + extra))
    return t
