"""Loads on crankpins and throws from all rods that they carry, Gots 2.6, (40)-(42)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from kshm.chain.stack import Batch
from kshm.engine.arrangement import pins
from kshm.mechanics import journals
from kshm.mechanics.forces import RodForces

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class PinForces:
    """Specific force on each crankpin in its frame [Pa], (engines, pins, angles)."""

    up: Array  # outwards along the crank
    side: Array  # along the rotation


@dataclass(frozen=True, slots=True)
class ThrowForces:
    """Specific forces of all rods on each throw in its frame [Pa], (engines, throws, angles)."""

    K: Array
    T: Array
    load: Array  # R_к with the centrifugal forces of the rods, the pin and the webs


def pin_forces(batch: Batch, rod: RodForces, unit: Array) -> PinForces:
    """Sum of K, T and the centrifugal forces of the rods on every crankpin, Gots (40).

    As in Gots 2.6 the distance between two rods along the pin is left out.  The halves of
    a split pin are pins of their own.

    Args:
        batch: the engines.
        rod: forces of every cylinder.
        unit: rω² [m/s²].
    """
    up = batch.pin_mass * unit / batch.area - rod.K
    groups = [list(group) for group in pins(batch.arrangement)]
    return PinForces(
        up=_summed(up, groups),
        side=_summed(rod.T, groups),
    )


def _summed(values: Array, groups: list[list[int]]) -> Array:
    if groups == [[rod] for rod in range(values.shape[1])]:
        return values
    return np.stack([values[:, group].sum(axis=1) for group in groups], axis=1)


def throw_forces(batch: Batch, rods: journals.Rods, K: Array, T: Array, unit: Array) -> ThrowForces:
    """Sum over the rods of every throw and the force R_к on it, Gots (42).

    The throw's own mass is m_к of Gots (28), both webs taken along the crank; each half of a
    split pin has half of the pin's mass.

    Args:
        batch: the engines.
        rods: the rods on the throws.
        K: specific force of each rod towards the crank axis in its throw's frame [Pa].
        T: specific force of each rod along the rotation in its throw's frame [Pa].
        unit: rω² [m/s²].
    """
    throws = batch.throws
    count = throws.angle.shape[1]
    K, T = rods.summed(K, count), rods.summed(T, count)
    cos, sin = np.cos(rods.turn), np.sin(rods.turn)
    carried = rods.summed(np.ones_like(cos), count)
    turning = [
        rods.summed(rods.mass * part, count) + throws.pin_mass * rods.summed(part, count) / carried
        for part in (cos, sin)
    ]
    centrifugal = unit / batch.area
    up = (turning[0] + throws.web_mass.sum(axis=-1))[..., None] * centrifugal - K
    side = T + turning[1][..., None] * centrifugal
    return ThrowForces(K, T, np.sqrt(up**2 + side**2))
