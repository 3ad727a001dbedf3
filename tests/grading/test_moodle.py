"""Moodle's own worksheet and zips, checked by a parser written from its import's rules."""

from __future__ import annotations

import csv
import io
import zipfile
from pathlib import Path
from types import SimpleNamespace

import pytest

from reports.grading.batch.grade import Options, grade
from reports.grading.pages.moodle import filled
from reports.grading.reading.submissions import collect
from reports.shared.errors import InputError
from tests.grading import classroom
from tests.grading.fill import filled_book

ENGLISH = ("Identifier", "Full name", "Email address", "Status", "Grade", "Maximum Grade",
           "Grade can be changed", "Last modified (submission)", "Last modified (grade)",
           "Feedback comments")  # fmt: skip
RUSSIAN = ("Идентификатор", "Полное имя", "Адрес электронной почты", "Состояние", "Оценка",
           "Максимальная оценка", "Оценка может быть изменена",
           "Последнее изменение (ответ)", "Последнее изменение (оценка)",
           "Отзыв в виде комментария")  # fmt: skip
WORDS = {ENGLISH: ("Participant ", "Yes", "-"), RUSSIAN: ("Участник", "Да", "-")}


def worksheet(head: tuple[str, ...], most: str = "100,00") -> str:
    participant, yes, never = WORDS[head]
    most = most if head is RUSSIAN else most.replace(",", ".")
    stream = io.StringIO()
    writer = csv.writer(stream)
    writer.writerow(head)
    for number, name in ((101, "Имя Иванов"), (102, "Имя Петров"), (999, "Никто")):
        mail = f"s{number - 100}@example.org"
        writer.writerow([f"{participant}{number}", name, mail, "Submitted for grading", "", most,
                         yes, "Tuesday, 1 December 2026, 10:00 AM", never, ""])  # fmt: skip
    return stream.getvalue()


def imported(text: str, head: tuple[str, ...]) -> dict[int, tuple[float | None, str]]:
    """What ``assignfeedback_offline_grade_importer`` takes: participant → grade, comment."""
    lines = list(csv.reader(io.StringIO(text.lstrip("\ufeff"))))
    columns = {name: lines[0].index(name) for name in head}  # found by their exact names
    prefix = WORDS[head][0].strip()
    found = {}
    for line in lines[1:]:
        assert len(line) == len(head)
        text_id = line[columns[head[0]]]
        assert text_id.startswith(prefix)
        grade = line[columns[head[4]]]
        comma = "," if head is RUSSIAN else "."  # unformat_float in the user's language
        value = float(grade.replace(comma, ".")) if grade else None
        assert value is None or 0 <= value <= float(line[columns[head[5]]].replace(",", "."))
        assert line[columns[head[8]]] == "-"  # else the line is skipped as graded since
        found[int(text_id.removeprefix(prefix))] = value, line[columns[head[9]]]
    return found


def feedback_goes_to(name: str) -> tuple[int, str]:
    """Participant and file of a zip's entry as ``assignfeedback_file_zip_importer`` reads it."""
    parts = name.split("_", 4)
    assert len(parts) == 5
    assert (parts[2], parts[3]) == ("assignsubmission", "file")
    return int(parts[1]), parts[4].lstrip("/")


@pytest.fixture(scope="module")
def graded(tmp_path_factory) -> Path:
    """A zip of Moodle's, graded with its worksheet."""
    folder = tmp_path_factory.mktemp("moodle")
    classroom.register()
    right, half = (filled_book(classroom.handout(n), classroom.assignment(n), c) for n, c in
                   ((1, None), (2, {"omega": ["=regime_speed_rpm"]})))  # fmt: skip
    with zipfile.ZipFile(folder / "a.zip", "w") as archive:
        archive.writestr("Имя Иванов_101_assignsubmission_file_/работа.xlsx", right)
        archive.writestr(
            "Имя Иванов_101_assignsubmission_onlinetext_/onlinetext.html", "<p>Вот</p>"
        )
        archive.writestr("Имя Петров_102_assignsubmission_file_/кр.xlsx", half)
    for head, name in ((ENGLISH, "en"), (RUSSIAN, "ru")):
        (folder / f"{name}.csv").write_text("\ufeff" + worksheet(head), encoding="utf-8")
        grade(classroom.folder() / "issued", folder / "a.zip", folder / name,
              secret_file=classroom.folder() / "secret.key",
              options=Options(workers=1, worksheet=folder / f"{name}.csv"))  # fmt: skip
    return folder


@pytest.mark.parametrize(("head", "name"), [(ENGLISH, "en"), (RUSSIAN, "ru")])
def test_the_worksheet_is_filled_and_nothing_else_is_changed(graded, head, name):
    text = (graded / name / "moodle-worksheet.csv").read_text("utf-8")
    found = imported(text, head)
    assert found[101] == (100.0, "")
    assert 90 < found[102][0] < 99
    assert found[999] == (None, "")
    before = list(csv.reader(io.StringIO(worksheet(head))))
    after = list(csv.reader(io.StringIO(text.lstrip("\ufeff"))))
    for old, new in zip(before, after, strict=True):
        assert [o for i, o in enumerate(old) if i not in (4, 9)] == [
            n for i, n in enumerate(new) if i not in (4, 9)
        ]


def test_online_texts_are_left_in_peace(graded):
    assert [item.moodle_id for item in collect(graded / "a.zip")] == ["101", "102"]


def test_feedback_files_reach_their_participants(graded):
    with zipfile.ZipFile(graded / "en" / "moodle-feedback.zip") as archive:
        found = {feedback_goes_to(name): archive.read(name) for name in archive.namelist()}
    assert set(found) == {(101, "feedback.html"), (102, "feedback.html")}
    assert "Иванов Имя" in found[101, "feedback.html"].decode()


def row(points: float | None, **more) -> dict:
    made = {"number": 1, "student": "Иванов Имя", "email": "", "points": points, "manual": False,
            "status": "проверено", "remark": "",
            "result": SimpleNamespace(moodle_id="101")}  # fmt: skip
    return made | more


def test_grades_fit_the_maximum_of_the_assignment():
    made = filled(worksheet(ENGLISH, "20,00"), [row(75.0)], 100, "w.csv")
    assert imported(made.text, ENGLISH)[101][0] == 15
    assert made.graded == 1


def test_who_waits_for_a_person_gets_no_grade():
    for waiting in (row(None), row(80.0, manual=True)):
        made = filled(worksheet(RUSSIAN), [waiting], 100, "w.csv")
        assert imported(made.text, RUSSIAN)[101][0] is None
        assert made.left


def test_a_closed_grade_is_not_written():
    text = worksheet(ENGLISH).replace(",Yes,", ",No,")
    assert filled(text, [row(80.0)], 100, "w.csv").graded == 0


def test_another_file_is_refused():
    with pytest.raises(InputError, match="это не ведомость оценивания Moodle"):
        filled("a;b\n1;2\n", [], 100, "w.csv")
