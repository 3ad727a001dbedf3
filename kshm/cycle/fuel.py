"""Fuel, its combustion products and their heat capacities; errors of the cycle.

Amounts [kmol per kg of fuel] follow the textbook convention of the Grinevetsky-Mazing method:
air is 20.8 % oxygen by volume (the share 0.21 contradicts the printed ρ and δ of the
program listing, Gots appendix 2).

Mean molar heat capacities from 0 °C are empirical formulas in their own units: t in °C,
kJ/(kmol·K).  They reproduce n_1 and T_z of the program listing to the printed digit.
The two ranges of the formulas do not meet: at 1500 °C the internal energy jumps by
up to 1 % (H2O).  A jump can leave an equation without a solution, so between 1400 and
1500 °C the lower formula passes linearly into the upper one.  Outside these 100 K,
and in everything the listing needs, the formulas are the printed ones.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from kshm.errors import CycleError

OXYGEN_SHARE = 0.208
AIR_MOLAR_MASS = 28.96  # kg/kmol
# Heat left in CO and H2 per kmol of missing air [J/kmol]
INCOMPLETE_HEAT = 119.95e6
R_GAS = 8.315  # kJ/(kmol·K), the constant of the method
ZERO_C = 273.0  # K, the method's 0 °C: 8.315·273 = 2270
UPPER_START = 1500.0  # °C
BLEND = 100.0  # K
TEMPERATURE_PASSES = 6


@dataclass(frozen=True, slots=True)
class Fuel:
    """A fuel: mass shares [kg/kg], net heating value [J/kg], vapour molar mass [kg/kmol].

    ``source`` says where the numbers come from: "listing" (appendix 2 of Gots),
    "stoichiometry" (follows from the molecule) or "memory" (not checked).
    """

    carbon: float
    hydrogen: float
    oxygen: float
    heating_value: float
    vapour_molar_mass: float
    source: str = ""

    @property
    def stoichiometric_air(self) -> float:
        """Air needed L_0 = (C/12 + H/4 − O/32)/0.208 [kmol/kg]."""
        return (self.carbon / 12 + self.hydrogen / 4 - self.oxygen / 32) / OXYGEN_SHARE

    @property
    def stoichiometric_air_mass(self) -> float:
        """Air needed l_0 = 28.96 L_0 [kg/kg]."""
        return AIR_MOLAR_MASS * self.stoichiometric_air


FUELS: dict[str, Fuel] = {
    "diesel": Fuel(0.870, 0.126, 0.004, 42.50e6, 190.0, "listing"),
    "petrol": Fuel(0.855, 0.145, 0.000, 43.93e6, 115.0, "memory"),
    "ethanol": Fuel(0.5214, 0.1313, 0.3473, 26.80e6, 46.07, "stoichiometry"),
    "methane": Fuel(0.7487, 0.2513, 0.0000, 50.00e6, 16.04, "stoichiometry"),
}


@dataclass(frozen=True, slots=True)
class Mixture:
    """Fresh charge and products [kmol per kg of fuel].

    ``fresh`` is M_1, ``products`` M_2, ``heat_loss`` ΔH_u [J/kg] is the heat not
    released for want of oxygen.
    """

    air: float
    vapour: float
    co2: float
    co: float
    h2o: float
    h2: float
    o2: float
    n2: float
    heat_loss: float

    @property
    def fresh(self) -> float:
        """Fresh charge M_1 [kmol/kg]."""
        return self.air + self.vapour

    @property
    def products(self) -> float:
        """Combustion products M_2 [kmol/kg]."""
        return self.co2 + self.co + self.h2o + self.h2 + self.o2 + self.n2

    @property
    def mu_0(self) -> float:
        """Chemical coefficient of molecular change μ_0 = M_2/M_1 [-]."""
        return self.products / self.fresh

    @property
    def shares(self) -> dict[str, float]:
        """Molar shares of the products by species [-]; the sum is 1."""
        amounts = {
            "CO2": self.co2,
            "CO": self.co,
            "H2O": self.h2o,
            "H2": self.h2,
            "O2": self.o2,
            "N2": self.n2,
        }
        return {name: amount / self.products for name, amount in amounts.items()}


def check_fuel(fuel: Fuel) -> None:
    """Refuse a fuel that cannot be.

    Raises:
        CycleError: a share outside 0…1, shares that do not add up to 1, no
            carbon or hydrogen left to burn, or a heating value that is no fuel's.
    """
    total = fuel.carbon + fuel.hydrogen + fuel.oxygen
    if not (0 <= fuel.carbon <= 1 and 0 < fuel.hydrogen <= 1 and 0 <= fuel.oxygen < 1):
        raise CycleError("fuel_shares", "fuel")
    if not abs(total - 1) <= 0.005:
        raise CycleError("fuel_total", "fuel", total=total)
    if not fuel.stoichiometric_air > 0:
        raise CycleError("fuel_oxygen", "fuel")
    if not 5e6 <= fuel.heating_value <= 130e6:
        raise CycleError("fuel_heat", "fuel", value=fuel.heating_value)
    if not 2 <= fuel.vapour_molar_mass <= 1000:
        raise CycleError("fuel_molar_mass", "fuel", value=fuel.vapour_molar_mass)


def burn(fuel: Fuel, alpha: float, *, external: bool, h2_co: float = 0.5) -> Mixture:
    """Amounts of the fresh charge and of the products [kmol/kg].

    Complete combustion for α ≥ 1; below that the missing oxygen leaves CO and H2
    in the fixed ratio ``h2_co`` = H2/CO (oxygen balance:
    (CO + H2)/2 = 0.208 (1 − α) L_0).

    Args:
        fuel: composition and heating value.
        alpha: excess air ratio α.
        external: whether the charge carries the fuel as vapour, M_1 = α L_0 + 1/m_f.
        h2_co: H2 to CO by volume, 0.45…0.50 for petrol.

    Raises:
        CycleError: α so small that more CO or H2 than carbon or hydrogen would be needed.
    """
    air_0 = fuel.stoichiometric_air
    air = alpha * air_0
    vapour = 1 / fuel.vapour_molar_mass if external else 0.0
    missing = OXYGEN_SHARE * max(1 - alpha, 0.0) * air_0
    co = 2 * missing / (1 + h2_co)
    h2 = h2_co * co
    if co > fuel.carbon / 12 or h2 > fuel.hydrogen / 2:
        raise CycleError("air_too_little", "excess_air", value=alpha)
    return Mixture(
        air=air,
        vapour=vapour,
        co2=fuel.carbon / 12 - co,
        co=co,
        h2o=fuel.hydrogen / 2 - h2,
        h2=h2,
        o2=OXYGEN_SHARE * max(alpha - 1, 0.0) * air_0,
        n2=(1 - OXYGEN_SHARE) * air,
        heat_loss=INCOMPLETE_HEAT * max(1 - alpha, 0.0) * air_0,
    )


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
        """Return internal energy above 0 °C U = c_v t [kJ/kmol]."""
        return self.mean(t) * t

    def true(self, t: float) -> float:
        """Return true heat capacity dU/dt at ``t`` [kJ/(kmol·K)]."""
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
