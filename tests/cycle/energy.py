"""The first law over the cycle in the method's own terms."""

from __future__ import annotations

from dataclasses import dataclass

from kshm.cycle.fuel import AIR, R_GAS, ZERO_C
from kshm.cycle.performance import Cycle


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
