"""Governor's branch of a diesel's characteristic: from the rated speed to idling.

M = M_N (ω_x − ω)/(ω_x − ω_N) with the irregularity δ = 2(ω_x − ω_N)/(ω_x + ω_N); the fuel flow
is linear in the torque, from a share of the rated one at idling.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from kshm.arrays import Array
from kshm.errors import CycleError

# Usual, from memory of the books on tractor diesels: 0.06…0.10 and 0.25…0.30.
GOVERNOR_IRREGULARITY, IDLE_FUEL_SHARE = 0.08, 0.28


@dataclass(frozen=True, slots=True)
class Governor:
    """Degree of irregularity δ [-] and fuel flow at idling over the rated one [-]."""

    irregularity: float = GOVERNOR_IRREGULARITY
    idle_fuel: float = IDLE_FUEL_SHARE

    def __post_init__(self) -> None:
        """Refuse what no governor does.

        Raises:
            CycleError: a number out of its range.
        """
        if not 0 < self.irregularity < 1 or not 0 <= self.idle_fuel < 1:
            raise CycleError("governor_off", "governor_irregularity")

    def idling(self, omega: float) -> float:
        """Speed ω_x at which the governor shuts the fuel off to idling [rad/s]."""
        return omega * (2 + self.irregularity) / (2 - self.irregularity)


@dataclass(frozen=True, slots=True)
class Branch:
    """Curves over the speed, shape (points,): SI [rad/s, N·m, W, kg/s, kg/J].

    The consumption of idling, which does no work, is zero.
    """

    omega: Array
    torque: Array
    power: Array
    fuel_flow: Array
    consumption: Array


def branch(
    power: float, omega: float, fuel_flow: float, governor: Governor, shares: Array
) -> Branch:
    """Return the branch at shares of its span of speeds, shape (points,), by a straight line.

    Args:
        power: N_e at the rated speed [W].
        omega: rated speed [rad/s].
        fuel_flow: G_T at the rated speed [kg/s].
        governor: the governor.
        shares: 0 at the rated speed, 1 at idling [-].

    The degree of irregularity is by definition the span of speeds over their mean; the straight
    line from the rated torque to none was not checked against a book.
    """
    speeds = omega + shares * (governor.idling(omega) - omega)
    torque = power / omega * (1 - shares)
    flow = fuel_flow * (governor.idle_fuel + (1 - governor.idle_fuel) * (1 - shares))
    powers = torque * speeds
    working = powers > 0
    consumption = np.where(working, flow / np.where(working, powers, 1.0), 0.0)
    return Branch(speeds, torque, powers, flow, consumption)
