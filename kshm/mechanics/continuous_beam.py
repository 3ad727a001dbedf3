"""Main-bearing reactions of the continuous shaft by the equation of three moments, Gots (54).

The shaft is a straight beam of one bending stiffness in both planes on rigid point
supports in a line, so that the stiffness itself falls out; the throws are as stiff as the
journals between them.  Moments are those that a load along the axis would make in a simple
beam, axes are those of the shaft (x left, y up along crank 1, turning with it).  In (54)
the second subscript of the last moment is read as the right support.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from kshm.arrays import Array
from kshm.mechanics.journals import Load


def load_terms(loads: Iterable[Load], length: Array, shape: tuple[int, ...]) -> tuple[Array, Array]:
    """Load terms Σ P a(l² − a²)/l and Σ P b(l² − b²)/l of spans [N·m²], Clapeyron, Gots (54).

    Args:
        loads: forces on the spans; their arrays broadcast with ``shape``.
        length: lengths of the spans l [m], broadcasting likewise.
        shape: of the terms without the last axis ``left``, ``up``.

    Returns:
        Terms of the right and of the left support, shape (*shape, 2).
    """
    right, left = np.zeros((*shape, 2)), np.zeros((*shape, 2))
    for load in loads:
        rest = length - load.place
        for axis, force in enumerate((load.left, load.up)):
            right[..., axis] += force * load.place * (length**2 - load.place**2) / length
            left[..., axis] += force * rest * (length**2 - rest**2) / length
    return right, left


def support_moments(spans: Array, right: Array, left: Array, ends: Array) -> Array:
    """Bending moments at all supports by Clapeyron's equation [N·m], Gots (54).

    Args:
        spans: lengths of the spans [m], shape (n,).
        right: Σ P a(l² − a²)/l of each span [N·m²], shape (n, …).
        left: Σ P b(l² − b²)/l of each span [N·m²], same shape.
        ends: moments at the first and the last support from the overhangs, shape (2, …).

    Returns:
        Shape (n + 1, …).
    """
    count = len(spans)
    moments = np.zeros((count + 1, *right.shape[1:]))
    moments[0], moments[-1] = ends[0], ends[1]
    if count == 1:
        return moments
    matrix = np.diag(2 * (spans[:-1] + spans[1:]))
    matrix += np.diag(spans[1:-1], 1) + np.diag(spans[1:-1], -1)
    known = -(right[:-1] + left[1:])
    known[0] -= spans[0] * ends[0]
    known[-1] -= spans[-1] * ends[1]
    flat = known.reshape(count - 1, -1)
    moments[1:-1] = np.linalg.solve(matrix, flat).reshape(known.shape)
    return moments


def corrections(spans: Array, moments: Array) -> Array:
    """What inner support moments add to the split scheme's reactions [N], Gots (54).

    The overhangs are in the split scheme already, so the end moments add nothing here.
    Shapes (n,) of the spans [m] and (n + 1, …) of the moments [N·m] and of the result.
    """
    inner = moments.copy()
    inner[0] = inner[-1] = 0
    steps = np.diff(inner, axis=0) / spans.reshape(-1, *([1] * (inner.ndim - 1)))
    added = np.zeros_like(inner)
    added[:-1] -= steps
    added[1:] += steps
    return added
