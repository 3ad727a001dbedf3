"""Engines that several tests of the cycle share."""

import math
from dataclasses import replace

from kshm.cycle.fuel import FUELS
from kshm.cycle.inputs import Boost, CycleInputs


def turbo_diesel() -> CycleInputs:
    """The engine of Gots, appendix 2."""
    return CycleInputs(
        kind="diesel",
        fuel=FUELS["diesel"],
        omega=4400 * math.pi / 30,
        cylinders=3,
        compression_ratio=18.0,
        excess_air=1.45,
        charge_heating=11.0,
        t_residual=840.0,
        intake_factor=0.87,
        exhaust_factor=1.10,
        xi_z=0.84,
        xi_b=0.85,
        fullness=0.91,
        mechanical=0.79,
        p_max=10.5e6,
        boost=Boost(1.75, 0.72, 0.70, 0.01e6, 65.0),
        bore=0.088,
        stroke=0.094,
        lam=0.317,
        recharge=1.05,
        scavenging=0.95,
    )


def natural_diesel() -> CycleInputs:
    return replace(
        turbo_diesel(),
        boost=None,
        omega=2200 * math.pi / 30,
        cylinders=4,
        compression_ratio=16.0,
        excess_air=1.5,
        p_max=7.5e6,
        charge_heating=20.0,
        t_residual=780.0,
        intake_factor=0.9,
        xi_z=0.76,
        xi_b=0.86,
        fullness=0.94,
        mechanical=0.78,
        bore=0.110,
        stroke=0.125,
        lam=0.272,
        recharge=1.0,
        scavenging=1.0,
    )


def petrol() -> CycleInputs:
    """ε = 9.5, α = 0.96: the sanity case of the petrol variant."""
    return replace(
        natural_diesel(),
        kind="petrol",
        fuel=FUELS["petrol"],
        p_max=None,
        omega=5600 * math.pi / 30,
        compression_ratio=9.5,
        excess_air=0.96,
        charge_heating=8.0,
        t_residual=1050.0,
        t_ambient=293.0,
        intake_factor=0.87,
        exhaust_factor=1.16,
        xi_z=0.88,
        xi_b=0.92,
        fullness=0.96,
        mechanical=0.82,
        bore=0.082,
        stroke=0.071,
        lam=0.285,
    )


def turbo_petrol() -> CycleInputs:
    return replace(
        petrol(),
        compression_ratio=9.0,
        excess_air=0.90,
        boost=Boost(1.6, 0.72, 0.70, 0.005e6, 35.0),
        exhaust_factor=1.05,
    )


ENGINES = {
    "turbo_diesel": turbo_diesel(),
    "natural_diesel": natural_diesel(),
    "petrol": petrol(),
    "turbo_petrol": turbo_petrol(),
}
