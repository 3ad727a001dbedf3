"""Mobility of a journal in its film: Reynolds' equation of pure squeeze, solved once for a width.

Seen from axes that turn at the mean speed of journal and shell there is no wedge: the centre
moves as in a pure squeeze film (Booker 1965).  So one map of the force over the eccentricity
and the direction of the velocity carries every motion, and the film is cut off at p = 0 once,
for the velocity that it has.  Around the journal the equation is taken in finite differences,
along it as a series of cosines; a line along the axis is cut off where its mean pressure would
be negative.  A film that conserves its mass is thinner.

H³ = (1 − ε cos θ)³, θ from the line of centres:
∂/∂θ(H³ ∂P/∂θ) + b⁻² H³ ∂²P/∂ζ² = −12 cos(θ − γ), P = p ψ²/(η |v|), P = 0 at ζ = ±1.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from kshm.arrays import Array
from kshm.mechanics.cubic_diagrams import Nodes, middle_slope

Complex = NDArray[np.complex128]
_AROUND, _COSINES = 80, 8
_CUTS = 60  # more than the lines between the ends of a film: the cut moves one in a step
_DEEPEST = 5.0  # artanh ε where the map ends: some nanometres of film
_ROWS, _DIRECTIONS, _COLUMNS = 33, 37, 49
_KEPT = 64
_NOTHING = 1e-300
# Cubics through two points with the slopes of the chords beside them, Catmull and Rom.
_CUBIC = np.array([[0, -1, 2, -1], [2, 0, -5, 3], [0, 1, 4, -3], [0, 0, -1, 1]]) / 2

_AROUND_CORNER = np.arange(4)[:, None] * (_COLUMNS + 2) + np.arange(4)


def squeeze_force(eccentricity: Array, direction: Array, width: float) -> Complex:
    """F ψ²/(B D η |v|) [-] with its direction from the line of centres, Reynolds.

    Args:
        eccentricity: ε [-], (cases,), below 1.
        direction: γ of the velocity from the line of centres [rad], (cases,).
        width: b = B/D [-].
    """
    e = eccentricity
    near = np.sqrt(np.sqrt((1 - e) / (1 + e)))  # how much closer the lines stand in the gap
    first = 2 * np.arctan2(np.cos(direction / 2), -near * np.sin(direction / 2))
    step = 2 * np.pi / _AROUND
    # The first line stands opposite to the velocity, where there is no pressure.
    place = (first + step * np.arange(1, _AROUND)[:, None]) / 2
    theta, length = _line(place, near, step)
    between, across = _line(np.vstack([place - step / 4, place[-1:] + step / 4]), near, step)
    flux = (1 - e * np.cos(between)) ** 3 / across
    source = 12 * np.cos(theta - direction) * length
    drain = (1 - e * np.cos(theta)) ** 3 * length
    pressure = _cut(flux, drain, source, width) * length
    force: Complex = (pressure * np.exp(1j * theta)).sum(axis=0) / 4
    return force


def _line(half: Array, near: Array, step: float) -> tuple[Array, Array]:
    """Angles θ [rad] of the lines along the axis, and the length of the step there."""
    sine, cosine = near * np.sin(half), np.cos(half)
    length: Array = step * near / (sine**2 + cosine**2)
    return 2 * np.arctan2(sine, cosine), length


def _cut(flux: Array, drain: Array, source: Array, width: float) -> Array:
    """Pressure integrated along the axis on each line, (lines, cases), nowhere below zero.

    Lines without pressure are found by active sets: those that would pull leave, those that
    would be pressed come back.
    """
    orders = np.pi * (np.arange(_COSINES)[:, None] + 0.5)
    shares = 2 * (-1.0) ** np.arange(_COSINES)[:, None] / orders
    held = (orders / width) ** 2
    whole = np.zeros_like(source)
    left = np.arange(source.shape[1])  # cases whose cut still moves
    full = np.ones(source.shape, dtype=bool)
    for _ in range(_CUTS):
        f, s = flux[:, left], source[:, left]
        series = _solved(f, drain[:, None, left] * held, s[:, None] * shares, full)
        mean = (series * shares).sum(axis=1)
        pressed = 2 * s
        pressed[:-1] += f[1:-1] * mean[1:]
        pressed[1:] += f[1:-1] * mean[:-1]
        now = np.where(full, mean >= 0, pressed > 0)
        moved = (now != full).any(axis=0)
        whole[:, left] = mean
        if not moved.any():
            break
        left, full = left[moved], now[:, moved]
    return whole


def _solved(flux: Array, drain: Array, source: Array, full: NDArray[np.bool_]) -> Array:
    """Series on the lines by elimination; zero on lines that are not full."""
    middle = np.where(full[:, None], (flux[:-1] + flux[1:])[:, None] + drain, 1.0)
    right = np.where(full[:, None], source, 0.0)
    below = np.where(full, flux[:-1], 0.0)[:, None]
    above = np.where(full, flux[1:], 0.0)[:, None]
    ratio = np.empty_like(middle)
    ratio[0] = above[0] / middle[0]
    right[0] /= middle[0]
    for i in range(1, len(middle)):
        pivot = middle[i] - below[i] * ratio[i - 1]
        ratio[i] = above[i] / pivot
        right[i] = (right[i] + below[i] * right[i - 1]) / pivot
    for i in range(len(middle) - 2, -1, -1):
        right[i] += ratio[i] * right[i + 1]
    return right


@dataclass(frozen=True, slots=True)
class MobilityMap:
    """Maps of bearings of the widths b, a table for each width.

    Rows are even in artanh ε, columns in the ``_seen`` direction of the load; an entry is
    ln G + ia of the velocity (cos a + iq sin a)/G with ``_stretch`` q.  Both change evenly.
    """

    tables: Complex  # (tables · rows · columns,), with a rim of one row and column
    first: NDArray[np.int_]  # of each bearing's table, (bearings,)

    @classmethod
    def of(cls, width: Array) -> MobilityMap:
        """Maps of bearings of the widths b [-], (bearings,)."""
        widths, which = np.unique(width, return_inverse=True)
        tables = np.array([_table(float(b)) for b in widths])
        return cls(tables.ravel(), which * tables[0].size)

    def velocity(self, eccentricity: Array, load: Complex) -> Complex:
        """Velocity [1/rad] under a load F ψ²/(B D η ω) seen from the line of centres.

        Shapes (…, bearings); ε [-] below 1.
        """
        e = eccentricity
        sizes = np.abs(load)
        seen = _seen(load, e)
        found = self._at(np.arctanh(e) * ((_ROWS - 1) / _DEEPEST), seen * ((_COLUMNS - 1) / np.pi))
        along = np.cos(found.imag)
        across = np.sin(found.imag) * _stretch(e, seen)
        speed = sizes * np.exp(-found.real)
        motion: Complex = speed * (along + 1j * np.copysign(across, load.imag))
        return motion

    def _at(self, row: Array, column: Array) -> Complex:
        """Entries between the points of the tables, by cubics both ways."""
        i = np.clip(row.astype(int), 0, _ROWS - 2)
        j = np.clip(column.astype(int), 0, _COLUMNS - 2)
        corner = self.first + i * (_COLUMNS + 2) + j
        around = _AROUND_CORNER.reshape(4, 4, *(1,) * corner.ndim)
        near = self.tables.take(corner + around)
        part = (near * _weights(column - j)).sum(axis=1)
        value: Complex = (part * _weights(row - i)).sum(axis=0)
        return value


def _weights(share: Array) -> Array:
    square = share * share
    powers = np.stack([np.ones_like(share), share, square, square * share])
    weights: Array = _CUBIC @ powers.reshape(4, -1)
    return weights.reshape(powers.shape)


def _seen(load: Complex, e: Array) -> Array:
    """Direction of the load in which the map is even: near contact it hardly turns, 0…π."""
    ahead = load.real / np.maximum(np.abs(load), _NOTHING)
    turned: Array = np.arctan2(np.abs(load.imag), load.real * np.power(1 - e * e, (1 + ahead) / 4))
    return turned


def _stretch(e: Array, seen: Array | float) -> Array:
    """Ratio of tan γ to tan a: sideways a journal near contact moves much more easily."""
    return np.power((1 + 3 * e * e) / np.sqrt(1 - e * e), (1 + np.cos(seen)) / 2)


@lru_cache(maxsize=_KEPT)
def _table(width: float) -> Complex:
    """Table of a width with its rim, (rows + 2, columns + 2)."""
    e = np.tanh(np.linspace(0, _DEEPEST, _ROWS))[:, None]
    turn = np.linspace(0, np.pi, _DIRECTIONS)
    # Sideways, where the force falls off, the directions stand close.
    close = np.where(turn < np.pi / 2, 1.0, 0.3)
    gamma = np.arctan2(np.sin(turn) * _stretch(e, 0.0) ** close, np.cos(turn))
    rows = np.broadcast_to(e, gamma.shape).ravel()
    force = squeeze_force(rows, gamma.ravel(), width).reshape(gamma.shape)
    seen = _seen(force, e)
    stretch = _stretch(e, seen)
    angle = np.arctan2(np.sin(gamma), np.cos(gamma) * stretch)
    size = np.log(np.abs(force) * np.hypot(np.cos(angle), stretch * np.sin(angle)))
    lines = zip(seen, size, angle, strict=True)
    inside = np.array(
        [_even(at, size, 1) + 1j * _even(at, turned, -1) for at, size, turned in lines]
    )
    above, below = (3 * (a - b) + c for a, b, c in (inside[:3], inside[:-4:-1]))
    rim = np.vstack([above, inside, below])
    before, after = rim[:, 1:2].conj(), rim[:, -2:-1].conj() + 2j * np.pi
    table: Complex = np.hstack([before, rim, after])
    table.setflags(write=False)
    return table


def _even(seen: Array, values: Array, mirror: int) -> Array:
    """Values at even directions 0…π by cubics that never leave their neighbours.

    Beyond the ends the values are mirrored, or turned about the ends with ``mirror`` −1.
    """
    ends = values[[0, -1]] * (1 - mirror)
    at = np.concatenate([-seen[1:2], seen, 2 * np.pi - seen[-2:-1]])
    y = np.concatenate([ends[:1] + mirror * values[1:2], values, ends[1:] + mirror * values[-2:-1]])
    width, chord = np.diff(at), np.diff(y) / np.diff(at)
    slope = middle_slope(chord[:-1], chord[1:], width[:-1], width[1:])
    return Nodes(seen, values, slope).at(np.linspace(0, np.pi, _COLUMNS))
