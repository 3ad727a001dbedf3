"""Orbit of a journal's centre in its clearance over the cycle, by the mobility of its film.

Seen from axes that turn at the mean speed of journal and shell there is no wedge: the centre
moves as in a pure squeeze film (Booker 1965).  So one map of the force over the eccentricity
and the direction of the velocity carries every motion, and the film is cut off at p = 0 once,
for the velocity that it has.  Around the journal the equation is taken in finite differences,
along it as a series of cosines; a line along the axis is cut off where its mean pressure would
be negative.  A film that conserves its mass is thinner.

H³ = (1 − ε cos θ)³, θ from the line of centres:
∂/∂θ(H³ ∂P/∂θ) + b⁻² H³ ∂²P/∂ζ² = −12 cos(θ − γ), P = p ψ²/(η |v|), P = 0 at ζ = ±1.

The centre is a complex number ε e^{iδ}, angles in the direction of rotation, so that it may
pass through the middle.  All bearings step together, each with a step of its own, by
Shampine's linearly implicit pair (ode23s): a film that lets go is stiff, because a journal
moves away hundreds of times more easily than it comes near.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from kshm.arrays import Array
from kshm.errors import FilmError, InputError
from kshm.mechanics.bearings import check_widths
from kshm.mechanics.gas import Nodes, middle_slope

Complex = NDArray[np.complex128]
_AROUND, _COSINES = 80, 8
_CUTS = 60  # more than the lines between the ends of a film: the cut moves one in a step
_DEEPEST = 5.0  # artanh ε where the map ends: some nanometres of film
_ROWS, _DIRECTIONS, _COLUMNS = 33, 37, 49
_KEPT = 64
_TINY = 1e-300
# Cubics through two points with the slopes of the chords beside them, Catmull and Rom.
_CUBIC = np.array([[0, -1, 2, -1], [2, 0, -5, 3], [0, 1, 4, -3], [0, 0, -1, 1]]) / 2

_AROUND_CORNER = np.arange(4)[:, None] * (_COLUMNS + 2) + np.arange(4)
CLOSED = 1e-3  # of the clearance: how near the cycle's end must come to its start
MAX_CYCLES = 20
_TOUCHES = 1e-4  # of the clearance: some nanometres, which no film is
_TOLERANCE = 2e-4  # of the gap in a step
_MIN_STEP = 1e-9
_MAX_STEP = 0.2
_MIDDLE = 1e-9
_D, _E = 1 / (2 + np.sqrt(2)), 6 + np.sqrt(2)


def squeeze_force(eccentricity: Array, direction: Array, width: float) -> Complex:
    """F ψ²/(B D η |v|) [-] with its direction from the line of centres, shape (cases,), Reynolds.

    Args:
        eccentricity: ε [-], (cases,), below 1.
        direction: γ of the velocity from the line of centres [rad], (cases,).
        width: b = B/D [-].
    """
    e = eccentricity
    closeness = np.sqrt(np.sqrt((1 - e) / (1 + e)))  # how much closer the lines stand in the gap
    first = 2 * np.arctan2(np.cos(direction / 2), -closeness * np.sin(direction / 2))
    step = 2 * np.pi / _AROUND
    # The first line stands opposite to the velocity, where there is no pressure.
    half = (first + step * np.arange(1, _AROUND)[:, None]) / 2
    theta, length = _line(half, closeness, step)
    between, across = _line(np.vstack([half - step / 4, half[-1:] + step / 4]), closeness, step)
    flux = (1 - e * np.cos(between)) ** 3 / across
    source = 12 * np.cos(theta - direction) * length
    drain = (1 - e * np.cos(theta)) ** 3 * length
    pressure = _cut(flux, drain, source, width) * length
    force: Complex = (pressure * np.exp(1j * theta)).sum(axis=0) / 4
    return force


def _line(half: Array, closeness: Array, step: float) -> tuple[Array, Array]:
    """Angles θ [rad] of the lines along the axis, and the length of the step there."""
    sine, cosine = closeness * np.sin(half), np.cos(half)
    length: Array = step * closeness / (sine**2 + cosine**2)
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
        """Return maps of bearings of the widths b [-], shape (bearings,), Booker."""
        widths, which = np.unique(width, return_inverse=True)
        tables = np.array([_table(float(b)) for b in widths])
        return cls(tables.ravel(), which * tables[0].size)

    def velocity(self, eccentricity: Array, load: Complex) -> Complex:
        """Velocity [1/rad] under a load F ψ²/(B D η ω) seen from the line of centres.

        Booker's mobility; shapes (…, bearings); ε [-] below 1.
        """
        e = eccentricity
        sizes = np.abs(load)
        seen = _seen(load, e)
        entry = self._at(np.arctanh(e) * ((_ROWS - 1) / _DEEPEST), seen * ((_COLUMNS - 1) / np.pi))
        along = np.cos(entry.imag)
        across = np.sin(entry.imag) * _stretch(e, seen)
        speed = sizes * np.exp(-entry.real)
        motion: Complex = speed * (along + 1j * np.copysign(across, load.imag))
        return motion

    def _at(self, row: Array, column: Array) -> Complex:
        """Entries between the points of the tables, by cubics both ways."""
        i = np.clip(row.astype(int), 0, _ROWS - 2)
        j = np.clip(column.astype(int), 0, _COLUMNS - 2)
        corner = self.first + i * (_COLUMNS + 2) + j
        around = _AROUND_CORNER.reshape(4, 4, *(1,) * corner.ndim)
        corners = self.tables.take(corner + around)
        part = (corners * _weights(column - j)).sum(axis=1)
        value: Complex = (part * _weights(row - i)).sum(axis=0)
        return value


def _weights(share: Array) -> Array:
    square = share * share
    powers = np.stack([np.ones_like(share), share, square, square * share])
    weights: Array = _CUBIC @ powers.reshape(4, -1)
    return weights.reshape(powers.shape)


def _seen(load: Complex, e: Array) -> Array:
    """Direction of the load, stretched so that the map is even, 0…π."""
    ahead = load.real / np.maximum(np.abs(load), _TINY)
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


@dataclass(frozen=True, slots=True)
class Orbits:
    """Centres ε e^{iδ} over the cycle [-], shape (bearings, angles), and how they closed.

    ``opening`` is the distance of the cycle's end from its start [-], (bearings,).
    """

    centre: Complex
    opening: Array

    @property
    def closed(self) -> NDArray[np.bool_]:
        """Mask of closed orbits, shape (bearings,)."""
        return self.opening <= CLOSED


def velocity(centre: Complex, load: Complex, half_speed: Array, film: MobilityMap) -> Complex:
    """Return the derivative of ε e^{iδ} by the shaft's angle [1/rad], shape (…, bearings), Booker.

    Args:
        centre: ε e^{iδ} [-].
        load: F ψ²/(B D η ω) with its direction [-].
        half_speed: (ω_J + ω_B)/(2ω) in the axes of the load [-].
        film: maps of the bearings.
    """
    distance = np.abs(centre)
    unit: Complex = np.where(distance > _MIDDLE, centre / np.maximum(distance, _MIDDLE), 1.0)
    step: Complex = unit * film.velocity(distance, load * unit.conj()) + 1j * half_speed * centre
    return step


def orbits(
    phi: Array, load: Complex, half_speed: Array, width: Array, most_cycles: int = MAX_CYCLES
) -> Orbits:
    """Orbits over the closed cycle, shape (bearings, angles), by Booker's mobility.

    Args:
        phi: angles of the cycle with its end [rad], (angles,), in equal steps.
        load: F ψ²/(B D η ω) with its direction [-], (bearings, angles).
        half_speed: (ω_J + ω_B)/(2ω) [-], (bearings, angles).
        width: b of each bearing [-], (bearings,).
        most_cycles: when to give up.

    Raises:
        InputError: numbers that are none, or a width outside the tables of the steady film.
        FilmError: a load that the film does not carry.
    """
    check_widths(width)
    if not (np.isfinite(load).all() and np.isfinite(half_speed).all()):
        raise InputError("loads and speeds must be finite")
    run = _Run(phi, load, half_speed, width)
    first = load[:, 0]
    size = np.abs(first)
    centre: Complex = np.where(size > 0, 0.5 * first / np.where(size > 0, size, 1), 0.0) + 0j
    for cycle in range(1, most_cycles + 1):
        path = run.cycle(centre)
        opening = np.abs(path[:, -1] - centre)
        centre = path[:, -1]
        if (opening <= CLOSED).all() and cycle > 1:
            break
    return Orbits(path, opening)


class _Run:
    """Integration over one cycle after another; the steps that suited last are kept."""

    def __init__(self, phi: Array, load: Complex, half_speed: Array, width: Array) -> None:
        self.phi, self.film = phi, MobilityMap.of(width)
        self.pitch = phi[1] - phi[0]
        self.step = np.full(len(width), self.pitch / 8)
        self.first = np.arange(len(width)) * len(phi)
        self.load, self.speed = load.ravel(), half_speed.ravel()
        self.load_rise, self.speed_rise = (
            np.append(np.diff(values), 0) for values in (self.load, self.speed)
        )

    def slope(self, at: Array, centre: Complex) -> Complex:
        """Return derivatives, bearings on the last axis; NaN outside the clearance circle."""
        position = (at - self.phi[0]) / self.pitch
        before = np.minimum(position.astype(int), len(self.phi) - 2)
        share, row = position - before, self.first + before
        load = self.load.take(row) + share * self.load_rise.take(row)
        speed = self.speed.take(row) + share * self.speed_rise.take(row)
        return velocity(centre, load, speed, self.film)

    def cycle(self, start: Complex) -> Complex:
        """Centres at the angles of the grid, shape (bearings, angles)."""
        at, end = np.full(len(start), self.phi[0]), self.phi[-1]
        with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
            here = (at, start, self.slope(at, start))
            points = [here]
            while (left := end - here[0]).max() > 0:
                step = np.minimum(self.step, left)
                new, slope, error = self._try(*here, step)
                good = error <= 1
                then = (np.where(step >= left, end, here[0] + step), new, slope)
                here = (
                    np.where(good, then[0], here[0]),
                    np.where(good, then[1], here[1]),
                    np.where(good, then[2], here[2]),
                )
                points.append(here)
                factor = np.clip(0.9 / np.cbrt(np.maximum(error, 1e-6)), 0.2, 3.0)
                # A step that only the end of the cycle cut short says nothing of the next.
                whole = ~good | (step >= self.step)
                self.step = np.where(whole, np.minimum(step * factor, _MAX_STEP), self.step)
                if (self.step < _MIN_STEP).any():
                    raise FilmError(int(np.argmin(self.step)))
        return self._on_grid(points)

    def _try(
        self, at: Array, centre: Complex, slope: Complex, step: Array
    ) -> tuple[Complex, Complex, Array]:
        """One step of every bearing: centre, slope there, error over the tolerance."""
        room = np.maximum(1 - np.abs(centre), 1e-6)
        tiny, nudge = 1e-6 * room, 1e-4 * step + 1e-12
        probes = np.stack((centre + tiny, centre + 1j * tiny, centre))
        in_x, in_y, in_time = self.slope(np.stack((at, at, at + nudge)), probes) - slope
        by_x, by_y, drift = in_x / tiny, in_y / tiny, step * _D * in_time / nudge
        reach = step * _D
        a, b = 1 - reach * by_x.real, -reach * by_y.real
        c, d = -reach * by_x.imag, 1 - reach * by_y.imag
        whole = a * d - b * c

        def solved(right: Complex) -> Complex:
            x = (d * right.real - b * right.imag) / whole
            both: Complex = x + 1j * ((a * right.imag - c * right.real) / whole)
            return both

        first = solved(slope + drift)
        middle = self.slope(at + step / 2, centre + step / 2 * first)
        second = solved(middle - first) + first
        new = centre + step * second
        end = self.slope(at + step, new)
        third = solved(end - _E * (second - middle) - 2 * (first - slope) + drift)
        wrong = np.abs(step / 6 * (first - 2 * second + third))
        gap = 1 - np.abs(new)
        error = wrong / (_TOLERANCE * np.maximum(np.minimum(gap, room), 1e-3))
        return new, end, np.where(np.isfinite(error) & (gap > _TOUCHES), error, 1e3)

    def _on_grid(self, points: list[tuple[Array, Complex, Complex]]) -> Complex:
        """Centres at the angles of the grid between the points of the steps, Hermite's cubic."""
        angles, centres, slopes = (np.stack(each, axis=1) for each in zip(*points, strict=True))
        path = np.empty((len(angles), len(self.phi)), dtype=complex)
        for k, row in enumerate(angles):
            moved = np.append(True, np.diff(row) > 0)  # else a step refused, or none
            at, z, slope = row[moved], centres[k, moved], slopes[k, moved]
            after = np.maximum(np.searchsorted(at, self.phi), 1)
            before = after - 1
            h = at[after] - at[before]
            u = (self.phi - at[before]) / h
            v = 1 - u
            path[k] = v * v * ((1 + 2 * u) * z[before] + u * h * slope[before])
            path[k] += u * u * ((3 - 2 * u) * z[after] - v * h * slope[after])
        return path
