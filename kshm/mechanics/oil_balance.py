"""A bearing under its mean load: eccentricity and temperature by the heat balance."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from kshm.arrays import Array
from kshm.mechanics import oil_film

HOTTEST = 400.0  # °C, where the search for the balance ends


@dataclass(frozen=True, slots=True)
class BearingArrays:
    """Bearings with one clearance each, all of shape (bearings,); SI units.

    ``lands`` is 2 where a groove parts the bearing, each ``land`` wide; ``clearance`` the
    diametral one; ``omega`` |ω_J − ω_B|.
    """

    diameter: Array
    land: Array
    lands: Array
    clearance: Array
    omega: Array
    hole: Array

    @property
    def psi(self) -> Array:
        """ψ [-]."""
        return self.clearance / self.diameter

    @property
    def width(self) -> Array:
        """B of a land [-]."""
        return self.land / self.diameter

    @property
    def area(self) -> Array:
        """B D that carries [m²]."""
        return self.lands * self.land * self.diameter

    def load_number(self, force: Array, viscosity: Array) -> Array:
        """F ψ²/(B D η ω) [-] with the shaft's speed, shape of ``force`` [N], definition."""
        number: Array = force * (self.psi**2 / (self.area * viscosity * self.omega))
        return number

    def flow(self, eccentricity: Array, viscosity: Array, pressure: float) -> Array:
        """Oil through the bearing [m³/s]: supply at [Pa], elementwise, ISO 7902."""
        push = pressure / viscosity
        out = oil_film.side_flow(eccentricity, self.diameter, self.width, self.psi, self.omega)
        through = oil_film.groove_flow(eccentricity, self.diameter, self.land, self.psi, push)
        share = np.clip(self.hole / self.land, None, 0.9)
        at_hole = oil_film.hole_flow(eccentricity, self.diameter, share, self.psi, push)
        # One side of each land beside a groove opens into the groove.
        return np.where(self.lands > 1, out + through, out + at_hole)

    def friction(self, eccentricity: Array, across: Array, viscosity: Array, slip: Array) -> Array:
        """Friction power [W], elementwise, Butenschön.

        ``across`` |F sin(γ − δ)| [N], ``slip`` |ω_J − ω_B| [rad/s].
        """
        shear = self.area * viscosity * slip
        force = oil_film.friction_force(eccentricity, shear, across, self.psi)
        power: Array = force * self.diameter / 2 * slip
        return power


@dataclass(frozen=True, slots=True)
class Balance:
    """What a steady load makes of each bearing, shape (bearings,).

    ``eccentricity`` [-], ``temperature`` in the film [°C], ``viscosity`` [Pa·s], ``friction``
    [W], ``flow`` [m³/s], ``heated`` how much the oil is heated [K].
    """

    eccentricity: Array
    temperature: Array
    viscosity: Array
    friction: Array
    flow: Array
    heated: Array


def balance(
    bearings: BearingArrays,
    force: Array,
    viscosity_at: tuple[float, float],
    heat: float,
    supply: tuple[float, float],
    temperature: float | None = None,
) -> Balance:
    """Steady bearings, shape (bearings,), whose oil takes their heat, conservation of energy.

    The film is half as much warmer than the supply as the oil that leaves it.

    Args:
        bearings: the bearings.
        force: mean load [N], (bearings,).
        viscosity_at: at 40 and 100 °C [Pa·s].
        heat: ρc [J/(m³·K)].
        supply: temperature [°C] and pressure [Pa] before the bearing.
        temperature: of the film, given [°C].
    """
    cold, pressure = supply

    def at(warm: Array) -> Balance:
        oil = oil_film.viscosity(warm, *map(np.asarray, viscosity_at))
        e = oil_film.steady_eccentricity(bearings.load_number(force, oil), bearings.width)
        across = force * np.sin(oil_film.attitude(e, bearings.width))
        power = bearings.friction(e, across, oil, bearings.omega)
        flow = bearings.flow(e, oil, pressure)
        return Balance(e, warm, oil, power, flow, power / (heat * flow))

    if temperature is not None:
        return at(np.full(len(force), temperature))
    low, high = np.full(len(force), cold), np.full(len(force), HOTTEST)
    for _ in range(48):
        middle = (low + high) / 2
        warmer = cold + at(middle).heated / 2 > middle
        low, high = np.where(warmer, middle, low), np.where(warmer, high, middle)
    return at(low)
