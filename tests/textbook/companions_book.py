"""Printed tables of the companion sources beside ours, and the errata that name the rest."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from tests.textbook.book import rows_of

Name = tuple[str, str]  # row label, column


def number(text: str) -> tuple[float, float]:
    """A printed number and one unit of its last digit; degrees and minutes in minutes."""
    if " " in text:
        degrees, minutes = text.split()
        return 60 * float(degrees) + float(minutes), 1.0
    return float(text), 10.0 ** -len(text.partition(".")[2])


def deviations(table: str, ours: Callable[[float, str], float]) -> dict[Name, float]:
    """Printed cell → distance from ours in units of the last printed digit."""
    found = {}
    for row in rows_of(table):
        label, *_ = row.values()
        for column, text in list(row.items())[1:]:
            if text:
                printed, unit = number(text)
                found[label, column] = abs(printed - ours(float(label), column)) / unit
    return found


def beyond_a_unit(found: dict[Name, float]) -> set[Name]:
    return {name for name, value in found.items() if not value <= 1 + 1e-9}


def errata(table: str) -> set[Name]:
    """Cells that the errata put further than one unit away."""
    return {
        (row["row"], row["column"])
        for row in rows_of("errata_companions")
        if row["table"] == table and row["class"].startswith("error")
    }


def minutes(degrees: float) -> float:
    return 60 * degrees


def rounds_to(value: float, printed: str) -> bool:
    """Whether a number rounds to a printed one."""
    target, unit = number(printed)
    return bool(np.abs(value - target) <= unit / 2 + 1e-9)
