"""External heat balance of the engine."""

from __future__ import annotations

from dataclasses import dataclass

from kshm.cycle.heat import AIR, R_GAS, ZERO_C
from kshm.cycle.result import Cycle
from kshm.cycle.turbo import AIR_CP


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


@dataclass(frozen=True, slots=True)
class CycleEnergy:
    """Energy of one kmol of charge in the method's own terms [kJ/kmol].

    In the converged method ``heat`` + ``start`` = ``work`` + ``end`` exactly.
    ``start`` is the energy of the charge at point a as the method counts it:
    U_c of the mixture less the compression work of air.
    """

    heat: float
    start: float
    work: float
    end: float

    @property
    def gap(self) -> float:
        """What is missing, relative to the heat [-]."""
        return (self.heat + self.start - self.work - self.end) / self.heat


def cycle_energy(cycle: Cycle) -> CycleEnergy:
    """First law over a → c → z → b for one kmol of charge.

    Work p_i' V_h per kmol is p_i'(ε − 1)/(p_c)·R T_c; heat ξ_b q; U_b of μ kmol.
    """
    comp, comb, gamma = cycle.compression, cycle.combustion, cycle.charge.gamma
    t_a, t_c = cycle.charge.t_a - ZERO_C, comp.t_c - ZERO_C
    products = comb.products
    u_c = (AIR.energy(t_c) + gamma * products.energy(t_c)) / (1 + gamma)
    swept = (cycle.inputs.compression_ratio - 1) * R_GAS * comp.t_c / comp.p_c
    return CycleEnergy(
        heat=cycle.inputs.xi_b * comb.heat,
        start=u_c - (AIR.energy(t_c) - AIR.energy(t_a)),
        work=cycle.indicated.p_theory * swept,
        end=comb.mu * products.energy(cycle.expansion.t_b - ZERO_C),
    )
