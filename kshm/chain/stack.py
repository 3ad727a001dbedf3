"""Engines of one structure stacked into arrays, so that one pass solves them all."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from operator import attrgetter
from typing import Generic, TypeVar

import numpy as np

from kshm.arrays import Array, Mask
from kshm.engine.arrangement import Arrangement, ArticulatedRod, Cylinder, hung
from kshm.engine.crankshaft import places
from kshm.engine.engine import Engine, Geometry
from kshm.engine.gas import PolytropicGas
from kshm.errors import InputError
from kshm.mechanics.articulated import ArticulatedArrays, Linkage
from kshm.mechanics.gas import PolytropicArrays
from kshm.mechanics.journals import Rods, ThrowArrays
from kshm.mechanics.masses import point_masses

Part = TypeVar("Part")


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
    exact: Mask
    k: Array  # relative offset e/r
    piston_stroke: Array
    theta: Array  # (engines, cylinders, 1), (1, cylinders, 1) if equal in all engines
    force_theta: Array
    pin_angle: Array  # of the split pin's part, (engines, cylinders, 1)
    pin_mass: Array  # m_2 that turns with the crankpin, (engines, cylinders, 1)
    arrangement: Arrangement
    articulated: ArticulatedArrays | None
    p_ambient: Array
    gas: PolytropicArrays | None  # None: tables of points
    throws: ThrowArrays
    rods: Rods
    rays: int


def structure(engine: Engine) -> tuple[object, ...]:
    """Structure of an engine; engines of one batch have the same."""
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
        InputError: the engines differ in structure or there are none.
    """
    if not engines:
        raise InputError("no engines to solve")
    if len({structure(engine) for engine in _one_of_each_kind(engines)}) > 1:
        msg = "engines of one batch must have one structure: layout, strokes, step, rays, gas"
        raise InputError(msg)
    first = engines[0]
    geometry = _SharedParts([engine.geometry for engine in engines])
    arrangement = _SharedParts([engine.arrangement for engine in engines])
    throws = _stack_throws(engines)
    degrees = np.arange(0, first.strokes * 180 + first.step_deg, first.step_deg, dtype=float)
    theta = _SharedParts([engine.firing_offsets for engine in engines]).values(lambda t: t)
    forced = _SharedParts([e.force_offsets or e.firing_offsets for e in engines]).values(
        lambda t: t
    )
    masses = np.array([point_masses(e.masses, e.geometry.rod_length) for e in engines])
    m_j, m_2 = masses[:, 0, None, None], masses[:, 1, None, None]

    def scalars(get: Callable[[Engine], float]) -> Array:
        return np.array([get(engine) for engine in engines])[:, None, None]

    def of_geometry(get: Callable[[Geometry], float]) -> Array:
        return geometry.values(get)[:, None, None]

    def per_cylinder(get: Callable[[Cylinder], float]) -> Array:
        return arrangement.values(lambda cylinders: [get(c) for c in cylinders])[:, :, None]

    pin_angle = per_cylinder(lambda c: c.pin_angle)
    pin_mass = m_2 * per_cylinder(lambda c: float(c.master is None))
    return Batch(
        engines=tuple(engines),
        phi=np.radians(degrees)[None, None, :],
        r=of_geometry(lambda g: g.crank_radius),
        lam=of_geometry(lambda g: g.lam),
        eps=of_geometry(lambda g: g.compression_ratio),
        area=of_geometry(lambda g: g.piston_area),
        omega=scalars(lambda e: e.omega),
        m_j=m_j,
        m_2=m_2,
        m_k=(throws.pin_mass + throws.web_mass.sum(axis=-1))[:, :1, None],
        exact=np.array([engine.method == "exact" for engine in engines])[:, None, None],
        k=of_geometry(lambda g: g.relative_offset),
        piston_stroke=of_geometry(lambda g: g.stroke),
        theta=_common(theta)[:, :, None],
        force_theta=_common(forced)[:, :, None],
        pin_angle=pin_angle,
        pin_mass=pin_mass,
        arrangement=first.arrangement,
        articulated=_stack_articulated(engines),
        p_ambient=scalars(lambda e: e.gas.p_ambient),
        gas=_stack_gas(engines),
        throws=throws,
        rods=Rods(
            throw=tuple(c.throw for c in first.arrangement),
            positions=tuple(c.rod_place for c in first.arrangement),
            turn=pin_angle[:, :, 0],
            mass=pin_mass[:, :, 0],
        ),
        rays=first.rays,
    )


