"""Tables over the crank angle whose columns another table has: such numbers are printed once."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from reports.document.text.terms import Terms

Columns = tuple[str, Sequence[str] | None]  # a table and those of its columns that are printed
_NEAR = 1e-6  # of the largest number of a column


def repeated(terms: Terms, tables: Sequence[Columns]) -> dict[str, str]:
    """Return the tables that repeat one before them, each with that one.

    A table of one cylinder's torques repeats the table of its forces: each column of the one is
    a column of the other, to the same unit.  The books must number both, so that the one that
    stands can say for which it stands.
    """
    standing: list[Columns] = []
    same: dict[str, str] = {}
    for key, columns in tables:
        number = terms.model.tables[key].number
        holders = (
            other
            for other, keys in standing
            if number and _holds(terms, (other, keys), key, columns)
        )
        other = next(holders, "")
        if other:
            same[key] = other
        else:
            standing.append((key, columns))
    return same


def _holds(terms: Terms, standing: Columns, key: str, columns: Sequence[str] | None) -> bool:
    """Whether a table that stands has all columns of another."""
    other, keys = standing
    if not terms.model.tables[other].number:
        return False
    if len(terms.model.tables[other].rows) != len(terms.model.tables[key].rows):
        return False
    there = printed(terms, other, keys)
    return all(
        any(_are_equal(terms, f"{key}.{one}", f"{other}.{two}") for two in there)
        for one in printed(terms, key, columns)
    )


def printed(terms: Terms, table: str, keys: Sequence[str] | None) -> list[str]:
    """Columns of a table that a note prints."""
    columns = terms.model.tables[table].columns
    return list(keys) if keys is not None else [each.key for each in columns if not each.helper]


def _are_equal(terms: Terms, one: str, other: str) -> bool:
    if terms.unit(one) != terms.unit(other):
        return False
    first, second = terms.column(one), terms.column(other)
    most = max(float(np.abs(first).max()), float(np.abs(second).max()))
    return bool(np.allclose(first, second, rtol=0, atol=_NEAR * most))
