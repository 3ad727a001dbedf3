"""Grading as an instructor runs it: whose file, which counts, what it is worth, the tables."""

from __future__ import annotations

import csv
import io
import os
import zipfile
from datetime import datetime
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from reports.cli import main
from reports.grading.batch import grade as room
from reports.grading.batch.grade import GradeSetup, decide, grade
from reports.grading.issuing.rubric import rubric_of
from reports.grading.judging.scoring import late_factor
from reports.grading.reading.submissions import collect
from reports.shared.errors import InputError
from tests.grading import classroom
from tests.grading.fill import filled_book


@pytest.fixture(autouse=True)
def _by_this_process(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(room, "grade_all", classroom.graded_here)


def right(number: int) -> bytes:
    return filled_book(classroom.handout(number), classroom.assignment(number))


def run(submitted: Path, out: Path) -> dict:
    folder = classroom.folder()
    secret = folder / "secret.key"
    done = grade(
        folder / "issued", submitted, out, secret_file=secret, options=GradeSetup(workers=1)
    )
    return done.summary


@pytest.mark.parametrize(
    ("name", "later", "waits"),
    [
        ("записка.docx", 60, False), ("книга.ods", 60, True), ("книга.xlsx", 60, True),
        ("книга.ods", -60, False),
    ],
)  # fmt: skip
def test_what_lies_beside_a_book_is_no_later_version_of_it(tmp_path, name, later, waits):
    """A note is nothing to look at; of a later book that cannot be read a person is told."""
    classroom.register()
    path, out, summary = tmp_path / "in", tmp_path / "out", {}
    folder = path / "Иванов Имя_101_assignsubmission_file_"
    folder.mkdir(parents=True)
    (folder / "моя работа.xlsx").write_bytes(right(1))
    (folder / name).write_bytes(b"x")
    os.utime(folder / "моя работа.xlsx", (1_700_000_000, 1_700_000_000))
    os.utime(folder / name, (1_700_000_000 + later, 1_700_000_000 + later))
    summary = run(path, out)
    row = next(row for row in summary["rows"] if row["student"] == "Иванов Имя")
    assert row["points"] == 100
    assert bool(row["manual"]) == bool(summary["manual"]) == waits
    assert ("оценён не последний файл" in row["remark"]) == waits
    grade_ = (out / "moodle.csv").read_text("utf-8").splitlines()[1].split(",")[4]
    assert grade_ == ("" if waits else "100")
    if waits:
        decided = GradeSetup(decisions=[("Иванов Имя", "всё", "+", "сдал в классе")])
        (row,) = [r for r in decide(out, decided).summary["rows"] if r["student"] == "Иванов Имя"]
        assert not row["manual"] and row["points"] == 100


def test_moodles_zip_is_read_as_it_is(tmp_path):
    classroom.register()
    path = tmp_path / "assignment.zip"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("Иванов Имя_101_assignsubmission_file_/моя работа.xlsx", right(1))
        # The file of another student under a foreign name.
        archive.writestr("Петров Имя_102_assignsubmission_file_/x.xlsx", right(3))
        archive.writestr("__MACOSX/junk.xlsx", b"x")
    actual = collect(path)
    assert [item.moodle_id for item in actual] == ["101", "102"]
    summary = run(path, tmp_path / "out")
    rows = {row["student"]: row for row in summary["rows"]}
    assert rows["Иванов Имя"]["points"] == 100
    assert not rows["Иванов Имя"]["manual"]
    assert rows["Сидорова Имя"]["manual"]
    assert "а идентификатор выдан: Сидорова Имя" in rows["Сидорова Имя"]["remark"]
    assert any("идентификатор выдан" in text for text in summary["signals"])
    table = list(csv.reader(io.StringIO((tmp_path / "out" / "moodle.csv").read_text("utf-8"))))
    grades = {line[1]: line for line in table[1:]}
    assert grades["Иванов Имя"][0] == "Participant 101"
    assert grades["Иванов Имя"][2] == "s1@example.org"
    assert grades["Иванов Имя"][4] == "100"
    assert grades["Сидорова Имя"][4:6] == ["", ""]  # a person looks first, at names of others


def zipped(**members: bytes) -> bytes:
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as archive:
        for name, data in members.items():
            archive.writestr(zipfile.ZipInfo(name, (2001, 1, 1, 0, 0, 0)), data)
    return stream.getvalue()


def under_windows(data: bytes, name: str) -> bytes:
    """A zip whose member x.xlsx is called as a Russian Windows calls it: without a flag."""
    return data.replace(b"x" * len(name), name.encode("cp866"))


def test_zips_of_students_are_opened(tmp_path):
    classroom.register()
    where, name = tmp_path / "in", "Сидорова Ёлка.xlsx"
    where.mkdir()
    second = right(2)
    inner = zipped(**{"работа.xlsx": second})
    odd = under_windows(zipped(**{"x" * len(name): right(3)}), name)
    (where / "Иванов.zip").write_bytes(zipped(**{"моя/работа.xlsx": right(1), "Thumbs.db": b"x"}))
    (where / "все.zip").write_bytes(zipped(**{"Петров.zip": inner, "три.zip": odd}))
    (where / "пусто.zip").write_bytes(zipped())
    (where / "много.zip").write_bytes(zipped(**{f"{i}.xlsx": b"" for i in range(201)}))
    (where / "битый.zip").write_bytes(odd[:200])
    collected = {item.key: item for item in collect(where)}
    assert list(collected) == [
        "Иванов.zip/моя/работа.xlsx", "битый.zip", "все.zip/Петров.zip/работа.xlsx",
        f"все.zip/три.zip/{name}", "много.zip", "пусто.zip",
    ]  # fmt: skip
    assert collected["все.zip/Петров.zip/работа.xlsx"].read() == second
    assert all(
        item.time.year > 2001 for item in collected.values()
    )  # not what the student's zip says
    rows = run(where, tmp_path / "out")["rows"]
    assert [row["points"] for row in rows[:4]] == [100, 100, 100, None]
    assert sum(row["manual"] for row in rows) == 3


def test_a_moodle_zip_in_a_folder_keeps_its_times(tmp_path):
    name = "Иванов Имя_101_assignsubmission_file_"
    data = zipped(**{f"{name}/a.zip": zipped(**{"a.xlsx": b"1"}), f"{name}/b.xlsx": b"2"})
    (tmp_path / "moodle.zip").write_bytes(data)
    actual = collect(tmp_path)
    assert [(item.time.year, item.moodle_id) for item in actual] == [(2001, "101")] * 2
    assert [item.read() for item in actual] == [b"1", b"2"]


def test_the_last_of_several_files_counts_and_copies_are_noticed(tmp_path):
    classroom.register()
    submitted = tmp_path / "submitted"
    submitted.mkdir()
    same = right(2)
    for name, data, when in (
        ("a.xlsx", right(1), 3_000), ("b.xlsx", classroom.handout(1), 1_000),
        ("c.xlsx", same, 1_000), ("d.xlsx", same, 1_000),
    ):  # fmt: skip
        (submitted / name).write_bytes(data)
        os.utime(submitted / name, (1_700_000_000 + when,) * 2)
    summary = run(submitted, tmp_path / "out")
    rows = {row["number"]: row for row in summary["rows"]}
    assert rows[1]["points"] == 100
    assert "оценён последний (a.xlsx)" in rows[1]["remark"]
    assert rows[3]["status"] == "не сдано"
    assert any(text.startswith("одинаковые файлы: ") for text in summary["signals"])


def test_results_of_another_program_are_made_anew(tmp_path, monkeypatch):
    """Its rules and its words may have been others, whatever it called itself."""
    marked: list[int] = []

    def graded(submissions, *given, **options):
        marked.append(len(submissions))
        return classroom.graded_here(submissions, *given, **options)

    monkeypatch.setattr(room, "grade_all", graded)
    submitted = tmp_path / "submitted"
    submitted.mkdir()
    (submitted / "a.xlsx").write_bytes(classroom.handout(1))
    for _ in range(2):
        run(submitted, tmp_path / "out")
    monkeypatch.setattr(room, "source_digest", lambda: "another")
    run(submitted, tmp_path / "out")
    assert [count for count in marked if count] == [1, 1]


def test_without_an_identifier_the_name_of_the_file_decides(tmp_path):
    from tests.grading.forms import rewritten

    ticket = classroom.book(2).ticket.encode()
    data = rewritten(right(2), lambda name, part: part.replace(ticket, b"-"))
    result = classroom.marks(data, "группа 1/Petrov, кр.xlsx")
    assert result["student"] == "Петров Имя"
    assert "идентификатора нет" in result["evidence"][0]
    assert result["points"] == 100
    assert classroom.marks(data, "Новая книга.xlsx")["status"] == "unmatched"


def test_late_rules():
    rubric = rubric_of(
        {"late": {"deadline": datetime(2026, 12, 1, 12), "rules": [
            {"after_hours": 0, "factor": 0.9}, {"after_hours": 24, "factor": 0.5}]}}, "r",
    )  # fmt: skip
    assert late_factor(rubric, datetime(2026, 12, 1, 12)) == 1
    assert late_factor(rubric, datetime(2026, 12, 1, 12, 1)) == 0.9
    assert late_factor(rubric, datetime(2026, 12, 3)) == 0.5
    assert late_factor(rubric, None) == 1


def test_wrong_places_are_refused(tmp_path):
    classroom.register()
    with pytest.raises(InputError, match="нет такого файла или папки"):
        run(tmp_path / "nothing", tmp_path / "out")
    (tmp_path / "empty").mkdir()
    with pytest.raises(InputError, match="нет ни одной сданной работы"):
        run(tmp_path / "empty", tmp_path / "out")
    (tmp_path / "empty" / "a.xlsx").write_bytes(b"a")
    with pytest.raises(InputError, match="результаты легли бы"):
        run(tmp_path / "empty", tmp_path / "empty" / "out")
    with pytest.raises(InputError, match="секрет не читается"):
        folder = classroom.folder()
        grade(folder / "issued", tmp_path / "empty", tmp_path / "out",
              secret_file=tmp_path / "no.key")  # fmt: skip


def kshm(*arguments: object) -> Result:
    """The command in this process; as one of its own it runs in tests/manual/test_commands.py."""
    return CliRunner().invoke(main, [*map(str, arguments)])


def test_the_command_explains_a_verdict(tmp_path):
    classroom.register()
    file = tmp_path / "работа.xlsx"
    wrong = {"omega": ["=regime_speed_rpm*PI()/60"]}
    file.write_bytes(filled_book(classroom.handout(1), classroom.assignment(1), wrong))
    folder = classroom.folder()
    common = ("--secret", folder / "secret.key", "--explain", file)
    # Windows leaves the quotes of the manual's line where they are.
    done = kshm("grade", folder / "issued", *common, "'П3.1!E'")
    assert done.exit_code == 0, done.stderr
    for words in ("P3_1.v1_m_s", "=r_crank*omega*SIN(RADIANS(A6))", "по его предыдущим значениям",
                  "omega", "Вердикт: верно по вашим предыдущим значениям"):  # fmt: skip
        assert words in done.stdout
    done = kshm("grade", folder / "issued", *common, "omega")
    assert "Вердикт: неверно" in done.stdout
    assert "вдвое меньше" in done.stdout
    done = kshm("grade", folder / "issued", *common, "П3.1!Z")
    assert done.exit_code == 2
    assert len(done.stderr.splitlines()) == 1
    assert "Traceback" not in done.stderr
    done = kshm("grade", folder / "issued")
    assert done.exit_code == 2
    assert "нужны папка выдачи" in done.stderr


def test_a_pdf_on_demand(tmp_path):
    classroom.register()
    submitted = tmp_path / "submitted"
    submitted.mkdir()
    (submitted / "a.xlsx").write_bytes(right(1))
    folder = classroom.folder()
    grade(folder / "issued", submitted, tmp_path / "out", secret_file=folder / "secret.key",
          options=GradeSetup(workers=1, pdf=True))  # fmt: skip
    (pdf,) = (tmp_path / "out" / "pages").glob("*.pdf")
    assert pdf.read_bytes().startswith(b"%PDF")
