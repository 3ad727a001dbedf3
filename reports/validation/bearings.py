"""Oil film of journal bearings: Butenschön's printed numbers and a course work's pressure."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np

from kshm.arrays import Array
from kshm.mechanics import oil_film
from kshm.mechanics.oil_balance import BearingArrays
from kshm.mechanics.oil_map import squeeze_force
from kshm.nomenclature.quantity import UNITS
from reports.validation.gots_text import Number

_WIDTH = 0.5  # B/D


def _at(form: Callable[[Array, Array], Array], eccentricity: float) -> float:
    return float(form(np.array(eccentricity), np.array(_WIDTH)))


def _degrees(eccentricity: Array, width: Array) -> Array:
    return np.degrees(oil_film.attitude(eccentricity, width))


def _squeeze(eccentricity: Array, width: Array) -> Array:
    """So_V at ε signed as ε̇ is: a journal that comes near its shell or leaves it."""
    direction = np.where(eccentricity < 0, np.pi, 0.0)
    force = squeeze_force(np.abs(eccentricity)[None], direction[None], float(width))
    size: Array = np.abs(force[0])
    return size


def _pressure() -> float:
    """Mean pressure of the tractor diesel's crankpin 68 × 38 mm under 11,745 N [MPa]."""
    sizes = (0.068, 0.038, 1.0, 0.057e-3, 230.0, 0.005)
    bearing = BearingArrays(*(np.array([size]) for size in sizes))
    return float(11745 / bearing.area[0]) / UNITS["MPa"].si


FILM: dict[str, Number] = {
    **{f"so_d_{e}": partial(_at, oil_film.rotation_number, e / 100)
       for e in (10, 30, 50, 70, 80, 90, 95, 99)},
    **{f"beta_{e}": partial(_at, _degrees, e / 100) for e in (10, 50, 90, 95, 99)},
    **{f"so_v_{e}": partial(_at, _squeeze, e / 100) for e in (-90, -50, 0, 50, 90)},
}  # fmt: skip
PRESSURE: dict[str, Number] = {"k": _pressure}
