"""Conditional wear diagrams by rays, Gots 2.6 and table 14."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from kshm.arrays import Array

HALF_WINDOW = np.pi / 3
# The window includes its edges: forces at dead centres lie exactly on them.
EDGE = 1e-9


def ray_angles(rays: int) -> Array:
    """Angles of the rays against rotation from ray I [rad], shape (rays,), Gots 2.6."""
    return 2 * np.pi / rays * np.arange(rays, dtype=np.float64)


def components(size: Array, ray: Array, rays: int) -> tuple[Array, Array]:
    """Components [N or Pa] along ray I and across it of forces that point at rays, Gots table 14.

    Args:
        size: lengths of the forces, shape (angles,).
        ray: where they point, counted from 0 at ray I, halves between two rays, same shape.
        rays: number of rays, 12 or 18.

    Returns:
        Two arrays of shape (angles,) in the unit of the lengths.
    """
    angle = 2 * np.pi / rays * ray
    return size * np.cos(angle), size * np.sin(angle)


def ray_loads(up: Array, against: Array, rays: int) -> Array:
    """Force [N or Pa] counted at each ray within ±60°, zero elsewhere, Gots table 14.

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


def ray_sums(up: Array, against: Array, size: Array, rays: int) -> Array:
    """Sum of ``ray_loads`` [N or Pa] over one cycle, the last angle left out, Gots table 14.

    Which rays count a force depends only on the sector that it points into, so the forces
    are summed by sectors first.  The edges of all windows are directions of rays, because
    60° is a multiple of the angle between them.

    Args:
        up: force component along ray I, shape (..., angles).
        against: component a quarter turn from it against rotation, same shape.
        size: length of the force, same shape.
        rays: number of rays, 12 or 18.

    Returns:
        Shape (..., rays) in the unit of the components.
    """
    count = 2 * rays + 1
    row = count * np.arange(size[..., 0].size).reshape(*size.shape[:-1], 1)
    once = size.copy()
    once[..., -1] = 0
    sector = row + _sectors(up, against, size, rays).astype(np.int64)
    by_sector = np.bincount(sector.ravel(), weights=once.ravel(), minlength=count * row.size)
    return by_sector.reshape(*size.shape[:-1], count) @ _counted_at(rays)


def _sectors(up: Array, against: Array, size: Array, rays: int) -> NDArray[np.int8]:
    """Sector of each force: 2k along ray k within rounding, 2k + 1 between it and the next.

    The rays are symmetric about both axes, so the edges of one quadrant suffice.  Sums of
    truth values stay bytes, which is what makes them cheap.
    """
    along, across = np.abs(up), np.abs(against)
    slack = size * (EDGE / np.sin(HALF_WINDOW))  # the edge of ``ray_loads`` as an angle
    sector: NDArray[np.int8] = (across > slack).view(np.int8)
    least, most = across - slack, across + slack
    for angle in ray_angles(rays)[1 : (rays + 3) // 4]:
        edge = along * np.tan(angle)
        sector += (least > edge).view(np.int8)
        sector += (most >= edge).view(np.int8)
    if rays % 4 == 0:  # a ray stands at 90°
        sector += (along <= slack).view(np.int8)
    sector += (up < 0).view(np.int8) * (np.int8(rays) - 2 * sector)
    sector += (against < 0).view(np.int8) * (np.int8(2 * rays) - 2 * sector)
    return sector


def _counted_at(rays: int) -> Array:
    """1 where a ray counts the forces of a sector, shape (sectors, rays); the last is the first."""
    between = (np.arange(2 * rays + 1)[:, None] - 2 * np.arange(rays)) % (2 * rays)
    reach = 2 * rays // 6  # sectors are half as wide as the angle between rays
    return ((between <= reach) | (between >= 2 * rays - reach)).astype(float)
