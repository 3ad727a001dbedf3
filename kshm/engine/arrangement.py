"""Layout of the cylinders: banks, throws, rods on a pin, articulated rods.

Angles run clockwise seen from the nose, as the shaft turns.  Cylinders are numbered as in
Gots 2.7.2: the left bank from the nose, then the next ones in the same order.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

from kshm.engine.checks import NOT_NEGATIVE, POSITIVE, check_numbers, refuse, takes_kinds

MAX_GAP = 2.0  # between two firings, over the mean: twins at 180° have 1.5


@dataclass(frozen=True, slots=True)
class Cylinder:
    """Place of one cylinder; the defaults of all but ``throw`` are those of an in-line engine.

    ``throw`` counts from 0 at the nose; ``axis`` is the angle of the cylinder's axis from
    that of cylinder 1 [rad]; ``rod_place`` is where along the pin its rod stands: 0 nearest
    to the nose (between l2 and l3 of Gots figure 36), 1 farthest (between l4 and l5);
    ``pin`` tells the parts of a split pin from one another, ``pin_angle`` turns this one
    against the throw [rad]; ``master`` is the number from 0 of the cylinder whose rod
    carries this one's articulated rod.
    """

    throw: int
    axis: float = 0.0
    rod_place: float = 0
    pin: int = 0
    pin_angle: float = 0.0
    master: int | None = None

    def __post_init__(self) -> None:
        """Refuse angles and places that are no numbers."""
        check_numbers(self, NOT_NEGATIVE, "throw", "rod_place", "pin")
        refuse((self.rod_place > 1, f"rod_place must be from 0 to 1, not {self.rod_place:g}"))


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

    def __post_init__(self) -> None:
        """Refuse what no rod can be."""
        check_numbers(self, POSITIVE, "rod_length")
        check_numbers(self, NOT_NEGATIVE, "radius", "reciprocating", "big_end")


Arrangement = tuple[Cylinder, ...]


def firing_gap(offsets: Sequence[float], period: float) -> tuple[float, float]:
    """Return the widest gap between two firings and the mean one.

    Args:
        offsets: where the cylinders fire, from 0 to below the period.
        period: length of the cycle in the same unit.

    >>> firing_gap([0, 40, 80], 720)
    (640, 240.0)
    """
    order = sorted(offsets)
    following = [*order[1:], order[0] + period]
    gap = max(later - earlier for earlier, later in zip(order, following, strict=True))
    return gap, period / len(order)


@cache
def in_row(count: int) -> Arrangement:
    """Cylinders in a row, each on its own throw."""
    return tuple(Cylinder(throw) for throw in range(count))


def fan(
    throws: int,
    axes: Sequence[float],
    *,
    pin_angles: Sequence[float] | None = None,
    articulated: bool = False,
) -> Arrangement:
    """Banks with a rod of each on every throw: V, W and radial engines, Gots 2.7.2.

    Args:
        throws: number of throws, each of which carries a rod of every bank.
        axes: of the banks from the first one's axis [rad].
        pin_angles: how far each bank's part of a split pin stands ahead of the throw [rad];
            None for pins that the rods share.
        articulated: the rods of all banks but the first hang on those of the first.
    """
    refuse(
        (not axes, "an engine has a bank"),
        (
            pin_angles is not None and len(pin_angles) != len(axes),
            f"{len(axes)} banks need a part of the pin each, not {len(pin_angles or ())}",
        ),
        (
            pin_angles is not None and articulated,
            "articulated rods hang on the master rod and have no part of a split pin",
        ),
    )
    cylinders = []
    for bank, axis in enumerate(axes):
        share = bank / max(1, len(axes) - 1)
        pin, ahead = (0, 0.0) if pin_angles is None else (bank, pin_angles[bank])
        for throw in range(throws):
            if articulated:
                cylinders.append(Cylinder(throw, axis, master=throw if bank else None))
            else:
                cylinders.append(Cylinder(throw, axis, share, pin, ahead))
    return tuple(cylinders)


@takes_kinds
def opposed(count: int) -> Arrangement:
    """Return two opposite banks, each rod on its own throw, left and right in turn, Gots 2.7.2.

    Args:
        count: cylinders, an even number.

    Raises:
        InputError: an odd number.

    >>> [cylinder.throw for cylinder in opposed(4)]  # left bank from the nose, then right
    [0, 2, 1, 3]
    """
    refuse((count < 2 or count % 2 != 0, f"an opposed engine has pairs of cylinders, not {count}"))
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


def hung(arrangement: Arrangement) -> tuple[int, ...]:
    """Cylinders (from 0) whose rods hang on others, in their order."""
    return tuple(i for i, cylinder in enumerate(arrangement) if cylinder.master is not None)


def pins(arrangement: Arrangement) -> tuple[tuple[int, ...], ...]:
    """Cylinders (from 0) on every crankpin, the pins counted from the nose."""
    pairs = sorted({(c.throw, c.pin) for c in arrangement})
    return tuple(
        tuple(i for i, c in enumerate(arrangement) if (c.throw, c.pin) == pin) for pin in pairs
    )


def pin_counts(arrangement: Arrangement) -> tuple[int, ...]:
    """Crankpins of every throw from the nose: more than one, in series, where they are split."""
    pairs = {(c.throw, c.pin) for c in arrangement}
    return tuple(
        sum(throw == number for throw, _ in pairs) for number in range(len(throws(arrangement)))
    )


def rods_beside(arrangement: Arrangement, cylinder: int) -> int:
    """Rods side by side on a cylinder's (from 0) crankpin; articulated rods take none of it."""
    cylinder_at = arrangement[cylinder]
    return sum(
        c.master is None
        for c in arrangement
        if (c.throw, c.pin) == (cylinder_at.throw, cylinder_at.pin)
    )


def throws(arrangement: Arrangement) -> tuple[tuple[int, ...], ...]:
    """Cylinders (from 0) on every throw from the nose."""
    count = 1 + max(c.throw for c in arrangement)
    return tuple(
        tuple(i for i, c in enumerate(arrangement) if c.throw == throw) for throw in range(count)
    )


def side_reach(
    crank_radius: float, rod_length: float, offset: float, radius: float, angle: float, bank: float
) -> float:
    """Greatest distance of an articulated pin from its cylinder's axis in a turn.

    Lengths in one unit, angles in radians: ``radius`` and ``angle`` are those of
    ``ArticulatedRod``, ``bank`` the own axis from the master's.
    """
    import numpy as np  # an engine without articulated rods is made without it

    phi = np.radians(np.arange(360.0))
    beta = np.arcsin((crank_radius * np.sin(phi) - offset) / rod_length)
    across = crank_radius * np.sin(phi - bank) + radius * np.sin(angle - beta - bank)
    return float(np.abs(across - offset).max())
