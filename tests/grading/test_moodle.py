"""Moodle's own worksheet and zips, checked by a parser written from its import's rules."""

from __future__ import annotations

import csv
import io
import re
import zipfile
from pathlib import Path

import pytest

from reports.grading.batch.grade import GradeSetup, grade
from reports.grading.pages.moodle import filled, read_worksheet
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
WORDS = {ENGLISH: ("Participant ", "Yes", "-"), RUSSIAN: ("Участник", "Да", "-")}  # hiddenuser, yes


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


def unformat_float(text: str, comma: str) -> float | None:
    """``unformat_float`` of ``moodlelib.php``: nothing is null, what is no number is cut off."""
    text = text.strip().replace(" ", "").replace(comma, ".")
    match = re.match(r"-?\d*\.?\d*", text)
    return float(match[0] or 0) if text and match else None


def imported(text: str, head: tuple[str, ...]) -> dict[int, tuple[float | None, str]]:
    """What ``assignfeedback_offline_grade_importer`` takes: participant → grade, comment.

    After ``init`` and ``next`` of ``importgradeslib.php`` and ``process_import_grades``.
    """
    lines = list(csv.reader(io.StringIO(text.removeprefix("\ufeff"))))
    columns = {name: index for index, name in enumerate(lines[0])}  # exact titles, the last counts
    id_, grade, modified = (columns[head[i]] for i in (0, 4, 8))  # else it refuses the file
    comment = columns.get(head[9])
    hidden, _, never = WORDS[head]
    collected = {}
    for line in lines[1:]:
        assert len(line) == len(lines[0])  # csv_import_reader: csvweirdcolumns
        participant = int(line[id_][len(hidden) :])
        value = unformat_float(line[grade], "," if head is RUSSIAN else ".")
        assert line[modified] == never  # a time that cannot be read is older than any grade
        most = unformat_float(line[columns[head[5]]], "," if head is RUSSIAN else ".")
        taken = value if value is not None and 0 <= value <= (most or 0) else None
        collected[participant] = taken, line[comment] if comment else ""
    return collected


def feedback_goes_to(path: str) -> tuple[int, str]:
    """Participant and file of a zip's entry as ``is_valid_filename_for_import`` reads it."""
    parts = path.split("/")
    assert parts[-1][0] not in ".~"  # hidden files are passed over
    while parts:
        info = parts.pop(0).split("_", 4)
        if len(info) < 4 or not info[1].isdigit():
            continue
        assert (info[2], info[3]) == ("assignsubmission", "file")  # get_plugin_by_type
        name = "/".join([info[4] if len(info) > 4 else "", *parts])
        return int(info[1]), name.lstrip("/")  # clean_param makes one of several
    raise AssertionError(path)


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
              options=GradeSetup(workers=1, worksheet=folder / f"{name}.csv"))  # fmt: skip
    return folder


@pytest.mark.parametrize(("head", "name"), [(ENGLISH, "en"), (RUSSIAN, "ru")])
def test_the_worksheet_is_filled_and_nothing_else_is_changed(graded, head, name):
    text = (graded / name / "moodle-worksheet.csv").read_text("utf-8")
    actual = imported(text, head)
    assert actual[101] == (100.0, "")
    assert 90 < actual[102][0] < 99
    assert actual[999] == (None, "")
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
        collected = {feedback_goes_to(name): archive.read(name) for name in archive.namelist()}
    assert set(collected) == {(101, "feedback.html"), (102, "feedback.html")}
    assert "Иванов Имя" in collected[101, "feedback.html"].decode()


def row(points: float | None, **more) -> dict:
    values = {"number": 1, "student": "Иванов Имя", "email": "", "points": points, "manual": False,
            "status": "проверено", "remark": "", "moodle_id": "101"}  # fmt: skip
    return values | more


def test_grades_fit_the_maximum_of_the_assignment():
    built = filled(worksheet(ENGLISH, "20,00"), [row(75.0)], 100, "w.csv")
    assert imported(built.text, ENGLISH)[101][0] == 15
    assert built.graded == 1


def test_who_waits_for_a_person_gets_no_grade():
    for waiting in (row(None), row(80.0, manual=True)):
        built = filled(worksheet(RUSSIAN), [waiting], 100, "w.csv")
        assert imported(built.text, RUSSIAN)[101][0] is None
        assert built.left


