"""A flywheel as a disc with a rim."""

from __future__ import annotations

import math
from typing import NamedTuple


class FlywheelRing(NamedTuple):
    """A ring or, with no bore, a disc: diameters and width [m], density [kg/m³]."""

    outer: float
    bore: float
    width: float
    density: float

    @property
    def mass(self) -> float:
        """Mass ρπb(D² − d²)/4 [kg], by statics."""
        return math.pi / 4 * self.density * self.width * (self.outer**2 - self.bore**2)

    @property
    def inertia(self) -> float:
        """Moment of inertia about the axis m(D² + d²)/8 [kg·m²], by statics."""
        return self.mass * (self.outer**2 + self.bore**2) / 8


def rim_stress(density: float, speed: float) -> float:
    """Hoop stress of a thin ring that turns freely ρv² [Pa] at a speed [m/s], by statics."""
    return density * speed**2
