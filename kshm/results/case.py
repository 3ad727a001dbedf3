"""One engine of a batch, names of its tables, extremes of its curves."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from kshm.arrays import Array
from kshm.chain.solve import ChainArrays, solve_batch
from kshm.defaults import FINE_STEP
from kshm.engine.arrangement import pins, throws
from kshm.engine.engine import Engine
from kshm.mechanics import balance, kinematics
from kshm.mechanics.wear import ray_angles

# Values this close to the extreme count as equal: the first angle or number is reported.
TIE = 1e-9
RAY_TIE = 1.0  # Pa: sums of rays that differ by less are alike, whatever their size
UNLOADED = 1e-3  # Pa: specific forces below are rounding noise of zero


def first_extremes(
    values: Array, where: Array, *, largest: bool = True, floor: float = 1.0
) -> tuple[Array, Array]:
    """Extreme of each row and the first place where it is reached within rounding.

    Args:
        values: shape (..., places).
        where: the places, shape (places,).
        largest: the maximum, else the minimum.
        floor: extremes smaller than that are rounded like it.

    Returns:
        Extremes and places, both of shape (...,).
    """
    signed = values if largest else -values
    top = signed.max(axis=-1, keepdims=True)
    reached = signed >= top - TIE * np.maximum(floor, np.abs(top))
    extreme = top[..., 0] if largest else -top[..., 0]
    return extreme, where[np.argmax(reached, axis=-1)]


def first_extreme(
    values: Array, where: Array, *, largest: bool = True, floor: float = 1.0
) -> tuple[float, float]:
    """Return the same of one curve, shape (places,)."""
    extreme, at = first_extremes(values, where, largest=largest, floor=floor)
    return float(extreme), float(at)


def first_number(values: Array) -> Array:
    """Number, from 1, of the first value of each row that equals its largest within rounding."""
    return first_extremes(values, np.arange(1.0, values.shape[-1] + 1))[1]


def mean_of(curve: Array) -> Array:
    """Mean over the cycle of shape (...,): the repeated last angle counts once."""
    mean: Array = curve[..., :-1].mean(axis=-1)
    return mean


def summary_of(name: str, curve: Array, phi: Array) -> dict[str, Array]:
    """Mean and extremes of ``curve``, shape (..., angles), with their angles, by key."""
    largest, at_largest = first_extremes(curve, phi)
    smallest, at_smallest = first_extremes(curve, phi, largest=False)
    return {
        f"{name}_mean": mean_of(curve),
        f"{name}_max": largest,
        f"phi_{name}_max_deg": at_largest,
        f"{name}_min": smallest,
        f"phi_{name}_min_deg": at_smallest,
    }


def least_loaded(sums: Array) -> tuple[Array, Array]:
    """Return the number of the ray with the smallest sum and the place of the oil hole [rad].

    Where several rays are loaded least, often not at all, the middle of their widest arc is
    taken: its place hardly depends on the step.  Rays are directions of the force on the
    journal; the journal is touched on the side from which the force comes, half a turn away.
    Shape of both (...,) for ``sums`` of shape (..., rays).
    """
    count = sums.shape[-1]
    least = sums.min(axis=-1, keepdims=True)
    tied = sums < least + RAY_TIE
    rays = np.arange(2 * count + 1)  # two turns: an arc may pass the first ray
    broken = np.where(tied[..., rays % count], -1, rays)
    arcs = (rays - np.maximum.accumulate(broken, axis=-1))[..., count:]  # ending at each ray
    ray = (arcs.argmax(axis=-1) - arcs.max(axis=-1) // 2) % count + 1
    return ray.astype(float), np.mod(ray_angles(count)[ray - 1] + np.pi, 2 * np.pi)


def has_single_rods(engine: Engine) -> bool:
    """Whether every throw carries one rod, as in line and in opposed engines."""
    return all(len(group) == 1 for group in throws(engine.arrangement))


def shown_pins(engine: Engine) -> tuple[tuple[int, ...], ...]:
    """Crankpins with results of their own; equal pins with one rod each differ in phase only."""
    groups, shaft = pins(engine.arrangement), engine.crankshaft
    sizes = set(zip(shaft.pin_diameters, shaft.pin_lengths, strict=True))
    single = all(len(group) == 1 for group in groups)
    return groups[:1] if single and len(sizes) == 1 else groups


def pin_table(number: int) -> str:
    """Id of the table with the loads on a crankpin, counted from 0."""
    return "crankpin" if number == 0 else f"crankpin_{number + 1}"


def wear_table(number: int) -> str:
    """Id of the table with the wear of a crankpin, counted from 0."""
    return "table_14" if number == 0 else f"table_14_pin_{number + 1}"


def throw_torque_key(engine: Engine, throw: int) -> str:
    """Column of the torque of a throw, from 0: its cylinder's where it has only one."""
    group = throws(engine.arrangement)[throw]
    return f"M{group[0] + 1}_Nm" if len(group) == 1 else f"Mthrow{throw + 1}_Nm"


def rod_names(count: int) -> tuple[str, ...]:
    """Names of the rods of a throw in columns, from the nose: left and right where there are two.

    Names of one rod's K and T are those of the nomenclature, ``Kleft_MPa``, ``Krod3_MPa``.
    """
    if count == 2:
        return ("left", "right")
    return tuple(f"rod{number}" for number in range(1, count + 1))


@dataclass(frozen=True)
class Case:
    """An engine, the arrays that it was solved in and its place in them."""

    engine: Engine
    raw: ChainArrays
    index: int

    @cached_property
    def turn(self) -> Array:
        """Crank angles of one turn [rad]."""
        return grid(0, 360, self.engine.step_deg)

    @cached_property
    def sizes(self) -> tuple[Array, Array, Array]:
        """R [m], λ and k [-] as arrays of shape ()."""
        return kinematics.sizes(self.engine.geometry)

    @cached_property
    def omega(self) -> Array:
        """ω [rad/s] as an array of shape ()."""
        return np.array(self.engine.omega)

    @cached_property
    def inertia_unit(self) -> float:
        """First-order inertia force of one cylinder m_j r ω² [N]."""
        return balance.inertia_unit(self.engine)

    @cached_property
    def fine_torque(self) -> tuple[Array, Array]:
        """Torque of the engine [N·m] and crank angles [rad] at the fine step, (angles,)."""
        if self.engine.step_deg <= FINE_STEP:
            return self.raw.torque_sum[self.index], self.raw.phi
        alone = replace(self.engine, step_deg=FINE_STEP, regimes=(), torsion=None, bearings=None)
        fine = solve_batch([alone])
        return fine.torque_sum[0], fine.phi

    def orders(self, last: float) -> Array:
        """Orders of the cycle up to the last [-], as far as the grid resolves them."""
        step = 2 / self.engine.strokes
        last = min(last, 180 / self.engine.step_deg - step)
        orders: Array = np.arange(1.0, round(last / step) + 1) * step
        return orders


def grid(first: float, last: float, step: float) -> Array:
    """Angles [rad] from ``first`` to ``last`` [°] inclusive."""
    return np.radians(first + step * np.arange(round((last - first) / step) + 1.0))
