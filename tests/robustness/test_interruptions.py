"""Stopped at any moment: old files stay whole, nothing half-written has a final name."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
import zipfile
from collections.abc import Callable
from pathlib import Path
from types import FrameType

import click
import pytest

from reports.cli import main
from reports.shared import files, interrupt
from reports.shared.background import can_split
from tests.cover import ALL
from tests.robustness.command import leftovers, small_input, started

OLD, NEW = b"old" * 1000, b"new" * 2000


class Stop:
    """Raises ``KeyboardInterrupt`` at the n-th line of some modules."""

    def __init__(self, number: int) -> None:
        self.left, self.places = number, (files.__file__, interrupt.__file__)

    def __call__(self, frame: FrameType, event: str, _: object) -> Stop | None:
        if frame.f_code.co_filename not in self.places:
            return None
        if event == "line":
            self.left -= 1
            if self.left == 0:
                raise KeyboardInterrupt
        return self


def interrupted_everywhere(act: Callable[[], None], check: Callable[[bool], None]) -> int:
    """Interrupt an action at each of its lines in turn, until it ends; tell how many."""
    for number in range(1, 1000):
        stop = Stop(number)
        before = sys.gettrace()
        sys.settrace(stop)
        try:
            act()
            done = True
        except KeyboardInterrupt:
            done = False
        finally:
            sys.settrace(before)
        files._remove_unfinished()  # as at the end of the program
        check(done)
        if done and stop.left > 0:
            return number
    raise AssertionError("it never ends")


def test_a_file_is_the_old_or_the_new_one_wherever_it_is_interrupted(tmp_path):
    target = tmp_path / "a.bin"
    target.write_bytes(OLD)

    def check(done: bool) -> None:
        assert target.read_bytes() in ((NEW,) if done else (OLD, NEW))
        assert leftovers(tmp_path) == []
        target.write_bytes(OLD)

    lines = interrupted_everywhere(lambda: files.write_bytes(target, NEW), check)
    assert lines > 20


def test_a_folder_is_the_old_or_the_new_one_wherever_it_is_interrupted(tmp_path):
    target = tmp_path / "folder"
    files.make_dir(target)
    (target / "a").write_bytes(OLD)

    def act() -> None:
        with files.atomic_dir(target) as temporary:
            (temporary / "a").write_bytes(NEW)

    def check(done: bool) -> None:
        assert (target / "a").read_bytes() in ((NEW,) if done else (OLD, NEW))
        assert leftovers(tmp_path) == []
        (target / "a").write_bytes(OLD)

    # In the program the signals are held back while the folders change places.
    swap = files._swap_dir
    lines = []
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(files, "_swap_dir", untraced(swap))
        lines.append(interrupted_everywhere(act, check))
    assert lines[0] > 20


def untraced(act: Callable[..., None]) -> Callable[..., None]:
    def quiet(*arguments: object) -> None:
        before = sys.gettrace()
        sys.settrace(None)
        try:
            act(*arguments)
        finally:
            sys.settrace(before)

    return quiet


def test_signals_wait_while_folders_change_places():
    seen = []
    before = signal.signal(signal.SIGTERM, lambda *_: seen.append("late"))
    try:
        with interrupt.held(signal.SIGINT, signal.SIGTERM):
            signal.raise_signal(signal.SIGTERM)
            assert seen == []
        assert seen == ["late"]
    finally:
        signal.signal(signal.SIGTERM, before)


@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
def test_a_signal_lost_in_a_callback_stops_the_next_file(tmp_path):
    class Deaf:
        def __del__(self) -> None:
            signal.raise_signal(signal.SIGTERM)  # nothing raised here gets out

    with pytest.raises(KeyboardInterrupt), interrupt.stoppable():
        item = Deaf()
        del item
        files.write_bytes(tmp_path / "a", NEW)
    assert list(tmp_path.iterdir()) == []


def test_a_signal_while_an_extension_is_loaded_stops_the_next_file(tmp_path):
    code = compile("signal.raise_signal(signal.SIGTERM)", "<frozen importlib._bootstrap>", "exec")
    loaded = False
    with pytest.raises(KeyboardInterrupt), interrupt.stoppable():
        exec(code, {"signal": signal})
        loaded = True
        files.write_bytes(tmp_path / "a", NEW)
    assert loaded and list(tmp_path.iterdir()) == []


def test_a_stopped_process_is_not_taken_apart():
    """Libraries that were stopped while they were being loaded may die of it."""
    code = """
import os, signal, sys, types

