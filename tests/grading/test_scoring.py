"""What takes points besides the verdicts: lateness by whose clock, needs, tables hardly begun."""

from __future__ import annotations

from dataclasses import replace
from datetime import datetime, timedelta
from types import SimpleNamespace

import pytest

from reports.grading.batch.rubric_trial import try_rubric
from reports.grading.batch.run_setup import put_off
from reports.grading.issuing.register import Issued, Register
from reports.grading.issuing.roster import Student, read_roster
from reports.grading.issuing.rubric import Rubric, load_rubric, rubric_of
from reports.grading.judging.judgement import CARRIED, EMPTY, RIGHT, WRONG
from reports.grading.judging.marking import Marker
from reports.grading.judging.scoring import HandedIn, hours_late, score
from reports.grading.reading.submissions import FILE_TIME, MOODLE, ZIP, Submission
from reports.shared.errors import InputError
from tests.grading import classroom
from tests.grading.fill import filled_book

DEADLINE = datetime(2026, 12, 1, 12)
LATE = rubric_of({"late": {"deadline": DEADLINE}}, "r")


def line(item: str, verdict: str, points: float = 10.0) -> dict:
    paid = points if verdict in (RIGHT, CARRIED) else 0.0
    return {"id": item, "block": item.split(".")[0], "heading": "Таблица", "label": item,
            "verdict": verdict, "points": paid, "of": points}  # fmt: skip


def scored(lines: list[dict], rubric, handed: HandedIn | None = None) -> dict:
    result = {"items": lines, "notes": [], "manual": []}
    score(result, rubric, handed or HandedIn())
    return result


def test_the_clock_of_moodle_takes_points_and_says_how_many_hours():
    handed = HandedIn(DEADLINE + timedelta(hours=26), MOODLE)
    result = scored([line("a.b", RIGHT, 100.0)], LATE, handed)
    assert result["points"] == 90 and result["manual"] == []
    assert result["notes"] == ["сдано через 26 ч после срока (часы Moodle): баллы умножены на 0,9"]


@pytest.mark.parametrize(("clock", "words"), [(ZIP, "время в архиве"), (FILE_TIME, "время файла")])
def test_the_time_of_a_copy_costs_nothing_without_a_person(clock, words):
    result = scored([line("a.b", RIGHT, 100.0)], LATE, HandedIn(datetime(2026, 12, 3), clock))
    assert result["points"] == 100 and result["notes"] == []
    (text,) = result["manual"]
    assert text == (
        f"сдано через 36 ч после срока, если верить копии ({words}): умножить баллы на 0,9?"
    )


@pytest.mark.parametrize(
    ("given", "hours"),
    [("", 36), ("03.12.2026", 0), ("02.12.2026 12:00", 12), ("+1 день", 12), ("+48 ч", 0),
     ("2026-11-30", 36)],
)  # fmt: skip
def test_an_own_deadline_of_the_roster(tmp_path, given, hours):
    path = tmp_path / "group.csv"
    path.write_text(f"Фамилия;Имя;Срок\nИванов;Иван;{given}\n", encoding="utf-8")
    (student,) = read_roster(path)
    assert hours_late(LATE, datetime(2026, 12, 3), student.extension) == hours


def test_an_own_deadline_of_nobody_in_the_class_is_told():
    known = [SimpleNamespace(student=Student(id=name, surname=name, name="")) for name in "аб"]
    register = SimpleNamespace(books=known)
    for student, words in ((Student("в", "Вуз", "", extension="+24"), "в этой выдаче нет: Вуз"),
                           (Student("г", "Гоц", ""), "в списке нет её студентов")):  # fmt: skip
        with pytest.raises(InputError, match=words):
            put_off(register, [student])


def test_an_own_deadline_reaches_who_was_issued_under_another_identity():
    """The list has got mails since, and another order of letters in a name."""
    student = Student("Ким Пётр, Д", "Ким", "Пётр", "Д")
    register = Register("", 1, "", Rubric(), (Issued(1, student, "", "", "", {}, {}),))
    (book,) = put_off(register, [Student("k@x.ru", "Ким", "Петр", "Д", extension="+24")]).books
    assert (book.student.id, book.student.extension) == (student.id, "+24")


