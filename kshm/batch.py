"""Engines of one structure stacked into arrays, so that one pass solves them all."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from kshm.arrangement import Arrangement, ArticulatedRod, Cylinder
from kshm.articulated import Linkage
from kshm.engine import Engine, PolytropicGas
from kshm.gas import PolytropicArrays
from kshm.inertia import point_masses, throw_mass
from kshm.journals import ThrowArrays

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Batch:
    """Engines × cylinders × angles: every array has three axes unless said otherwise."""

    engines: tuple[Engine, ...]
    phi: Array  # (1, 1, angles) over the whole cycle, last = first + period
    r: Array  # (engines, 1, 1), as all scalars below
    lam: Array
    eps: Array
    area: Array
    omega: Array
    m_j: Array
    m_2: Array
    m_k: Array
    exact: NDArray[np.bool_]
    k: Array  # relative offset e/r
    piston_stroke: Array
    theta: Array  # (engines, cylinders, 1)
    force_theta: Array
    axis: Array  # of the cylinder from that of cylinder 1, (engines, cylinders, 1)
    pin_angle: Array  # of the split pin's half, (engines, cylinders, 1)
    pin_mass: Array  # m_2 that turns with the crankpin, (engines, cylinders, 1)
    arrangement: Arrangement
    articulated: ArticulatedArrays | None
    p_ambient: Array
    gas: PolytropicArrays | None  # None: tables of points
    throws: ThrowArrays
    rays: int


@dataclass(frozen=True, slots=True)
class ArticulatedArrays:
    """Articulated rods of all engines, (engines, 1, 1) as the scalars of ``Batch``."""

    link: Linkage
    reciprocating: Array
    big_end: Array
    cylinders: tuple[int, ...]  # those that hang on others
    masters: tuple[int, ...]


def structure(engine: Engine) -> tuple[object, ...]:
    """What must be equal for engines to be solved in one batch."""
    return (
        engine.cylinders,
        engine.strokes,
        engine.step_deg,
        engine.rays,
        len(engine.crankshaft.throws),
        type(engine.gas),
        tuple((c.throw, c.rod_place, c.pin, c.master) for c in engine.arrangement),
    )


def stack(engines: Sequence[Engine]) -> Batch:
    """Stack engines of one structure.

    Raises:
        ValueError: the engines differ in structure or there are none.
    """
    if not engines:
        msg = "no engines to solve"
        raise ValueError(msg)
    if len({structure(engine) for engine in engines}) > 1:
        msg = "engines of one batch must have one structure: layout, strokes, step, rays, gas"
        raise ValueError(msg)
    first = engines[0]

    def scalars(get: Callable[[Engine], float]) -> Array:
        return np.array([get(engine) for engine in engines], dtype=float)[:, None, None]

    def per_cylinder(get: Callable[[Cylinder], float]) -> Array:
        return np.array([[get(c) for c in engine.arrangement] for engine in engines])[:, :, None]

    masses = [point_masses(e.masses, e.geometry.rod_length) for e in engines]
    degrees = np.arange(0, first.strokes * 180 + first.step_deg, first.step_deg, dtype=float)
    theta = np.array([engine.firing_offsets for engine in engines])[:, :, None]
    forced = np.array([engine.force_offsets or engine.firing_offsets for engine in engines])
    return Batch(
        engines=tuple(engines),
        phi=np.radians(degrees)[None, None, :],
        r=scalars(lambda e: e.geometry.crank_radius),
        lam=scalars(lambda e: e.geometry.lam),
        eps=scalars(lambda e: e.geometry.compression_ratio),
        area=scalars(lambda e: e.geometry.piston_area),
        omega=scalars(lambda e: e.omega),
        m_j=np.array([pair[0] for pair in masses])[:, None, None],
        m_2=np.array([pair[1] for pair in masses])[:, None, None],
        m_k=scalars(lambda e: throw_mass(e.crankshaft.throws[0])),
        exact=np.array([engine.method == "exact" for engine in engines])[:, None, None],
        k=scalars(lambda e: e.geometry.relative_offset),
        piston_stroke=scalars(lambda e: e.geometry.stroke),
        theta=theta,
        force_theta=forced[:, :, None],
        axis=per_cylinder(lambda c: c.axis),
        pin_angle=per_cylinder(lambda c: c.pin_angle),
        pin_mass=np.array([pair[1] for pair in masses])[:, None, None]
        * per_cylinder(lambda c: float(c.master is None)),
        arrangement=first.arrangement,
        articulated=_stack_articulated(engines),
        p_ambient=scalars(lambda e: e.gas.p_ambient),
        gas=_stack_gas(engines),
        throws=_stack_throws(engines),
        rays=first.rays,
    )


def _stack_articulated(engines: Sequence[Engine]) -> ArticulatedArrays | None:
    first = engines[0]
    pairs = [(i, c.master) for i, c in enumerate(first.arrangement) if c.master is not None]
    rods = [(e, e.articulated) for e in engines if e.articulated is not None]
    if not pairs:
        return None
    if len(rods) != len(engines):
        msg = "the arrangement has articulated rods, the engine does not describe them"
        raise ValueError(msg)
    slave = pairs[0][0]

    def scalars(get: Callable[[Engine, ArticulatedRod], float]) -> Array:
        return np.array([get(engine, rod) for engine, rod in rods], dtype=float)[:, None, None]

    link = Linkage(
        r=scalars(lambda e, _: e.geometry.crank_radius),
        rod_length=scalars(lambda e, _: e.geometry.rod_length),
        offset=scalars(lambda e, _: e.geometry.offset),
        bank=scalars(lambda e, _: e.arrangement[slave].axis),
        radius=scalars(lambda _, rod: rod.radius),
        angle=scalars(lambda _, rod: rod.angle),
        own_length=scalars(lambda _, rod: rod.rod_length),
    )
    return ArticulatedArrays(
        link,
        reciprocating=scalars(lambda _, rod: rod.reciprocating),
        big_end=scalars(lambda _, rod: rod.big_end),
        cylinders=tuple(i for i, _ in pairs),
        masters=tuple(master for _, master in pairs),
    )


def _stack_gas(engines: Sequence[Engine]) -> PolytropicArrays | None:
    gases = [engine.gas for engine in engines]
    if not all(isinstance(gas, PolytropicGas) for gas in gases):
        return None
    polytropic = [gas for gas in gases if isinstance(gas, PolytropicGas)]
    names = PolytropicArrays.__dataclass_fields__
    columns = {
        name: np.array([getattr(gas, name) for gas in polytropic])[:, None, None] for name in names
    }
    return PolytropicArrays(**columns)


def _stack_throws(engines: Sequence[Engine]) -> ThrowArrays:
    shafts = [engine.crankshaft for engine in engines]
    webs = [[(t.left_web, t.right_web) for t in shaft.throws] for shaft in shafts]
    ends = [(shaft.nose, shaft.rear) for shaft in shafts]

    def per_web(name: str) -> Array:
        return np.array([[[getattr(w, name) for w in pair] for pair in row] for row in webs])

    def per_throw(name: str) -> Array:
        return np.array([[getattr(t, name) for t in shaft.throws] for shaft in shafts])

    def per_end(name: str) -> Array:
        return np.array([[getattr(end, name) for end in pair] for pair in ends])

    return ThrowArrays(
        angle=per_throw("angle"),
        arms=per_throw("arms"),
        left_web_thickness=per_throw("left_web_thickness"),
        right_web_thickness=per_throw("right_web_thickness"),
        web_mass=per_web("mass"),
        web_angle=per_web("angle"),
        counterweight_mass=per_web("counterweight_mass"),
        counterweight_angle=per_web("counterweight_angle"),
        pin_mass=per_throw("pin_mass"),
        end_mass=per_end("mass"),
        end_angle=per_end("angle"),
        end_arm=per_end("arm"),
    )
