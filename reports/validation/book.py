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
    tolerance allows.
    """

    total: int
    close: int
    by_verdict: dict[Verdict, int]

    @property
    def agrees(self) -> int:
        """Within the tolerance."""
        return self.by_verdict[Verdict.AGREES]

    @property
    def needs_a_person(self) -> bool:
        """Something deviates without a recorded reason, or a record is stale."""
        return self.by_verdict[Verdict.NEW] > 0


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
    by_verdict = dict.fromkeys(Verdict, 0)
    close = 0
    for check in listed:
        by_verdict[check.verdict] += 1
        if check.verdict is Verdict.AGREES:
            close += check.units is None or check.units <= _CLOSE
    return Counts(len(listed), close, by_verdict)


@lru_cache(maxsize=1)
def validate() -> Book:
    """Recompute every printed table and number."""
    return Book(tuple(Checked(table, check_table(table)) for table in TABLES))
