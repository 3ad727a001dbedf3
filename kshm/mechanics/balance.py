"""Free forces and moments of an engine by orders, as rotating phasors; balancing of them.

A quantity of order n is kept as the complex number Q of  q(φ) = Re(Q·exp(i·n·φ)).
Vectors across the crankshaft are ``up`` (to the cylinder heads) and ``right`` (seen
from the nose, the side to which rotation leads from up).  Places run along the
shaft from the middle of the main journals towards the flywheel [m].

Reciprocating masses follow the exact series of the acceleration, Neiman (36).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from kshm.engine.arrangement import Cylinder
from kshm.engine.engine import Engine, Throw
from kshm.mechanics.harmonics import acceleration_amplitude
from kshm.mechanics.masses import point_masses

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Cylinders:
    """Cylinders of any layout: TDC phases [rad], places [m], axes clockwise from up [rad]."""

    phase: Array
    place: Array
    axis: Array


@dataclass(frozen=True, slots=True)
class Phasors:
    """A vector of one order: complex amplitudes of its components up and to the right."""

    up: complex
    right: complex


@dataclass(frozen=True, slots=True)
class Ellipse:
    """What a vector of one order describes: greatest and smallest length, direction [rad].

    The direction is that of the greatest length, clockwise from up, in (−π/2, π/2];
    zero where the vector keeps its length.
    """

    largest: float
    smallest: float
    direction: float


def throw_starts(engine: Engine) -> Array:
    """Places of the left supports of all throws and of the last support [m]."""
    lengths = [throw.length for throw in engine.crankshaft.throws]
    ends = np.concatenate([[0.0], np.cumsum(lengths)])
    places: Array = ends - ends[-1] / 2
    return places


def rod_place(throw: Throw) -> float:
    """Distance of the rod from the throw's left support [m], Gots figure 35."""
    return throw.arms[0] + throw.left_web_thickness + throw.arms[1]


def is_balanced_by_orders(engine: Engine) -> bool:
    """Whether the orders of Neiman's series describe all pistons: central, no articulated rods."""
    hung = any(place.master is not None for place in engine.arrangement)
    return engine.geometry.is_central and not hung


def places(engine: Engine) -> Array:
    """Place of every cylinder's rod along the shaft from its middle [m], Gots figure 36."""
    starts, throws = throw_starts(engine), engine.crankshaft.throws

    def place(cylinder: Cylinder) -> float:
        throw = throws[cylinder.throw]
        further = throw.arms[2] + throw.arms[3] if cylinder.rod_place else 0.0
        return float(starts[cylinder.throw]) + rod_place(throw) + further

    return np.array([place(cylinder) for cylinder in engine.arrangement])


def pin_angles(engine: Engine) -> Array:
    """Angle of every cylinder's crankpin, clockwise from crank 1 [rad]."""
    throws = engine.crankshaft.throws
    return np.array([throws[c.throw].angle + c.pin_angle for c in engine.arrangement])


def cylinders_of(engine: Engine) -> Cylinders:
    """Cylinders of an engine; "up" is the axis of cylinder 1."""
    axes = np.array([cylinder.axis for cylinder in engine.arrangement])
    return Cylinders(np.array(engine.firing_offsets), places(engine), axes)


def order_phasors(cylinders: Cylinders, order: float, weights: Array | None = None) -> Phasors:
    """Vector sum of unit forces cos(order·(φ − θ_i)) along the cylinder axes.

    Args:
        cylinders: the cylinders.
        order: order n.
        weights: one per cylinder; their places give the moment.
    """
    unit = np.exp(-1j * order * cylinders.phase)
    if weights is not None:
        unit = unit * weights
    return Phasors(
        complex(np.sum(unit * np.cos(cylinders.axis))),
        complex(np.sum(unit * np.sin(cylinders.axis))),
    )


def reciprocating(engine: Engine, cylinders: Cylinders, order: int) -> tuple[Phasors, Phasors]:
    """Free force [N] and moment [N·m] of one order of all reciprocating masses.

    Directed away from the crankshaft where the pistons are thrown upwards.
    """
    m_j, _ = point_masses(engine.masses, engine.geometry.rod_length)
    amplitude = m_j * engine.geometry.crank_radius * engine.omega**2
    amplitude *= acceleration_amplitude(engine.geometry.lam, order)
    force = order_phasors(cylinders, order)
    moment = order_phasors(cylinders, order, cylinders.place)
    return scaled(force, amplitude), scaled(moment, amplitude)


