"""A person's word: points and a remark, kept, shown, stronger than the program's."""

from __future__ import annotations

import csv
import json
import os
from datetime import datetime
from getpass import getuser
from pathlib import Path
from types import SimpleNamespace
from unittest.mock import Mock

import pytest
from click.testing import CliRunner
from openpyxl import Workbook, load_workbook

from reports.cli import main
from reports.commands import class_commands
from reports.grading.batch import grade as room
from reports.grading.batch.decisions import WHOLE, Decision, from_gradebook
from reports.grading.batch.grade import GradeSetup, decide, grade
from reports.grading.issuing.rubric import Attempts, Rubric, rubric_of
from reports.grading.judging.judgement import EMPTY, RIGHT, WRONG
from reports.grading.judging.scoring import HandedIn, late_factor, score
from reports.grading.judging.work_digest import Work, work_of
from reports.grading.pages.gradebook import DECISION, OF_FILE
from reports.grading.pages.states import State
from reports.grading.pages.summary import choose, table_rows
from reports.shared.errors import InputError
from tests.grading import classroom
from tests.grading.fill import filled_book

UNKNOWN = {"V_c": ['=INDIRECT("V_h")/17']}


@pytest.fixture(autouse=True)
def _by_this_process(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(room, "grade_all", classroom.graded_here)


def submitted(folder: Path) -> Path:
    """One book with a formula that no program calculates, one that is right."""
    classroom.register()
    folder.mkdir()
    for number, changes in ((1, UNKNOWN), (2, None)):
        book = filled_book(classroom.handout(number), classroom.assignment(number), changes)
        (folder / f"{number}.xlsx").write_bytes(book)
    return folder


def run(
    where: Path, out: Path, *words: tuple[str, str, str, str], rubric: Path | None = None
) -> dict:
    folder = classroom.folder()
    options = GradeSetup(workers=1, decisions=words, author="Преподаватель")
    done = grade(folder / "issued", where, out, rubric_file=rubric,
                 secret_file=folder / "secret.key", options=options)  # fmt: skip
    return {row["number"]: row for row in done.summary["rows"]}


def test_an_unknown_is_decided_and_the_decision_survives(tmp_path):
    where, out = submitted(tmp_path / "in"), tmp_path / "out"
    rows = run(where, out)
    worth = next(x for x in rows[1]["result"].items if x.id == "geometry.V_c").of
    assert rows[1]["manual"]
    assert rows[1]["points"] == pytest.approx(100 - worth, abs=0.01)
    # Without anything to grade anew, and without the secret.
    words = ("Иванов Имя", "geometry.V_c", f"{worth:.4f}", "посмотрел: верно")
    done = decide(out, GradeSetup(decisions=(words,), author="Петрова"))
    assert not done.needs_a_person
    (entry,) = json.loads((out / "decisions.json").read_text("utf-8"))["decisions"]
    assert (entry["author"], entry["remark"]) == ("Петрова", "посмотрел: верно")
    assert entry["date"].startswith(str(datetime.now().year))
    for rows in (run(where, out), run(where, out)):  # and of every later run
        assert rows[1]["points"] == pytest.approx(100, abs=0.01)
        assert not rows[1]["manual"]
        page = (out / rows[1]["page"]).read_text("utf-8")
        assert "Решение преподавателя" in page
        assert "посмотрел: верно" in page
        assert "Петрова" in page
    rows = run(where, out, ("1", "geometry.V_c", "50 %", "половина"))  # of the column's points
    assert rows[1]["points"] == pytest.approx(100 - worth / 2, abs=0.01)
    rows = run(where, out, ("1", "geometry.V_c", "-", ""))  # withdrawn
    assert rows[1]["manual"]
    assert "посмотрел" not in (out / rows[1]["page"]).read_text("utf-8")


def test_the_gradebook_is_read_back(tmp_path):
    where, out = submitted(tmp_path / "in"), tmp_path / "out"
    run(where, out)
    path = out / "gradebook.xlsx"
    book = load_workbook(path)
    sheet = book.active
    head = [cell.value for cell in sheet[1]]
    points, remark = head.index("Решение: баллы") + 1, head.index("Решение: примечание") + 1
    sheet.cell(3, points).value, sheet.cell(3, remark).value = 55.5, "защита не сдана"
    book.properties.lastModifiedBy = "Сидорова"
    book.save(path)
    for rows in (run(where, out), run(where, out)):
        assert rows[2]["points"] == 55.5
        assert "защита не сдана" in rows[2]["remark"]
    entry = json.loads((out / "decisions.json").read_text("utf-8"))["decisions"][0]
    assert entry["author"] == "Сидорова"
    assert load_workbook(path).active.cell(3, points).value == 55.5
    book = load_workbook(path)
    book.active.cell(3, points).value = book.active.cell(3, remark).value = None
    book.save(path)
    assert run(where, out)[2]["points"] == 100


@pytest.mark.parametrize(("given", "told"), [((), getuser()), (("--author", "Петрова"), "Петрова")])
def test_who_decides_is_who_calls_or_who_is_named(tmp_path, monkeypatch, given, told):
    done, seen = SimpleNamespace(needs_a_person=False), []
    monkeypatch.setattr(room, "decide", lambda _, options: seen.append(options.author) or done)
    words = ["grade", "-o", str(tmp_path), "--decide", "1", "всё", "+", "верно", *given]
    assert CliRunner().invoke(main, words).exit_code == 0
    assert seen == [told]


@pytest.mark.parametrize("error", [KeyError, ImportError, OSError])  # as the Pythons there say it
def test_nobody_decides_where_the_system_does_not_say_who(tmp_path, monkeypatch, error):
    monkeypatch.setattr(class_commands, "getuser", Mock(side_effect=error))
    test_who_decides_is_who_calls_or_who_is_named(tmp_path, monkeypatch, (), "")


@pytest.mark.parametrize("remark", ["болел", "есть справка"])
def test_another_remark_with_the_same_points_is_taken_over(tmp_path, remark):
    book, path = Workbook(), tmp_path / "gradebook.xlsx"
    book.active.append(["Вариант", *DECISION, OF_FILE])
    book.active.append([2, "55.5", remark, "sha"])
    book.save(path)
    kept = [Decision(2, WHOLE, 55.5, "болел", "Петрова", "2026-01-01T00:00", "sha")]
    (actual,) = from_gradebook(path, kept, {}, Rubric())
    assert (actual.points, actual.remark, actual.file) == (55.5, remark, "sha")
    assert (actual == kept[0]) == (remark == "болел")


def test_a_doubtful_work_is_accepted_by_a_person(tmp_path):
    from tests.grading.real.cheats import reticketed

    where, out = submitted(tmp_path / "in"), tmp_path / "out"
    data = (where / "2.xlsx").read_bytes()
    (where / "2.xlsx").unlink()
    ticket = classroom.book(2).ticket
    (where / f"{classroom.book(2).folder}.xlsx").write_bytes(reticketed(data, ticket, ""))
    rows = run(where, out)
    assert rows[2]["points"] is None
    assert "нет идентификатора" in rows[2]["remark"]
    assert "предварительные" in (out / rows[2]["page"]).read_text("utf-8") or rows[2]["manual"]
    rows = run(where, out, ("2", "всё", "+", "его работа"))
    assert rows[2]["points"] == 100
    assert not rows[2]["manual"]


def saved_again(book: Workbook, _: object) -> None:
    """The same formulas in another file."""
    book.properties.title = "Ещё раз"


@pytest.mark.parametrize("word", ["+", "0"])
def test_a_decision_is_about_the_file_that_was_looked_at(tmp_path, word):
    """Who was accepted, or failed, does not settle it by handing in another file."""
    where, out = submitted(tmp_path / "in"), tmp_path / "out"
    decided = run(where, out, ("2", "всё", word, ""))[2]["points"]
    earlier = (where / "2.xlsx").read_bytes()
    for changes in (UNKNOWN, None):
        data = filled_book(classroom.handout(2), classroom.assignment(2), changes, saved_again)
        (where / "2.xlsx").write_bytes(data)
        assert data != earlier
        for rows in (run(where, out), run(where, out)):  # the gradebook of the first has a «+»
            assert rows[2]["points"] is None
            assert "решите о нём заново" in rows[2]["remark"]
    cell = decision_cell(out, 2)
    assert cell.value is None
    assert decide_in_gradebook(where, out, 2, "+")[2]["points"] == 100
    (where / "2.xlsx").write_bytes(earlier)  # what was handed in first counts again
    assert run(where, out)[2]["points"] == decided
    assert run(where, out, ("2", "всё", "-", ""))[2]["points"] == 100


@pytest.mark.parametrize("later", ["other", "empty", "right"])
def test_a_decision_on_a_column_is_about_the_file_that_was_looked_at(tmp_path, later):
    """Neither is a column paid that nobody has seen, nor is a mended one left without points."""
    where, out = submitted(tmp_path / "in"), tmp_path / "out"
    run(where, out)
    points = "0" if later == "right" else "1"
    rows = run(where, out, ("1", "geometry.V_c", points, "посмотрел"))
    assert not rows[1]["manual"]
    earlier = (where / "1.xlsx").read_bytes()
    changes = {"other": {"V_c": ['=INDIRECT("V_h")/18']}, "empty": {"V_c": [None]}, "right": None}
    book = filled_book(classroom.handout(1), classroom.assignment(1), changes[later])
    (where / "1.xlsx").write_bytes(book)
    for rows in (run(where, out), run(where, out)):
        assert rows[1]["manual"]
        assert "сдан другой файл, решите заново о столбцах: Массы Vc" in rows[1]["remark"]
        line = next(line for line in rows[1]["result"].items if line.id == "geometry.V_c")
        assert line.points == (line.of if later == "right" else 0)
    rows = run(where, out, ("1", "geometry.V_c", "+", ""))
    assert not rows[1]["manual"]
    (where / "1.xlsx").write_bytes(earlier)  # what was handed in first counts again
    rows = run(where, out)
    assert not rows[1]["manual"] and "посмотрел" in rows[1]["remark"]


def test_the_gradebook_tells_of_the_file_that_was_looked_at(tmp_path):
    """A word written into it is not about what was handed in meanwhile."""
    where, out = submitted(tmp_path / "in"), tmp_path / "out"
    run(where, out)
    earlier = (where / "2.xlsx").read_bytes()
    book = filled_book(classroom.handout(2), classroom.assignment(2), {"V_c": [None]})
    (where / "2.xlsx").write_bytes(book)
    rows = decide_in_gradebook(where, out, 2, "100")
    assert rows[2]["points"] is None and "решите о нём заново" in rows[2]["remark"]
    (where / "2.xlsx").write_bytes(earlier)
    assert run(where, out)[2]["points"] == 100


def test_the_best_of_several_files_does_not_pass_by_a_decision(tmp_path):
    """Who was failed for one file is not paid for another that nobody has looked at."""
    where, out = submitted(tmp_path / "in"), tmp_path / "out"
    book = filled_book(classroom.handout(2), classroom.assignment(2), {"V_c": [None]})
    (where / "2 ещё.xlsx").write_bytes(book)
    rubric = tmp_path / "rubric.toml"
    rubric.write_text('[attempts]\ncount = "best"\n', encoding="utf-8")
    assert run(where, out, rubric=rubric)[2]["points"] == 100
    for words in ([("2", "всё", "0", "списано")], []):
        item = run(where, out, *words, rubric=rubric)
        assert item[2]["points"] is None and "решите о нём заново" in item[2]["remark"]


@pytest.mark.parametrize("word", [950, "8O", "сто", "nan", -1])
def test_what_is_no_decision_in_the_gradebook_is_told_and_kept(tmp_path, word):
    where, out = submitted(tmp_path / "in"), tmp_path / "out"
    run(where, out)
    with pytest.raises(InputError) as caught:
        decide_in_gradebook(where, out, 2, word)
    (problem,) = caught.value.problems
    assert "строка 3" in problem.where and str(word) in problem.where
    assert decision_cell(out, 2).value == word


def test_a_decision_on_a_file_of_nobody_is_told(tmp_path):
    where, out = submitted(tmp_path / "in"), tmp_path / "out"
    (where / "чья.xlsx").write_bytes(b"")
    run(where, out)
    with pytest.raises(InputError, match="без владельца"):
        decide_in_gradebook(where, out, 5, 10)


def test_decisions_on_one_class_are_not_taken_for_another(tmp_path):
    where, out = submitted(tmp_path / "in"), tmp_path / "out"
    run(where, out, ("2", "всё", "10", "списано"))
    other = classroom.issue_class(tmp_path / "other", 2)
    with pytest.raises(InputError, match="другой группы"):
        grade(tmp_path / "other/issued", where, out, secret_file=tmp_path / "other/secret.key")
    assert other.register.books[1].ticket != classroom.book(2).ticket
    assert run(where, out)[2]["points"] == 10


def decision_cell(out: Path, number: int):
    """Where the points of a decision are written."""
    sheet = load_workbook(out / "gradebook.xlsx")["Оценки"]
    head = [cell.value for cell in sheet[1]]
    return sheet.cell(number + 1, head.index("Решение: баллы") + 1)


def decide_in_gradebook(where: Path, out: Path, number: int, word: object) -> dict:
    at = decision_cell(out, number)
    book = at.parent.parent
    at.value = word
    book.move_sheet("Оценки", 1)  # as a person may leave it
    book.save(out / "gradebook.xlsx")
    return run(where, out)


def test_a_file_that_cannot_be_read_is_decided_by_a_person(tmp_path):
    """He gives points, his student reads them; there are none of the program's to accept."""
    classroom.register()
    where, out = tmp_path / "in", tmp_path / "out"
    where.mkdir()
    (where / f"{classroom.book(2).folder}.ods").write_bytes(b"x")
    assert run(where, out)[2]["status"] == "не принято"
    with pytest.raises(InputError, match="нет баллов программы"):
        decide(out, GradeSetup(decisions=(("2", "всё", "+", ""),)))
    done = decide(out, GradeSetup(decisions=(("2", "всё", "70", "смотрел книгу .ods"),)))
    row = done.summary["rows"][1]
    assert row["points"] == 70 and not done.needs_a_person
    page = (out / row["page"]).read_text("utf-8")
    assert "70 из 100 баллов" in page and "смотрел книгу .ods" in page


def test_an_earlier_file_asks_for_nobody(tmp_path):
    """No decision is about a file that does not count: it would have waited for ever."""
    where, out = submitted(tmp_path / "in"), tmp_path / "out"
    os.utime(where / "1.xlsx", (1_700_000_000, 1_700_000_000))
    data = filled_book(classroom.handout(1), classroom.assignment(1), None, saved_again)
    (where / "1 ещё.xlsx").write_bytes(data)
    rows = run(where, out)
    assert rows[1]["points"] == 100 and "файлов: 2" in rows[1]["remark"]
    assert not decide(out, GradeSetup()).needs_a_person


def test_a_column_may_be_paid_more_but_no_work_is(tmp_path):
    """Moodle takes no grade above the maximum."""
    where, out = submitted(tmp_path / "in"), tmp_path / "out"
    run(where, out)
    assert run(where, out, ("1", "geometry.V_c", "20", "показал вывод"))[1]["points"] == 100
    page = (out / run(where, out)[1]["page"]).read_text("utf-8")
    assert "нужна ручная проверка" not in page  # it has been decided


def test_what_is_no_decision_is_refused(tmp_path):
    where, out = submitted(tmp_path / "in"), tmp_path / "out"
    run(where, out)
    with pytest.raises(InputError, match="работа не сдана"):
        decide_in_gradebook(where, out, 3, 40)
    (out / "gradebook.xlsx").unlink()
    for words, message in (
        (("3", "всё", "40", ""), "работа не сдана"),
        (("Никто", "всё", "5", ""), "нет такого студента"),
        (("1", "P9.x", "5", ""), "нет такого столбца"),
        (("1", "всё", "101", ""), "это не баллы"),
        (("1", "всё", "пять", ""), "это не баллы"),
    ):
        with pytest.raises(InputError, match=message):
            decide(out, GradeSetup(decisions=(words,)))
    (out / "decisions.json").write_text("{", encoding="utf-8")
    with pytest.raises(InputError, match="файл решений преподавателя повреждён"):
        decide(out, GradeSetup())


def test_the_best_attempt_counts_where_the_rubric_says_so():
    def result(points: float, time: str, submitter: int | None = None) -> Work:
        values = {"number": 1, "status": "graded", "points": points, "time": time, "key": time,
                "file": time, "submitter": submitter, "items": [], "manual": []}  # fmt: skip
        return work_of(values, {})

    first, second = result(90.0, "2026-01-01"), result(60.0, "2026-01-02")
    assert choose([first, second])[1] is second
    assert choose([first, second], Attempts(count="best"))[1] is first
    thief = result(0.0, "2026-01-03", 2)
    assert choose([first, second, thief])[1] is second  # a stranger's file is never mine


def test_of_files_in_one_zip_none_is_the_last():
    """By their names an empty book beside the filled one would have counted."""
    about = {"number": 1, "status": "graded", "time": "2026-01-01", "submitter": None,
             "items": [], "manual": [], "page": "", "fingerprint": "", "sha256": ""}  # fmt: skip
    files = (("1.zip/filled.xlsx", 90.0), ("1.zip/the empty.xlsx", 0.0))
    works = [work_of(about | {"key": key, "file": key, "points": n}, {}) for key, n in files]
    row = table_rows(classroom.register(), works)[0]
    assert row["points"] == 90
    assert "файлов: 2, оценён лучший из сданных в то же время (1.zip/filled" in row["remark"]


def test_days_of_delay():
    late = {"deadline": datetime(2026, 12, 1, 12), "per_day": 0.1, "free_days": 1, "least": 0.3}
    rubric = rubric_of({"late": late}, "r")
    assert late_factor(rubric, datetime(2026, 12, 1, 12)) == 1
    assert late_factor(rubric, datetime(2026, 12, 2, 11)) == 1  # the free day
    assert late_factor(rubric, datetime(2026, 12, 2, 13)) == pytest.approx(0.9)
    assert late_factor(rubric, datetime(2026, 12, 4, 13)) == pytest.approx(0.7)
    assert late_factor(rubric, datetime(2026, 12, 30)) == 0.3


@pytest.mark.parametrize(("least", "points"), [(0.0, 3.2), (0.3333, 3.2), (0.34, 0.0)])
def test_too_little_filled_in_is_worth_nothing(least, points):
    late = {"deadline": datetime(2026, 12, 1), "per_day": 0.2}
    rubric = rubric_of({"maximum": 24.0, "minimum": {"filled": least}, "late": late}, "r")
    # A right line and a wrong one of six; what is worth nothing counts on neither side.
    verdicts = [(RIGHT, 4.0, 4.0), (WRONG, 0.0, 4.0), *[(EMPTY, 0.0, 4.0)] * 4, (WRONG, 0.0, 0.0)]
    lines = [{"verdict": v, "points": got, "of": most} for v, got, most in verdicts]
    result = {"items": lines, "notes": []}
    score(result, rubric, HandedIn(datetime(2026, 12, 1, 1)))
    assert (result["raw"], result["points"], result["maximum"]) == (4.0, points, 24.0)
    assert (result["filled"], result["late"], result["enough"]) == (0.3333, 0.8, points > 0)
    short = "заполнено 33% при наименьшем 34%: 0 баллов"
    notes = ["сдано через 1 ч после срока (часы Moodle): баллы умножены на 0,8"]
    assert result["notes"] == ([short] if not points else []) + notes


def test_a_work_of_nothing_paid_is_not_filled_in():
    result = {"items": [], "notes": []}
    score(result, rubric_of({}, "r"), HandedIn())
    assert (result["filled"], result["points"], result["notes"]) == (0.0, 0.0, [])


assert os


def test_parts_marked_by_hand_stand_in_the_same_sum(tmp_path):
    """The book keeps what note and defence leave; until both have points the work waits."""
    rubric = tmp_path / "rubric.toml"
    rubric.write_text('[parts]\n"записка" = 20\n"защита" = 30\n', encoding="utf-8")
    where, out = tmp_path / "in", tmp_path / "out"
    where.mkdir()
    data = filled_book(classroom.handout(1), classroom.assignment(1))
    (where / classroom.book(1).file).write_bytes(data)

    def told() -> tuple[float | None, str, str]:
        rows = json.loads((out / "summary.json").read_text(encoding="utf-8"))["rows"]
        return rows[0]["points"], rows[0]["status"], rows[0]["remark"]

    issued = classroom.folder() / "issued"
    grade(issued, where, out, rubric_file=rubric, secret_file=classroom.folder() / "secret.key",
          options=GradeSetup(workers=1))  # fmt: skip
    assert told() == (50, State.BY_HAND, "ставит преподаватель: записка, защита")
    decide(out, GradeSetup(decisions=[("1", "записка", "15", "без чертежа")]))
    points, state, remark = told()
    assert (points, state) == (65, State.BY_HAND) and "ставит преподаватель: защита" in remark
    decide(out, GradeSetup(decisions=[("1", "защита", "90%", "")]))
    assert told()[:2] == (92, State.CHECKED)
    table = (out / "gradebook.csv").read_text("utf-8-sig").splitlines()
    cells = next(csv.DictReader(table, delimiter=";"))
    assert (cells["Записка"], cells["Защита"]) == ("15", "27")
    page = next((out / "pages").glob("*.html")).read_text(encoding="utf-8")
    assert "Записка" in page and "92 из 100" in page
    decide(out, GradeSetup(decisions=[("1", "защита", "-", "")]))
    assert told()[:2] == (65, State.BY_HAND)
    for parts in ({"записка": 101}, {"1": 5}, {"записка": 60, "защита": 60}):
        with pytest.raises(InputError):
            rubric_of({"parts": parts}, "рубрика")


def test_another_rubric_is_shown_before_it_is_applied(tmp_path):
    """Who gains and who loses, what was decided standing; the results stay as they were."""
    where, out = submitted(tmp_path / "in"), tmp_path / "out"
    run(where, out, ("2", "всё", "80", ""))
    before = {path: path.read_bytes() for path in out.rglob("*") if path.is_file()}
    rubric = tmp_path / "rubric.toml"
    rubric.write_text('[points]\n"geometry" = 90\n', encoding="utf-8")
    issued, secret = classroom.folder() / "issued", classroom.folder() / "secret.key"
    command = ["grade", str(issued), str(where), "-o", str(out), "--preview"]
    keys = ["--rubric", str(rubric), "--secret", str(secret)]
    shown = CliRunner().invoke(main, [*command, *keys])
    assert shown.exit_code == 0, shown.output
    first, *others = shown.output.splitlines()
    assert classroom.book(1).student.full in first and "(−" in first
    assert others == ["Без изменений: 1", "Ничего не записано: это показ."]
    assert before == {path: path.read_bytes() for path in out.rglob("*") if path.is_file()}


def test_another_look_is_asked_for_and_answered_on_the_student_s_page(tmp_path):
    where, out = submitted(tmp_path / "in"), tmp_path / "out"
    run(where, out, ("1", "geometry.V_c", "+", ""))

    def state() -> tuple[str, str, str]:
        rows = json.loads((out / "summary.json").read_text(encoding="utf-8"))["rows"]
        page = next((out / "pages").glob("01-*.html")).read_text(encoding="utf-8")
        return rows[0]["status"], rows[0]["remark"], page

    decide(out, GradeSetup(requests=[("1", "Массы Vc", "ДВССЫЛ даёт то же <b>число</b>")]))
    for _ in range(2):  # and the next run still knows
        status, remark, page = state()
        assert status == State.BY_HAND
        assert remark.count("просит посмотреть ещё раз Массы Vc: ДВССЫЛ") == 1
        assert "Вы просили посмотреть ещё раз" in page and "&lt;b&gt;" in page
        run(where, out)
    decide(out, GradeSetup(decisions=[("1", "geometry.V_c", "2", "верно, засчитано")]))
    status, remark, page = state()
    assert status == State.CHECKED and "просит посмотреть" not in remark
    assert "верно, засчитано" in page and "Ответа пока нет" not in page
    for column, words in (("П9.9 q", "слова"), ("Массы Vc", " ")):
        with pytest.raises(InputError):
            decide(out, GradeSetup(requests=[("1", column, words)]))
