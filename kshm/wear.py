"""Conditional wear diagrams by rays, Gots 2.6 and table 14."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

HALF_WINDOW = np.pi / 3
# The window includes its edges: forces at dead centres lie exactly on them.
EDGE = 1e-9


def ray_angles(rays: int) -> Array:
    """Angles of the rays against rotation from ray I [rad], shape (rays,)."""
    return 2 * np.pi / rays * np.arange(rays, dtype=np.float64)


def ray_loads(up: Array, against: Array, rays: int) -> Array:
    """Force counted at each ray within ±60°, zero elsewhere, Gots table 14.

    Args:
        up: force component along ray I, shape (..., angles).
        against: component a quarter turn from it against rotation, same shape.
        rays: number of rays, 12 or 18.

    Returns:
        Shape (..., angles, rays) in the unit of the components.
    """
    size = np.hypot(up, against)
    delta = ray_angles(rays)
    projection = up[..., None] * np.cos(delta) + against[..., None] * np.sin(delta)
    inside = projection >= size[..., None] * (np.cos(HALF_WINDOW) - EDGE)
    return np.where(inside, size[..., None], 0.0)


def ray_sums(loads: Array) -> Array:
    """Sum over one cycle for each ray; the repeated last angle is left out. Shape (..., rays)."""
    sums: Array = loads[..., :-1, :].sum(axis=-2)
    return sums
