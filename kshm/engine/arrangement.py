"""How the cylinders stand round the crankshaft: banks, throws, rods on a pin, articulated rods.

Angles run clockwise seen from the nose, as the shaft turns.  Cylinders are numbered as in
Gots 2.7.2: the left bank from the nose, then the right one in the same order.
"""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Cylinder:
    """Place of one cylinder; the defaults of all but ``throw`` are those of an in-line engine.

    ``throw`` counts from 0 at the nose; ``axis`` is the angle of the cylinder's axis from
    that of cylinder 1 [rad]; ``rod_place`` is 0 for the rod nearer to the nose (between l2
    and l3 of Gots figure 36), 1 for the other (between l4 and l5); ``pin`` tells the halves
    of a split pin apart, ``pin_angle`` turns this one against the throw [rad]; ``master`` is
    the number from 0 of the cylinder whose rod carries this one's articulated rod.
    """

    throw: int
    axis: float = 0.0
    rod_place: int = 0
    pin: int = 0
    pin_angle: float = 0.0
    master: int | None = None


@dataclass(frozen=True, slots=True)
class ArticulatedRod:
    """Rod that hangs on the master rod, Gots figure 2 в; metres, kilograms, radians.

    ``radius`` is the distance of its pin from the crankpin, ``angle`` the angle of that
    radius from the master rod's axis in the direction of rotation.  ``reciprocating`` is
    m_j of its cylinder, ``big_end`` the rod's mass reduced to the articulated pin.
    """

    rod_length: float
    radius: float
    angle: float
    reciprocating: float
    big_end: float


Arrangement = tuple[Cylinder, ...]


def in_line(count: int) -> Arrangement:
    """Cylinders in a row, each on its own throw."""
    return tuple(Cylinder(throw) for throw in range(count))


def v_shaped(
    count: int, bank_angle: float, *, split_pin: float | None = None, articulated: bool = False
) -> Arrangement:
    """Two banks with two rods on every pin: throw k carries cylinders k and k + n, Gots 2.7.2.

    Args:
        count: number of cylinders, even.
        bank_angle: from the left bank's axis to the right one's [rad].
        split_pin: how far the right rods' halves of the pins stand ahead [rad]; None for
            pins that both rods share.
        articulated: the right rods hang on the left ones.
    """
    throws = count // 2
    left = tuple(Cylinder(throw) for throw in range(throws))
    if articulated:
        right = tuple(Cylinder(throw, bank_angle, master=throw) for throw in range(throws))
    else:
        pin, turned = (0, 0.0) if split_pin is None else (1, split_pin)
        right = tuple(Cylinder(throw, bank_angle, 1, pin, turned) for throw in range(throws))
    return left + right


def opposed(count: int) -> Arrangement:
    """Two opposite banks, every rod on its own throw, left and right in turn from the nose."""
    pairs = count // 2
    left = tuple(Cylinder(2 * pair) for pair in range(pairs))
    right = tuple(Cylinder(2 * pair + 1, math.pi) for pair in range(pairs))
    return left + right


def throw_angle(cylinder: Cylinder, firing_offset: float) -> float:
    """Angle γ [rad] in 0…2π of the throw on which a cylinder fires at ``firing_offset`` [rad].

    At φ = θ the cylinder's own pin lies along its axis, so γ + δ + θ ≡ axis (mod 2π);
    in line γ ≡ −θ.
    """
    return (cylinder.axis - cylinder.pin_angle - firing_offset) % (2 * math.pi)


def pins(arrangement: Arrangement) -> tuple[tuple[int, ...], ...]:
    """Cylinders (from 0) on every crankpin, the pins counted from the nose."""
    places = sorted({(c.throw, c.pin) for c in arrangement})
    return tuple(
        tuple(i for i, c in enumerate(arrangement) if (c.throw, c.pin) == place) for place in places
    )


def throws(arrangement: Arrangement) -> tuple[tuple[int, ...], ...]:
    """Cylinders (from 0) on every throw from the nose."""
    count = 1 + max(c.throw for c in arrangement)
    return tuple(
        tuple(i for i, c in enumerate(arrangement) if c.throw == throw) for throw in range(count)
    )