class Half:
    def __del__(self, write=os.write):
        write(2, b"taken apart")

sys.modules["half"] = types.ModuleType("half")
sys.modules["half"].it = Half()
from reports import __main__, cli
stop = sys.argv.pop() == "stop"
cli.main.commands["doctor"].callback = lambda **_: stop and signal.raise_signal(signal.SIGTERM)
sys.argv = ["kshm", "doctor"]
__main__.start()
"""
    lines = []
    for how in ("stop", "go"):
        done = subprocess.run([sys.executable, "-c", code, how], capture_output=True, check=False)
        lines.append((done.returncode, done.stderr.decode()))
    assert lines == [(2, "прервано\n"), (0, "taken apart")]


INT, TERM, KILL = signal.SIGINT, signal.SIGTERM, signal.SIGKILL
SOLVE, BUILD = ("solve", "--csv"), ("build", "--only", "xlsx", "-o")
SHARES = (0.4, 0.7, 0.9)  # of the time that a command takes
MOMENTS = (
    [(number, share) for number in (INT, TERM, KILL) for share in SHARES]
    if ALL
    else [*zip((INT, TERM, KILL), SHARES, strict=True), (TERM, SHARES[-1])]
)


@pytest.mark.parametrize(
    ("number", "command", "share"),
    [
        *((number, SOLVE, share) for number, share in MOMENTS),
        (INT, BUILD, 0.3),
        (TERM, BUILD, 0.6),
    ],
)
def test_a_command_that_is_stopped(tmp_path, number, command, share, whole_times):
    source, out = small_input(tmp_path), tmp_path / "out"
    out.mkdir()
    target = out / ("engine.xlsx" if command is BUILD else "table_1.csv")
    target.write_bytes(OLD)
    process = started(
        command[0], source, *command[1:], out, temporary=tmp_path / "tmp",
        before=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )  # fmt: skip
    time.sleep(whole_times[command[0]] * share)
    process.send_signal(number)
    _, error = process.communicate()
    if target.read_bytes() != OLD:
        assert_whole(target)
    if number == signal.SIGKILL:
        return
    # Either it was still loading, or it says so, or it had just finished.
    assert process.returncode in (-number, 2, 0, 1), error
    notes = ("Принято:", "Внимание:", "Шаг таблиц")
    said = [line for line in error.splitlines() if not line.startswith(notes)]
    assert said == (["прервано"] if process.returncode == 2 else []), error
    assert leftovers(out) == leftovers(tmp_path / "tmp") == []


def assert_whole(target: Path) -> None:
    if target.suffix == ".xlsx":
        with zipfile.ZipFile(target) as archive:
            assert archive.testzip() is None
    else:
        lines = target.read_text(encoding="utf-8").splitlines()
        assert len({line.count(",") for line in lines}) == 1


@pytest.fixture(scope="module")
def whole_times(tmp_path_factory):
    """Seconds that the commands take now."""
    folder = tmp_path_factory.mktemp("whole")
    source = small_input(folder)
    times = {}
    for name, *keys in (SOLVE, BUILD):
        begin = time.monotonic()
        assert started(name, source, *keys, folder / "out").wait() in (0, 1)
        times[name] = time.monotonic() - begin
    return times


@pytest.mark.skipif(not can_split(), reason="one processor: nothing is done aside")
def test_a_command_that_gives_up_is_silent_about_its_second_process(tmp_path):
    """The end of the first process ends the second one in the middle of its work."""
    code = (
        "import time\n"
        "from reports.shared.background import aside\n"
        "from reports.shared.interrupt import stoppable\n"
        "with stoppable():\n"
        "    aside(lambda: time.sleep(60))\n"
        "    time.sleep(0.5)\n"
    )
    command = [sys.executable, "-c", code]
    done = subprocess.run(command, capture_output=True, text=True, timeout=30, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


def test_a_stop_that_a_library_turns_into_its_own_error_is_told_as_one(capsys, monkeypatch):
    def building() -> None:
        try:
            signal.raise_signal(signal.SIGINT)
        except interrupt.Stopped:
            raise ValueError("SchemaError: Stopped") from None

    monkeypatch.setitem(main.commands, "building", click.Command("building", callback=building))
    # In the background the signal is ignored, and stays so.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        with pytest.raises(SystemExit) as ended:
            main(["building"])
    finally:
        signal.signal(signal.SIGINT, before)
    assert ended.value.code == 2
    assert capsys.readouterr().err.splitlines() == ["прервано"]
