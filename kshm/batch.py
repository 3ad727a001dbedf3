"""Engines of one structure stacked into arrays, so that one pass solves them all."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

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
    theta: Array  # (engines, cylinders, 1)
    force_theta: Array
    p_ambient: Array
    gas: PolytropicArrays | None  # None: tables of points
    throws: ThrowArrays
    rays: int


def structure(engine: Engine) -> tuple[object, ...]:
    """What must be equal for engines to be solved in one batch."""
    return (
        engine.cylinders,
        engine.strokes,
        engine.step_deg,
        engine.rays,
        len(engine.crankshaft.throws),
        type(engine.gas),
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
        msg = "engines of one batch must have one structure: cylinders, strokes, step, rays, gas"
        raise ValueError(msg)
    first = engines[0]

    def scalars(get: Callable[[Engine], float]) -> Array:
        return np.array([get(engine) for engine in engines], dtype=float)[:, None, None]

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
        theta=theta,
        force_theta=forced[:, :, None],
        p_ambient=scalars(lambda e: e.gas.p_ambient),
        gas=_stack_gas(engines),
        throws=_stack_throws(engines),
        rays=first.rays,
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