def scaled(vector: Phasors, factor: float) -> Phasors:
    """The vector times a number."""
    return Phasors(vector.up * factor, vector.right * factor)


def added(first: Phasors, second: Phasors) -> Phasors:
    """Sum of two vectors of one order."""
    return Phasors(first.up + second.up, first.right + second.right)


def turning(vector: complex) -> Phasors:
    """A vector that turns with the shaft; ``vector`` = up + i·right at φ = 0."""
    return Phasors(vector, -1j * vector)


def ellipse(vector: Phasors, noise: float = 0.0) -> Ellipse:
    """Greatest and smallest length of a vector of one order and the direction.

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
    _, m_2 = point_masses(engine.masses, engine.geometry.rod_length)
    unit = engine.geometry.crank_radius * engine.omega**2
    force, moment = 0j, 0j
    for mass, angle, place in _masses(engine, m_2, counterweights=counterweights):
        vector = mass * unit * np.exp(1j * angle)
        force, moment = force + vector, moment + place * vector
    return complex(force), complex(moment)


def _masses(
    engine: Engine, m_2: float, *, counterweights: bool
) -> list[tuple[float, float, float]]:
    """Mass at the crank radius [kg], angle clockwise from crank 1 [rad], place [m]."""
    found = []
    shaft, starts = engine.crankshaft, throw_starts(engine)
    spots = zip(pin_angles(engine), places(engine), strict=True)
    found += [(m_2, float(angle), float(place)) for angle, place in spots]
    turned = _pin_turn(engine)
    for throw, start in zip(shaft.throws, starts[:-1], strict=True):
        rod = rod_place(throw)
        right = rod + sum(throw.arms[2:5]) + throw.right_web_thickness / 2
        webs = (
            (throw.left_web, throw.arms[0] + throw.left_web_thickness / 2),
            (throw.right_web, right),
        )
        pin = start + rod + throw.arms[2]
        found += [(throw.pin_mass / 2, throw.angle, pin)]
        found += [(throw.pin_mass / 2, throw.angle + turned, pin)]
        for web, place in webs:
            # A web's angle runs against rotation, a counterweight's with it from "opposite".
            found.append((web.mass, throw.angle - web.angle, start + place))
            if counterweights:
                opposite = throw.angle + np.pi + web.counterweight_angle
                found.append((web.counterweight_mass, opposite, start + place))
    if counterweights:
        nose, rear = shaft.nose, shaft.rear
        found.append((nose.mass, shaft.throws[0].angle + nose.angle, starts[0] - nose.arm))
        found.append((rear.mass, shaft.throws[-1].angle - rear.angle, starts[-1] + rear.arm))
    return found


def _pin_turn(engine: Engine) -> float:
    """How far the second half of the pins is turned [rad]: zero for pins in one piece."""
    return max((c.pin_angle for c in engine.arrangement), key=abs)


def ideal_counterweights(engine: Engine) -> tuple[complex, complex]:
    """Force [N] and moment [N·m] of masses m_j opposite every crankpin, up + i·right at φ = 0.

    One for each rod; a share of them balances that share of its first-order force.
    """
    m_j, _ = point_masses(engine.masses, engine.geometry.rod_length)
    unit = m_j * engine.geometry.crank_radius * engine.omega**2
    vectors = -unit * np.exp(1j * pin_angles(engine))
    return complex(vectors.sum()), complex((vectors * places(engine)).sum())


def turning_parts(vector: Phasors) -> tuple[complex, complex]:
    """Two vectors of constant length that turn with and against rotation and make the vector."""
    with_ = (vector.up + 1j * vector.right) / 2
    against = (np.conj(vector.up) + 1j * np.conj(vector.right)) / 2
    return complex(with_), complex(against)


def shaft_moments(engine: Engine) -> tuple[tuple[float, float], tuple[float, float]]:
    """Mass times radius of the two shafts of a pair, orders 1 and 2 [kg·m].

    The first shaft of each pair turns with the crankshaft at n·ω, the second against it;
    each takes the chosen share of the vector that turns as it does.  Of cylinders in line
    both are equal (Lanchester).
    """
    cylinders = cylinders_of(engine)
    shares = engine.balancing.first_shafts_share, engine.balancing.second_shafts_share
    found = []
    for order, share in zip((1, 2), shares, strict=True):
        force, _ = reciprocating(engine, cylinders, order)
        along, against = (abs(part) for part in turning_parts(force))
        unit = (order * engine.omega) ** 2
        found.append((share * along / unit, share * against / unit))
    return found[0], found[1]
