"""A printed number held against ours, and what that says."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from enum import StrEnum
from functools import lru_cache

from reports.validation.printed import Cell, Number, cells_of, number, rows_of

Ours = float | str
Lookup = Callable[[str, str], Ours]

UNKNOWN = "—"  # ours where the source does not say enough to compute it
_HAIR = 1e-9  # rounding of the comparison itself


class Verdict(StrEnum):
    """What a printed number turned out to be."""

    AGREES = "agrees"
    MISPRINT = "misprint"
    OTHER_RUN = "other_run"
    NOT_REPRODUCED = "not_reproduced"
    NEW = "new"  # deviates and nothing is recorded about it, or recorded and does not deviate


@dataclass(frozen=True, slots=True)
class Tolerance:
    """How far ours may be: in units of the last printed digit, or absolute.

    Attributes:
        units: For every column, or by column key with "" for the rest.
        absolute: In the unit of the table instead.
        why: What of the print makes it so wide (Russian).
    """

    units: float | Mapping[str, float] = 0.5
    absolute: float | None = None
    why: str = "половина последнего знака"

    def of(self, cell: Cell, printed: Number) -> float:
        """Allowed distance of a cell."""
        if self.absolute is not None:
            return self.absolute
        units = self.units
        if cell.units is not None:
            units = cell.units
        elif isinstance(units, Mapping):
            units = units.get(cell.column, units[""])
        return units * printed.unit


@dataclass(frozen=True, slots=True)
class Erratum:
    """What is known about a printed number that is not ours."""

    value: str
    verdict: Verdict
    reason: str


@dataclass(frozen=True, slots=True)
class Table:
    """A printed table and what computes it.

    Attributes:
        id: Key of the errata and of the results.
        source: Key of the source.
        place: Where it is printed (Russian).
        title: What it holds (Russian).
        run: What computes it (Russian).
        ours: Makes the look-up of our values by row and column.
        tolerance: How far they may be.
        cells: Printed cells.
        notes: What is wrong with the table as a whole (Russian).
    """

    id: str
    source: str
    place: str
    title: str
    run: str
    ours: Callable[[], Lookup]
    tolerance: Tolerance = Tolerance()
    cells: Callable[[str], Iterator[Cell]] = cells_of
    notes: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Check:
    """A printed number, ours and the verdict.

    ``deviation`` is ours − printed in the unit of the print (minutes for angles with
    minutes), None where one of the two is no number; ``units`` is its size in units of
    the last digit.
    """

    table: Table
    cell: Cell
    printed: Number | None
    ours: Ours
    deviation: float | None
    tolerance: float | None
    verdict: Verdict
    reason: str = ""
    should_be: str = ""

    @property
    def is_sign(self) -> bool:
        """Whether a sign is compared, which is no number."""
        return self.printed is None and sign(self.cell.text) in ("+", "-")

    @property
    def is_number(self) -> bool:
        """Whether a printed number is held against one that is computed without it."""
        return not (self.is_sign or self.cell.is_place)

    @property
    def name(self) -> tuple[str, str]:
        """Row and column."""
        return self.cell.row, self.cell.column

    @property
    def units(self) -> float | None:
        """Distance in units of the last printed digit."""
        if self.deviation is None or self.printed is None:
            return None
        return abs(self.deviation) / self.printed.unit


@lru_cache(maxsize=1)
def errata() -> dict[tuple[str, str, str], Erratum]:
    """Everything that is recorded, by table, row and column."""
    return {
        (row["table"], row["row"], row["column"]): Erratum(
            row["value"], Verdict(row["verdict"]), row["reason"]
        )
        for row in rows_of("errata")
    }


def check_table(table: Table) -> tuple[Check, ...]:
    """Every printed cell of a table with its verdict."""
    ours = table.ours()
    return tuple(
        check_cell(table, cell, ours(cell.row, cell.column)) for cell in table.cells(table.id)
    )


def check_cell(table: Table, cell: Cell, ours: Ours) -> Check:
    """One printed cell with its verdict."""
    printed = number(cell.text)
    known = errata().get((table.id, cell.row, cell.column))
    deviation = tolerance = None
    if printed is not None and not isinstance(ours, str):
        deviation = ours - printed.value
        if printed.bound:
            deviation = max(0.0, deviation)
        tolerance = table.tolerance.of(cell, printed)
        agrees = abs(deviation) <= tolerance + _HAIR * printed.unit
    else:
        agrees = isinstance(ours, str) and sign(cell.text) == ours
    verdict, reason, value = Verdict.AGREES, "", ""
    if known is not None and not agrees:
        verdict, reason, value = known.verdict, known.reason, known.value
    elif known is not None:
        verdict, reason = Verdict.NEW, f"записано отклонение, но число сходится: {known.reason}"
    elif not agrees:
        verdict, reason = Verdict.NEW, "отклонение без записанной причины"
    return Check(table, cell, printed, ours, deviation, tolerance, verdict, reason, value)


def sign(text: str) -> str:
    """A printed sign whatever dash the press took."""
    return text.replace("–", "-").replace("—", "-").strip()
