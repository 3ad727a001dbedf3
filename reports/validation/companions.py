"""Look-ups of the companion sources' tables."""

from __future__ import annotations

import re

import numpy as np

from kshm.mechanics import dimensionless, harmonics, kinematics
from reports.validation.checks import Lookup
from reports.validation.gots_text import minutes

_MULTIPLE = re.compile(r"(\d*)p(\d)")


def segal_angles() -> Lookup:
    """Segal, table 2: β for α and λ, in minutes."""

    def look(row: str, column: str) -> float:
        alpha, lam = np.radians(float(row)), np.array(float(column))
        return minutes(float(kinematics.rod_angle(alpha, lam)))

    return look


def segal_displacements() -> Lookup:
    """Segal, table 3: exact s for α and λ."""

    def look(row: str, column: str) -> float:
        alpha, lam = np.radians(float(row)), np.array(float(column))
        return float(dimensionless.exact(alpha, lam).s)

    return look


def neiman_multiples() -> Lookup:
    """Neiman, tables 1, 2 and 4: n·p_m by the series cut after sin⁸."""

    def look(row: str, column: str) -> float:
        lam = 1 / float(row)
        if column == "k":
            return harmonics.printed_coefficient(lam, 0)
        found = _MULTIPLE.fullmatch(column)
        if found is None:
            raise KeyError(f"unknown column {column}")
        return int(found[1] or 1) * harmonics.printed_coefficient(lam, int(found[2]))

    return look


def neiman_speeds() -> Lookup:
    """Neiman, table 3: angle of the greatest speed and its ratio to the mean one."""

    def look(row: str, column: str) -> float:
        angle, ratio = harmonics.max_velocity(np.array(1 / float(row)))
        return minutes(float(angle)) if column == "alpha1" else float(ratio)

    return look
