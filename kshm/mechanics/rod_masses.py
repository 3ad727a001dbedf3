"""Rod by two and by three masses, by weighing, by swinging, and table 4, Gots 2.2.

A rod is its mass, the distance of its centre of mass from the piston pin and, where it
is known, its own moment of inertia; SI units throughout.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from kshm.engine.masses import Estimate, Swinging, Weighing

GRAVITY = 9.81  # m/s², as the textbook takes it

Range = tuple[float, float]

# Table 4 [kg/m²].  The row of the rod has lost its numbers in the text at hand: 100…200 and
# 250…400 are those of Kolchin and Demidov, whose table the other rows repeat.
PISTON: dict[tuple[str, str], Range] = {
    ("aluminium", "petrol"): (80.0, 100.0),
    ("aluminium", "diesel"): (150.0, 300.0),
    ("iron", "petrol"): (150.0, 200.0),
    ("iron", "diesel"): (250.0, 400.0),
}
ROD: dict[str, Range] = {"petrol": (100.0, 200.0), "diesel": (250.0, 400.0)}
THROW: dict[tuple[str, str], Range] = {
    ("steel", "petrol"): (150.0, 200.0),
    ("steel", "diesel"): (200.0, 400.0),
    ("iron", "petrol"): (100.0, 200.0),
    ("iron", "diesel"): (150.0, 300.0),
}
BORES: dict[str, Range] = {"petrol": (0.06, 0.1), "diesel": (0.08, 0.12)}
STROKE_BORE: Range = (1.0, 1.2)  # «the smaller values for S/D ≤ 1»


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
        raise ValueError("the two swings do not fix the centre of mass")
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
    size = _share(bore, BORES[fuel])
    slender = _share(stroke / bore, STROKE_BORE)
    table = (
        (estimate.piston_area_mass, PISTON[estimate.piston_material, fuel], size),
        (estimate.rod_area_mass, ROD[fuel], slender),
        (estimate.throw_area_mass, THROW[estimate.shaft, fuel], size),
    )
    return AreaMasses(
        *(low + (high - low) * at if own is None else own for own, (low, high), at in table)
    )


def _share(value: float, bounds: Range) -> float:
    low, high = bounds
    return min(1.0, max(0.0, (value - low) / (high - low)))


def reduced_web(mass: float, centre: float, radius: float) -> float:
    """Web mass reduced to the crank radius [kg], m_щ ρ/r, Gots (28)."""
    return mass * centre / radius
