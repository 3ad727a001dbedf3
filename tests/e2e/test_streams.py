"""Output elsewhere than to a terminal: other code pages, readers that leave, no stream."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.cover import sparse
from tests.robustness.command import ROOT, small_input

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="closed streams as in POSIX")
MAIN = (sys.executable, "-m", "reports")


def run(
    arguments: list[object], encoding: str = "cp1251", **more: object
) -> subprocess.CompletedProcess[bytes]:
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "PYTHONIOENCODING": encoding}
    streams: dict[str, object] = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE} | more
    return subprocess.run(
        [*MAIN, *map(str, arguments)], cwd=ROOT, env=environment, check=False, timeout=300,
        **streams,  # type: ignore[call-overload]
    )  # fmt: skip


def with_engine(words: str, folder: Path) -> list[object]:
    engine = small_input(folder)
    places = {"ENGINE": str(engine), "OUT": str(folder / "out")}
    return [re.sub("ENGINE|OUT", lambda match: places[match[0]], word) for word in words.split()]


COMMANDS = [
    ("solve ENGINE", "λ"),
    ("solve ENGINE --json -", "λ"),
    ("check ENGINE", "ошибок нет"),
    ("check ENGINE --json", "ok"),
    ("new", "мин⁻¹"),
    ("new --cylinders 4 --speed 5000", "мин⁻¹"),
    ("--help", "Команды"),
    ("new --help", "мин⁻¹"),
    ("build ENGINE --only html -o OUT", "out"),
    ("sweep ENGINE --vary geometry.bore_mm=84:92:3 -o OUT.csv", "сочетаний 3"),
    ("compare ENGINE samples/d-240.toml -o OUT.html", "двигателей 2"),
    ("doctor", "pango"),
]


@pytest.mark.parametrize(
    ("words", "told", "encoding"),
    [
        *((*COMMANDS[0], encoding) for encoding in ("cp866", "ascii", "utf-8")),
        *((*command, "cp1251") for command in COMMANDS[:5]),
    ],
)
def test_what_is_redirected_is_whole_in_utf_8(
    tmp_path: Path, words: str, told: str, encoding: str
) -> None:
    done = run(with_engine(words, tmp_path), encoding)
    odd = words.startswith("check")  # a check fails on a coarse grid
    assert done.returncode == odd, done.stderr.decode()
    assert told in done.stdout.decode("utf-8")
    assert "�" not in done.stdout.decode("utf-8")
    if "json" in words:
        json.loads(done.stdout)


@pytest.mark.parametrize(("words", "told"), sparse(COMMANDS[5:]))
def test_every_command_on_a_russian_windows(tmp_path: Path, words: str, told: str) -> None:
    done = run(with_engine(words, tmp_path))
    assert done.returncode in (0, 1, 3), done.stderr.decode()  # 3: no pango here
    assert told in done.stdout.decode("utf-8")


def test_an_error_is_told_in_utf_8(tmp_path: Path) -> None:
    done = run(["check", tmp_path / "нет λ.toml"])
    assert done.returncode == 2
    assert "нет λ.toml: файл не найден" in done.stderr.decode("utf-8")


def test_a_name_that_is_no_text_is_told_with_marks(tmp_path: Path) -> None:
    path = os.fsencode(tmp_path) + b"/\xff.toml"
    done = run(["new", "-o", os.fsdecode(path)])
    assert done.returncode == 0, done.stderr.decode()
    assert Path(os.fsdecode(path)).is_file()
    assert done.stdout.decode().endswith("/?.toml\n")


def test_a_terminal_keeps_its_encoding(tmp_path: Path) -> None:
    """What the terminal's code page does not have is shown as a question mark."""
    import pty

    shown, side = pty.openpty()
    done = run(with_engine("solve ENGINE", tmp_path), stdout=side)
    os.close(side)
    text = b""
    while True:
        try:
            text += (part := os.read(shown, 65536))
        except OSError:  # Linux: the other side is closed
            break
        if not part:
            break
    os.close(shown)
    assert done.returncode == 0, done.stderr.decode()
    assert "радиус кривошипа: r = 0,0470 м" in text.decode("cp1251")
    assert ": ? = " in text.decode("cp1251")  # λ


def closing(*numbers: int) -> Callable[[], None]:
    return lambda: [os.close(number) for number in numbers] and None


@pytest.mark.parametrize(
    ("words", "code", "numbers"),
    [
        *(
            ("solve ENGINE", 0, numbers)
            for numbers in sparse(((1,), (2,), (0, 1, 2), (1, 2), (0, 1)))
        ),
        ("solve ENGINE --json -", 0, (0, 1, 2)),
        ("new", 0, (0, 1)),
        ("--help", 0, (1, 2)),
        ("check none.toml", 2, (0, 1, 2)),
        ("build ENGINE --only html -o OUT", 1, (1, 2)),  # the book of a coarse grid is told
    ],
)
def test_a_closed_stream_ends_quietly(
    tmp_path: Path, words: str, code: int, numbers: tuple[int, ...]
) -> None:
    done = run(with_engine(words, tmp_path), preexec_fn=closing(*numbers))
    assert done.returncode == code, done.stderr.decode()
    assert "ошибка" not in done.stderr.decode()
    assert "Traceback" not in done.stderr.decode()
    if "OUT" in words:  # a file opened in the place of the closed stream would take the words
        (page,) = (tmp_path / "out").glob("*.html")
        assert page.read_text(encoding="utf-8").startswith("<!DOCTYPE html>")


@pytest.mark.parametrize(
    ("words", "code"),
    [
        ("solve ENGINE", 0),
        ("solve ENGINE --json -", 0),
        ("new", 0),
        ("--help", 0),
        ("new --help", 0),
        ("--version", 0),
        ("check ENGINE --json", 0),
        ("check none.toml", 2),
    ],
)
def test_a_reader_that_has_left_ends_it_quietly(tmp_path: Path, words: str, code: int) -> None:
    reading, writing = os.pipe()
    os.close(reading)
    done = run(with_engine(words, tmp_path), stdout=writing)
    os.close(writing)
    assert done.returncode == code, done.stderr.decode()
    assert len(done.stderr.splitlines()) == (code == 2)


def test_a_reader_of_errors_that_has_left_does_not_change_the_code(tmp_path: Path) -> None:
    reading, writing = os.pipe()
    os.close(reading)
    assert run(["check", tmp_path / "none.toml"], stderr=writing).returncode == 2
    os.close(writing)


def test_the_script_of_windows_runs_python_in_utf_8() -> None:
    lines = (ROOT / "run.cmd").read_text(encoding="utf-8").splitlines()
    assert 'set "PYTHONUTF8=1"' in lines
    assert lines.index('set "PYTHONUTF8=1"') < lines.index(":install")
