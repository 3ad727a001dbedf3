"""The printed tables of the sources and what deviates in them.

The numbers, our values and the comparison are those of ``reports.studies``.

@book{gots2006,
  author    = {Гоц, А. Н.},
  title     = {Кинематика и динамика кривошипно-шатунного механизма поршневых двигателей},
  publisher = {Владим. гос. ун-т},
  address   = {Владимир},
  year      = {2006},
  isbn      = {5-89368-664-0},
}
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache

from reports.studies.validation_checks import (
    Check,
    PrintTolerance,
    Verdict,
    cells_of,
    check_table,
    errata,
    number,
    rows_of,
)
from reports.studies.validation_lookups import on_grid, solution
from reports.studies.validation_registry import table

__all__ = ["number", "on_grid", "rows_of", "solution"]

Name = tuple[str, str]  # row, column


@lru_cache(maxsize=64)
def checks(name: str) -> dict[Name, Check]:
    """Every printed cell of a table."""
    return {check.name: check for check in check_table(table(name))}


def beyond(name: str) -> set[Name]:
    """Cells further away than the rounding of the print, whatever is recorded about them."""
    return {key for key, check in checks(name).items() if not agrees(check)}


def agrees(check: Check) -> bool:
    """By the numbers alone."""
    if check.deviation is None or check.tolerance is None:
        return check.verdict is Verdict.AGREES
    return abs(check.deviation) <= check.tolerance + 1e-9 * check.printed.unit


def recorded(name: str, *kinds: Verdict) -> set[Name]:
    """Cells that the errata name, all or those of some verdicts."""
    return {
        key[1:]
        for key, erratum in errata().items()
        if key[0] == name and (not kinds or erratum.verdict in kinds)
    }


def tolerance_of(name: str) -> PrintTolerance:
    """How far our values may be."""
    return table(name).tolerance


def ours(name: str, row: str, column: str = "") -> float:
    """Our value beside a printed one."""
    return float(checks(name)[row, column].ours)


def propagated(name: str, first: str) -> Iterator[float]:
    """Distances in last digits from multiples of another printed table's numbers."""
    base = {cell.row + cell.column: cell.text for cell in cells_of(first)}
    for cell in cells_of(name):
        factor, _, order = cell.column.partition("p")
        printed = number(cell.text)
        expected = int(factor) * float(base[f"{cell.row}p{order}"])
        yield abs(printed.value - expected) / printed.unit
