"""Firing orders that a given crankshaft allows, by evenness, torque orders and journal load.

Inertia forces repeat every turn: they are the same for all firing orders of a shaft.
What differs is the evenness of the power strokes, the low torque orders (1/2, 1, …)
that shake the shaft, and the load on the main journals.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from kshm.arrays import Array
from kshm.chain.solve import solve_batch
from kshm.engine.engine import Engine
from kshm.errors import InputError

MAX_CYLINDERS = 7  # 64 orders; more throws have too many to list


@dataclass(frozen=True, slots=True)
class FiringOrder:
    """One firing order of a shaft and its figures."""

    order: tuple[int, ...]
    offsets: tuple[float, ...]  # θ_i [rad]
    unevenness: float  # (greatest − smallest interval)/mean interval
    half_order: float  # |Σ exp(−iθ/2)|: cylinders that excite order 1/2 together
    journal_load: float  # greatest load of a main journal [N]


def dead_centres(engine: Engine) -> Array:
    """Shaft angles [rad] at which the pins lie along the axes, shape (cylinders,), Gots 2.7."""
    throws = engine.crankshaft.throws
    return np.array([c.axis - c.pin_angle - throws[c.throw].angle for c in engine.arrangement])


def offsets_table(starts: Array) -> Array:
    """Return firing offsets [rad] of all orders, shape (2^(cylinders − 1), cylinders), Gots 2.7.

    Cylinder i fires with its pin at TDC, see ``dead_centres``, in the first or second
    turn of the cycle; cylinder 1 always in the first.
    """
    base = np.mod(starts, 2 * np.pi)
    base = np.where(np.isclose(base, 2 * np.pi, atol=1e-9), 0.0, base)
    count = len(base)
    variants = np.arange(2 ** (count - 1))[:, None]
    turn = np.where(np.arange(count) == 0, 0, variants >> np.maximum(np.arange(count) - 1, 0) & 1)
    return base + 2 * np.pi * turn


def intervals(offsets: Array) -> Array:
    """Intervals between power strokes [rad], shape of the offsets, four-stroke, Gots 2.8."""
    ordered = np.sort(offsets, axis=-1)
    following = np.concatenate([ordered[..., 1:], ordered[..., :1] + 4 * np.pi], axis=-1)
    return following - ordered


def unevenness(offsets: Array) -> Array:
    """(Greatest − smallest interval)/mean [-], shape (orders,), zero for even firing, Gots 2.8."""
    gaps = intervals(offsets)
    spread: Array = np.ptp(gaps, axis=-1) / gaps.mean(axis=-1)
    return spread


def order_sum(offsets: Array, order: float) -> Array:
    """|Σ exp(−i·order·θ)| [-], shape (orders,): cylinders that excite a torque order together.

    The phasors of Neiman's series, as in ``kshm.mechanics.balance``.
    """
    size: Array = np.abs(np.exp(-1j * order * offsets).sum(axis=-1))
    return size


def sequence(offsets: Array) -> tuple[int, ...]:
    """Cylinder numbers in the order in which they fire, of offsets [rad] of shape (cylinders,).

    Gots 2.8.
    """
    rounded = np.round(offsets, 9)
    return tuple(int(i) + 1 for i in np.lexsort((np.arange(len(offsets)), rounded)))


def journal_loads(engine: Engine, table: Array) -> Array:
    """Greatest load of a main journal [N] for every row of offsets, shape (orders,), Gots 2.7."""
    engines = [replace(engine, firing_offsets=tuple(row), force_offsets=None) for row in table]
    loads: Array = solve_batch(engines).journal_load.max(axis=(1, 2))
    return loads * engine.geometry.piston_area


def rank_firing_orders(engine: Engine) -> tuple[FiringOrder, ...]:
    """All firing orders of the engine's crankshaft, the best first.

    Sorted by evenness, then by the sum of order 1/2, then by the greatest load of a
    main journal.

    Raises:
        InputError: more cylinders than orders can be listed for, or two strokes, which
            leave no choice.
    """
    if engine.strokes != 4:
        raise InputError("a two-stroke engine has one firing order")
    if engine.cylinders > MAX_CYLINDERS:
        raise InputError(f"firing orders are listed for up to {MAX_CYLINDERS} cylinders")
    table = offsets_table(dead_centres(engine))
    loads = journal_loads(engine, table)
    rough, half = unevenness(table), order_sum(table, 0.5)
    ranked = (
        FiringOrder(sequence(row), tuple(row), float(a), float(b), float(load))
        for row, a, b, load in zip(table, rough, half, loads, strict=True)
    )
    return tuple(
        sorted(
            ranked, key=lambda o: (round(o.unevenness, 6), round(o.half_order, 6), o.journal_load)
        )
    )
