"""Masses that stand for rod, piston group and throw, Gots 2.2 and 2.3; the rod by Ilchenko.

A rod is its mass, the distance of its centre of mass from the piston pin and, where it
is known, its own moment of inertia; SI units throughout.

The rod estimated from the main dimensions: Ilchenko (20)-(31), middle values of the ranges of
table 1, readings corrected.  The shank is a truncated cone whose circles have the areas of the
I-sections: this alone gives the numbers of the printed (21).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from math import pi, sqrt

from kshm.defaults import STEEL
from kshm.engine.arrangement import throws as throws_of
from kshm.engine.crankshaft import Throw
from kshm.engine.engine import Engine
from kshm.engine.masses import DirectMasses, Estimate, Masses, Swinging, Weighing
from kshm.errors import InputError
from kshm.ranges import (
    MASSES_BORES,
    MASSES_STROKE_BORE,
    PISTON_MASSES,
    ROD_MASSES,
    THROW_MASSES,
    Span,
)

GRAVITY = 9.81  # m/s², as the textbook takes it


def two_mass_rod(rod: float, centre: float, length: float) -> tuple[float, float]:
    """Masses m_1 (piston pin) and m_2 (crankpin) replacing the rod [kg], Gots (20).

    Args:
        rod: rod mass [kg].
        centre: l_1, distance from the piston pin to the centre of mass [m].
        length: rod length l [m].
    """
    big_end = rod * centre / length
    return rod - big_end, big_end


def point_masses(masses: Masses, rod_length: float) -> tuple[float, float]:
    """Reciprocating mass m_j and rotating rod mass m_2 [kg], Gots 2.2, (20), (22)."""
    if isinstance(masses, DirectMasses):
        return masses.reciprocating, masses.rod_big_end
    small_end, big_end = two_mass_rod(masses.rod, masses.centre, rod_length)
    return masses.piston_group + small_end, big_end


def throw_mass(throw: Throw) -> float:
    """Unbalanced mass of a throw without counterweights m_к [kg], Gots (28).

    The web masses are already reduced to the crank radius.
    """
    return throw.pin_mass + throw.left_web.mass + throw.right_web.mass


def rotating_mass(engine: Engine) -> float:
    """Rotating mass of the first throw with its rods m_r = m_к + Σm_2 [kg], Gots (29).

    Rods on one pin count each; an articulated rod hangs on its master and does not.
    """
    _, big_end = point_masses(engine.masses, engine.geometry.rod_length)
    arrangement = engine.arrangement
    rods = sum(arrangement[i].master is None for i in throws_of(arrangement)[0])
    return throw_mass(engine.crankshaft.throws[0]) + rods * big_end


@dataclass(frozen=True, slots=True)
class AreaMasses:
    """Masses over the piston area m′ [kg/m²]: piston group, rod, throw."""

    piston: float
    rod: float
    throw: float


def weighed_centre(weighing: Weighing, length: float) -> float:
    """l_1, distance from the piston pin to the centre of mass [m], Gots (23)."""
    return length * (1 - weighing.small_end / weighing.mass)


def pendulum_inertia(mass: float, arm: float, swings: float) -> float:
    """Moment of inertia about the edge [kg·m²] from the swings per second, Gots (24), (25)."""
    return mass * GRAVITY * arm / (2 * math.pi * swings) ** 2


def swung_centre(data: Swinging) -> float:
    """l_1 [m], Gots (27): both swings see the same inertia about the centre of mass.

    With a and b the distances of the centre from the edges and k = g/(2πn)²,
    a² − k_A a = b² − k_C b and a + b = l_3 give a linear equation for a.
    """
    k_a = GRAVITY / (2 * math.pi * data.swings_small) ** 2
    k_c = GRAVITY / (2 * math.pi * data.swings_big) ** 2
    below = k_a + k_c - 2 * data.distance
    if below == 0:
        raise InputError("the two swings do not fix the centre of mass")
    return data.distance * (k_c - data.distance) / below - data.bore_radius


def swung_inertia(data: Swinging) -> float:
    """I_ш about the centre of mass [kg·m²], Gots (26), by the parallel axis."""
    arm = swung_centre(data) + data.bore_radius
    return pendulum_inertia(data.mass, arm, data.swings_small) - data.mass * arm**2


def three_masses(
    mass: float, centre: float, length: float, inertia: float
) -> tuple[float, float, float]:
    """m_1, m_2, m_3 [kg] that keep mass, centre and inertia of the rod, Gots 2.2.

    The book prints m_3 with one term short; m_3 = m − I/(l_1(l − l_1)).
    """
    first = inertia / (centre * length)
    second = inertia / ((length - centre) * length)
    return first, second, mass - first - second


def two_mass_inertia(mass: float, centre: float, length: float) -> float:
    """I_1 of the two replacing masses about the centre of mass [kg·m²], Gots (21)."""
    return mass * centre * (length - centre)


def area_masses(estimate: Estimate, bore: float, stroke: float) -> AreaMasses:
    """Table 4 between its bounds [kg/m²]: pistons and throws by bore, rods by S/D."""
    fuel = estimate.fuel
    size = _share(bore, MASSES_BORES[fuel])
    slender = _share(stroke / bore, MASSES_STROKE_BORE)
    table = (
        (estimate.piston_area_mass, PISTON_MASSES[estimate.piston_material, fuel], size),
        (estimate.rod_area_mass, ROD_MASSES[fuel], slender),
        (estimate.throw_area_mass, THROW_MASSES[estimate.shaft, fuel], size),
    )
    return AreaMasses(
        *(
            low + (high - low) * at if stated is None else stated
            for stated, (low, high), at in table
        )
    )


def _share(value: float, bounds: Span) -> float:
    low, high = bounds
    return min(1.0, max(0.0, (value - low) / (high - low)))


def reduced_web(mass: float, centre: float, radius: float) -> float:
    """Web mass reduced to the crank radius [kg], m_щ ρ/r, Gots (28)."""
    return mass * centre / radius


@dataclass(frozen=True, slots=True)
class RodSizes:
    """Sizes of the rod [m]."""

    small_bore: float  # d_н
    small_outer: float  # d_г
    small_length: float  # l_ш
    shank_least: float  # h_ш.мин
    shank_middle: float  # h_ш
    shank_width: float  # b_ш
    wall: float  # a_ш ≈ t_ш
    pin_diameter: float  # d_ш
    big_length: float  # l_к
    cap_height: float  # h_1
    length: float  # L


@dataclass(frozen=True, slots=True)
class RodEstimate:
    """Mass [kg], place of the centre of mass from the crankpin [m], central inertia [kg·m²]."""

    mass: float
    centre: float
    inertia: float
    radius_small: float  # r′
    radius_big: float  # R′


def rod_sizes(bore: float, pin_diameter: float, pin_length: float, length: float) -> RodSizes:
    """Middle sizes of table 1 for a bore, with what one rod has of the engine's crankpin."""
    small_bore = 0.25 * bore
    small_outer = 1.45 * small_bore
    small_length = 0.39 * bore
    least, width = 0.525 * small_outer, 0.55 * small_length
    return RodSizes(
        small_bore, small_outer, small_length, least, 1.3 * least, width,
        # 2.5…4 mm in the paper; thinner on small engines, where the section would close.
        min(0.00325, 0.3 * width, 0.3 * least),
        pin_diameter, pin_length, 0.55 * pin_diameter, length,
    )  # fmt: skip


