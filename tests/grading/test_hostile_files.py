"""Hostile files: each refused or graded with a reason, and nobody else is harmed."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from reports.grading.batch import grade as grading
from reports.grading.batch.grade import GradeSetup, grade
from reports.grading.batch.pool import DIED, grade_all
from reports.grading.issuing.register import load_register
from reports.grading.issuing.roster import listings
from reports.grading.pages import moodle
from reports.grading.reading.submissions import collect
from reports.shared.errors import InputError
from tests.grading import classroom
from tests.grading.fill import filled_book
from tests.grading.hostile import hostile_files
from tests.grading.test_moodle import ENGLISH, worksheet

ROOT = Path(__file__).parents[2]


def right_book(number: int) -> bytes:
    return filled_book(classroom.handout(number), classroom.assignment(number))


def run(submitted: Path, out: Path, **options) -> dict:
    """Grade a folder against the small class."""
    folder = classroom.folder()
    return grade(
        folder / "issued", submitted, out, secret_file=folder / "secret.key",
        options=GradeSetup(workers=1, **options),
    ).summary  # fmt: skip


def result_of(out: Path, key: str) -> dict:
    for path in (out / "results").glob("*.json"):
        data = json.loads(path.read_text(encoding="utf-8"))
        if data.get("key") == key:
            return data
    raise AssertionError(key)


def test_every_hostile_file_is_one_row_with_a_reason(tmp_path):
    classroom.register()
    submitted, alone = tmp_path / "submitted", tmp_path / "alone"
    submitted.mkdir()
    alone.mkdir()
    good = {1: right_book(1), 2: right_book(2)}
    files = dict(hostile_files(right_book(3), classroom.book(3).ticket, classroom.book(4).ticket))
    assert len(files) >= 40
    for name, data in files.items():
        (submitted / name).write_bytes(data)
    for number, data in good.items():
        for position in (submitted, alone):
            path = position / classroom.book(number).file
            path.write_bytes(data)
            os.utime(path, (1_700_000_000, 1_700_000_000))
    started = time.monotonic()
    summary = run(submitted, tmp_path / "out")
    assert time.monotonic() - started < 300
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(grading, "grade_all", classroom.graded_here)
        run(alone, tmp_path / "out-alone")

    # What the student's own rows say does not depend on the company.
    for number in good:
        key = classroom.book(number).file
        mine, theirs = result_of(tmp_path / "out", key), result_of(tmp_path / "out-alone", key)
        assert mine == theirs
        assert mine["points"] == 100
        assert mine["manual"] == []

    quiet = []
    for name in files:
        result = result_of(tmp_path / "out", name)
        page = (tmp_path / "out" / result["page"]).read_text(encoding="utf-8")
        assert "<script" not in page.lower()
        if result["status"] == "graded":
            lines = {line["id"]: line for line in result["items"]}
            messages = [line for line in lines.values() if line["verdict"] != "right"]
            if not (result["manual"] or messages or result["notes"]):
                quiet.append(name)
            # A formula that could not be calculated never earns points.
            for line in messages:
                assert line["verdict"] != "unknown" or line["points"] == 0
        else:
            assert result["manual"], name
            assert result.get("points") is None
        text = json.dumps(result, ensure_ascii=False)
        assert "root:" not in text
        assert "внутренняя ошибка" not in text, (name, result["manual"])
    # These are right books in spite of what was tried.
    assert set(quiet) <= {"up-chain.xlsx", "lying.xlsx", "wrong-row.xlsx"}, quiet
    assert len(summary["manual"]) >= 35
    csv_text = (tmp_path / "out" / "gradebook.csv").read_text(encoding="utf-8-sig")
    assert not any(field.startswith(("=", "+", "@")) for line in csv_text.splitlines()
                   for field in line.split(";"))  # fmt: skip


def test_a_worker_that_dies_or_hangs_costs_one_file(tmp_path):
    classroom.register()
    submitted = tmp_path / "submitted"
    submitted.mkdir()
    (submitted / classroom.book(1).file).write_bytes(right_book(1))
    (submitted / "slow.xlsx").write_bytes(right_book(2))
    # Nothing can be graded in no time: the limit itself is what is tried.
    summary = run(submitted, tmp_path / "out", timeout_s=0.001)
    assert {row["status"] for row in summary["rows"]} <= {"не принято", "не сдано", "проверено"}
    assert any("слишком много времени" in " ".join(entry["why"]) for entry in summary["manual"])


def test_files_that_exhaust_the_memory_do_not_end_the_batch(tmp_path):
    classroom.register()
    submissions = []
    for index in range(6):
        path = tmp_path / f"{index}.xlsx"
        path.write_bytes(right_book(1) if index == 0 else (tmp_path / "0.xlsx").read_bytes())
        submissions += collect(path)
    tight = grade_all(submissions, classroom.folder() / "issued", workers=2, memory=2**20)
    collected = list(tight)
    assert sorted(outcome.submission.key for outcome in collected) == [
        f"{i}.xlsx" for i in range(6)
    ]
    assert all(outcome.result is None and outcome.problem == DIED for outcome in collected)


def test_the_worker_refuses_network_and_programs():
    code = (
        "import socket, subprocess\n"
        "from reports.shared.workers import forbid_the_world\n"
        "forbid_the_world()\n"
        "for act in (lambda: socket.create_connection(('127.0.0.1', 9)),\n"
        "            lambda: subprocess.run(['true'])):\n"
        "    try:\n        act()\n"
        "    except PermissionError:\n        print('refused')\n"
    )
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, env=environment, check=True
    )
    assert done.stdout.split() == ["refused", "refused"]


def tree(folder: Path) -> dict[str, bytes]:
    """All files of a folder; the workbook's parts, whose zip holds no time of ours."""
    return {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }


