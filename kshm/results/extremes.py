"""Means and extremes of curves with the first places where they stand."""

from __future__ import annotations

import numpy as np

from kshm.arrays import Array
from kshm.mechanics.wear import ray_angles

# Values this close to the extreme count as equal: the first angle or number is reported.
TIE = 1e-9
RAY_TIE = 1.0  # Pa: sums of rays that differ by less are alike, whatever their size
UNLOADED = 1e-3  # Pa: specific forces below are rounding noise of zero


def first_extremes(
    values: Array, where: Array, *, largest: bool = True, floor: float = 1.0
) -> tuple[Array, Array]:
    """Extreme of each row and the first place where it is reached within rounding.

    Args:
        values: shape (..., places).
        where: the places, shape (places,).
        largest: the maximum, else the minimum.
        floor: extremes smaller than that are rounded like it.

    Returns:
        Extremes and places, both of shape (...,).
    """
    signed = values if largest else -values
    top = signed.max(axis=-1, keepdims=True)
    reached = signed >= top - TIE * np.maximum(floor, np.abs(top))
    extreme = top[..., 0] if largest else -top[..., 0]
    return extreme, where[np.argmax(reached, axis=-1)]


def first_extreme(
    values: Array, where: Array, *, largest: bool = True, floor: float = 1.0
) -> tuple[float, float]:
    """The same of one curve, shape (places,)."""
    extreme, place = first_extremes(values, where, largest=largest, floor=floor)
    return float(extreme), float(place)


def first_number(values: Array) -> Array:
    """Number, from 1, of the first value of each row that equals its largest within rounding."""
    return first_extremes(values, np.arange(1.0, values.shape[-1] + 1))[1]


def mean_of(curve: Array) -> Array:
    """Mean over the cycle of shape (...,): the repeated last angle counts once."""
    mean: Array = curve[..., :-1].mean(axis=-1)
    return mean


def summary_of(name: str, curve: Array, phi: Array) -> dict[str, Array]:
    """Mean and extremes of ``curve``, shape (..., angles), with their angles, by key."""
    largest, at_largest = first_extremes(curve, phi)
    smallest, at_smallest = first_extremes(curve, phi, largest=False)
    return {
        f"{name}_mean": mean_of(curve),
        f"{name}_max": largest,
        f"phi_{name}_max_deg": at_largest,
        f"{name}_min": smallest,
        f"phi_{name}_min_deg": at_smallest,
    }


def least_loaded(sums: Array) -> tuple[Array, Array]:
    """Number of the ray with the smallest sum and the place of the oil hole [rad].

    Where several rays are loaded least, often not at all, the middle of their widest arc is
    taken: its place hardly depends on the step.  Rays are directions of the force on the
    journal; the journal is touched on the side from which the force comes, half a turn away.
    Shape of both (...,) for ``sums`` of shape (..., rays).
    """
    count = sums.shape[-1]
    least = sums.min(axis=-1, keepdims=True)
    tied = sums < least + RAY_TIE
    places = np.arange(2 * count + 1)  # two turns: an arc may pass the first ray
    broken = np.where(tied[..., places % count], -1, places)
    arcs = (places - np.maximum.accumulate(broken, axis=-1))[..., count:]  # ending at each ray
    ray = (arcs.argmax(axis=-1) - arcs.max(axis=-1) // 2) % count + 1
    return ray.astype(float), np.mod(ray_angles(count)[ray - 1] + np.pi, 2 * np.pi)
