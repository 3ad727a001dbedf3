"""Articulated rods of V engines, Gots figure 2 в: exact kinematics and statics.

The articulated rod hangs on a pin of the master rod at the radius ρ from the crankpin,
turned by γ_п from the master rod's axis.  Everything follows from the coordinates of
that pin: the book gives no formulas.  There is no two-term form; both methods take the
exact acceleration of these pistons.

Angles φ are those of the articulated cylinder: its crank is parallel to its axis at
φ = 0, the master cylinder's angle is φ plus the angle between the banks.  Functions are
elementwise: their arrays broadcast with (engines, articulated rods, angles).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from kshm.arrays import Array
from kshm.mechanics.kinematics import Stroke, volume_ratio

_NEWTON_STEPS = 8
_SCAN = np.radians(np.arange(-60.0, 61.0, 1.0))


@dataclass(frozen=True, slots=True)
class Linkage:
    """Geometry of every articulated rod, shape (engines, rods, 1); SI."""

    r: Array
    rod_length: Array  # of the master rod
    offset: Array  # e, the same for both banks in their own frames
    bank: Array  # from the master cylinder's axis to the own one
    radius: Array
    angle: Array
    own_length: Array


@dataclass(frozen=True, slots=True)
class Point:
    """The articulated pin in its cylinder's frame with two derivatives by φ [m].

    ``along`` runs up the cylinder's axis, ``across`` to the side of rotation.
    ``beta`` is the master rod's angle [rad].
    """

    beta: Array
    along: tuple[Array, Array, Array]
    across: tuple[Array, Array, Array]


@dataclass(frozen=True, slots=True)
class ArticulatedMotion:
    """Articulated piston: height of its pin over the shaft with derivatives [m], β_п [rad]."""

    height: tuple[Array, Array, Array]
    beta: Array
    pin: Point


def articulated_pin(phi: Array, link: Linkage) -> Point:
    """Path of the articulated pin [m], elementwise, from the master rod, Gots figure 2 в."""
    alpha = phi + link.bank
    lam = link.r / link.rod_length
    beta = np.arcsin((link.r * np.sin(alpha) - link.offset) / link.rod_length)
    first = lam * np.cos(alpha) / np.cos(beta)
    second = (np.sin(beta) * first**2 - lam * np.sin(alpha)) / np.cos(beta)
    # Direction of ρ from the cylinder's axis; it turns against β.
    chi = link.angle - link.bank - beta
    cos, sin = link.radius * np.cos(chi), link.radius * np.sin(chi)
    return Point(
        beta,
        along=(
            link.r * np.cos(phi) + cos,
            -link.r * np.sin(phi) + sin * first,
            -link.r * np.cos(phi) - cos * first**2 + sin * second,
        ),
        across=(
            link.r * np.sin(phi) + sin,
            link.r * np.cos(phi) - cos * first,
            -link.r * np.sin(phi) - sin * first**2 - cos * second,
        ),
    )


def motion(phi: Array, link: Linkage) -> ArticulatedMotion:
    """Motion of the articulated piston [m], exact, elementwise, Gots figure 2 в."""
    pin = articulated_pin(phi, link)
    side, side_1, side_2 = pin.across
    side = side - link.offset
    up = np.sqrt(link.own_length**2 - side**2)
    up_1 = -side * side_1 / up
    up_2 = -(side_1**2 + side * side_2 + up_1**2) / up
    along, along_1, along_2 = pin.along
    height = (along + up, along_1 + up_1, along_2 + up_2)
    return ArticulatedMotion(height, np.arcsin(side / link.own_length), pin)


def dead_centres(link: Linkage) -> tuple[Array, Array]:
    """Crank angles of TDC and BDC [rad], shape (engines, rods, 1), where Gots 1.4 has none.

    Near 0 and π, by Newton's steps to where the piston's speed vanishes.
    """
    centres = []
    for start, sign in ((0.0, 1.0), (np.pi, -1.0)):
        grid = start + _SCAN
        heights = sign * motion(grid, link).height[0]
        phi = grid[np.argmax(heights, axis=-1)][..., None]
        for _ in range(_NEWTON_STEPS):
            _, speed, change = motion(phi, link).height
            phi = phi - speed / change
        centres.append(phi)
    return centres[0], centres[1]


@dataclass(frozen=True, slots=True)
class RodPinForces:
    """Forces of the articulated rod on the crankpin and the master piston's wall.

    ``K`` and ``T`` are the components on the crankpin of its own push and of the side
    force ``N_added`` that it makes on the master piston; ``moment`` is the moment of the
    push about the crankpin over the piston area, which bends the master rod.
    """

    K: Array
    T: Array
    N_added: Array
    moment: Array


def pin_forces(
    axial: Array, phi: Array, piston: ArticulatedMotion, link: Linkage, inertia_unit: Array
) -> RodPinForces:
    """Forces of an articulated rod by statics of the massless rods, elementwise, Gots figure 2 в.

    The rod pushes its pin along itself; the pin's own mass adds its inertia force.  The
    master rod in equilibrium carries the moment of this push about the crankpin to the
    wall of its cylinder, so the master piston's side force grows by moment/(L cosβ).

    Args:
        axial: force along the articulated cylinder's axis over the piston area [Pa].
        phi: angle of that cylinder [rad].
        piston: its motion at ``phi``.
        link: geometry.
        inertia_unit: mass on the articulated pin times ω² over the piston area [Pa/m].
    """
    side = axial * np.tan(piston.beta) - inertia_unit * piston.pin.across[2]
    up = -axial - inertia_unit * piston.pin.along[2]
    # Into the master cylinder's frame: x to the side of rotation, y up its axis.
    cos, sin = np.cos(link.bank), np.sin(link.bank)
    x, y = side * cos + up * sin, up * cos - side * sin
    turn = link.angle - piston.pin.beta
    moment = link.radius * (np.sin(turn) * y - np.cos(turn) * x)
    added = moment / (link.rod_length * np.cos(piston.pin.beta))
    alpha = phi + link.bank
    radial = (x + added) * np.sin(alpha) + y * np.cos(alpha)
    tangential = (x + added) * np.cos(alpha) - y * np.sin(alpha)
    return RodPinForces(K=-radial, T=tangential, N_added=added, moment=moment)


@dataclass(frozen=True, slots=True)
class ArticulatedArrays:
    """Articulated rods of all engines, shape (engines, rods, 1); SI."""

    link: Linkage
    reciprocating: Array
    big_end: Array
    cylinders: tuple[int, ...]  # those that hang on others


@dataclass(frozen=True, slots=True)
class Hung:
    """Everything about the cylinders of articulated rods, shape (engines, rods, angles)."""

    motion: ArticulatedMotion
    volume: Stroke
    displacement: Array  # from the piston's own TDC [m]
    stroke: Array
    volume_ratio: Array
    p: Array
    p_inertia: Array
    N: Array
    S: Array
    on_pin: RodPinForces


def hang(
    rods: ArticulatedArrays,
    phi: Array,
    eps: Array,
    pressure: Callable[[Array, Stroke], Array],
    p_ambient: Array,
    omega: Array,
    area: Array,
) -> Hung:
    """Kinematics and forces of all articulated rods at their cylinders' angles ``phi`` [rad].

    By the geometry of Gots figure 2 в; shape (engines, rods, angles), SI.  ``pressure``
    gives the gas pressure for V/V_c at ``phi`` and the motion of these pistons; their
    clearance volume follows from their own stroke and the engine's compression ratio.
    """
    link = rods.link
    tdc, bdc = dead_centres(link)
    top, bottom = motion(tdc, link).height[0], motion(bdc, link).height[0]

    def ratio(angle: Array) -> Array:
        return volume_ratio(top - motion(angle, link).height[0], top - bottom, eps)

    piston, volume = motion(phi, link), Stroke(ratio, tdc, bdc)
    moved = top - piston.height[0]
    in_cylinder = volume_ratio(moved, top - bottom, eps)
    p = pressure(in_cylinder, volume)
    # The second derivative points up where the piston is thrown towards the head.
    inertia = rods.reciprocating * omega**2 * piston.height[2] / area
    axial = p - p_ambient + inertia
    return Hung(
        motion=piston,
        volume=volume,
        displacement=moved,
        stroke=top - bottom,
        volume_ratio=in_cylinder,
        p=p,
        p_inertia=inertia,
        N=axial * np.tan(piston.beta),
        S=axial / np.cos(piston.beta),
        on_pin=pin_forces(axial, phi, piston, link, rods.big_end * omega**2 / area),
    )
