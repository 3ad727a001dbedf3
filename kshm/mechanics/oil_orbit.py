"""Orbit of a journal's centre in its clearance circle over the cycle, by the mobility of its film.

The load gives the velocity in axes that turn at the mean speed of journal and shell; these
axes turn the centre besides.  It is a complex number ε e^{iδ}, angles in the direction of
rotation, so that it may pass through the middle.  All bearings step together, each with a step
of its own, by Shampine's linearly implicit pair (ode23s): a film that lets go is stiff, because
a journal moves away hundreds of times more easily than it comes near.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from kshm.arrays import Array
from kshm.mechanics.oil_film import check_widths
from kshm.mechanics.oil_map import MobilityMap

Complex = NDArray[np.complex128]
CLOSED = 1e-3  # of the clearance: how near the cycle's end must come to its start
MOST_CYCLES = 20
_TOUCHES = 1e-4  # of the clearance: some nanometres, which no film is
_TOLERANCE = 2e-4  # of the gap in a step
_LEAST_STEP = 1e-9
_MOST_STEP = 0.2
_MIDDLE = 1e-9
_D, _E = 1 / (2 + np.sqrt(2)), 6 + np.sqrt(2)


class FilmError(ValueError):
    """A load that no film carries; ``bearing`` is its row among those asked for."""

    def __init__(self, bearing: int) -> None:
        super().__init__("the oil film does not carry the load")
        self.bearing = bearing


@dataclass(frozen=True, slots=True)
class Orbits:
    """Centres ε e^{iδ} over the cycle [-], shape (bearings, angles), and how they closed.

    ``opening`` is the distance of the cycle's end from its start [-], (bearings,).
    """

    centre: Complex
    opening: Array

    @property
    def closed(self) -> NDArray[np.bool_]:
        """Which orbits closed, shape (bearings,)."""
        return self.opening <= CLOSED


def velocity(centre: Complex, load: Complex, half_speed: Array, film: MobilityMap) -> Complex:
    """Derivative of ε e^{iδ} by the shaft's angle [1/rad], (…, bearings), Booker's mobility.

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
    phi: Array, load: Complex, half_speed: Array, width: Array, most_cycles: int = MOST_CYCLES
) -> Orbits:
    """Orbits over the closed cycle, shape (bearings, angles), by Booker's mobility.

    Args:
        phi: angles of the cycle with its end [rad], (angles,), in equal steps.
        load: F ψ²/(B D η ω) with its direction [-], (bearings, angles).
        half_speed: (ω_J + ω_B)/(2ω) [-], (bearings, angles).
        width: b of each bearing [-], (bearings,).
        most_cycles: when to give up.

    Raises:
        ValueError: numbers that are none, or a width outside the tables of the steady film.
        FilmError: a load that the film does not carry.
    """
    check_widths(width)
    if not (np.isfinite(load).all() and np.isfinite(half_speed).all()):
        raise ValueError("loads and speeds must be finite")
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
        """Derivatives, bearings on the last axis; NaN outside the clearance circle."""
        place = (at - self.phi[0]) / self.pitch
        before = np.minimum(place.astype(int), len(self.phi) - 2)
        share, row = place - before, self.first + before
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
                self.step = np.where(whole, np.minimum(step * factor, _MOST_STEP), self.step)
                if (self.step < _LEAST_STEP).any():
                    raise FilmError(int(np.argmin(self.step)))
        return self._on_grid(points)

    def _try(
        self, at: Array, centre: Complex, slope: Complex, step: Array
    ) -> tuple[Complex, Complex, Array]:
        """One step of every bearing: centre, slope there, error over the tolerance."""
        room = np.maximum(1 - np.abs(centre), 1e-6)
        tiny, nudge = 1e-6 * room, 1e-4 * step + 1e-12
        near = np.stack((centre + tiny, centre + 1j * tiny, centre))
        in_x, in_y, in_time = self.slope(np.stack((at, at, at + nudge)), near) - slope
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
        rest = 1 - np.abs(new)
        error = wrong / (_TOLERANCE * np.maximum(np.minimum(rest, room), 1e-3))
        return new, end, np.where(np.isfinite(error) & (rest > _TOUCHES), error, 1e3)

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
