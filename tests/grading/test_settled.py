"""Formulas that are proven are not calculated anew, and nothing is judged otherwise for it."""

from __future__ import annotations

from pathlib import Path

import pytest

from reports.grading.judging.marking import Marker
from reports.grading.reading.student import Student
from reports.grading.reading.submissions import Submission
from reports.recalculation import evaluate
from reports.recalculation.read import read_grid
from tests.grading import classroom
from tests.grading.fill import filled_book
from tests.grading.forms import as_excel, tampered

HALF = {"omega": ["=regime_speed_rpm*PI()/60"]}


@pytest.fixture(scope="module")
def marker() -> Marker:
    """A marker that has seen a right book."""
    made = Marker(classroom.register())
    mark(made, right())
    return made


def right() -> bytes:
    return as_excel(filled_book(classroom.handout(), classroom.assignment()))


def mark(marker: Marker, data: bytes) -> dict:
    return marker.mark(Submission("р.xlsx", Path("р.xlsx"), None, None), data)


def settled(marker: Marker, data: bytes) -> tuple[Student, frozenset[str]]:
    student = marker.student(classroom.book(), read_grid(data))
    return student, marker.response(student).settled


def test_a_right_book_is_not_calculated_again(marker, monkeypatch):
    def never(*_: object) -> bytes:
        raise AssertionError

    monkeypatch.setattr(evaluate, "plain_book", never)
    assert mark(marker, right())["points"] == 100


def test_what_follows_from_a_mistake_is_calculated(marker):
    data = as_excel(filled_book(classroom.handout(), classroom.assignment(), HALF))
    student, found = settled(marker, data)
    assert {"lam", "P3_1.s1_mm", "P3_2.beta_rad"} <= found
    for node in ("omega", "P3_1.v1_m_s", "P4_1.T_MPa", "P4_2.Msum_Nm"):
        assert node not in found
    student.settle(found)
    assert student.answers["P3_1.v1_m_s"].values[3] == pytest.approx(
        student.expected.value("P3_1.v1_m_s")[3] / 2
    )


def test_a_number_that_is_not_the_formula_s_is_calculated_and_told(marker):
    data = tampered(right(), "П4.1", "I9")
    found = settled(marker, data)[1]
    assert "P4_1.M_Nm" not in found
    assert "P4_2.M1_Nm" not in found  # reads it
    result = mark(marker, data)
    assert result["points"] == 100
    assert "П4.1!I9" in result["altered"][0]


def test_a_book_without_saved_numbers_is_calculated(marker):
    data = filled_book(classroom.handout(), classroom.assignment())
    assert not settled(marker, data)[1] & classroom.assignment().fill_nodes
    assert mark(marker, data)["points"] == 100


def test_a_formula_that_is_right_to_the_printed_digits_alone_is_calculated(marker):
    rounded = {"lam": ["=ROUND(r_crank/L_rod,4)"]}
    data = as_excel(filled_book(classroom.handout(), classroom.assignment(), rounded))
    mark(marker, data)
    found = settled(marker, data)[1]
    assert "lam" not in found
    assert "P3_1.s2_mm" not in found
