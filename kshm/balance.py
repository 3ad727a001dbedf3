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

from kshm.engine import Engine, Throw
from kshm.harmonics import acceleration_amplitude
from kshm.inertia import point_masses

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


def cylinders_of(engine: Engine) -> Cylinders:
    """Cylinders of an in-line engine: all axes upright."""
    starts = throw_starts(engine)
    rods = [rod_place(throw) for throw in engine.crankshaft.throws]
    phase = np.array(engine.firing_offsets)
    return Cylinders(phase, starts[:-1] + np.array(rods), np.zeros_like(phase))


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
    # Two vectors of constant length turning with and against rotation.
    along = (vector.up + 1j * vector.right) / 2
    against = (np.conj(vector.up) + 1j * np.conj(vector.right)) / 2
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
    for throw, start in zip(shaft.throws, starts[:-1], strict=True):
        rod = rod_place(throw)
        right = rod + sum(throw.arms[2:5]) + throw.right_web_thickness / 2
        webs = (
            (throw.left_web, throw.arms[0] + throw.left_web_thickness / 2),
            (throw.right_web, right),
        )
        found.append((m_2, throw.angle, start + rod))
        found.append((throw.pin_mass, throw.angle, start + rod + throw.arms[2]))
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


def ideal_counterweights(engine: Engine) -> tuple[complex, complex]:
    """Force [N] and moment [N·m] of masses m_j opposite every crank, up + i·right at φ = 0.

    A share of them balances that share of the first-order forces of its own throw.
    """
    m_j, _ = point_masses(engine.masses, engine.geometry.rod_length)
    unit = m_j * engine.geometry.crank_radius * engine.omega**2
    angles = np.array([throw.angle for throw in engine.crankshaft.throws])
    vectors = -unit * np.exp(1j * angles)
    places = cylinders_of(engine).place
    return complex(vectors.sum()), complex((vectors * places).sum())


def shaft_moments(engine: Engine) -> tuple[float, float]:
    """Mass times radius of each shaft of a Lanchester pair, orders 1 and 2 [kg·m].

    Two shafts turning against each other at n·ω give 2·m·e·(n·ω)² along the cylinders.
    """
    cylinders = cylinders_of(engine)
    shares = engine.balancing.first_shafts_share, engine.balancing.second_shafts_share
    found = []
    for order, share in zip((1, 2), shares, strict=True):
        force, _ = reciprocating(engine, cylinders, order)
        found.append(share * abs(force.up) / (2 * (order * engine.omega) ** 2))
    return found[0], found[1]
