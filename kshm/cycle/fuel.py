"""Fuel by composition and its combustion products, kmol per kg of fuel.

Amounts follow the textbook convention of the Grinevetsky-Mazing method: air is
20.8 % oxygen by volume (the share 0.21 contradicts the printed ρ and δ of the
program listing, Gots appendix 2).
"""

from __future__ import annotations

from dataclasses import dataclass

from kshm.cycle.errors import CycleError

OXYGEN_SHARE = 0.208
AIR_MOLAR_MASS = 28.96  # kg/kmol
# Heat left in CO and H2 per kmol of missing air [J/kmol]
INCOMPLETE_HEAT = 119.95e6


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
