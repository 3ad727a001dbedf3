"""Loads on main and big-end bearings, Gots 2.6 and 2.7.

Split scheme: each throw is a beam on two supports in its own frame, ``up`` along the crank,
``left`` a quarter turn against rotation.  All results are reactions of the bearings on the
shaft; loads on the bearings are their negatives.

Continuous shaft, by the equation of three moments, Gots (54): a straight beam of one bending
stiffness in both planes on rigid point supports in a line, so that the stiffness itself falls
out; the throws are as stiff as the journals between them.  Moments are those that a load along
the axis would make in a simple beam, axes are those of the shaft (x left, y up along crank 1,
turning with it).  In (54) the second subscript of the last moment is read as the right support.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from kshm.arrays import Array
from kshm.engine.arrangement import rods_beside
from kshm.engine.crankshaft import Places
from kshm.engine.engine import Engine
from kshm.mechanics.kinematics import Position

PLANES = 18  # planes through the pin's axis, every 10°


@dataclass(frozen=True, slots=True)
class ThrowArrays:
    """Throws as arrays of shape (engines, throws); metres, kilograms, radians."""

    angle: Array
    places: Places[Array]
    web_mass: Array  # (engines, throws, 2): left, right
    web_angle: Array
    counterweight_mass: Array
    counterweight_angle: Array
    pin_mass: Array
    end_mass: Array  # (engines, 2): nose, rear
    end_angle: Array
    end_arm: Array


@dataclass(frozen=True, slots=True)
class Rods:
    """Throw and position of each rod; arrays of shape (engines, cylinders)."""

    throw: tuple[int, ...]
    positions: tuple[float, ...]  # along the pin: 0 nearest to the nose, 1 farthest
    turn: Array  # δ: how far a split pin's part stands ahead of its throw [rad]
    mass: Array  # m_2 that turns with the pin [kg]

    def summed(self, values: Array, throws: int) -> Array:
        """Sum over the rods of every throw, in the unit of ``values`` [any], Gots 2.7.2.

        Shape (engines, cylinders, …) becomes (engines, throws, …).
        """
        if self.throw == tuple(range(throws)):  # a rod on each throw
            return values
        total = np.zeros((values.shape[0], throws, *values.shape[2:]))
        for rod, throw in enumerate(self.throw):
            total[:, throw] += values[:, rod]
        return total

    def shares(self, positions: Places[Array]) -> Array:
        """Share [-] of each rod's load on its throw's right support, by statics, Gots (50)-(53).

        Shape (engines, cylinders); it may lie outside 0…1.
        """
        on_throws = [
            (positions.rod_at(position) / positions.length)[:, throw]
            for throw, position in zip(self.throw, self.positions, strict=True)
        ]
        return np.stack(on_throws, axis=1)


class Load(NamedTuple):
    """A force on a throw: its place [m] and components [N], shape (engines, throws)."""

    position: Array
    left: Array
    up: Array


def in_throw_frame(K: Array, T: Array, turn: Array) -> tuple[Array, Array]:
    """Return forces K and T [N or Pa] on a split pin's part in its throw's frame, Gots 2.7.2.

    ``turn`` [rad] is how far the part stands ahead of the throw; its shape broadcasts.
    """
    if not np.any(turn):
        return K, T
    cos, sin = np.cos(turn), np.sin(turn)
    return K * cos + T * sin, T * cos - K * sin


def own_loads(throws: ThrowArrays, unit: Array, pin_up: Array, pin_ahead: Array) -> list[Load]:
    """Centrifugal forces [N] of pins, webs and counterweights, Gots (44)-(49).

    Args:
        throws: shape (engines, throws).
        unit: rω² [m/s²], shape (engines, 1).
        pin_up: share of the pin's mass that stands along the crank [-], as ``throws``.
        pin_ahead: share that stands a quarter turn ahead, with a split pin.
    """
    positions = throws.places
    pin = throws.pin_mass * unit
    loads = [Load(positions.pin, -pin * pin_ahead, pin * pin_up)]
    for side, where in enumerate((positions.left_web, positions.right_web)):
        web, angle = throws.web_mass[..., side] * unit, throws.web_angle[..., side]
        loads.append(Load(where, web * np.sin(angle), web * np.cos(angle)))
        # A counterweight stands opposite the crank, turned on in the direction of rotation:
        # from "down" rotation leads to "left".
        weight = throws.counterweight_mass[..., side] * unit
        angle = throws.counterweight_angle[..., side]
        loads.append(Load(where, weight * np.sin(angle), -weight * np.cos(angle)))
    return loads


def end_loads(throws: ThrowArrays, unit: Array) -> tuple[Load, Load]:
    """External counterweights as overhung loads [N], Gots 2.7: on the first throw, on the last.

    Args:
        throws: shape (engines, throws).
        unit: rω² [m/s²], shape (engines, 1).
    """
    force, count = throws.end_mass * unit, throws.angle.shape[-1]
    up, turned = force * np.cos(throws.end_angle), force * np.sin(throws.end_angle)
    first, last = np.arange(count) == 0, np.arange(count) == count - 1
    length = throws.places.length
    nose = np.broadcast_to(-throws.end_arm[:, :1], length.shape)
    # The nose angle runs with rotation, hence away from "left"; the rear angle against it.
    return (
        Load(nose, first * -turned[:, :1], first * up[:, :1]),
        Load(length + throws.end_arm[:, 1:], last * turned[:, 1:], last * up[:, 1:]),
    )


def pin_directions(rods: Rods, throws: int) -> tuple[Array, Array]:
    """Shares of the pins' masses along the crank and ahead of it [-], (engines, throws).

    Each rod's part of a split pin has an equal share of the pin's mass; Gots 2.7.2 has no
    split pins.  Shape (engines, throws).
    """
    up, ahead = np.cos(rods.turn), np.sin(rods.turn)
    carried = rods.summed(np.ones_like(up), throws)
    return rods.summed(up, throws) / carried, rods.summed(ahead, throws) / carried


def centrifugal_reactions(throws: ThrowArrays, unit: Array, rods: Rods) -> tuple[Array, Array]:
    """Constant reactions of both supports to centrifugal forces [N], Gots (44)-(49).

    With two rods on a throw C_3 is the mass m_2 of the left one, C_5 that of the right one.

    Args:
        throws: shape (engines, throws).
        unit: rω² [m/s²], shape (engines, 1).
        rods: the rods on the throws.

    Returns:
        Left and right reactions, shape (engines, throws, 2), the last axis being
        ``left`` (against rotation) and ``up`` (along the crank).
    """
    count = throws.angle.shape[1]
    up, ahead = np.cos(rods.turn), np.sin(rods.turn)
    loads = [*own_loads(throws, unit, *pin_directions(rods, count)), *end_loads(throws, unit)]
    left = np.zeros((*throws.angle.shape, 2))
    right = np.zeros_like(left)
    share = rods.shares(throws.places)
    for axis, part in enumerate((-ahead, up)):
        force = rods.mass * part
        right[..., axis] -= rods.summed(share * force, count) * unit
        left[..., axis] -= rods.summed((1 - share) * force, count) * unit
        for load in loads:
            size, at = load[1 + axis], load.position / throws.places.length
            right[..., axis] -= at * size
            left[..., axis] -= (1 - at) * size
    return left, right


def to_shaft_axes(left: Array, up: Array, gamma: Array) -> tuple[Array, Array]:
    """Components x, y [N or Pa] of a throw's ``left`` and ``up``, elementwise, Gots 2.7.1.

    ``gamma`` [rad] is the throw's angle clockwise from crank 1.
    """
    cos, sin = np.cos(gamma), np.sin(gamma)
    return left * cos - up * sin, left * sin + up * cos


def main_reactions(
    K: Array, T: Array, throws: ThrowArrays, rods: Rods, constant: tuple[Array, Array]
) -> tuple[Array, Array, Array]:
    """Reactions of every main bearing on its journal in shaft axes, Gots (50)-(57).

    Args:
        K: force of each rod towards the crank axis in its throw's frame [N or Pa],
            shape (engines, cylinders, angles).
        T: force of each rod along the rotation in its throw's frame, same shape.
        throws: the throws.
        rods: the rods on the throws.
        constant: left and right centrifugal reactions, see ``centrifugal_reactions``.

    Returns:
        Total (engines, journals, angles, 2) and the shares of the throw before and
        after each journal, same shape; the last axis is x, y.
    """
    count = throws.angle.shape[1]
    share = rods.shares(throws.places)[..., None]
    # A push along T is answered against rotation ("left"), a push K inwards by "up".
    answers = to_shaft_axes(T, K, throws.angle[:, list(rods.throw)][:, :, None])
    # x and y apart in memory: arithmetic runs over whole rows.
    before = np.empty((2, K.shape[0], count + 1, K.shape[-1]))
    after = np.empty_like(before)
    before[:, :, 0], after[:, :, -1] = 0, 0
    sides = ((after[:, :, :-1], constant[0], 1 - share), (before[:, :, 1:], constant[1], share))
    for target, steady, part in sides:
        still = to_shaft_axes(steady[..., 0], steady[..., 1], throws.angle)
        for axis in (0, 1):
            moving = rods.summed(part * answers[axis], count)
            np.add(still[axis][..., None], moving, out=target[axis])
    total, first, second = (np.moveaxis(v, 0, -1) for v in (before + after, before, after))
    return total, first, second


def side_forces_left_of_pin(throws: ThrowArrays, unit: Array) -> Array:
    """Centrifugal forces against rotation left of each crankpin [N], (engines, throws), statics.

    ``unit`` is rω² [m/s²] of shape (engines, 1).
    """
    web = throws.web_mass[..., 0] * np.sin(throws.web_angle[..., 0])
    weight = throws.counterweight_mass[..., 0] * np.sin(throws.counterweight_angle[..., 0])
    return unit * (web + weight) + end_loads(throws, unit)[0].left


def rod_bearing(inward: Array, ahead: Array, at: Position) -> tuple[Array, Array]:
    """Load on the big-end bearing in the rod's axes [Pa], shape (angles,), Gots 2.6.

    The load is the opposite of the force on the pin, turned into axes along the rod (y,
    towards the piston pin) and across it (x, in the direction of rotation at the pin).

    Args:
        inward: force of the rod on the pin towards the shaft with m_2's [Pa].
        ahead: force along the rotation [Pa].
        at: position of crank and rod.
    """
    across = inward * at.sin - ahead * at.cos  # on the bearing, in the cylinder's axes
    along = inward * at.cos + ahead * at.sin
    return (
        across * at.cos_beta + along * at.sin_beta,
        along * at.cos_beta - across * at.sin_beta,
    )


def rod_width(engine: Engine, cylinder: int) -> float:
    """Width of the big-end bearing of a cylinder's (from 0) pin that carries [m], Gots 2.6.

    That of the data on bearings, else the pin's part under one of its rods; less the groove.
    """
    data, shaft = engine.bearings, engine.crankshaft
    rods = rods_beside(engine.arrangement, cylinder)
    width = shaft.pin_lengths[engine.arrangement[cylinder].throw] / rods
    return width if data is None else (data.pin_width or width) - data.pin_groove


def on_plane(inward: Array, ahead: Array, angle: float) -> Array:
    """Projection of R_к on a plane of the pin [Pa], shape (angles,), Gots 2.6, (42).

    Args:
        inward: K_Σ towards the shaft with all centrifugal forces [Pa].
        ahead: T along the rotation [Pa].
        angle: of the plane from the crank against rotation [rad].
    """
    projection: Array = inward * np.cos(angle) + ahead * np.sin(angle)
    return projection


def plane_angles() -> Array:
    """Angles of the planes from the crank against rotation [rad], shape (planes,), Gots 2.6."""
    return np.pi / PLANES * np.arange(PLANES, dtype=np.float64)


def load_terms(loads: Iterable[Load], length: Array, shape: tuple[int, ...]) -> tuple[Array, Array]:
    """Load terms Σ P a(l² − a²)/l and Σ P b(l² − b²)/l of spans [N·m²], Clapeyron, Gots (54).

    Args:
        loads: forces on the spans; their arrays broadcast with ``shape``.
        length: lengths of the spans l [m], broadcasting likewise.
        shape: of the terms without the last axis ``left``, ``up``.

    Returns:
        Terms of the right and of the left support, shape (*shape, 2).
    """
    right, left = np.zeros((*shape, 2)), np.zeros((*shape, 2))
    for load in loads:
        right_span = length - load.position
        for axis, force in enumerate((load.left, load.up)):
            right[..., axis] += force * load.position * (length**2 - load.position**2) / length
            left[..., axis] += force * right_span * (length**2 - right_span**2) / length
    return right, left


def support_moments(spans: Array, right: Array, left: Array, ends: Array) -> Array:
    """Bending moments at all supports by Clapeyron's equation [N·m], Gots (54).

    Args:
        spans: lengths of the spans [m], shape (n,).
        right: Σ P a(l² − a²)/l of each span [N·m²], shape (n, …).
        left: Σ P b(l² − b²)/l of each span [N·m²], same shape.
        ends: moments at the first and the last support from the overhangs, shape (2, …).

    Returns:
        Shape (n + 1, …).
    """
    count = len(spans)
    moments = np.zeros((count + 1, *right.shape[1:]))
    moments[0], moments[-1] = ends[0], ends[1]
    if count == 1:
        return moments
    matrix = np.diag(2 * (spans[:-1] + spans[1:]))
    matrix += np.diag(spans[1:-1], 1) + np.diag(spans[1:-1], -1)
    outer = -(right[:-1] + left[1:])
    outer[0] -= spans[0] * ends[0]
    outer[-1] -= spans[-1] * ends[1]
    flat = outer.reshape(count - 1, -1)
    moments[1:-1] = np.linalg.solve(matrix, flat).reshape(outer.shape)
    return moments


def corrections(spans: Array, moments: Array) -> Array:
    """Reactions added by inner support moments to the split scheme's [N], Gots (54).

    The overhangs are in the split scheme already, so the end moments add nothing here.
    Shapes (n,) of the spans [m] and (n + 1, …) of the moments [N·m] and of the result.
    """
    inner = moments.copy()
    inner[0] = inner[-1] = 0
    steps = np.diff(inner, axis=0) / spans.reshape(-1, *([1] * (inner.ndim - 1)))
    added = np.zeros_like(inner)
    added[:-1] -= steps
    added[1:] += steps
    return added
