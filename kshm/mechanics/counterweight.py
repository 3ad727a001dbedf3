"""Counterweights as sectors of a ring; partial balance of one crank."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np


class Sector(NamedTuple):
    """A sector of a ring: angle [rad], mass [kg], its centre's distance from the shaft [m].

    ``fullness`` is the sine of half the angle that the moment asks for [-]: above 1 there is no
    such sector, and half a ring is taken.
    """

    fullness: float
    angle: float
    mass: float
    centre: float


class SectorRing(NamedTuple):
    """Section of a sector: inner and outer radius and width [m], density [kg/m³]."""

    inner: float
    outer: float
    width: float
    density: float

    @property
    def half_moment(self) -> float:
        """First moment of half the ring about the shaft ∬ρbr sin ψ r dr dψ [kg·m], by statics."""
        return 2 / 3 * self.density * self.width * (self.outer**3 - self.inner**3)

    def sector(self, moment: float) -> Sector:
        """Sector with a first moment [kg·m] about the shaft, by statics."""
        fullness = moment / self.half_moment
        angle = 2 * float(np.arcsin(min(1.0, fullness)))
        mass = self.density * self.width * angle / 2 * (self.outer**2 - self.inner**2)
        centre = self.half_moment * float(np.sin(angle / 2)) / mass if mass else 0.0
        return Sector(fullness, angle, mass, centre)

    def width_for(self, moment: float) -> float:
        """Width with which half a ring has the first moment [m], by statics."""
        return self.width * moment / self.half_moment


class Crank(NamedTuple):
    """One crank: rotating and reciprocating mass [kg], radius [m], speed [rad/s]."""

    rotating: float
    reciprocating: float
    radius: float
    omega: float

    def balance_mass(self, share: float, radius: float) -> float:
        """Mass [kg] at a radius [m] opposite the crank, for a share of the reciprocating mass."""
        return (self.rotating + share * self.reciprocating) * self.radius / radius

    def residue(self, share: float, angle: float) -> float:
        """Force of the first order [N] that this mass leaves at a crank angle [rad], statics."""
        unit = self.reciprocating * self.radius * self.omega**2
        along, across = (1 - share) * np.cos(angle), share * np.sin(angle)
        return float(unit * np.hypot(along, across))
