"""Inputs of the flywheel as a part: rim and disc; SI units.

A size that is None follows from the stroke or from the outer diameter.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from kshm.defaults import IRON_DENSITY, STEEL_DENSITY
from kshm.engine.checks import POSITIVE, check_numbers, refuse

FlywheelMaterial = Literal["iron", "steel"]
DENSITIES = {"iron": IRON_DENSITY, "steel": STEEL_DENSITY}
RIM_SPEEDS = {"iron": 70.0, "steel": 110.0}  # m/s, from memory of the books on engines


@dataclass(frozen=True, slots=True)
class Flywheel:
    """Outer diameter, thickness of the disc [m]; rim over the diameter, ω_max/ω [-]."""

    material: FlywheelMaterial = "iron"
    outer: float | None = None
    rim_share: float = 0.12
    disc: float | None = None
    overspeed: float = 1.1

    def __post_init__(self) -> None:
        """Refuse what no flywheel can be."""
        check_numbers(self, POSITIVE, "outer", "disc", "overspeed", "rim_share")
        refuse((self.rim_share >= 0.5, "the rim is thinner than the flywheel's radius"))

    @property
    def density(self) -> float:
        """Density of the material [kg/m³]."""
        return DENSITIES[self.material]

    @property
    def rim_speed(self) -> float:
        """Greatest speed of the rim [m/s]."""
        return RIM_SPEEDS[self.material]
