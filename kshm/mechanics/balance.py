"""Free forces and moments of an engine by orders, as rotating phasors; balancing of them.

A quantity of order n is kept as the complex number Q of  q(φ) = Re(Q·exp(i·n·φ)), a
vector across the crankshaft as two of them, shape (2,): ``up`` (to the cylinder heads)
and ``right`` (seen from the nose, the side to which rotation leads from up).  Places run
along the shaft from the middle of the main journals towards the flywheel [m].

Reciprocating masses follow the exact series of the acceleration, Neiman (36).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from kshm.arrays import Array
from kshm.engine.arrangement import hung, throws
from kshm.engine.engine import Engine
from kshm.mechanics.harmonics import acceleration_amplitude
from kshm.mechanics.masses import point_masses

Phasors = NDArray[np.complex128]


@dataclass(frozen=True, slots=True)
class Cylinders:
    """Cylinders of any layout: TDC phases [rad], places [m], axes clockwise from up [rad]."""

    phase: Array
    position: Array
    axis: Array


@dataclass(frozen=True, slots=True)
class Ellipse:
    """Path of a vector of one order: greatest and smallest length, direction [rad].

    The direction is that of the greatest length, clockwise from up, in (−π/2, π/2];
    zero where the vector keeps its length.
    """

    largest: float
    smallest: float
    direction: float


def throw_starts(engine: Engine) -> Array:
    """Places of the main journals [m], shape (journals,), Gots figure 35."""
    lengths = [throw.length for throw in engine.crankshaft.throws]
    ends = np.concatenate([[0.0], np.cumsum(lengths)])
    positions: Array = ends - ends[-1] / 2
    return positions


def is_balanced_by_orders(engine: Engine) -> bool:
    """Whether the orders of Neiman's series describe all pistons: central, no articulated rods."""
    return engine.geometry.is_central and not hung(engine.arrangement)


def rod_places(engine: Engine) -> Array:
    """Place of every cylinder's rod along the shaft [m], shape (cylinders,), Gots figure 36."""
    starts, shaft = throw_starts(engine), engine.crankshaft.throws
    return np.array(
        [starts[c.throw] + shaft[c.throw].places.rod_at(c.rod_place) for c in engine.arrangement]
    )


def pin_angles(engine: Engine) -> Array:
    """Angle of every cylinder's pin from crank 1 [rad], clockwise, shape (cylinders,), Gots 2.7."""
    shaft = engine.crankshaft.throws
    return np.array([shaft[c.throw].angle + c.pin_angle for c in engine.arrangement])


def cylinders_of(engine: Engine) -> Cylinders:
    """Cylinders of an engine; "up" is the axis of cylinder 1."""
    axes = np.array([cylinder.axis for cylinder in engine.arrangement])
    return Cylinders(np.array(engine.firing_offsets), rod_places(engine), axes)


def order_phasors(cylinders: Cylinders, order: float, weights: Array | None = None) -> Phasors:
    """Vector sum of unit forces cos(order·(φ − θ_i)) along the cylinder axes [-], Neiman (36).

    Args:
        cylinders: the cylinders.
        order: order n.
        weights: one per cylinder, shape (cylinders,); their places [m] give the moment.
    """
    unit = np.exp(-1j * order * cylinders.phase)
    if weights is not None:
        unit = unit * weights
    return np.array([np.sum(unit * np.cos(cylinders.axis)), np.sum(unit * np.sin(cylinders.axis))])


def inertia_unit(engine: Engine) -> float:
    """First-order inertia force of one cylinder m_j r ω² [N], Gots (31)."""
    m_j, _ = point_masses(engine.masses, engine.geometry.rod_length)
    return m_j * engine.geometry.crank_radius * engine.omega**2


def reciprocating(engine: Engine, cylinders: Cylinders, order: int) -> tuple[Phasors, Phasors]:
    """Free force [N] and moment [N·m] of one order, each of shape (2,), Neiman (36).

    Of all reciprocating masses, directed away from the crankshaft where the pistons are
    thrown upwards.
    """
    amplitude = inertia_unit(engine) * acceleration_amplitude(engine.geometry.lam, order)
    force = order_phasors(cylinders, order)
    moment = order_phasors(cylinders, order, cylinders.position)
    return force * amplitude, moment * amplitude