def test_an_own_deadline_that_is_none_is_one_clear_line(tmp_path):
    path = tmp_path / "group.csv"
    path.write_text("Фамилия;Имя;Срок\nИванов;Иван;после сессии\n", encoding="utf-8")
    with pytest.raises(InputError, match="срок «после сессии» непонятен"):
        read_roster(path)


def test_items_count_only_where_those_that_they_need_are_right():
    rubric = rubric_of({"needs": {"P4_2": ["P4_1.M_Nm"]}}, "r")
    lines = [line("P4_1.M_Nm", WRONG), line("P4_2.M1_Nm", RIGHT), line("P3_1.s_mm", RIGHT)]
    result = scored(lines, rubric)
    assert [entry["points"] for entry in result["items"]] == [0, 0, 10]
    assert lines[1]["needs"] == ["P4_1.M_Nm"]
    fine = scored([line("P4_1.M_Nm", CARRIED), line("P4_2.M1_Nm", RIGHT)], rubric)
    assert fine["points"] == 20


def test_a_table_that_is_hardly_begun_has_no_points():
    rubric = rubric_of({"minimum": {"tables": {"P4_1": 0.5}}}, "r")
    begun = [line(f"P4_1.{key}", EMPTY) for key in "abc"] + [line("P4_1.d", RIGHT)]
    result = scored([*begun, line("P3_1.s_mm", RIGHT)], rubric)
    assert result["points"] == 10
    assert result["notes"] == ["Таблица: заполнено 25% при наименьшем 50%, баллов за неё нет"]


OWN = """
[[messages]]
items = "P3_1.v1_m_s"
formula = "2*r_crank*omega*sin(rad(phi_deg))"
text = "На лекции 3 радиус взят из табл. 1."
[[messages]]
items = "P3_1"
cause = "обратный знак"
text = "Правило знаков — с. 14."
"""


def test_own_words_stand_at_the_mistake_that_they_are_about(tmp_path):
    (tmp_path / "rubric.toml").write_text(OWN, encoding="utf-8")
    rubric = load_rubric(tmp_path / "rubric.toml")
    formulas = {
        "P3_1.v1_m_s": [f"=2*r_crank*omega*SIN(RADIANS(A{row}))" for row in range(6, 31)],
        "P3_1.j1_m_s2": [f"=-r_crank*omega^2*COS(RADIANS(A{row}))" for row in range(6, 31)],
        "P3_1.s1_mm": [f"=3*A{row}" for row in range(6, 31)],
    }
    formulas = {node: texts[: len(classroom.assignment().model.tables["P3_1"].rows)]
                for node, texts in formulas.items()}  # fmt: skip
    marker = Marker(replace(classroom.register(), rubric=rubric))
    book = filled_book(classroom.handout(), classroom.assignment(), formulas)
    result = marker.mark(Submission("р.xlsx", tmp_path, None, None), book)
    lines = {entry["id"]: entry["message"] for entry in result["items"] if entry["message"]}
    assert lines == {
        "P3_1.v1_m_s": "На лекции 3 радиус взят из табл. 1.",
        "P3_1.j1_m_s2": "Правило знаков — с. 14.",
    }


TRIAL = """
[[works]]
name = "всё верно"
points = 100
[[works]]
name = "без П3.1"
empty = ["P3_1"]
typed = ["P3_2"]
points = 100
"""


def test_a_rubric_is_tried_on_works_of_known_points(tmp_path):
    (tmp_path / "rubric.toml").write_text('[work]\nfill = ["P3_*"]\n', encoding="utf-8")
    (tmp_path / "trial.toml").write_text(TRIAL, encoding="utf-8")
    base = classroom.folder() / "base.toml"
    classroom.register()
    right, other = try_rubric(base, tmp_path / "trial.toml", rubric_file=tmp_path / "rubric.toml",
                              ranges_file=None)  # fmt: skip
    assert right.is_as_expected and not other.is_as_expected
    assert 0 < other.points < 50
