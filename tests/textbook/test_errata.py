"""What is recorded about deviations: nothing new, nothing stale, and the right value."""

import re

import pytest

from reports.studies.validation_checks import Verdict, errata
from reports.studies.validation_registry import SHORT, SOURCES, TABLES
from tests.textbook.book import checks, number


@pytest.mark.parametrize("table", [table.id for table in TABLES])
def test_every_deviation_is_recorded_and_every_record_deviates(table: str) -> None:
    new = [(check.name, check.reason) for check in checks(table).values()
           if check.verdict is Verdict.NEW]  # fmt: skip
    assert new == []
    assert len(checks(table)) == len(list(_cells(table)))  # no two cells of one name


def _cells(name: str):
    (table,) = (table for table in TABLES if table.id == name)
    return table.cells(name)


def test_every_record_names_a_printed_cell_and_says_why_in_russian() -> None:
    cells = {(table.id, *name) for table in TABLES for name in checks(table.id)}
    assert set(errata()) <= cells
    for name, erratum in errata().items():
        assert erratum.verdict in (Verdict.MISPRINT, Verdict.OTHER_RUN, Verdict.NOT_REPRODUCED)
        assert re.search("[а-яё]", erratum.reason), name


def test_what_should_stand_there_is_what_we_compute() -> None:
    """The recorded value is ours, rounded to its digits."""
    held = 0
    for (table, row, column), erratum in errata().items():
        value = number(erratum.value)
        if value is None:
            continue
        ours = float(checks(table)[row, column].ours)
        # Values that follow from the book's own rounded numbers are a digit less certain.
        assert abs(ours - value.value) <= (1.5 + 1e-9) * value.unit, (table, row, column, ours)
        held += 1
    assert held >= 100


def test_every_table_has_its_source() -> None:
    assert {table.source for table in TABLES} == set(SOURCES) == set(SHORT)
    assert len({table.id for table in TABLES}) == len(TABLES)
