"""Journal bearings under a steady load: oil film, heat balance; fatigue of the journals.

So_D = F ψ²/(B D η |ω̄|) of the rotation, with the closed forms fitted to Butenschön's tables
(H. J. Butenschön, Karlsruhe 1976) as an open multibody program states them.  ψ is the diametral
clearance over the diameter, b the width over the diameter, ω̄ = ω_J + ω_B.  The pressure is cut
off where it would be negative; a film that conserves its mass there is thinner.

Fatigue: nominal stresses, Serensen and Kinasoshvili, rule of the classification societies.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from kshm.arrays import Array
from kshm.engine.bearings import MAX_WIDTH, MIN_WIDTH
from kshm.errors import InputError
from kshm.nomenclature.quantity import UNITS

HOTTEST = 400.0  # °C, where the search for the balance ends
_MPA = UNITS["MPa"].si


def check_widths(width: Array) -> None:
    """Refuse widths over the diameter b [-] outside Butenschön's tables, any shape.

    Raises:
        InputError: b is outside 0.1…1.
    """
    if not np.all((width >= MIN_WIDTH) & (width <= MAX_WIDTH)):
        raise InputError(f"the width over the diameter must be {MIN_WIDTH:g} to {MAX_WIDTH:g}")


def _polynomial(b: Array, *coefficients: float) -> Array:
    value = np.zeros_like(b)
    for coefficient in reversed(coefficients):
        value = value * b + coefficient
    return value


@dataclass(frozen=True, slots=True)
class Film:
    """The closed forms for widths b = B/D: what depends on b alone, found once, a_1 … a_7."""

    scale: Array  # −½b²a1
    a2: Array
    turn: tuple[Array, ...]  # a3 … a7

    @classmethod
    def of(cls, width: Array) -> Film:
        """Film of bearings of the widths b [-], any shape, Butenschön."""
        b = np.asarray(width, dtype=float)
        return cls(
            -(b**2) / 2 * _polynomial(b, 1.1642, -1.9456, 7.1161, -10.1073, 5.0141),
            _polynomial(b, -1.000026, -0.023634, -0.4215, -0.038817, -0.090551),
            (
                1.152624 - 0.104565 * b, -2.5905 + 0.798745 * b, 8.73393 - 2.3291 * b,
                -13.3414 + 3.424337 * b, 6.6294 - 1.591732 * b,
            ),
        )  # fmt: skip

    def rotation(self, eccentricity: Array) -> Array:
        """So_D [-] at the relative eccentricity ε [-], elementwise, Butenschön's tables fitted.

        Median error 2.4 % of the printed tables, largest 6.8 %.
        """
        e = eccentricity
        square = e * e
        complement = 1 - square
        root = np.sqrt(np.pi**2 * complement + 16 * square)
        number: Array = self.scale * e * root * (1 - e) / (complement * complement * (self.a2 + e))
        return number

    def attitude(self, eccentricity: Array) -> Array:
        """Angle β from the line of centres to the force [rad], elementwise, Butenschön fitted."""
        e = eccentricity
        a3, a4, a5, a6, a7 = self.turn
        factor = a3 + e * (a4 + e * (a5 + e * (a6 + e * a7)))
        angle: Array = np.arctan2(np.pi * np.sqrt(1 - e * e), 2 * e) * factor
        return angle


def rotation_number(eccentricity: Array, width: Array) -> Array:
    """So_D [-] at ε and b [-], elementwise; see ``Film.rotation``, Butenschön."""
    return Film.of(width).rotation(eccentricity)


def attitude(eccentricity: Array, width: Array) -> Array:
    """β [rad] at ε and b [-], elementwise; see ``Film.attitude``, Butenschön."""
    return Film.of(width).attitude(eccentricity)


def steady_eccentricity(load_number: Array, width: Array) -> Array:
    """ε [-] at which So_D carries a steady load of that number, elementwise, Butenschön."""
    film = Film.of(width)
    low = np.zeros(np.broadcast(load_number, width).shape)
    high = np.ones_like(low)
    for _ in range(52):
        middle = (low + high) / 2
        below = film.rotation(middle) < load_number
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    return low


def friction_force(
    eccentricity: Array, shear: Array, across: Array, clearance: Array
) -> Array:  # fmt: skip
    """Friction force on the journal [N], elementwise, of μ = ψ(…) by Butenschön.

    Args:
        eccentricity: ε [-].
        shear: B D η |ω_J − ω_B| [N].
        across: part of the load across the line of centres |F sin(γ − δ)| = F_D sin β [N].
        clearance: ψ [-].
    """
    drag: Array = np.pi * shear / (clearance * np.sqrt(1 - eccentricity**2))
    return drag + clearance * eccentricity / 2 * across


def side_flow(
    eccentricity: Array, diameter: Array, width: Array, clearance: Array, omega: Array
) -> Array:
    """Oil that the rotation presses out at both ends [m³/s], elementwise, ISO 7902, from memory.

    D³ψω̄ ¼(b − 0.223b³)ε with the diameter [m], b and ψ [-], |ω̄| [rad/s].
    """
    flow: Array = diameter**3 * clearance * omega * (width - 0.223 * width**3) * eccentricity / 4
    return flow


def groove_flow(
    eccentricity: Array, diameter: Array, land: Array, clearance: Array, push: Array
) -> Array:
    """Oil that the supply presses through both lands of a groove [m³/s], elementwise, Poiseuille.

    π D⁴ψ³(1 + 1.5ε²)/(48 l) · p/η with the land's width l [m] and ``push`` p/η [1/s].
    """
    flow: Array = (
        np.pi * diameter**4 * clearance**3 * (1 + 1.5 * eccentricity**2) / (48 * land) * push
    )
    return flow


def hole_flow(
    eccentricity: Array, diameter: Array, hole: Array, clearance: Array, push: Array
) -> Array:
    """Oil that the supply presses through a hole opposite the load [m³/s], ISO 7902, from memory.

    D³ψ³ p/η · π/48 (1 + ε)³/(ln(B/d) q); ``hole`` is d/B [-], ``push`` p/η [1/s]; elementwise.
    """
    shape = _polynomial(hole, 1.204, 0.368, -1.046, 1.942)
    flow: Array = (
        diameter**3 * clearance**3 * push * np.pi / 48
        * (1 + eccentricity) ** 3 / (-np.log(hole) * shape)
    )  # fmt: skip
    return flow


def viscosity(temperature: Array, at_40: Array, at_100: Array) -> Array:
    """η [Pa·s] at a temperature [°C], elementwise, Vogel's law with 95 °C through two points."""
    slope = np.log(at_40 / at_100) / (1 / 135 - 1 / 195)
    value: Array = at_100 * np.exp(slope * (1 / (temperature + 95) - 1 / 195))
    return value


