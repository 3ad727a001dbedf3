"""Full disks, limits and folders that cannot be written: one Russian line, old files whole."""

from __future__ import annotations

import errno
import os
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest
from click.testing import CliRunner

from reports.cli import main
from reports.shared.errors import OutputError
from reports.shared.files import make_dir
from tests.robustness.command import leftovers, refusal, small_input, started

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="limits of Linux")


@pytest.mark.parametrize(
    ("size", "command"),
    [
        (0, ("solve", "--json")),
        (2000, ("solve", "--json")),
        (30_000, ("build", "--only", "xlsx", "-o")),  # the temporary files of the writer
    ],
)
def test_a_limit_of_the_size_of_files(tmp_path, size, command):
    import resource

    out = tmp_path / "out"
    out.mkdir()
    (out / "engine.xlsx").write_bytes(b"old")
    target = out if command[0] == "build" else out / "engine.xlsx"
    process = started(
        command[0], small_input(tmp_path), *command[1:], target, temporary=tmp_path / "tmp",
        before=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size)),
    )  # fmt: skip
    assert "не удаётся записать: файл больше, чем разрешено" in refusal(process)
    assert (out / "engine.xlsx").read_bytes() == b"old"
    assert leftovers(out) == leftovers(tmp_path / "tmp") == []


@pytest.mark.parametrize("command", [("new",), ("solve", "INPUT"), ("check", "INPUT", "--json")])
def test_a_full_disk_behind_the_output(tmp_path, command):
    source = small_input(tmp_path)
    with Path("/dev/full").open("w") as full:
        arguments = [source if word == "INPUT" else word for word in command]
        assert "на диске нет места" in refusal(started(*arguments, output=full.fileno()))


def test_a_reader_that_goes_away(tmp_path):
    reading, writing = os.pipe()
    os.close(reading)
    process = started("solve", small_input(tmp_path), output=writing)
    os.close(writing)
    assert process.communicate()[1] == ""
    assert process.returncode == 0


@pytest.mark.parametrize("number", [errno.ENOSPC, errno.EDQUOT, errno.EROFS])
@pytest.mark.parametrize("place", ["open", "fsync", "replace"])
@pytest.mark.parametrize("command", [["--csv", "out"], ["--json", "out/table_1.csv"]])
def test_every_step_of_writing_may_fail(tmp_path, monkeypatch, number, place, command):
    monkeypatch.chdir(tmp_path)
    out = tmp_path / "out"
    out.mkdir()
    (out / "table_1.csv").write_bytes(b"old")
    source = small_input(tmp_path)

    def fail(*_: object, **__: object) -> None:
        raise OSError(number, "English")

    if place == "replace":
        monkeypatch.setattr(Path, "replace", fail)
    else:
        owner = {"open": os.open, "fsync": os.fsync}[place].__name__
        monkeypatch.setattr(f"reports.shared.files.os.{owner}", fail)
    done = CliRunner().invoke(main, ["solve", str(source), *command])
    assert done.exit_code == 2, done.output
    (line,) = done.stderr.splitlines()
    assert "не удаётся записать" in line
    assert "English" not in line
    assert (out / "table_1.csv").read_bytes() == b"old"
    assert leftovers(out) == []


def test_a_folder_that_nobody_can_write_to(tmp_path):
    process = started("solve", small_input(tmp_path), "--csv", "/proc/self/fd")
    assert "не удаётся записать" in refusal(process)


@pytest.mark.parametrize("full", [False, True])
def test_a_small_disk_and_a_disk_for_reading_only(tmp_path, full):
    disk = tmp_path / "disk"
    disk.mkdir()
    if subprocess.run(
        ["mount", "-t", "tmpfs", "-o", "size=8k", "tmpfs", str(disk)],
        capture_output=True, check=False,
    ).returncode:  # fmt: skip
        pytest.skip("no right to mount a disk")
    try:
        (disk / "engine.xlsx").write_bytes(b"old")
        if not full:
            subprocess.run(["mount", "-o", "remount,ro", str(disk)], check=True)
        process = started("solve", small_input(tmp_path), "--json", disk / "engine.xlsx")
        why = "на диске нет места" if full else "диск доступен только для чтения"
        assert why in refusal(process)
        assert (disk / "engine.xlsx").read_bytes() == b"old"
        assert leftovers(disk) == []
    finally:
        subprocess.run(["umount", str(disk)], check=True)


@pytest.mark.parametrize(("flag", "told"), [(0, "нет прав"), (os.ST_RDONLY, "только для чтения")])
def test_why_a_folder_takes_no_files(tmp_path, monkeypatch, flag, told):
    monkeypatch.setattr(os, "access", lambda *_: False)  # root may always
    monkeypatch.setattr(os, "statvfs", lambda _: SimpleNamespace(f_flag=flag))
    with pytest.raises(OutputError, match=told):
        make_dir(tmp_path)