def test_killed_in_the_middle_and_started_again(tmp_path, monkeypatch):
    folder = classroom.folder()
    classroom.register()
    submitted = tmp_path / "submitted"
    submitted.mkdir()
    for copy in range(2):
        for number in (1, 2, 3):
            path = submitted / f"{copy}-{classroom.book(number).file}"
            path.write_bytes(right_book(number) if copy == 0 else classroom.handout(number))
            os.utime(path, (1_700_000_000 + copy, 1_700_000_000 + copy))
    (submitted / "bad.xlsx").write_bytes(b"bad")
    os.utime(submitted / "bad.xlsx", (1_700_000_000, 1_700_000_000))
    out = tmp_path / "out"
    command = [
        sys.executable, "-m", "reports", "grade", str(folder / "issued"), str(submitted),
        "-o", str(out), "--secret", str(folder / "secret.key"), "--jobs", "1",
    ]  # fmt: skip
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    process = subprocess.Popen(command, env=environment, stderr=subprocess.PIPE, cwd=ROOT)
    results = out / "results"
    for _ in range(1200):
        if results.is_dir() and len(list(results.glob("*.json"))) >= 3:
            break
        assert process.poll() is None, process.communicate()
        time.sleep(0.05)
    process.send_signal(signal.SIGKILL)
    process.communicate()
    before = len(list(results.glob("*.json"))) - 1
    assert 0 < before < 7
    assert not (out / "summary.html").exists()

    done = subprocess.run(
        command, env=environment, capture_output=True, text=True, cwd=ROOT, check=False
    )
    assert done.returncode == 1, done.stderr  # bad.xlsx needs a person
    monkeypatch.setattr(grading, "grade_all", classroom.graded_here)
    whole = tmp_path / "whole"
    given = folder / "issued", submitted
    assert grade(*given, whole, secret_file=folder / "secret.key").reused == 0
    assert tree(out) == tree(whole)
    # A third run has nothing left to do and changes nothing.
    assert grade(*given, whole, secret_file=folder / "secret.key").reused == 7
    assert tree(out) == tree(whole)


@pytest.mark.parametrize(
    ("read", "limit_mb", "what"), [(load_register, 50, "реестр"), (listings, 2, "список группы")]
)
def test_the_limit_is_the_one_that_is_told(tmp_path, read, limit_mb, what):
    path = tmp_path / "register.json"
    with path.open("wb") as stream:
        stream.truncate(limit_mb * 10**6 + 1)
    with pytest.raises(InputError, match=f"файл больше {limit_mb} МБ; это не {what}"):
        read(path)


def test_a_worksheet_as_large_as_the_limit(tmp_path, monkeypatch):
    path, text = tmp_path / "grades.csv", worksheet(ENGLISH)
    path.write_bytes(text.encode())
    monkeypatch.setattr(moodle, "MAX_BYTES", path.stat().st_size)
    assert moodle.read_worksheet(path) == text
    path.write_bytes(text.encode() + b"\n")
    with pytest.raises(InputError, match="это не ведомость Moodle"):
        moodle.read_worksheet(path)
