"""What a person gives: points, a share, a factor, a sum and a mark are told from each other."""

from __future__ import annotations

import io
import json
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import CliRunner
from openpyxl import load_workbook

from reports.cli import main
from reports.grading.batch import grade as room
from reports.grading.batch.awards import award_of
from reports.grading.batch.grade import GradeSetup, grade
from reports.grading.issuing.rubric import MarkScale, Rubric
from reports.grading.pages.gradebook import GROUPS
from reports.shared.errors import InputError
from reports.workbook.layout import Layout
from tests.grading import classroom
from tests.grading.fill import filled_book, solved_formulas

RUBRIC = Rubric(scale=MarkScale(marks={"5": 85, "4": 70, "зачтено": 60}, none="не зачтено"))


@pytest.mark.parametrize(
    ("text", "points", "given"),
    [
        ("×0,75", 40, 30), ("*0.75", 40, 30), ("x 0,75", 40, 30), ("х0,75", 100, 75),
        ("×75%", 40, 30), ("0,75×", 0, 0), ("× 1,5", 80, 100), ("·0,5", 39, 19.5),
        ("+5", 40, 45), ("-5", 40, 35), ("−5", 3, 0), ("– 2,5", 40, 37.5), ("плюс 5", 98, 100),
        ("минус 5", 40, 35), ("+ 5", 0, 5), ("40", 7, 40), ("40,5", 7, 40.5), ("+", 40, 40),
        ("50%", 7, 50), ("85 %", 0, 85), ("100%", 0, 100), ("12,5%", 3, 12.5),
        ("оценка 4", 0, 70), ("Оценка: 5", 0, 85), ("зачтено", 0, 60), ("не зачтено", 99, 0),
        ("4", 50, 4),
    ],
)  # fmt: skip
def test_words_of_a_person(text, points, given):
    award = award_of(text, RUBRIC, 100.0)
    assert award.of(points, 100.0) == pytest.approx(given)
    if award.word:  # what is written into the gradebook means the same
        assert award_of(award.word, RUBRIC, None) == award


@pytest.mark.parametrize(
    "text", ["", "-", "сто", "101", "×", "×11", "101%", "+101", "оценка 3", "1e3%", "nan", "5+"]
)
def test_what_is_no_award_is_refused(text):
    with pytest.raises(InputError, match="это не баллы"):
        award_of(text, RUBRIC, 100.0)


def test_a_share_of_two_things_is_asked_back():
    with pytest.raises(InputError, match=r"доля чего.*«×0,75» — умножить.*«75» — поставить"):
        award_of("75%", RUBRIC, None)


# --- a class that waits for one reason -----------------------------------------------------------

LATE = "[late]\ndeadline = 2020-01-01T00:00:00\nrules = [{after_hours = 0, factor = 0.75}]\n"
SHARES = {1: 1.0, 2: 0.6, 3: 0.0}  # of the columns that are filled in


