"""Read printed numbers and compare ours with them."""

from __future__ import annotations

import csv
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from enum import StrEnum
from functools import lru_cache

from kshm.nomenclature.dizdn_listing import OUTPUTS
from reports.shared.resources import validation_dir

_MINUTES = re.compile(r"(\d+) (\d\d)")
_FRACTION = re.compile(r"(\d+)/(\d+)")
_NUMBER = re.compile(r"-?\d+(\.\d*)?")
_UP_TO = "≤"
Ours = float | str
Lookup = Callable[[str, str], Ours]
UNKNOWN = "—"  # ours where the source does not say enough to compute it
_HAIR = 1e-9  # rounding of the comparison itself


@dataclass(frozen=True, slots=True)
class Number:
    """A printed number and one unit of its last digit; degrees and minutes in minutes."""

    value: float
    unit: float
    decimals: int = 0
    minutes: bool = False
    bound: bool = False


def number(text: str) -> Number | None:
    """Return what a printed text says; None where it is no number (a sign, a slip of the press)."""
    bound = text.startswith(_UP_TO)
    text = text.removeprefix(_UP_TO)
    if match := _MINUTES.fullmatch(text):
        return Number(60 * float(match[1]) + float(match[2]), 1.0, minutes=True)
    if match := _FRACTION.fullmatch(text):
        return Number(float(match[1]) / float(match[2]), 1e-9, 3)  # exact
    if not _NUMBER.fullmatch(text):
        return None
    decimals = len(text.partition(".")[2])
    return Number(float(text), 10.0**-decimals, decimals, bound=bound)


@dataclass(frozen=True, slots=True)
class PrintedCell:
    """A printed cell.

    Attributes:
        row: Label of the row as printed, key of the number in running text.
        column: Key of the column, empty for a number in running text.
        text: What is printed, with a decimal point.
        what: What the number is (Russian), of running text only.
        unit: Its unit (Russian), of running text only.
        units: Own tolerance in units of the last digit.
        is_place: What is checked is where the number stands or that none does, not the number.
    """

    row: str
    column: str
    text: str
    what: str = ""
    unit: str = ""
    units: float | None = None
    is_place: bool = False


@lru_cache(maxsize=64)
def rows_of(name: str) -> tuple[dict[str, str], ...]:
    """Rows of a data file by column."""
    with (validation_dir() / f"{name}.csv").open(encoding="utf-8", newline="") as stream:
        return tuple(csv.DictReader(stream))


def cells_of(table: str) -> Iterator[PrintedCell]:
    """Yield printed cells of a table file; its first column labels the rows."""
    for row in rows_of(table):
        label, *_ = row.values()
        for column, text in list(row.items())[1:]:
            if text and column != "phi_mirror_deg":
                yield PrintedCell(label, column, text)


def text_of(table: str) -> Iterator[PrintedCell]:
    """Yield printed numbers of a section of running text."""
    for row in rows_of("text"):
        if row["table"] == table:
            units = float(row["units"])
            yield PrintedCell(row["row"], "", row["printed"], row["what"], row["unit"], units)


def outputs_of(table: str) -> Iterator[PrintedCell]:
    """Yield printed outputs of the program: path of the number in the cycle, value."""
    quantities = {quantity.key: quantity for quantity in OUTPUTS}
    for row in rows_of(table):
        quantity = quantities[row["key"]]
        yield PrintedCell(row["key"], "value", row["value"], quantity.title, quantity.unit)


def window_cells(table: str) -> Iterator[PrintedCell]:
    """Cells of a wear table, the empty ones too: where a ray has no force."""
    for row in rows_of(table):
        label, *_ = row.values()
        for column, text in list(row.items())[1:]:
            yield PrintedCell(label, column, text, is_place=label.isdigit())


def force_cells(table: str) -> Iterator[PrintedCell]:
    """Yield the one force of each row of a wear table."""
    for row in rows_of(table):
        label, *texts = row.values()
        if label.isdigit():
            yield PrintedCell(label, "R_MPa", next(text for text in texts if text))


class Verdict(StrEnum):
    """What a printed number turned out to be."""

    AGREES = "agrees"
    MISPRINT = "misprint"
    OTHER_RUN = "other_run"
    NOT_REPRODUCED = "not_reproduced"
    NEW = "new"  # deviates and nothing is recorded about it, or recorded and does not deviate


@dataclass(frozen=True, slots=True)
class PrintTolerance:
    """How far ours may be: in units of the last printed digit, or absolute.

    Attributes:
        units: For every column, or by column key with "" for the rest.
        absolute: In the unit of the table instead.
        why: What of the print makes it so wide (Russian).
    """

    units: float | Mapping[str, float] = 0.5
    absolute: float | None = None
    why: str = "половина последнего знака"

    def of(self, cell: PrintedCell, printed: Number) -> float:
        """Return allowed distance of a cell."""
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
    tolerance: PrintTolerance = PrintTolerance()
    cells: Callable[[str], Iterator[PrintedCell]] = cells_of
    notes: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Check:
    """A printed number, ours and the verdict.

    ``deviation`` is ours − printed in the unit of the print (minutes for angles with
    minutes), None where one of the two is no number; ``units`` is its size in units of
    the last digit.
    """

    table: Table
    cell: PrintedCell
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


def check_cell(table: Table, cell: PrintedCell, ours: Ours) -> Check:
    """One printed cell with its verdict."""
    printed = number(cell.text)
    misprint = errata().get((table.id, cell.row, cell.column))
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
    if misprint is not None and not agrees:
        verdict, reason, value = misprint.verdict, misprint.reason, misprint.value
    elif misprint is not None:
        verdict, reason = Verdict.NEW, f"записано отклонение, но число сходится: {misprint.reason}"
    elif not agrees:
        verdict, reason = Verdict.NEW, "отклонение без записанной причины"
    return Check(table, cell, printed, ours, deviation, tolerance, verdict, reason, value)


def sign(text: str) -> str:
    """Return a printed sign whatever dash the press took."""
    return text.replace("–", "-").replace("—", "-").strip()
