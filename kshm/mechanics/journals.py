"""Main-journal reactions by the split scheme, Gots 2.7, from statics of each throw.

Each throw is a beam on two supports in its own frame: ``up`` along the crank,
``left`` a quarter turn against rotation.  All results are reactions of the
bearings on the shaft; loads on the bearings are their negatives.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class ThrowArrays:
    """Throws as arrays of shape (engines, throws); metres, kilograms, radians."""

    angle: Array
    arms: Array  # (engines, throws, 6): l1 … l6
    left_web_thickness: Array
    right_web_thickness: Array
    web_mass: Array  # (engines, throws, 2): left, right
    web_angle: Array
    counterweight_mass: Array
    counterweight_angle: Array
    pin_mass: Array
    end_mass: Array  # (engines, 2): nose, rear
    end_angle: Array
    end_arm: Array


@dataclass(frozen=True, slots=True)
class Positions:
    """Places along the throw from the left support [m], shape (engines, throws)."""

    left_web: Array
    rod: Array
    right_rod: Array  # the second rod of a V engine's throw
    pin: Array
    right_web: Array
    length: Array


@dataclass(frozen=True, slots=True)
class Rods:
    """Which throw carries each rod, and where; arrays of shape (engines, cylinders)."""

    throw: tuple[int, ...]
    place: tuple[int, ...]  # 0 the rod nearer to the nose, 1 the other
    turn: Array  # δ: how far a split pin's half stands ahead of its throw [rad]
    mass: Array  # m_2 that turns with the pin [kg]

    def summed(self, values: Array, throws: int) -> Array:
        """Sum over the rods of every throw: (engines, cylinders, …) to (engines, throws, …)."""
        if self.throw == tuple(range(throws)):  # a rod on each throw
            return values
        total = np.zeros((values.shape[0], throws, *values.shape[2:]))
        for rod, throw in enumerate(self.throw):
            total[:, throw] += values[:, rod]
        return total

    def places(self, found: Positions) -> Array:
        """Distance of each rod from its throw's left support [m], (engines, cylinders)."""
        both = (found.rod, found.right_rod)
        columns = [
            both[place][:, throw] for throw, place in zip(self.throw, self.place, strict=True)
        ]
        return np.stack(columns, axis=1)


def in_throw_frame(K: Array, T: Array, turn: Array) -> tuple[Array, Array]:
    """Forces K and T on a split pin's half as components of its throw's frame.

    ``turn`` [rad] is how far the half stands ahead of the throw; it broadcasts.
    """
    if not np.any(turn):
        return K, T
    cos, sin = np.cos(turn), np.sin(turn)
    return K * cos + T * sin, T * cos - K * sin


def positions(throws: ThrowArrays) -> Positions:
    """Places of webs, rods and pin along each throw, Gots figures 35 and 36."""
    l1, l2, l3, l4, l5, l6 = np.moveaxis(throws.arms, -1, 0)
    h_left, h_right = throws.left_web_thickness, throws.right_web_thickness
    rod = l1 + h_left + l2
    right = rod + l3 + l4 + l5
    return Positions(
        left_web=l1 + h_left / 2,
        rod=rod,
        right_rod=rod + l3 + l4,
        pin=rod + l3,
        right_web=right + h_right / 2,
        length=right + h_right + l6,
    )


def right_share(place: Array, length: Array) -> Array:
    """Share of a load at ``place`` carried by the right support [-]; may lie outside 0…1."""
    return place / length


def centrifugal_reactions(
    throws: ThrowArrays, r: Array, omega: Array, rods: Rods
) -> tuple[Array, Array]:
    """Constant reactions of both supports to centrifugal forces [N], Gots (44)-(49).

    With two rods on a throw C_3 is the mass m_2 of the left one, C_5 that of the right one.
    Half of a split pin's mass stands in the direction of each half, in the middle of the pin.

    Args:
        throws: shape (engines, throws).
        r: crank radius [m], shape (engines, 1).
        omega: angular velocity [rad/s], same shape.
        rods: the rods on the throws.

    Returns:
        Left and right reactions, shape (engines, throws, 2), the last axis being
        ``left`` (against rotation) and ``up`` (along the crank).
    """
    unit = r * omega**2
    place = positions(throws)
    count = place.rod.shape[1]
    up, ahead = np.cos(rods.turn), np.sin(rods.turn)
    carried = rods.summed(np.ones_like(rods.turn), count)
    pin_up, pin_ahead = (rods.summed(part, count) / carried for part in (up, ahead))
    loads: list[tuple[Array, Array, Array]] = []
    for which, where in enumerate((place.rod, place.right_rod)):
        mass = rods.mass * (np.array(rods.place) == which)
        along, across = (rods.summed(mass * part, count) * unit for part in (up, ahead))
        loads.append((where, along, -across))
    pin = throws.pin_mass * unit
    loads.append((place.pin, pin * pin_up, -pin * pin_ahead))
    for side, where in enumerate((place.left_web, place.right_web)):
        web = throws.web_mass[..., side] * unit
        web_angle = throws.web_angle[..., side]
        loads.append((where, web * np.cos(web_angle), web * np.sin(web_angle)))
        # A counterweight stands opposite the crank, turned on in the direction of rotation:
        # from "down" rotation leads to "left".
        weight = throws.counterweight_mass[..., side] * unit
        angle = throws.counterweight_angle[..., side]
        loads.append((where, -weight * np.cos(angle), weight * np.sin(angle)))
    loads.extend(_end_loads(throws, place, unit))

    left = np.zeros((*place.rod.shape, 2))
    right = np.zeros_like(left)
    for where, up, side_force in loads:
        share = right_share(where, place.length)
        vector = np.stack(np.broadcast_arrays(side_force, up), axis=-1)
        right -= share[..., None] * vector
        left -= (1 - share)[..., None] * vector
    return left, right


