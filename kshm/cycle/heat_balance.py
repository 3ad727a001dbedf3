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
