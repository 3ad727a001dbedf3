"""The whole validation book: every check, and how many of each kind."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache

from reports.validation.checks import Check, Table, Verdict, check_table
from reports.validation.registry import TABLES

WORDS: dict[Verdict, str] = {
    Verdict.AGREES: "совпадает",
    Verdict.MISPRINT: "опечатка",
    Verdict.OTHER_RUN: "другой расчёт",
    Verdict.NOT_REPRODUCED: "не воспроизведено",
    Verdict.NEW: "новое отклонение",
}
_CLOSE = 0.5 + 1e-9


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
        """Counts of a source."""
        return count(check for checked in self.of(source) for check in checked.checks)


def count(checks: Iterable[Check]) -> Counts:
    """Count checks by verdict."""
    listed = list(checks)
    numbers = [check for check in listed if check.is_number]
    agreeing = [check for check in numbers if check.verdict is Verdict.AGREES]
    by_verdict = {kind: sum(check.verdict is kind for check in numbers) for kind in Verdict}
    places = [check for check in listed if check.cell.is_place]
    return Counts(
        total=len(numbers),
        close=sum(check.units is None or check.units <= _CLOSE for check in agreeing),
        by_verdict=by_verdict,
        signs=_apart(check for check in listed if check.is_sign),
        placed=_apart(check for check in places if check.cell.text),
        empty=_apart(check for check in places if not check.cell.text),
        new=sum(check.verdict is Verdict.NEW for check in listed),
    )


def _apart(checks: Iterable[Check]) -> tuple[int, int]:
    """How many, and how many agree."""
    verdicts = [check.verdict for check in checks]
    return len(verdicts), verdicts.count(Verdict.AGREES)


@lru_cache(maxsize=1)
def validate() -> Book:
    """Recompute every printed table and number."""
    return Book(tuple(Checked(table, check_table(table)) for table in TABLES))
