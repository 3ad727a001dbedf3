"""When two numbers are the same: half a unit of the last digit that the book prints."""

from __future__ import annotations

from fnmatch import fnmatchcase

import numpy as np
from numpy.typing import NDArray

from reports.grading.issuing.assignment import Item
from reports.grading.reading.student import Student

Array = NDArray[np.float64]


def tolerance(item: Item, expected: Array, student: Student) -> float:
    """Largest difference that the book's rounding allows.

    Half a unit of the last digit that the book prints, but never more than a small
    share of the column: some quantities are smaller than their printed digits.
    """
    rules = student.assignment.rubric.tolerance
    for pattern, value in rules.items.items():
        if fnmatchcase(item.id, pattern):
            return float(value)
    digits = item.quantity.digits
    unit = 10.0**-digits.decimals
    finite = np.abs(expected[np.isfinite(expected)])
    largest = float(finite.max()) if finite.size else 0.0
    # A double carries about sixteen digits: results that differ in the tenth are equal.
    return max(min(rules.units * unit * (1 + 1e-9), rules.share * largest), 1e-10 * largest, 1e-12)


def close(item: Item, values: Array, expected: Array, allowed: float) -> NDArray[np.bool_]:
    """Where two columns agree; directions agree also a full turn apart."""
    with np.errstate(invalid="ignore"):
        difference = np.abs(values - expected)
        if item.quantity.unit == "deg":
            difference = np.minimum(difference, np.abs(360.0 - difference))
        return np.asarray(difference <= allowed)
