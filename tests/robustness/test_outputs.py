"""Outputs that are no regular files: pipes, devices and open streams stay, links are followed."""

from __future__ import annotations

import json
import os
import stat
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from reports.shared.errors import OutputError
from reports.shared.files import atomic_dir, atomic_path, write_bytes
from tests.robustness.command import leftovers, small_input, started

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="places of Linux")
OLD, NEW = b"old", b"new"


def device(path: Path, minor: int) -> Path:
    """A device of the system's memory under a name of its own: 3 takes all, 7 is always full."""
    try:
        os.mknod(path, stat.S_IFCHR | 0o666, os.makedev(1, minor))
        path.open("wb").close()
    except OSError:
        pytest.skip("no right to make a device here")
    return path


def test_a_link_stays_and_its_target_is_replaced(tmp_path: Path) -> None:
    """A chain of links, over folders, to a file that is there or is still to be made."""
    (tmp_path / "far").mkdir()
    target = tmp_path / "far" / "target"
    link, chain = tmp_path / "link", tmp_path / "chain"
    link.symlink_to("far/target")
    chain.symlink_to(link)
    for number in range(2):
        for position in (link, chain):
            write_bytes(position, NEW + bytes([number]))
            assert target.read_bytes() == NEW + bytes([number])
    assert link.is_symlink()
    assert chain.is_symlink()
    assert leftovers(tmp_path) == leftovers(target.parent) == []


def test_a_target_keeps_its_rights(tmp_path: Path) -> None:
    target, link = tmp_path / "target", tmp_path / "link"
    target.write_bytes(OLD)
    target.chmod(0o640)
    link.symlink_to(target)
    write_bytes(link, NEW)
    assert target.stat().st_mode & 0o777 == 0o640


def test_a_ring_of_links_is_told(tmp_path: Path) -> None:
    first, second = tmp_path / "first", tmp_path / "second"
    first.symlink_to(second)
    second.symlink_to(first)
    with pytest.raises(OutputError, match="ссылки указывают друг на друга"):
        write_bytes(first, NEW)
    assert first.is_symlink()
    assert leftovers(tmp_path) == []


def test_a_link_to_a_folder_stays_one(tmp_path: Path) -> None:
    target, link = tmp_path / "target", tmp_path / "link"
    target.mkdir()
    (target / "a").write_bytes(OLD)
    link.symlink_to(target)
    with atomic_dir(link) as temporary:
        (temporary / "b").write_bytes(NEW)
    assert link.is_symlink()
    assert [path.name for path in target.iterdir()] == ["b"]
    with pytest.raises(OutputError, match="папка"):
        write_bytes(link, NEW)


@pytest.mark.parametrize("linked", [False, True])
def test_a_device_stays_one(tmp_path: Path, linked: bool) -> None:
    null = device(tmp_path / "null", 3)
    path = tmp_path / "link" if linked else null
    if linked:
        path.symlink_to(null)
    write_bytes(path, NEW)
    assert stat.S_ISCHR(null.stat().st_mode)
    assert leftovers(tmp_path) == []


def test_a_full_device_is_told(tmp_path: Path) -> None:
    full = device(tmp_path / "full", 7)
    with pytest.raises(OutputError, match="на диске нет места"):
        write_bytes(full, NEW)
    assert stat.S_ISCHR(full.stat().st_mode)


def test_a_pipe_gets_what_a_file_would_hold(tmp_path: Path) -> None:
    pipe = tmp_path / "pipe.json"
    os.mkfifo(pipe)
    process = started("solve", small_input(tmp_path), "--json", pipe)
    read = subprocess.run(["cat", pipe], capture_output=True, timeout=100, check=True).stdout
    assert process.wait() == 0
    assert json.loads(read)
    assert stat.S_ISFIFO(pipe.stat().st_mode)
    assert leftovers(tmp_path) == []


def test_a_pipe_gets_nothing_of_what_failed(tmp_path: Path) -> None:
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    with os.fdopen(os.open(pipe, os.O_RDWR | os.O_NONBLOCK), "rb", buffering=0) as reader:
        with pytest.raises(ValueError, match="half"), atomic_path(pipe) as temporary:
            temporary.write_bytes(NEW)
            raise ValueError("half")
        assert reader.read() is None


def test_a_socket_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    import socket

    monkeypatch.chdir(tmp_path)  # the name of a socket must be short
    with socket.socket(socket.AF_UNIX) as own:
        own.bind("s")
        with pytest.raises(OutputError, match="на другой стороне никого нет"):
            write_bytes(Path("s"), NEW)
    assert stat.S_ISSOCK((tmp_path / "s").stat().st_mode)


@pytest.mark.parametrize("folder", ["/dev/fd", "/proc/self/fd"])
def test_an_open_stream_is_written_where_it_stands(tmp_path: Path, folder: str) -> None:
    """A regular file behind it keeps what is there already, as after «>>»."""
    target, link = tmp_path / "target", tmp_path / "link"
    with target.open("wb") as stream:
        stream.write(OLD)
        stream.flush()
        path = Path(folder, str(stream.fileno()))
        link.symlink_to(path)
        write_bytes(path, NEW)
        write_bytes(link, NEW)
        assert os.fstat(stream.fileno()).st_ino == target.stat().st_ino
    assert target.read_bytes() == OLD + NEW + NEW
    assert link.is_symlink()


def test_an_open_stream_that_is_none_is_told() -> None:
    with pytest.raises(OutputError, match="такого потока нет"):
        write_bytes(Path("/dev/fd/999"), NEW)
    reading, writing = os.pipe()
    try:
        with pytest.raises(OutputError, match="только для чтения"):
            write_bytes(Path(f"/dev/fd/{reading}"), NEW)
    finally:
        os.close(reading)
        os.close(writing)


@pytest.mark.parametrize(
    "command",
    [
        lambda source, out: ("solve", source, "--json", out),
        lambda _, out: ("new", "-o", out),
    ],
)
@pytest.mark.parametrize("behind", ["pipe", "file"])
def test_the_output_by_its_name_takes_nothing_else(
    tmp_path: Path, command: Callable[..., tuple[object, ...]], behind: str
) -> None:
    """Its own words go beside it; a private name stands for /dev/stdout."""
    out = tmp_path / "stdout"
    out.symlink_to("/proc/self/fd/1")
    source = small_input(tmp_path)
    with (tmp_path / "said").open("wb") as stream:
        output = subprocess.PIPE if behind == "pipe" else stream.fileno()
        process = started(*command(source, out), output=output)
        text, said = process.communicate()
    if behind == "file":
        text = (tmp_path / "said").read_text(encoding="utf-8")
    assert process.returncode == 0
    assert said.splitlines()[0] == str(out)
    assert text
    assert str(out) not in text
    assert out.is_symlink()


def test_the_output_by_its_name_without_a_reader_ends_quietly(tmp_path: Path) -> None:
    out = tmp_path / "stdout"
    out.symlink_to("/proc/self/fd/1")
    reading, writing = os.pipe()
    os.close(reading)
    process = started("solve", small_input(tmp_path), "--json", out, output=writing)
    os.close(writing)
    assert process.communicate()[1] == ""
    assert process.returncode == 0
