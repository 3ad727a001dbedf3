"""A cycle calculation as a whole: the cycle, the sizes found for it, the speed characteristic."""

from __future__ import annotations

from dataclasses import dataclass

from kshm.cycle.cycle import cycle
from kshm.cycle.design import Design, Rounding, design
from kshm.cycle.heat_balance import HeatBalance, heat_balance
from kshm.cycle.inputs import CycleInputs
from kshm.cycle.result import Cycle
from kshm.cycle.speed_characteristic import Leiderman, SpeedPoint, speed_points


@dataclass(frozen=True, slots=True)
class Wanted:
    """What the design mode starts from: N_e [W], S/D, step of the series [m]."""

    power: float
    stroke_bore: float
    step: float = 0.001
    rounding: Rounding = "nearest"


@dataclass(frozen=True, slots=True)
class CycleRun:
    """A cycle with everything derived from it; ``design`` is None when D and S were given."""

    cycle: Cycle
    design: Design | None
    balance: HeatBalance
    law: Leiderman
    points: tuple[SpeedPoint, SpeedPoint, SpeedPoint]

    @property
    def gas_power(self) -> float:
        """Power of the diagram as the dynamics take it: unrounded, with gas exchange [W].

        (p_i' − (p_r − p_a)) V_h i n/(30 τ): the fullness rounds only the cycle's own
        diagram, and the forces of the gas exchange strokes act on the piston.
        """
        inputs, charge = self.cycle.inputs, self.cycle.charge
        pressure = self.cycle.indicated.p_theory - (charge.p_r - charge.p_a)
        swept = self.cycle.effective.displacement * inputs.cylinders
        return pressure * swept * inputs.speed_rpm / (30 * inputs.strokes)


def run_cycle(
    inputs: CycleInputs,
    wanted: Wanted | None,
    law: Leiderman,
    *,
    omega_torque: float | None = None,
    omega_idle: float | None = None,
) -> CycleRun:
    """Calculate a cycle, in design mode with the sizes for the wanted power.

    Args:
        inputs: the engine and the regime.
        wanted: power and S/D of the design mode; None when bore and stroke are given.
        law: coefficients of the external speed characteristic.
        omega_torque: speed of maximum torque [rad/s], when given.
        omega_idle: idle speed [rad/s], when given.

    Raises:
        CycleError: no cycle follows from the inputs.
    """
    sizes = None
    if wanted is None:
        result = cycle(inputs)
    else:
        sizes = design(
            inputs,
            wanted.power,
            wanted.stroke_bore,
            step=wanted.step,
            rounding=wanted.rounding,
        )
        result = sizes.cycle
    figures = result.effective
    points = speed_points(
        figures.power_e,
        inputs.omega,
        law,
        kind=inputs.kind,
        omega_torque=omega_torque,
        omega_idle=omega_idle,
    )
    return CycleRun(result, sizes, heat_balance(result), law, points)