def equal_circle(height: float, width: float, wall: float) -> float:
    """Radius [m] of the circle with the area of an I-section, Ilchenko (21)."""
    area = height * width - (width - wall) * (height - 2 * wall)
    return sqrt(area / pi)


def rod_estimate(rod: RodSizes) -> RodEstimate:
    """Mass, centre of mass and central moment of inertia, Ilchenko (20), (28)-(31)."""
    r = equal_circle(rod.shank_least, rod.shank_width, rod.wall)
    big = equal_circle(rod.shank_middle, rod.shank_width, rod.wall)
    span = rod.length - rod.cap_height - rod.small_outer / 2
    ends = (
        _ring(rod.cap_height, rod.pin_diameter / 2, rod.big_length, 0.0),
        _cone(big, r, span, rod.cap_height),
        _ring(rod.small_outer / 2, rod.small_bore / 2, rod.small_length, rod.length),
    )
    mass = sum(part[0] for part in ends)
    centre = sum(part[0] * part[1] for part in ends) / mass
    inertia = sum(central + m * (position - centre) ** 2 for m, position, central in ends)
    return RodEstimate(mass, centre, inertia, r, big)


def _ring(outer: float, inner: float, length: float, position: float) -> tuple[float, float, float]:
    """Mass, place and inertia about its own axis of a hollow cylinder, (20)."""
    mass = STEEL * pi * (outer**2 - inner**2) * length
    return mass, position, mass * (outer**2 + inner**2) / 2


def _cone(big: float, small: float, span: float, start: float) -> tuple[float, float, float]:
    """Mass, place and central transverse inertia of a truncated cone, from its moments."""
    # r(z) = big − (big − small)·z/span; integrals of r², r²z, r²z², r⁴ over the height.
    b, s = big, small
    zero = span * (b * b + b * s + s * s) / 3
    one = span**2 * (b * b + 2 * b * s + 3 * s * s) / 12
    two = span**3 * (b * b + 3 * b * s + 6 * s * s) / 30
    fourth = span * (b**4 + b**3 * s + b * b * s * s + b * s**3 + s**4) / 5
    density = STEEL * pi
    inertia = density * (fourth / 4 + two - one**2 / zero)
    return density * zero, start + one / zero, inertia
