"""A referee for the film: Reynolds' equation on a grid both ways, p ≥ 0 in every point.

Written apart from the solver: sparse matrices of scipy, the cut found point by point, finer
lines around the journal and points along it instead of cosines.
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import spsolve


def carried(
    centre: complex, velocity: complex, width: float, lines: int = 160, points: int = 16,
    *, fed: bool = False,
) -> complex:  # fmt: skip
    """F ψ²/(B D η) that the film carries at a centre ε e^{iδ} that moves without a wedge.

    ``fed`` puts p = 0 at the widest gap, as the printed tables of a turning journal have it.
    """
    e, unit = abs(centre), np.exp(1j * np.angle(centre))
    seen = velocity / unit
    near = ((1 - e) / (1 + e)) ** 0.3
    step = 2 * np.pi / lines
    at = -np.pi + step * np.arange(lines)

    def angle(x):
        return 2 * np.arctan2(near * np.sin(x / 2), np.cos(x / 2))

    def pitch(x):
        return step * near / (np.cos(x / 2) ** 2 + near**2 * np.sin(x / 2) ** 2)

    theta, size = angle(at), pitch(at)
    between = at + step / 2
    ahead = (1 - e * np.cos(angle(between))) ** 3 / pitch(between)
    behind = np.roll(ahead, 1)
    share = np.full(points, 1 / points)
    share[0] /= 2  # the middle of the bearing
    along = ((1 - e * np.cos(theta)) ** 3 * size * points / width**2)[:, None]
    number = np.arange(lines * points).reshape(lines, points)
    whole = np.outer(ahead + behind, share)
    whole[:, :-1] += along
    whole[:, 1:] += along
    whole[:, -1:] += along  # the end, where there is no pressure
    parts = [
        (number, number, whole),
        (number, np.roll(number, -1, 0), -np.outer(ahead, share)),
        (number, np.roll(number, 1, 0), -np.outer(behind, share)),
        (number[:, :-1], number[:, 1:], np.broadcast_to(-along, (lines, points - 1))),
        (number[:, 1:], number[:, :-1], np.broadcast_to(-along, (lines, points - 1))),
    ]
    row, column, value = (np.concatenate([p[k].ravel() for p in parts]) for k in range(3))
    matrix = sparse.csr_matrix((value, (row, column)))
    push = np.outer(12 * (np.cos(theta) * seen.real + np.sin(theta) * seen.imag) * size, share)
    pressure = _complementary(matrix, push.ravel(), number[0] if fed else number[:0, 0])
    line = 2 * (pressure.reshape(lines, points) * share).sum(axis=1)
    return complex(unit * (line * size * np.exp(1j * theta)).sum() / 4)


def _complementary(matrix, push, empty):
    """p ≥ 0, Ap − f ≥ 0, one of them zero in each point; none in the points ``empty``."""
    out = np.zeros(len(push), dtype=bool)
    out[empty] = True
    for _ in range(200):
        inside = np.flatnonzero(~out)
        pressure = np.zeros(len(push))
        pressure[inside] = spsolve(matrix[inside][:, inside].tocsc(), push[inside])
        rest = matrix @ pressure - push
        now = np.where(out, rest >= 0, pressure < 0)
        now[empty] = True
        if (now == out).all():
            return pressure
        out = now
    raise AssertionError("the cut does not settle")


def moved(centre, load, half_speed, step, width, guess, **grid):
    """Centre a step [rad] later by the implicit midpoint rule; load and speed of the middle."""

    def wrong(new):
        middle = (new + centre) / 2
        velocity = (new - centre) / step - 1j * half_speed * middle
        return carried(middle, velocity, width, **grid) / load - 1

    new = guess
    for _ in range(12):
        tiny = 1e-5 * (1 - abs(new))
        here = wrong(new)
        if abs(here) < 1e-4:
            return new
        by_x, by_y = (wrong(new + d) - here for d in (tiny, 1j * tiny))
        slope = np.array([[by_x.real, by_y.real], [by_x.imag, by_y.imag]]) / tiny
        x, y = np.linalg.solve(slope, [-here.real, -here.imag])
        change = x + 1j * y
        while abs(new + change) >= 1 - 0.3 * (1 - abs(new)):
            change /= 2
        new += change
    raise AssertionError(f"no balance of forces at {centre}")