@pytest.fixture(scope="module")
def late(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Three works that came too late by the clock of their files, worth 100, some and 0."""
    folder = tmp_path_factory.mktemp("late")
    (folder / "in").mkdir()
    (folder / "rubric.toml").write_text(LATE, encoding="utf-8")
    register = classroom.register()
    for number, share in SHARES.items():
        assignment = classroom.assignment(number)
        formulas = solved_formulas(assignment, Layout.of(assignment.model))
        blank = sorted(formulas)[round(share * len(formulas)) :]
        empty = {node: [None] * len(formulas[node]) for node in blank}
        data = filled_book(classroom.handout(number), assignment, empty)
        (folder / "in" / register.books[number - 1].file).write_bytes(data)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(room, "grade_all", classroom.graded_here)
        graded(folder, folder / "out")
    return folder


def graded(late: Path, out: Path) -> dict:
    where = classroom.folder()
    done = grade(where / "issued", late / "in", out, secret_file=where / "secret.key",
                 rubric_file=late / "rubric.toml", options=GradeSetup(workers=1))  # fmt: skip
    return done.summary


@pytest.fixture
def out(late: Path, tmp_path: Path) -> Path:
    return shutil.copytree(late / "out", tmp_path / "out")


def summary(out: Path) -> dict:
    return json.loads((out / "summary.json").read_text(encoding="utf-8"))


def points(out: Path) -> list[float | None]:
    return [row["points"] for row in summary(out)["rows"][:3]]


def command(out: Path, *words: str):
    return CliRunner().invoke(main, ["grade", "-o", str(out), *words])


def test_a_factor_is_one_of_the_points_that_are_there(out):
    """It is shown before it is applied, and taken back by the name of the group."""
    groups = summary(out)["groups"]
    group, before = groups[0], points(out)
    assert "умножить баллы на 0,75?" in group["why"]
    assert before[0] == 100 and 0 < before[1] < 90 and before[2] < 1
    assert group["points"] == before
    files = {path: path.read_bytes() for path in out.rglob("*") if path.is_file()}
    refused = command(out, "--decide", group["name"], "всё", "75%", "опоздали")
    assert refused.exit_code == 2 and "доля чего" in refused.output
    shown = command(out, "--decide", group["name"], "всё", "×0,75", "опоздали", "--preview")
    assert shown.exit_code == 0 and "100 → 75 (−25)" in shown.output
    assert {path: path.read_bytes() for path in out.rglob("*") if path.is_file()} == files
    done = command(out, "--decide", group["name"], "всё", "×0,75", "опоздали")
    assert done.exit_code in (0, 1) and "100 → 75 (−25)" in done.output
    assert points(out) == pytest.approx([0.75 * each for each in before], abs=0.006)
    assert group not in summary(out)["groups"]
    (said,) = summary(out)["decided"]
    assert (said["name"], said["points"], said["numbers"]) == (group["name"], "×0,75", [1, 2, 3])
    page = next((out / "pages").glob("01*.html")).read_text(encoding="utf-8")
    assert "×0,75" in page and "75 из 100 баллов" in page and "пока" not in page
    again = command(out, "--decide", group["name"], "всё", "×0,5", "")
    assert again.exit_code == 2 and "о ней уже решено; отменить" in again.output
    back = command(out, "--decide", group["name"], "всё", "-", "")
    assert back.exit_code == 1 and "75 → 100 (+25)" in back.output
    assert points(out) == before and summary(out)["groups"] == groups


@pytest.mark.parametrize(
    ("word", "of"),
    [("+5", lambda p: min(100, p + 5)), ("-5", lambda p: max(0, p - 5)), ("40", lambda p: 40),
     ("*0,5", lambda p: p / 2), ("+", lambda p: p)],
)  # fmt: skip
def test_a_sum_and_points_are_no_share(out, word: str, of: Callable[[float], float]):
    before = points(out)
    command(out, "--decide", summary(out)["groups"][0]["name"], "всё", word, "")
    assert points(out) == pytest.approx([of(each) for each in before], abs=0.006)


def decision(out: Path, title: str, row: int, value: object, form: str = "General") -> None:
    """Write a decision as Excel stores what is typed."""
    book = load_workbook(out / "gradebook.xlsx")
    sheet = book[title]
    column = [cell.value for cell in sheet[1]].index("Решение: баллы") + 1
    sheet.cell(row, column).value, sheet.cell(row, column).number_format = value, form
    book.save(out / "gradebook.xlsx")


@pytest.mark.parametrize(
    ("value", "form", "given"),
    [(0.85, "0%", 85), (0.855, "0.0%", 85.5), (1, "0%", 100), (0.5, '0 %" балла"', 50),
     (0.5, '0.0"%"', 0.5), (85, "General", 85), ("85%", "@", 85), (0, "0%", 0),
     ("×0,5", "@", 50)],
)  # fmt: skip
def test_per_cents_on_the_sheet_of_marks_are_read_as_meant(
    late, out, monkeypatch, value, form, given
):
    monkeypatch.setattr(room, "grade_all", classroom.graded_here)
    decision(out, "Оценки", 2, value, form)
    for _ in range(2):  # what stands there afterwards means the same
        assert graded(late, out)["rows"][0]["points"] == given


def test_a_decision_on_a_group_in_the_gradebook_is_taken_back_there(late, out, monkeypatch):
    monkeypatch.setattr(room, "grade_all", classroom.graded_here)
    before = points(out)
    decision(out, GROUPS, 2, 0.75, "0%")
    with pytest.raises(InputError, match="доля чего"):
        graded(late, out)
    decision(out, GROUPS, 2, "×0,75")
    graded(late, out)
    assert points(out)[0] == 75
    graded(late, out)
    assert points(out)[0] == 75
    decision(out, GROUPS, 2, "×0,5")  # it is decided anew
    graded(late, out)
    assert points(out)[0] == 50
    decision(out, GROUPS, 2, None)  # and wiped out
    graded(late, out)
    assert points(out) == before


UNKNOWN = {"V_c": ['=INDIRECT("V_h")/17']}


@pytest.mark.parametrize(
    ("value", "form", "share"), [(0.5, "0%", 0.5), (1, "0%", 1), ("×0,5", "@", 0.5)]
)
def test_half_of_a_column_is_half_of_its_points(tmp_path, monkeypatch, value, form, share):
    monkeypatch.setattr(room, "grade_all", classroom.graded_here)
    (tmp_path / "in").mkdir()
    for number in (1, 2):
        data = filled_book(classroom.handout(number), classroom.assignment(number), UNKNOWN)
        (tmp_path / "in" / classroom.book(number).file).write_bytes(data)
    (tmp_path / "rubric.toml").write_text("", encoding="utf-8")
    rows = graded(tmp_path, tmp_path / "out")["rows"]
    worth = next(line for line in rows[0]["result"].items if line.id == "geometry.V_c").of
    decision(tmp_path / "out", GROUPS, 2, value, form)
    after = graded(tmp_path, tmp_path / "out")["rows"]
    assert after[0]["points"] == pytest.approx(100 - worth + share * worth, abs=0.006)
    word = ("1", "geometry.V_c", "25%", "")
    options = GradeSetup(decisions=[word])
    last = room.decide(tmp_path / "out", options).summary["rows"]
    assert last[0]["points"] == pytest.approx(100 - worth + 0.25 * worth, abs=0.006)


def test_the_sheet_takes_what_is_typed_as_it_is_typed(out):
    book = load_workbook(io.BytesIO((out / "gradebook.xlsx").read_bytes()))
    for title in ("Оценки", GROUPS):
        sheet = book[title]
        column = [cell.value for cell in sheet[1]].index("Решение: баллы") + 1
        assert sheet.cell(2, column).number_format == "@"
    assert "(100)" in str([cell.value for cell in book[GROUPS][2]])