class _SharedParts(Generic[Part]):
    """One part of every engine; what engines share, as in a study of one key, is read once."""

    def __init__(self, parts: Sequence[Part]) -> None:
        self.distinct = {id(part): part for part in parts}
        numbers = {key: number for number, key in enumerate(self.distinct)}
        self._numbers = np.array([numbers[id(part)] for part in parts])

    def values(self, get: Callable[[Part], object]) -> Array:
        """Values of ``get`` for every engine, engines first."""
        values: Array = np.array([get(part) for part in self.distinct.values()], dtype=float)
        each: Array = values[self._numbers]
        return each


def _one_of_each_kind(engines: Sequence[Engine]) -> Iterable[Engine]:
    """Return one engine of each structure: to compare all is slow."""
    return {
        (e.cylinders, e.strokes, e.step_deg, e.rays, id(e.crankshaft), id(e.arrangement),
         type(e.gas)): e
        for e in engines
    }.values()  # fmt: skip


def _common(values: Array) -> Array:
    """One row for all engines where they agree: what follows from it is computed once."""
    return values[:1] if np.all(values == values[:1]) else values


def _stack_articulated(engines: Sequence[Engine]) -> ArticulatedArrays | None:
    cylinders = hung(engines[0].arrangement)
    if not cylinders:
        return None

    def per_rod(get: Callable[[Engine, ArticulatedRod, Cylinder], float]) -> Array:
        rows = [
            [get(e, rod, e.arrangement[i]) for rod, i in zip(e.articulated, cylinders, strict=True)]
            for e in engines
        ]
        return np.array(rows, dtype=float)[:, :, None]

    link = Linkage(
        r=per_rod(lambda e, _, __: e.geometry.crank_radius),
        rod_length=per_rod(lambda e, _, __: e.geometry.rod_length),
        offset=per_rod(lambda e, _, __: e.geometry.offset),
        bank=per_rod(lambda e, _, c: c.axis - e.arrangement[c.master or 0].axis),
        radius=per_rod(lambda _, rod, __: rod.radius),
        angle=per_rod(lambda _, rod, __: rod.angle),
        own_length=per_rod(lambda _, rod, __: rod.rod_length),
    )
    return ArticulatedArrays(
        link,
        reciprocating=per_rod(lambda _, rod, __: rod.reciprocating),
        big_end=per_rod(lambda _, rod, __: rod.big_end),
        cylinders=cylinders,
    )


def _stack_gas(engines: Sequence[Engine]) -> PolytropicArrays | None:
    gases = [engine.gas for engine in engines]
    if not all(isinstance(gas, PolytropicGas) for gas in gases):
        return None
    parts = _SharedParts(gases)
    names = PolytropicArrays.__dataclass_fields__
    columns = {name: _common(parts.values(attrgetter(name)))[:, None, None] for name in names}
    return PolytropicArrays(**columns)


def _stack_throws(engines: Sequence[Engine]) -> ThrowArrays:
    shafts = _SharedParts([engine.crankshaft for engine in engines])

    def per_web(name: str) -> Array:
        get = attrgetter(name)
        return shafts.values(lambda s: [(get(t.left_web), get(t.right_web)) for t in s.throws])

    def per_throw(name: str) -> Array:
        get = attrgetter(name)
        return shafts.values(lambda s: [get(t) for t in s.throws])

    def per_end(name: str) -> Array:
        get = attrgetter(name)
        return shafts.values(lambda s: (get(s.nose), get(s.rear)))

    thickness = per_throw("left_web_thickness"), per_throw("right_web_thickness")
    return ThrowArrays(
        angle=per_throw("angle"),
        places=places(tuple(np.moveaxis(per_throw("arms"), -1, 0)), *thickness),
        web_mass=per_web("mass"),
        web_angle=per_web("angle"),
        counterweight_mass=per_web("counterweight_mass"),
        counterweight_angle=per_web("counterweight_angle"),
        pin_mass=per_throw("pin_mass"),
        end_mass=per_end("mass"),
        end_angle=per_end("angle"),
        end_arm=per_end("arm"),
    )
