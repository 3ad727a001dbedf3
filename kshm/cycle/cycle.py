"""The cycle calculation by the method of Grinevetsky and Mazing.

`cycle` is the clean, converged method; with a `Listing` it reproduces the program
DIZDN behind appendix 2 of Gots.  Sources and proofs of the formulas: the printed
digits of that listing; the petrol variant follows the same equations at constant
volume.
"""

from __future__ import annotations

from dataclasses import dataclass

from kshm.cycle.dizdn_listing import Listing, listing_cycle
from kshm.cycle.errors import CycleError, Remark
from kshm.cycle.figures import effective, indicate, theoretical_pressure
from kshm.cycle.fuel import Mixture, burn
from kshm.cycle.heat import ZERO_C, mixture_heat
from kshm.cycle.inputs import CycleInputs, check_inputs
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
from kshm.cycle.result import Cycle, Indicated, Turbo
from kshm.cycle.turbo import turbo_balance

__all__ = ["Cycle", "CycleError", "CycleInputs", "Listing", "Thermodynamics", "cycle"]

HOT = 2800.0  # °C, end of the heat capacity formulas
TOO_HOT = 3500.0  # K
RESIDUAL_TOLERANCE = 0.05


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
