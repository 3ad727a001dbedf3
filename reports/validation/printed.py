"""Printed numbers: the cells of the sources as they stand there."""

from __future__ import annotations

import csv
import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

from kshm.nomenclature.dizdn_listing import OUTPUTS
from reports.shared.resources import validation_dir

_MINUTES = re.compile(r"(\d+) (\d\d)")
_FRACTION = re.compile(r"(\d+)/(\d+)")
_NUMBER = re.compile(r"-?\d+(\.\d*)?")
_UP_TO = "≤"


@dataclass(frozen=True, slots=True)
class Number:
    """A printed number and one unit of its last digit; degrees and minutes in minutes."""

    value: float
    unit: float
    decimals: int = 0
    minutes: bool = False
    bound: bool = False


def number(text: str) -> Number | None:
    """What a printed text says; None where it is no number (a sign, a slip of the press)."""
    bound = text.startswith(_UP_TO)
    text = text.removeprefix(_UP_TO)
    if found := _MINUTES.fullmatch(text):
        return Number(60 * float(found[1]) + float(found[2]), 1.0, minutes=True)
    if found := _FRACTION.fullmatch(text):
        return Number(float(found[1]) / float(found[2]), 1e-9, 3)  # exact
    if not _NUMBER.fullmatch(text):
        return None
    decimals = len(text.partition(".")[2])
    return Number(float(text), 10.0**-decimals, decimals, bound=bound)


@dataclass(frozen=True, slots=True)
class Cell:
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


def cells_of(table: str) -> Iterator[Cell]:
    """Printed cells of a table file; its first column labels the rows."""
    for row in rows_of(table):
        label, *_ = row.values()
        for column, text in list(row.items())[1:]:
            if text and column != "phi_mirror_deg":
                yield Cell(label, column, text)


def text_of(table: str) -> Iterator[Cell]:
    """Printed numbers of a section of running text."""
    for row in rows_of("text"):
        if row["table"] == table:
            units = float(row["units"])
            yield Cell(row["row"], "", row["printed"], row["what"], row["unit"], units)


def outputs_of(table: str) -> Iterator[Cell]:
    """Printed outputs of the program: path of the number in the cycle, value."""
    about = {quantity.key: quantity for quantity in OUTPUTS}
    for row in rows_of(table):
        quantity = about[row["key"]]
        yield Cell(row["key"], "value", row["value"], quantity.title, quantity.unit)


def window_cells(table: str) -> Iterator[Cell]:
    """Cells of a wear table, the empty ones too: where a ray has no force."""
    for row in rows_of(table):
        label, *_ = row.values()
        for column, text in list(row.items())[1:]:
            yield Cell(label, column, text, is_place=label.isdigit())


def force_cells(table: str) -> Iterator[Cell]:
    """The one force of each row of a wear table."""
    for row in rows_of(table):
        label, *texts = row.values()
        if label.isdigit():
            yield Cell(label, "R_MPa", next(text for text in texts if text))