def turning(vector: complex) -> Phasors:
    """Return a vector [N or N·m] that turns with the shaft, shape (2,), Gots 2.2.

    ``vector`` = up + i·right at φ = 0.
    """
    return np.array([vector, -1j * vector])


def turning_parts(vector: Phasors) -> tuple[complex, complex]:
    """Two vectors [N or N·m] that turn with and against rotation and make one of shape (2,).

    Lanchester's shafts answer them.
    """
    up, right = vector
    along, against = up + 1j * right, np.conj(up) + 1j * np.conj(right)
    return complex(along / 2), complex(against / 2)


def ellipse(vector: Phasors, noise: float = 0.0) -> Ellipse:
    """Lengths of a vector of one order and its direction [rad], shape (2,), Neiman (36).

    Args:
        vector: the vector.
        noise: a length below which a part counts as zero.
    """
    along, against = turning_parts(vector)
    first, second = abs(along), abs(against)
    direction = 0.0
    if min(first, second) > noise:
        # The angle of the product is taken modulo 2π, hence the direction modulo π.
        direction = float(np.angle(along * against)) / 2
        # −90° and 90° are one direction: within a millionth of a degree it is 90°.
        if direction < -np.pi / 2 + np.radians(1e-6):
            direction += np.pi
    return Ellipse(first + second, abs(first - second), direction)


def rotating(engine: Engine, *, counterweights: bool) -> tuple[complex, complex]:
    """Centrifugal force [N] and moment [N·m] of the shaft at φ = 0 as up + i·right."""
    mass, angle, position = np.array(_masses(engine, counterweights=counterweights)).T
    vectors = mass * engine.geometry.crank_radius * engine.omega**2 * np.exp(1j * angle)
    return complex(vectors.sum()), complex((position * vectors).sum())


def _masses(engine: Engine, *, counterweights: bool) -> list[tuple[float, float, float]]:
    """Mass at the crank radius [kg], angle clockwise from crank 1 [rad], place [m]."""
    _, m_2 = point_masses(engine.masses, engine.geometry.rod_length)
    shaft, starts, angles = engine.crankshaft, throw_starts(engine), pin_angles(engine)
    masses = [(m_2, a, z) for a, z in zip(angles, rod_places(engine), strict=True)]
    groups = throws(engine.arrangement)
    for throw, start, rods in zip(shaft.throws, starts[:-1], groups, strict=True):
        positions = throw.places
        # Each rod's part of a split pin has an equal share of the pin's mass.
        masses += [(throw.pin_mass / len(rods), angles[i], start + positions.pin) for i in rods]
        webs = ((throw.left_web, positions.left_web), (throw.right_web, positions.right_web))
        for web, at in webs:
            # A web's angle runs against rotation, a counterweight's with it from "opposite".
            masses.append((web.mass, throw.angle - web.angle, start + at))
            if counterweights:
                opposite = throw.angle + np.pi + web.counterweight_angle
                masses.append((web.counterweight_mass, opposite, start + at))
    if counterweights:
        nose, rear = shaft.nose, shaft.rear
        masses.append((nose.mass, shaft.throws[0].angle + nose.angle, starts[0] - nose.arm))
        masses.append((rear.mass, shaft.throws[-1].angle - rear.angle, starts[-1] + rear.arm))
    return masses


def ideal_counterweights(engine: Engine) -> tuple[complex, complex]:
    """Force [N] and moment [N·m] of masses m_j opposite every crankpin, up + i·right at φ = 0.

    One for each rod; a share of them balances that share of its first-order force.
    """
    vectors = -inertia_unit(engine) * np.exp(1j * pin_angles(engine))
    return complex(vectors.sum()), complex((vectors * rod_places(engine)).sum())


def shaft_moments(engine: Engine) -> tuple[tuple[float, float], tuple[float, float]]:
    """Mass times radius of the two shafts of a pair, orders 1 and 2 [kg·m].

    The first shaft of each pair turns with the crankshaft at n·ω, the second against it;
    each takes the chosen share of the vector that turns as it does.  Of cylinders in line
    both are equal (Lanchester).
    """
    cylinders, choice = cylinders_of(engine), engine.balancing

    def pair(order: int, share: float) -> tuple[float, float]:
        along, against = turning_parts(reciprocating(engine, cylinders, order)[0])
        unit = share / (order * engine.omega) ** 2
        return abs(along) * unit, abs(against) * unit

    return pair(1, choice.first_shafts_share), pair(2, choice.second_shafts_share)
