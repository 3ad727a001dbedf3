"""Loads on crankpins and throws from all rods that they carry, Gots 2.6, (40)-(42)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from kshm.arrays import Array
from kshm.chain.stack import Batch
from kshm.engine.arrangement import pins
from kshm.mechanics.journals import pin_directions


@dataclass(frozen=True, slots=True)
class CrankpinForces:
    """Specific force on each crankpin in its frame [Pa], (engines, pins, angles)."""

    up: Array  # outwards along the crank
    side: Array  # along the rotation


@dataclass(frozen=True, slots=True)
class ThrowForces:
    """Specific forces of all rods on each throw in its frame [Pa], (engines, throws, angles)."""

    K: Array
    T: Array
    load: Array  # R_к with the centrifugal forces of the rods, the pin and the webs


def crankpin_forces(batch: Batch, K: Array, T: Array, unit: Array) -> CrankpinForces:
    """Sum of K, T and the centrifugal forces of the rods on every crankpin [Pa], Gots (40).

    As in Gots 2.6 the distance between the rods along the pin is left out.  The parts of
    a split pin are pins of their own.

    Args:
        batch: the engines.
        K: specific force of each rod towards the crank axis [Pa], shape
            (engines, cylinders, angles).
        T: specific force of each rod along the rotation, same shape.
        unit: rω² [m/s²], shape (engines, 1, 1).
    """
    up = batch.pin_mass * unit / batch.area - K
    groups = [list(group) for group in pins(batch.arrangement)]
    if groups == [[rod] for rod in range(up.shape[1])]:
        return CrankpinForces(up, T)

    def summed(values: Array) -> Array:
        return np.stack([values[:, group].sum(axis=1) for group in groups], axis=1)

    return CrankpinForces(summed(up), summed(T))


def throw_forces(batch: Batch, K: Array, T: Array, unit: Array) -> ThrowForces:
    """Sum over the rods of every throw and the force R_к on it [Pa], Gots (42).

    The throw's own mass is m_к of Gots (28), both webs taken along the crank.

    Args:
        batch: the engines.
        K: specific force of each rod towards the crank axis in its throw's frame [Pa],
            shape (engines, cylinders, angles).
        T: specific force of each rod along the rotation in its throw's frame, same shape.
        unit: rω² [m/s²], shape (engines, 1, 1).
    """
    throws, rods = batch.throws, batch.rods
    count = throws.angle.shape[1]
    K, T = rods.summed(K, count), rods.summed(T, count)
    shares = pin_directions(rods, count)
    along, ahead = (
        rods.summed(rods.mass * part, count) + throws.pin_mass * share
        for part, share in zip((np.cos(rods.turn), np.sin(rods.turn)), shares, strict=True)
    )
    centrifugal = unit / batch.area
    up = (along + throws.web_mass.sum(axis=-1))[..., None] * centrifugal - K
    side = T + ahead[..., None] * centrifugal
    return ThrowForces(K, T, np.sqrt(up**2 + side**2))
