"""Atomic writing: the old file or the new one, and nothing else in the folder."""

import errno
import os
import pathlib
import stat

import pytest

from reports.shared import files
from reports.shared.errors import OutputError


def names(folder):
    return sorted(path.name for path in folder.iterdir())


def refusing(number):
    def act(*args, **kwargs):
        raise OSError(number, "English")

    return act


def test_text_is_written_as_it_is(tmp_path):
    target = tmp_path / "new" / "deep" / "a.csv"
    files.write_text(target, "φ\nψ\r\n")
    assert target.read_bytes() == "φ\nψ\r\n".encode()
    assert names(target.parent) == ["a.csv"]


def test_an_old_file_is_replaced_and_keeps_its_mode(tmp_path):
    target = tmp_path / "a.bin"
    target.write_bytes(b"old")
    target.chmod(0o640)
    files.write_bytes(target, b"new")
    assert target.read_bytes() == b"new"
    assert stat.S_IMODE(target.stat().st_mode) == 0o640


def test_a_new_file_follows_the_umask(tmp_path):
    old = os.umask(0o022)
    try:
        files.write_bytes(tmp_path / "a", b"")
    finally:
        os.umask(old)
    assert stat.S_IMODE((tmp_path / "a").stat().st_mode) == 0o644


def test_a_failing_block_leaves_the_old_file(tmp_path):
    target = tmp_path / "a.xlsx"
    target.write_bytes(b"old")

    def interrupted():
        with files.atomic_path(target) as temporary:
            assert temporary.suffix == ".xlsx"
            temporary.write_bytes(b"half")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        interrupted()
    assert target.read_bytes() == b"old"
    assert names(tmp_path) == ["a.xlsx"]


@pytest.mark.parametrize(
    ("number", "reason"),
    [
        (errno.EACCES, "нет прав"),
        (errno.ENOSPC, "на диске нет места"),
        (errno.EROFS, "диск доступен только для чтения"),
        (errno.EIO, "ошибка ввода-вывода"),
    ],
)
def test_a_refusal_is_one_russian_line(tmp_path, monkeypatch, number, reason):
    target = tmp_path / "a.bin"
    target.write_bytes(b"old")
    monkeypatch.setattr(pathlib.Path, "replace", refusing(number))
    with pytest.raises(OutputError) as caught:
        files.write_bytes(target, b"new")
    assert caught.value.exit_code == 2
    assert caught.value.lines() == [
        f"{target}: не удаётся записать: {reason}; укажите другое место"
    ]
    assert target.read_bytes() == b"old"
    assert names(tmp_path) == ["a.bin"]


def test_the_folder_is_a_file(tmp_path):
    (tmp_path / "f").write_text("x")
    with pytest.raises(OutputError, match="не удаётся записать"):
        files.write_text(tmp_path / "f" / "a", "")
    with pytest.raises(OutputError, match="не удаётся записать: на этом месте уже есть файл"):
        files.make_dir(tmp_path / "f")


def test_the_target_is_a_folder(tmp_path):
    (tmp_path / "a").mkdir()
    with pytest.raises(OutputError, match="на этом месте уже есть папка"):
        files.write_text(tmp_path / "a", "")


def test_a_folder_without_rights(tmp_path, monkeypatch):
    monkeypatch.setattr(os, "access", lambda *args: False)
    with pytest.raises(OutputError, match="нет прав"):
        files.write_text(tmp_path / "a", "")
    assert names(tmp_path) == []


def test_a_folder_replaces_a_folder(tmp_path):
    target = tmp_path / "csv"
    target.mkdir()
    (target / "old").write_text("x")
    with files.atomic_dir(target) as temporary:
        (temporary / "new").write_text("y")
    assert names(target) == ["new"]
    assert names(tmp_path) == ["csv"]


def test_a_failing_block_leaves_the_old_folder(tmp_path):
    target = tmp_path / "csv"
    target.mkdir()
    (target / "old").write_text("x")

    def failing():
        with files.atomic_dir(target) as temporary:
            (temporary / "new").write_text("y")
            raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        failing()
    assert names(target) == ["old"]
    assert names(tmp_path) == ["csv"]


def test_a_failing_swap_puts_the_old_folder_back(tmp_path, monkeypatch):
    target = tmp_path / "csv"
    target.mkdir()
    (target / "old").write_text("x")
    rename = pathlib.Path.rename
    calls = []

    def second_fails(self, other):
        calls.append(other)
        if len(calls) == 2:
            raise OSError(errno.EACCES, "English")
        return rename(self, other)

    monkeypatch.setattr(pathlib.Path, "rename", second_fails)
    with pytest.raises(OutputError, match="нет прав"), files.atomic_dir(target) as temporary:
        (temporary / "new").write_text("y")
    assert names(target) == ["old"]
    assert names(tmp_path) == ["csv"]
