"""Rod estimated from the main dimensions, Ilchenko (20)-(31) and table 1, readings corrected.

Middle values of the ranges of table 1.  The shank is a truncated cone whose circles
have the areas of the I-sections: this alone gives the numbers of the printed (21).
Places run from the crankpin along the rod.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, sqrt

from kshm.mechanics.reduced_inertia import STEEL


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


def sizes(bore: float, pin_diameter: float, pin_length: float, length: float) -> RodSizes:
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


def estimate(rod: RodSizes) -> RodEstimate:
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
    inertia = sum(own + m * (place - centre) ** 2 for m, place, own in ends)
    return RodEstimate(mass, centre, inertia, r, big)


def _ring(outer: float, inner: float, length: float, place: float) -> tuple[float, float, float]:
    """Mass, place and inertia about its own axis of a hollow cylinder, (20)."""
    mass = STEEL * pi * (outer**2 - inner**2) * length
    return mass, place, mass * (outer**2 + inner**2) / 2


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