def _end_loads(
    throws: ThrowArrays, place: Positions, unit: Array
) -> list[tuple[Array, Array, Array]]:
    """External counterweights as overhung loads on the first and the last throw."""
    count = place.rod.shape[-1]
    force = throws.end_mass * unit
    up, turned = force * np.cos(throws.end_angle), force * np.sin(throws.end_angle)
    first = np.arange(count) == 0
    last = np.arange(count) == count - 1
    nose_place = np.broadcast_to(-throws.end_arm[:, :1], place.rod.shape)
    rear_place = place.length + throws.end_arm[:, 1:]
    return [
        # The nose angle runs with rotation, hence away from "left"; the rear angle against it.
        (nose_place, first * up[:, :1], first * -turned[:, :1]),
        (rear_place, last * up[:, 1:], last * turned[:, 1:]),
    ]


def to_shaft_axes(vector: Array, gamma: Array) -> Array:
    """Turn (left, up) components of a throw at γ clockwise from crank 1 to shaft axes x, y.

    Args:
        vector: shape (..., 2).
        gamma: angle [rad], broadcasting with ``vector`` without its last axis.
    """
    return np.stack(_turned(vector[..., 0], vector[..., 1], gamma), axis=-1)


def _turned(left: Array, up: Array, gamma: Array) -> tuple[Array, Array]:
    cos, sin = np.cos(gamma), np.sin(gamma)
    return left * cos - up * sin, left * sin + up * cos


def main_reactions(
    K: Array, T: Array, throws: ThrowArrays, rods: Rods, constant: tuple[Array, Array]
) -> tuple[Array, Array, Array]:
    """Reactions of every main bearing on its journal in shaft axes, Gots (50)-(57).

    Args:
        K: force of each rod towards the crank axis in its throw's frame,
            (engines, cylinders, angles); all forces are in one unit.
        T: force of each rod along the rotation in its throw's frame, same shape.
        throws: the throws.
        rods: the rods on the throws.
        constant: left and right centrifugal reactions, see ``centrifugal_reactions``.

    Returns:
        Total (engines, journals, angles, 2) and the shares of the throw before and
        after each journal, same shape; the last axis is x, y.
    """
    place = positions(throws)
    count = place.rod.shape[1]
    length = place.length[:, list(rods.throw)]
    share = right_share(rods.places(place), length)[..., None]
    # A push along T is answered against rotation ("left"), a push K inwards by "up".
    answers = _turned(T, K, throws.angle[:, list(rods.throw)][:, :, None])
    # x and y apart in memory: arithmetic runs over whole rows.
    before = np.empty((2, K.shape[0], count + 1, K.shape[-1]))
    after = np.empty_like(before)
    before[:, :, 0], after[:, :, -1] = 0, 0
    sides = ((after[:, :, :-1], constant[0], 1 - share), (before[:, :, 1:], constant[1], share))
    for target, steady, part in sides:
        still = _turned(steady[..., 0], steady[..., 1], throws.angle)
        for axis in (0, 1):
            moving = rods.summed(part * answers[axis], count)
            np.add(still[axis][..., None], moving, out=target[axis])
    total, first, second = (np.moveaxis(v, 0, -1) for v in (before + after, before, after))
    return total, first, second


def side_forces_left_of_pin(throws: ThrowArrays, r: Array, omega: Array) -> Array:
    """Centrifugal forces against rotation acting left of each crankpin [N], (engines, throws)."""
    unit = r * omega**2
    web = throws.web_mass[..., 0] * np.sin(throws.web_angle[..., 0])
    weight = throws.counterweight_mass[..., 0] * np.sin(throws.counterweight_angle[..., 0])
    nose = throws.end_mass[:, :1] * np.sin(throws.end_angle[:, :1])
    first = np.arange(web.shape[-1]) == 0
    side: Array = unit * (web + weight - first * nose)
    return side
