"""One engine of a batch, as every subject of the results takes it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from kshm.arrays import Array
from kshm.chain.result import ChainArrays
from kshm.engine.engine import Engine
from kshm.mechanics import balance, kinematics


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

    def orders(self, last: float) -> Array:
        """Orders of the cycle up to the last [-], as far as the grid of angles tells them."""
        step = 2 / self.engine.strokes
        last = min(last, 180 / self.engine.step_deg - step)
        orders: Array = np.arange(1.0, round(last / step) + 1) * step
        return orders


def grid(first: float, last: float, step: float) -> Array:
    """Angles [rad] from ``first`` to ``last`` [°] inclusive."""
    return np.radians(first + step * np.arange(round((last - first) / step) + 1.0))