def test_a_closed_grade_is_not_written():
    text = worksheet(ENGLISH).replace(",Yes,", ",No,")
    assert filled(text, [row(80.0)], 100, "w.csv").graded == 0


def test_a_namesake_gets_no_grade_of_another():
    """From another group: his number in Moodle is not that of the work."""
    namesake = worksheet(ENGLISH).replace("Никто", "Имя Иванов")
    rows = [row(80.0), row(90.0, number=2, student="Петров Имя", moodle_id="102")]
    assert imported(filled(namesake, rows, 100, "w.csv").text, ENGLISH)[999][0] is None
    left_out = namesake.replace("Participant 101,", "Participant 555,").replace("s1@", "x@")
    actual = imported(filled(left_out, rows, 100, "w.csv").text, ENGLISH)
    assert (actual[102][0], actual[555][0], actual[999][0]) == (90.0, None, None)
    nameless = [row(80.0, moodle_id="")]  # works out of a folder: by mail, else by name
    assert imported(filled(namesake, nameless, 100, "w.csv").text, ENGLISH)[101][0] is None
    mailed = [row(80.0, moodle_id="", email="S1@example.org")]
    actual = imported(filled(namesake, mailed, 100, "w.csv").text, ENGLISH)
    assert (actual[101][0], actual[999][0]) == (80.0, None)


def test_a_work_handed_in_by_another_is_not_told_to_him(tmp_path):
    with zipfile.ZipFile(tmp_path / "a.zip", "w") as archive:
        data = filled_book(classroom.handout(3), classroom.assignment(3))
        archive.writestr("Имя Петров_102_assignsubmission_file_/работа.xlsx", data)
    out = tmp_path / "out"
    grade(classroom.folder() / "issued", tmp_path / "a.zip", out,
          secret_file=classroom.folder() / "secret.key", options=GradeSetup(workers=1))  # fmt: skip
    with zipfile.ZipFile(out / "moodle-feedback.zip") as archive:
        assert archive.namelist() == []
    assert "102" not in (out / "moodle.csv").read_text("utf-8")


def test_a_scale_is_left_to_a_person():
    text = worksheet(RUSSIAN).replace("Максимальная оценка", "Шкала").replace("100,00", "зачтено")
    built = filled(text, [row(80.0)], 100, "w.csv")
    assert built.graded == 0
    assert built.left == ("Имя Иванов: в задании шкала, а не баллы",)


def test_a_remark_is_html_and_a_persons_comment_is_not_wiped_out():
    text = worksheet(ENGLISH)
    said = filled(text, [row(80.0, remark="R<0 & T>1")], 100, "w.csv").text
    assert imported(said, ENGLISH)[101][1] == "R&lt;0 &amp; T&gt;1"
    commented = text.replace(",-,", ",-,Молодец", 1)
    kept = imported(filled(commented, [row(80.0)], 100, "w.csv").text, ENGLISH)
    assert kept[101] == (80.0, "Молодец")


@pytest.mark.parametrize("folder", ["Имя Иванов_101_assignsubmission_file",
                                    "ДВС-1-Имя Иванов_101_assignsubmission_file_"])  # fmt: skip
def test_folders_of_all_versions_are_read(tmp_path, folder):
    """Since 4.1 the folder has no last ``_``; with groups their name stands first."""
    with zipfile.ZipFile(tmp_path / "a.zip", "w") as archive:
        archive.writestr(f"{folder}/работа.xlsx", b"x")
    (actual,) = collect(tmp_path / "a.zip")
    assert actual.moodle_id == "101"


def test_an_endless_field_is_no_worksheet(tmp_path):
    (tmp_path / "w.csv").write_text("Identifier,Grade," + "x" * 200_000, encoding="utf-8")
    with pytest.raises(InputError, match="это не ведомость оценивания Moodle"):
        read_worksheet(tmp_path / "w.csv")


def test_another_file_is_refused():
    no_times = worksheet(RUSSIAN).replace("Последнее изменение (оценка)", "Время")
    with pytest.raises(InputError, match="это не ведомость оценивания Moodle"):
        filled(no_times, [], 100, "w.csv")
    with pytest.raises(InputError, match="это не ведомость оценивания Moodle"):
        filled("a;b\n1;2\n", [], 100, "w.csv")
