"""The cycle calculation by the method of Grinevetsky and Mazing.

`cycle` is the clean, converged method; with a `Listing` it reproduces the program
DIZDN behind appendix 2 of Gots.  Sources and proofs of the formulas: the printed
digits of that listing; the petrol variant follows the same equations at constant
volume.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Literal

from kshm.cycle.dizdn_listing import POWER_FACTOR, Listing, listing_cycle
from kshm.cycle.fuel import ZERO_C, Mixture, burn, mixture_heat
from kshm.cycle.governor import Governor
from kshm.cycle.inputs import CycleInputs, check_inputs, check_range
from kshm.cycle.performance import (
    Cycle,
    HeatBalance,
    Indicated,
    Turbo,
    effective,
    friction_pressure,
    heat_balance,
    indicate,
    theoretical_pressure,
    turbo_balance,
)
from kshm.cycle.processes import (
    Charge,
    Combustion,
    Compression,
    Expansion,
    compress,
    expand,
    fill,
    ignite,
    residual_temperature,
)
from kshm.cycle.speed_characteristic import Leiderman, SpeedPoint, speed_points
from kshm.errors import CycleError, Remark

HOT = 2800.0  # °C, end of the heat capacity formulas
TOO_HOT = 3500.0  # K
RESIDUAL_TOLERANCE = 0.05
Rounding = Literal["nearest", "up"]
# S enters p_e only through c_m^1·S^(−1/3): the passes contract by b c_m/(3 p_e)
STROKE_PASSES = 400


@dataclass(frozen=True, slots=True)
class Thermodynamics:
    """The part of the cycle that does not know bore and stroke."""

    mixture: Mixture
    charge: Charge
    compression: Compression
    combustion: Combustion
    expansion: Expansion
    indicated: Indicated


def thermodynamics(inputs: CycleInputs) -> Thermodynamics:
    """Clean, converged cycle up to the indicated pressure; needs no bore or stroke.

    Raises:
        CycleError: an input is out of range or no cycle follows from it.
    """
    check_inputs(inputs)
    mixture = burn(inputs.fuel, inputs.excess_air, external=inputs.external, h2_co=inputs.h2_co)
    products = mixture_heat(mixture.shares)
    eps = inputs.compression_ratio
    charge = fill(inputs)
    compression = compress(charge, eps)
    combustion = ignite(inputs, mixture, charge, compression, products)
    if combustion.t_z > TOO_HOT:
        raise CycleError("too_hot", "xi_z", t_z=combustion.t_z)
    expansion = expand(combustion, inputs.xi_z, inputs.xi_b)
    p_theory = theoretical_pressure(eps, compression, combustion, expansion, charge.t_a)
    indicated = indicate(inputs, mixture, charge, p_theory)
    return Thermodynamics(mixture, charge, compression, combustion, expansion, indicated)


def cycle(inputs: CycleInputs, listing: Listing | None = None) -> Cycle:
    """Calculate the cycle of an engine with given bore and stroke.

    Args:
        inputs: the engine and the regime.
        listing: None for the clean method; a `Listing` reproduces the program's
            peculiarities for validation (turbocharged diesel only).

    Returns:
        All stages, the effective figures, the turbocharger balance and warnings.

    Raises:
        CycleError: no cycle follows from the inputs.
    """
    if listing is not None:
        return listing_cycle(inputs, listing)
    thermo = thermodynamics(inputs)
    figures = effective(inputs, thermo.indicated)
    turbo = None
    if inputs.boost is not None:
        turbo = turbo_balance(
            inputs, inputs.boost, thermo.charge, thermo.combustion, thermo.expansion, figures
        )
    return Cycle(
        inputs=inputs,
        mixture=thermo.mixture,
        charge=thermo.charge,
        compression=thermo.compression,
        combustion=thermo.combustion,
        expansion=thermo.expansion,
        indicated=thermo.indicated,
        effective=figures,
        turbo=turbo,
        t_residual_check=residual_temperature(thermo.expansion, thermo.charge.p_r),
        warnings=(*_residual_warning(inputs, thermo), *_heat_warning(thermo), *_turbo(turbo)),
    )


def _residual_warning(inputs: CycleInputs, thermo: Thermodynamics) -> tuple[Remark, ...]:
    check = residual_temperature(thermo.expansion, thermo.charge.p_r)
    gap = (check - inputs.t_residual) / inputs.t_residual
    if abs(gap) <= RESIDUAL_TOLERANCE:
        return ()
    numbers = {"given": inputs.t_residual, "check": check, "gap": gap}
    return (Remark("residual_temperature_off", "t_residual", numbers),)


def _heat_warning(thermo: Thermodynamics) -> tuple[Remark, ...]:
    if thermo.combustion.t_z - ZERO_C <= HOT:
        return ()
    return (Remark("heat_capacity_extended", "xi_z", {"t_z": thermo.combustion.t_z}),)


def _turbo(turbo: Turbo | None) -> tuple[Remark, ...]:
    if turbo is None or turbo.turbine_power >= turbo.compressor_power:
        return ()
    numbers = {
        "turbine": turbo.turbine_power,
        "compressor": turbo.compressor_power,
        "balance": turbo.c2_balance,
    }
    return (Remark("turbine_too_weak", "exhaust_factor", numbers),)


@dataclass(frozen=True, slots=True)
class Design:
    """Bore and stroke [m] as calculated and as rounded, and the cycle with the latter.

    ``power_error`` is (N_e − wanted)/wanted after rounding [-].
    """

    bore_exact: float
    stroke_exact: float
    bore: float
    stroke: float
    power: float
    cycle: Cycle
    power_error: float


def bore_for(displacement: float, stroke_bore: float) -> float:
    """Bore D = (4 V_h/(π S/D))^(1/3) [m]."""
    return math.cbrt(4 * displacement / (math.pi * stroke_bore))


def round_to_series(size: float, step: float, rounding: Rounding) -> float:
    """Size rounded to a multiple of ``step`` [m]."""
    # 1e-9: an exact multiple must not be lifted to the next one by the last bit
    count = math.ceil(size / step - 1e-9) if rounding == "up" else round(size / step)
    # Multiplying by 1/step gives the decimal number itself: 88/1000, not 88·0.001
    inverse = round(1 / step)
    return count / inverse if abs(inverse * step - 1) < 1e-9 else count * step


def exact_stroke(
    inputs: CycleInputs, p_i: float, power: float, stroke_bore: float, factor: float
) -> float:
    """Stroke [m] that gives the wanted power [W] before rounding.

    V_h = N_e/(factor·p_e n i) with factor = 1/(30 τ); when friction depends on the
    piston speed, S and p_e are found together by repeated substitution.

    Raises:
        CycleError: friction eats the indicated work at any size, or no convergence.
    """
    stroke, previous = 0.1, 0.0
    for _ in range(STROKE_PASSES):
        speed = stroke * inputs.omega / math.pi
        p_e = p_i - friction_pressure(inputs.mechanical, p_i, speed)
        if not p_e > 0:
            raise CycleError("friction_eats_all_sizes", "mechanical", speed=speed)
        swept = power / (factor * p_e * inputs.speed_rpm * inputs.cylinders)
        previous, stroke = stroke, stroke_bore * bore_for(swept, stroke_bore)
        if abs(stroke - previous) <= 1e-13 * stroke:
            return stroke
    raise CycleError("stroke_not_found", "power")


def design(
    inputs: CycleInputs,
    power: float,
    stroke_bore: float,
    *,
    step: float = 0.001,
    rounding: Rounding = "nearest",
    bore_range: tuple[float, float] = (0.04, 0.40),
    listing: Listing | None = None,
) -> Design:
    """Find bore and stroke for the wanted effective power and recalculate.

    Args:
        inputs: the engine; its bore and stroke are ignored.
        power: wanted N_e [W].
        stroke_bore: S/D.
        step: step of the series of bores and strokes [m].
        rounding: to the nearest size or upwards.
        bore_range: allowed bores [m].
        listing: listing mode, as in `kshm.cycle.cycle`.

    Returns:
        Sizes before and after rounding and the cycle of the rounded engine.

    Raises:
        CycleError: no bore in the range gives this power, or no cycle follows.
    """
    for field, value in (("power", power), ("stroke_bore", stroke_bore), ("step", step)):
        check_range(field, value)
    if listing is None:
        p_i, factor = thermodynamics(inputs).indicated.p_i, 1 / (30 * inputs.strokes)
    else:
        # The indicated pressure does not depend on the size: any size will do
        trial = replace(inputs, bore=0.1, stroke=0.1 * stroke_bore)
        p_i, factor = cycle(trial, listing).indicated.p_i, POWER_FACTOR
    stroke = exact_stroke(inputs, p_i, power, stroke_bore, factor)
    bore = stroke / stroke_bore
    if not bore_range[0] <= bore <= bore_range[1]:
        key = "bore_too_small" if bore < bore_range[0] else "bore_too_large"
        low, high = bore_range
        raise CycleError(key, "power", power=power, bore=bore, low=low, high=high)
    sizes = [round_to_series(size, step, rounding) for size in (bore, stroke)]
    result = cycle(replace(inputs, bore=sizes[0], stroke=sizes[1]), listing)
    error = result.effective.power_e / power - 1
    return Design(bore, stroke, sizes[0], sizes[1], power, result, error)


@dataclass(frozen=True, slots=True)
class Wanted:
    """Targets of the design mode: N_e [W], S/D, step of the series [m]."""

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
    governor: Governor | None = None  # of a diesel

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
    target: Wanted | None,
    law: Leiderman,
    *,
    omega_torque: float | None = None,
    omega_idle: float | None = None,
    governor: Governor | None = None,
) -> CycleRun:
    """Calculate a cycle, in design mode with the sizes for the wanted power.

    Args:
        inputs: the engine and the regime.
        target: power and S/D of the design mode; None when bore and stroke are given.
        law: coefficients of the external speed characteristic.
        omega_torque: speed of maximum torque [rad/s], when given.
        omega_idle: idle speed [rad/s], when given.
        governor: that of a diesel; the usual one where none is given.

    Raises:
        CycleError: no cycle follows from the inputs.
    """
    sizes = None
    if target is None:
        result = cycle(inputs)
    else:
        sizes = design(
            inputs,
            target.power,
            target.stroke_bore,
            step=target.step,
            rounding=target.rounding,
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
    if inputs.kind != "diesel":
        governor = None
    elif governor is None:
        governor = Governor()
    return CycleRun(result, sizes, heat_balance(result), law, points, governor)
