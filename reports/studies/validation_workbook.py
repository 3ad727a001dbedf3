"""Check every printed table; numbers and headings as people read them."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache

from kshm.nomenclature.quantity import quantity
from reports.shared.russian import MINUS, fixed
from reports.studies.validation_checks import (
    UNKNOWN,
    Check,
    Number,
    Table,
    Verdict,
    check_table,
    rows_of,
)
from reports.studies.validation_registry import TABLES

EMPTY = "пусто"  # of a cell without a number

WORDS: dict[Verdict, str] = {
    Verdict.AGREES: "совпадает",
    Verdict.MISPRINT: "опечатка",
    Verdict.OTHER_RUN: "другой расчёт",
    Verdict.NOT_REPRODUCED: "не воспроизведено",
    Verdict.NEW: "новое отклонение",
}
_ROUNDING_TOLERANCE = 0.5 + 1e-9
_ROW_HEADS = {"phi_deg": "φ, °", "alpha_deg": "α, °", "1/lambda": "1/λ"}
_HEADS = {
    "sign": "знак",
    "sign_mirror": "знак при 360° − φ",
    "piston_mm": "перемещение, мм",
    "volume_dm3": "объём, дм³",
    "pressure_MPa": "давление, МПа",
    "temperature_K": "температура, К",
    "alpha1": "α₁",
    "ratio": "vmax/vср",
    "k": "k",
    "R_MPa": "R′ш.ш, МПа",
    "value": "значение",
}
_LOWERED = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")
_MULTIPLE = re.compile(r"(\d*)p(\d)")
_OUR_EXTRA = 1  # digits more than the book


@dataclass(frozen=True, slots=True)
class Counts:
    """How many printed numbers there are and what became of them.

    ``close`` counts those that are ours rounded to the printed digits, whatever a table's
    tolerance allows.  Signs, numbers of which only the place is checked and empty places are
    checked too but are no numbers held against ours: they are counted apart, as all and as
    those that agree.
    """

    total: int
    close: int
    by_verdict: dict[Verdict, int]
    signs: tuple[int, int]
    placed: tuple[int, int]
    empty: tuple[int, int]
    new: int  # of everything that is checked

    @property
    def agrees(self) -> int:
        """Within the tolerance."""
        return self.by_verdict[Verdict.AGREES]

    @property
    def needs_a_person(self) -> bool:
        """Something deviates without a recorded reason, or a record is stale."""
        return self.new > 0


@dataclass(frozen=True, slots=True)
class Checked:
    """A table with its checks."""

    table: Table
    checks: tuple[Check, ...]

    @property
    def counts(self) -> Counts:
        """Counts of this table."""
        return count(self.checks)

    @property
    def deviating(self) -> tuple[Check, ...]:
        """Checks that do not agree."""
        return tuple(check for check in self.checks if check.verdict is not Verdict.AGREES)

    @property
    def is_text(self) -> bool:
        """Numbers of running text or a list, each with its own name."""
        return all(check.cell.what for check in self.checks)


@dataclass(frozen=True, slots=True)
class Book:
    """All tables in order."""

    tables: tuple[Checked, ...]

    @property
    def checks(self) -> tuple[Check, ...]:
        """All checks in order."""
        return tuple(check for checked in self.tables for check in checked.checks)

    @property
    def new(self) -> tuple[Check, ...]:
        """Checks that need a person."""
        return tuple(check for check in self.checks if check.verdict is Verdict.NEW)

    @property
    def counts(self) -> Counts:
        """Counts of everything."""
        return count(self.checks)

    def of(self, source: str) -> tuple[Checked, ...]:
        """Tables of a source."""
        return tuple(checked for checked in self.tables if checked.table.source == source)

    def counts_of(self, source: str) -> Counts:
        """Return counts of a source."""
        return count(check for checked in self.of(source) for check in checked.checks)


def count(checks: Iterable[Check]) -> Counts:
    """Count checks by verdict."""
    listed = list(checks)
    numbers = [check for check in listed if check.is_number]
    agreeing = [check for check in numbers if check.verdict is Verdict.AGREES]
    by_verdict = {kind: sum(check.verdict is kind for check in numbers) for kind in Verdict}
    cells = [check for check in listed if check.cell.is_place]
    return Counts(
        total=len(numbers),
        close=sum(check.units is None or check.units <= _ROUNDING_TOLERANCE for check in agreeing),
        by_verdict=by_verdict,
        signs=_apart(check for check in listed if check.is_sign),
        placed=_apart(check for check in cells if check.cell.text),
        empty=_apart(check for check in cells if not check.cell.text),
        new=sum(check.verdict is Verdict.NEW for check in listed),
    )


def _apart(checks: Iterable[Check]) -> tuple[int, int]:
    """Number of checks, and of those that agree."""
    verdicts = [check.verdict for check in checks]
    return len(verdicts), verdicts.count(Verdict.AGREES)


@lru_cache(maxsize=1)
def validate() -> Book:
    """Recompute every printed table and number."""
    return Book(tuple(Checked(table, check_table(table)) for table in TABLES))


def printed(check: Check) -> str:
    """Return the printed text with a decimal comma, a real minus and minutes of angles."""
    text = check.cell.text
    if check.printed is None:
        return _plain(text) or EMPTY
    if check.printed.minutes:
        degrees, minutes = text.split()
        return f"{degrees}°{minutes}′"
    return _plain(text)


def ours(check: Check) -> str:
    """Our value with a digit more than the book has."""
    if isinstance(check.ours, str):
        return _plain(check.ours) or EMPTY
    if check.printed is None:
        return fixed(check.ours, 3)
    return value(check.ours, check.printed)


def value(number: float, like: Number) -> str:
    """Return a number with a digit more than a printed one."""
    digits = like.decimals + _OUR_EXTRA
    if not like.minutes:
        return fixed(number, digits, group=False)
    tenths = round(10 * number)
    degrees, left = divmod(tenths, 600)
    return f"{degrees}°{left // 10:02d},{left % 10}′"


def deviation(check: Check) -> str:
    """Ours − book in the unit of the print."""
    if check.deviation is None or check.printed is None:
        return "—"
    sign = "+" if check.deviation > 0 else ""
    text = fixed(check.deviation, check.printed.decimals + _OUR_EXTRA, group=False)
    text = f"{sign}{text}" if text.strip("0,") else text
    return f"{text}′" if check.printed.minutes else text


def tolerance(check: Check) -> str:
    """Return allowed deviation in the unit of the print."""
    if check.tolerance is None or check.printed is None:
        return "—"
    if check.printed.unit < 10.0**-check.printed.decimals:
        return "точно"
    more = check.printed.decimals + _OUR_EXTRA
    if round(check.tolerance, more) != round(check.tolerance, 12):
        more += 2
    text = fixed(check.tolerance, more, group=False)
    return f"{text}′" if check.printed.minutes else text


def verdict(check: Check) -> str:
    """Verdict in words with its reason and what should stand there."""
    word = WORDS[check.verdict]
    return f"{word}: {check.reason}" if check.reason else word


def apart(counts: Counts) -> str:
    """Return the checks other than numbers, in a sentence."""
    signs, placed, empty = (
        f"{all_} (совпадает {agree})" for all_, agree in (counts.signs, counts.placed, counts.empty)
    )
    return (
        f"Кроме того сверены, но в числа не входят: знаки — {signs}; места сил в клетках лучей "
        f"таблицы 14, где сама сила взята из печати, — {placed}; пустые места печати — {empty}."
    )


def row_head(check: Check) -> str:
    """Return what a row is: the number in running text, the labelled row of a table."""
    if check.cell.what:
        unit = f", {check.cell.unit}" if check.cell.unit else ""
        return check.cell.what + unit
    return "сумма" if check.cell.row == "sum" else _plain(check.cell.row)


def row_title(table: str) -> str:
    """Heading of the first column of a table."""
    if table == "table_14_forces":
        table = "table_14"
    return _ROW_HEADS.get(next(iter(rows_of(table)[0])), "")


def column_head(column: str) -> str:
    """Heading of a column: symbol and unit."""
    if column in _HEADS:
        return _HEADS[column]
    if column.startswith("lambda_1/"):
        return "λ = 1/" + _plain(column.removeprefix("lambda_1/"))
    if match := _MULTIPLE.fullmatch(column):
        return f"{match[1]}p{match[2].translate(_LOWERED)}"
    if column.replace(".", "").isdigit():
        return f"λ = {_plain(column)}"
    return quantity(column).header


def is_marked(check: Check) -> bool:
    """Whether a cell is marked in its table."""
    return check.verdict is not Verdict.AGREES


def _plain(text: str) -> str:
    if text == UNKNOWN:
        return text
    for dash in "-–—":
        text = text.replace(dash, MINUS)
    return text.replace(".", ",")
