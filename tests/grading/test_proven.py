"""Formulas that are proven are not calculated anew, and nothing is judged otherwise for it."""

from __future__ import annotations

import io
import re
import zipfile
from pathlib import Path

import pytest

from reports.grading.judging import verdicts
from reports.grading.judging.marking import Marker
from reports.grading.judging.verdicts import proven
from reports.grading.reading.student import StudentBook
from reports.grading.reading.submissions import Submission
from reports.model.evaluation import evaluate_model
from reports.recalculation import evaluate
from reports.recalculation.read import read_grid
from tests.grading import classroom
from tests.grading.fill import filled_book
from tests.grading.forms import as_excel, rewritten, tampered

HALF = {"omega": ["=regime_speed_rpm*PI()/60"]}


@pytest.fixture(scope="module")
def marker() -> Marker:
    """A marker that has seen a right book."""
    built = Marker(classroom.register())
    mark(built, right())
    return built


def right() -> bytes:
    return as_excel(filled_book(classroom.handout(), classroom.assignment()))


def mark(marker: Marker, data: bytes) -> dict:
    return marker.mark(Submission("р.xlsx", Path("р.xlsx"), None, None), data)


def settled(marker: Marker, data: bytes) -> tuple[StudentBook, frozenset[str]]:
    student = marker.student(classroom.book(), read_grid(data))
    return student, marker.response(student).settled


def test_a_right_book_is_not_calculated_again(marker, monkeypatch):
    def never(*_: object) -> bytes:
        raise AssertionError

    monkeypatch.setattr(evaluate, "simple_workbook", never)
    assert mark(marker, right())["points"] == 100


@pytest.mark.parametrize("changes", [{}, HALF])
def test_what_is_proven_is_what_the_rules_say(marker, monkeypatch, changes):
    data = as_excel(filled_book(classroom.handout(), classroom.assignment(), changes))
    shortened: list[str] = []

    def counted(evidence):
        judgement = proven(evidence)
        shortened.extend([evidence.item.id] if judgement else [])
        return judgement

    monkeypatch.setattr(verdicts, "proven", counted)
    at_once = mark(marker, data)
    assert len(shortened) >= (10 if changes else 40)
    monkeypatch.setattr(verdicts, "proven", lambda evidence: None)
    assert mark(marker, data) == at_once


RING = {"E": "G{r}-F{r}", "F": "G{r}-E{r}", "G": "E{r}+F{r}"}


def ring() -> bytes:
    """A right book in which three columns are made of each other, and hold the right numbers."""
    keys = dict(zip(RING, ("P3_1.v1_m_s", "P3_1.v2_m_s", "P3_1.v_m_s"), strict=True))
    changes = {node: [f"={RING[letter].format(r=row)}" for row in range(6, 19)]
               for letter, node in keys.items()}  # fmt: skip
    values = evaluate_model(classroom.assignment().model).columns["P3_1"]

    def with_numbers(name: str, data: bytes) -> bytes:
        text = data.decode("utf-8") if b"<f>G6-F6</f>" in data else ""
        for letter, node in keys.items():
            for row in range(6, 19):
                number = values[node.partition(".")[2]][row - 6]
                cell = rf'(<c r="{letter}{row}"[^>]*><f>[^<]*</f>)<v ?/?>(</v>)?'
                text = re.sub(cell, rf"\g<1><v>{float(number)!r}</v>", text)
        return text.encode() or data

    book = filled_book(classroom.handout(), classroom.assignment(), changes)
    return rewritten(book, with_numbers)


def test_a_ring_of_right_numbers_rests_on_nothing(marker):
    """Not even for the second student who hands it in: its formulas are known by then."""
    assert b"<v>0.0</v>" in b"".join(parts_of(ring()))
    for _ in range(3):
        result = mark(marker, ring())
        lines = {line["id"]: line for line in result["items"]}
        collected = [lines[f"P3_1.{key}"] for key in ("v1_m_s", "v2_m_s", "v_m_s")]
        assert [(line["verdict"], line["points"]) for line in collected] == [("unknown", 0)] * 3
        assert result["manual"]


def parts_of(data: bytes) -> list[bytes]:
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        return [archive.read(name) for name in archive.namelist()]


def test_what_follows_from_a_mistake_is_calculated(marker):
    data = as_excel(filled_book(classroom.handout(), classroom.assignment(), HALF))
    student, actual = settled(marker, data)
    assert {"lam", "P3_1.s1_mm", "P3_2.beta_rad"} <= actual
    for node in ("omega", "P3_1.v1_m_s", "P4_1.T_MPa", "P4_2.Msum_Nm"):
        assert node not in actual
    student.settle(actual)
    assert student.answers["P3_1.v1_m_s"].values[3] == pytest.approx(
        student.expected.value("P3_1.v1_m_s")[3] / 2
    )


def test_a_number_that_is_not_the_formula_s_is_calculated_and_told(marker):
    data = tampered(right(), "П4.1", "I9")
    actual = settled(marker, data)[1]
    assert "P4_1.M_Nm" not in actual
    assert "P4_2.M1_Nm" not in actual  # reads it
    result = mark(marker, data)
    assert result["points"] == 100
    assert "П4.1!I9" in result["altered"][0]


@pytest.mark.parametrize("saved", [lambda v: "0", lambda v: f"{float(v):.6g}"])
def test_a_program_that_saves_noughts_or_few_digits_has_altered_nothing(marker, saved):
    """XlsxWriter saves a nought for every formula; 21,1284 is not told from 21,12841."""

    def change(name: str, data: bytes) -> bytes:
        if not name.startswith("xl/worksheets/"):
            return data
        return re.sub(rb"(<f[^>]*(?:/>|>[^<]*</f>)<v>)(-?[0-9][^<]*)",
                      lambda m: m[1] + saved(m[2]).encode(), data)  # fmt: skip

    result = mark(marker, rewritten(right(), change))
    assert (result["points"], result["altered"]) == (100, [])


def test_a_book_without_saved_numbers_is_calculated(marker):
    data = filled_book(classroom.handout(), classroom.assignment())
    assert not settled(marker, data)[1] & classroom.assignment().fill_nodes
    assert mark(marker, data)["points"] == 100


def test_a_formula_that_is_right_to_the_printed_digits_alone_is_calculated(marker):
    rounded = {"lam": ["=ROUND(r_crank/L_rod,4)"]}
    data = as_excel(filled_book(classroom.handout(), classroom.assignment(), rounded))
    mark(marker, data)
    actual = settled(marker, data)[1]
    assert "lam" not in actual
    assert "P3_1.s2_mm" not in actual