def gap(eccentricity: Array, clearance: Array) -> Array:
    """Least film Δ/2·(1 − ε) [m] under a diametral clearance [m], elementwise, statics."""
    least: Array = clearance / 2 * (1 - eccentricity)
    return least


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
        out = side_flow(eccentricity, self.diameter, self.width, self.psi, self.omega)
        through = groove_flow(eccentricity, self.diameter, self.land, self.psi, push)
        share = np.clip(self.hole / self.land, None, 0.9)
        at_hole = hole_flow(eccentricity, self.diameter, share, self.psi, push)
        # One side of each land beside a groove opens into the groove.
        return np.where(self.lands > 1, out + through, out + at_hole)

    def friction(self, eccentricity: Array, across: Array, viscosity: Array, slip: Array) -> Array:
        """Friction power [W], elementwise, Butenschön.

        ``across`` |F sin(γ − δ)| [N], ``slip`` |ω_J − ω_B| [rad/s].
        """
        shear = self.area * viscosity * slip
        force = friction_force(eccentricity, shear, across, self.psi)
        power: Array = force * self.diameter / 2 * slip
        return power


@dataclass(frozen=True, slots=True)
class Balance:
    """State of each bearing under a steady load, shape (bearings,).

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
        oil = viscosity(warm, *map(np.asarray, viscosity_at))
        e = steady_eccentricity(bearings.load_number(force, oil), bearings.width)
        across = force * np.sin(attitude(e, bearings.width))
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


@dataclass(frozen=True, slots=True)
class Swing:
    """Amplitude and mean of a stress [Pa], any shape."""

    amplitude: Array
    mean: Array

    @classmethod
    def of(cls, largest: Array, smallest: Array, modulus: Array) -> Swing:
        """From the extremes of a moment [N·m] and the modulus [m³], elementwise, statics."""
        return cls((largest - smallest) / 2 / modulus, (largest + smallest) / 2 / modulus)


def polar_modulus(diameter: Array, bore: Array) -> Array:
    """W_p = π(D⁴ − d⁴)/(16D) [m³], elementwise, statics; half of it resists bending."""
    modulus: Array = np.pi / 16 * diameter**3 * (1 - (bore / diameter) ** 4)
    return modulus


def concentration(shape: float, sensitivity: float) -> float:
    """Effective concentration k = 1 + q(α − 1) [-], definition."""
    return 1 + sensitivity * (shape - 1)


def safety(swing: Swing, limit: float, factor: float, of_mean: float) -> Array:
    """N = σ_−1/(kσ_a/(ε ε_п) + ψ|σ_m|) [-], shape of the stresses, Serensen, Kinasoshvili.

    Args:
        swing: the stress.
        limit: σ_−1 or τ_−1 [Pa].
        factor: k/(ε ε_п) [-].
        of_mean: ψ [-].
    """
    acting = factor * swing.amplitude + of_mean * np.abs(swing.mean)
    with np.errstate(divide="ignore"):
        factor_of_safety: Array = limit / acting
    return factor_of_safety


def together(bending: Array, torsion: Array) -> Array:
    """N = n_σ n_τ/√(n_σ² + n_τ²) [-], elementwise, Serensen, Kinasoshvili."""
    joined: Array = 1 / np.sqrt(1 / bending**2 + 1 / torsion**2)
    return joined


def class_strength(tensile: Array, diameter: Array, radius: Array, making: float) -> Array:
    """Fatigue strength of a crankpin [Pa], elementwise, IACS UR M53, from memory.

    K(0.42σ_B + 39.3)(0.264 + 1.073 D^−0.2 + (785 − σ_B)/4900 + 196/σ_B √(1/R)) in N/mm², mm.

    Args:
        tensile: σ_B [Pa].
        diameter: D [m].
        radius: R of the fillet, or half of the oil hole [m].
        making: K of the forging.
    """
    sigma, big, small = tensile / _MPA, 1000 * diameter, 1000 * radius
    shape = 0.264 + 1.073 * big**-0.2 + (785 - sigma) / 4900 + 196 / sigma * np.sqrt(1 / small)
    strength: Array = _MPA * making * (0.42 * sigma + 39.3) * shape
    return strength
