"""Indicator diagrams as frozen dataclasses: absolute pressures [Pa], angles [rad]."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

from kshm.engine.checks import POSITIVE, check_numbers, refuse

_DIAGRAM = ("p_ambient", "p_intake", "p_residual", "p_max", "n_compression", "n_expansion", "rho")


@dataclass(frozen=True, slots=True)
class PolytropicGas:
    """Indicator diagram by polytropes as the program Dinn builds it.

    Crank angles are counted from TDC before the intake stroke, in a two-stroke engine from
    the TDC of combustion.  An offset moves the dead centres: angles are meant as if these
    stood at 0, π, 2π, 3π.  ``scavenge_open`` is used by two-stroke engines only.
    ``ignition_advance`` is the angle from the start of injection to TDC;
    ``combustion_start`` the angle at which the straight pressure rise begins (φ_c, already
    delayed).
    """

    p_ambient: float
    p_intake: float
    p_residual: float
    p_max: float
    n_compression: float
    n_expansion: float
    rho: float
    combustion_start: float
    ignition_advance: float
    exhaust_open: float
    exhaust_close: float
    scavenge_open: float = 0.0

    def __post_init__(self) -> None:
        """Refuse what no gas can be."""
        check_numbers(self, POSITIVE, *_DIAGRAM, "ignition_advance")


@dataclass(frozen=True, slots=True)
class TabulatedGas:
    """Indicator diagram by points over the whole cycle; the ends repeat."""

    p_ambient: float
    angles: tuple[float, ...]
    pressures: tuple[float, ...]
    smooth: bool = False  # cubics without overshoot instead of straight lines

    def __post_init__(self) -> None:
        """Refuse points that make no closed diagram."""
        check_numbers(self, POSITIVE, "p_ambient", "pressures")
        refuse(
            (
                len(self.angles) != len(self.pressures) or len(self.angles) < 3,
                "as many pressures as angles are needed, three or more",
            ),
            (not all(a < b for a, b in pairwise(self.angles)), "angles must rise"),
        )
        refuse(
            (
                self.angles[0] != 0 or self.pressures[0] != self.pressures[-1],
                "the points must begin at 0° and end with the pressure of the beginning",
            ),
        )


@dataclass(frozen=True, slots=True)
class RoundedGas:
    """Rounded indicator diagram of a four-stroke engine.

    ``peak`` is z_д and ``join`` the end of its rounding, both as angles in the cycle;
    ``settle`` is the angle at which the intake pressure is reached.
    """

    p_ambient: float
    p_intake: float
    p_residual: float
    p_max: float
    n_compression: float
    n_expansion: float
    rho: float
    combustion_start: float
    tdc_rise: float  # p_c''/p_c
    peak: float
    peak_share: float  # p_zд/p_z
    join: float
    exhaust_open: float
    exhaust_close: float
    settle: float

    def __post_init__(self) -> None:
        """Refuse what no gas can be."""
        check_numbers(self, POSITIVE, *_DIAGRAM, "tdc_rise", "peak_share")


Gas = PolytropicGas | TabulatedGas | RoundedGas
