"""A printed number against ours: what is read, how far it may be, which verdict."""

from __future__ import annotations

import pytest

from reports.studies import validation_checks
from reports.studies.validation_checks import (
    Erratum,
    PrintedCell,
    PrintTolerance,
    Table,
    Verdict,
    check_cell,
    number,
)

KNOWN = Erratum("1.5", Verdict.MISPRINT, "потеряна запятая")


HALF = PrintTolerance()


def table(tolerance: PrintTolerance = HALF) -> Table:
    return Table("t", "gots", "табл.", "", "", lambda: lambda _row, _column: 0.0, tolerance)


@pytest.fixture
def known(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(validation_checks, "errata", lambda: {("t", "1", "x"): KNOWN})


@pytest.mark.parametrize(
    ("text", "value", "unit", "decimals"),
    [
        ("1.50", 1.5, 0.01, 2), ("-697", -697, 1, 0), ("22.", 22, 1, 0),
        ("16 22", 982, 1, 0), ("9/8", 1.125, 1e-9, 3), ("≤10", 10, 1, 0),
        ("0.0000000582", 5.82e-8, 1e-10, 10),
    ],
)  # fmt: skip
def test_printed_numbers(text: str, value: float, unit: float, decimals: int) -> None:
    actual = number(text)
    assert actual is not None
    assert (actual.value, actual.decimals) == (pytest.approx(value), decimals)
    assert actual.unit == pytest.approx(unit, rel=1e-12)


@pytest.mark.parametrize("text", ["", "+", "–", "-8633--", "1,5", "nan", "1e3", "82.3 / 90.7"])
def test_slips_of_the_press_are_no_numbers(text: str) -> None:
    assert number(text) is None


@pytest.mark.parametrize(
    ("tolerance", "ours", "agrees"),
    [
        (PrintTolerance(), 1.234999, True), (PrintTolerance(), 1.235001, True),
        (PrintTolerance(), 1.23551, False),
        (PrintTolerance(1.5), 1.2365, True), (PrintTolerance(1.5), 1.23651, False),
        (PrintTolerance(absolute=1.0), 2.2349, True), (PrintTolerance(absolute=1.0), 2.2351, False),
        (PrintTolerance({"x": 2.0, "": 0.5}), 1.2369, True),
        (PrintTolerance({"": 0.5}), 1.2369, False),
    ],
)  # fmt: skip
def test_tolerance_is_in_units_of_the_last_digit(
    tolerance: PrintTolerance, ours: float, agrees: bool
) -> None:
    check = check_cell(table(tolerance), PrintedCell("2", "x", "1.235"), ours)
    assert (check.verdict is Verdict.AGREES) == agrees
    assert check.deviation == pytest.approx(ours - 1.235)


def test_tiny_numbers_are_not_forgiven_by_an_absolute_slack() -> None:
    check = check_cell(table(PrintTolerance(1.0)), PrintedCell("2", "x", "0.000000466"), 4.648e-7)
    assert check.units == pytest.approx(1.2)
    assert check.verdict is Verdict.NEW


def test_a_bound_is_kept_from_one_side() -> None:
    assert check_cell(table(), PrintedCell("2", "x", "≤10"), 3.0).verdict is Verdict.AGREES
    assert check_cell(table(), PrintedCell("2", "x", "≤10"), 15.6).deviation == pytest.approx(5.6)


@pytest.mark.parametrize(
    ("text", "ours", "agrees"),
    [("–", "-", True), ("+", "-", False), ("", "", True), ("", 1.5, False), ("1.50", "", False)],
)
def test_signs_and_empty_places(text: str, ours: float | str, agrees: bool) -> None:
    check = check_cell(table(), PrintedCell("2", "x", text), ours)
    assert (check.verdict is Verdict.AGREES) == agrees


@pytest.mark.usefixtures("known")
def test_a_recorded_deviation_has_its_reason_and_a_stale_record_is_new() -> None:
    deviating = check_cell(table(), PrintedCell("1", "x", "15"), 1.5)
    assert deviating.verdict is Verdict.MISPRINT
    assert (deviating.reason, deviating.should_be) == ("потеряна запятая", "1.5")
    stale = check_cell(table(), PrintedCell("1", "x", "15"), 15.0)
    assert stale.verdict is Verdict.NEW
    assert "число сходится" in stale.reason
    unknown = check_cell(table(), PrintedCell("1", "y", "15"), 1.5)
    assert unknown.verdict is Verdict.NEW
    assert "без записанной причины" in unknown.reason
