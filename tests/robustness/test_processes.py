"""Processes that commands start: they end with the command, and never say a word of their own."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from reports.shared import parallel_map
from reports.shared.background import can_split, processors
from reports.shared.errors import OutputError
from reports.shared.files import write_together
from tests.robustness.command import ROOT, leftovers

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="pipes and signals of Linux")

ASIDE = """
from reports.shared.background import aside
import time
def work():
    print("ready", flush=True)
    {work}
aside(work)
time.sleep(600)
"""
WORKERS = """
from reports.shared.workers import Workers
from tests.robustness.test_processes import {begin}
import time
with Workers(2, {begin}, memory=None) as pool:
    futures = [pool.ask(seconds=None) for _ in range(2)]
    [future.result() for future in futures]
"""
PARENTS = {
    "at work": ASIDE.format(work="time.sleep(600)"),
    "in a write into the pipe": ASIDE.format(work="return bytes(2**24)"),
    "workers that answer": WORKERS.format(begin="answering"),
    "workers that begin": WORKERS.format(begin="beginning"),
}


def answering() -> object:
    return lambda: [print("ready", flush=True), time.sleep(600)]


def beginning() -> object:
    print("ready", flush=True)
    time.sleep(600)
    return answering


def parent(code: str) -> subprocess.Popen[str]:
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    return subprocess.Popen(
        [sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
        env=environment, start_new_session=True,
    )  # fmt: skip


@pytest.mark.skipif(not can_split(), reason="one processor: nothing is done aside")
@pytest.mark.parametrize("case", PARENTS)
def test_a_child_ends_with_its_parent(case: str) -> None:
    process = parent(PARENTS[case])
    try:
        assert process.stdout is not None and process.stdout.readline() == "ready\n"
        process.kill()
        # The end of its output is the end of the last process that holds it.
        said, _ = process.communicate(timeout=60)
        assert "Traceback" not in said
    finally:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)


SWALLOWED = """
import signal, sys, time
sys.unraisablehook = lambda _: None
from reports.shared.interrupt import Stopped, stoppable
class Deaf:
    def __del__(self):
        signal.raise_signal(signal.SIGINT)
loading = compile("signal.raise_signal(signal.SIGINT)", "<frozen importlib._bootstrap>", "exec")
signal.signal(signal.SIGINT, signal.default_int_handler)
try:
    with stoppable():
        {swallow}
        for _ in range(3000):  # ends by itself where nothing stops it
            time.sleep(0.01)
except Stopped:
    print("stopped")
"""
CLEANING = """
import signal, time
from reports.shared.interrupt import Stopped, stoppable
signal.signal(signal.SIGINT, signal.default_int_handler)
try:
    with stoppable():
        try:
            signal.raise_signal(signal.SIGINT)
        finally:
            for _ in range(20):
                time.sleep(0.01)
                signal.raise_signal(signal.SIGINT)
            print("cleaned")
except Stopped:
    print("stopped")
"""
STOPS = {
    "swallowed by a callback": (SWALLOWED.format(swallow="it = Deaf(); del it"), "stopped\n"),
    "while a module is loaded": (SWALLOWED.format(swallow="exec(loading)"), "stopped\n"),
    "while it cleans up": (CLEANING, "cleaned\nstopped\n"),
}


@pytest.mark.parametrize("case", STOPS)
def test_a_signal_is_obeyed_though_it_was_swallowed(case: str) -> None:
    code, said = STOPS[case]
    assert parent(code).communicate(timeout=60)[0] == said


def test_ctrl_c_for_all_is_heard_by_the_command_alone() -> None:
    """Of a terminal's signal the processes that only load know nothing."""
    code = (
        "from reports.shared.interrupt import Stopped, stoppable\n"
        "import signal\n"
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "try:\n"
        "    with stoppable():\n"
        + "\n".join(f"        {line}" for line in WORKERS.format(begin="answering").splitlines())
        + "\nexcept Stopped:\n    print('stopped')\n"
    )
    process = parent(code)
    assert process.stdout is not None and process.stdout.readline() == "ready\n"
    os.killpg(process.pid, signal.SIGINT)
    assert process.communicate(timeout=60)[0].replace("ready\n", "") == "stopped\n"


def test_no_more_processes_than_processors(monkeypatch: pytest.MonkeyPatch) -> None:
    counts = []

    class Counted(parallel_map.Workers):
        def __init__(self, count: int, *given: object, **more: object) -> None:
            counts.append(count)
            super().__init__(count, *given, **more)  # type: ignore[arg-type]

    monkeypatch.setattr(parallel_map, "Workers", Counted)
    assert [*parallel_map.in_order(abs, [-1, 2], jobs=5000)] == [1, 2]
    assert counts == [processors()]


KILLED = """
import sys
from pathlib import Path
from reports.shared.files import atomic_dir, atomic_path
with {how}(Path(sys.argv[1], "target")):
    print("ready", flush=True)
    sys.stdin.read()
"""


@pytest.mark.parametrize("how", ["atomic_path", "atomic_dir"])
def test_what_a_killed_command_has_left_goes_at_the_next_run(how: str, tmp_path: Path) -> None:
    def begun() -> subprocess.Popen[str]:
        process = subprocess.Popen(
            [sys.executable, "-c", KILLED.format(how=how), str(tmp_path)], text=True,
            stdin=subprocess.PIPE, stdout=subprocess.PIPE,
            env={**os.environ, "PYTHONPATH": str(ROOT)},
        )  # fmt: skip
        assert process.stdout is not None and process.stdout.readline() == "ready\n"
        return process

    killed, alive = begun(), begun()
    assert len(leftovers(tmp_path)) == 2
    killed.kill()
    killed.communicate()
    later = begun()  # removes what the first has left, and nothing of the second
    assert len(leftovers(tmp_path)) == 2
    for process in (alive, later):
        process.communicate("")
        assert process.returncode == 0
    assert leftovers(tmp_path) == []


def test_folders_killed_while_they_changed_places_stay(tmp_path: Path) -> None:
    for name in (".kshm-1", ".kshm-1.old", ".kshm-2.old", ".kshm-3"):
        (tmp_path / name).mkdir()
    write_together({tmp_path / "a": b"1"})
    assert leftovers(tmp_path) == [".kshm-1", ".kshm-1.old"]


@pytest.mark.parametrize("is_new", [True, False])
def test_files_that_belong_together_are_written_or_none(is_new: bool, tmp_path: Path) -> None:
    folder = tmp_path / "deep" / "out"
    if not is_new:
        write_together({folder / "a": b"old", folder / "b": b"old"})
    with pytest.raises(OutputError):
        write_together({folder / "a": b"new", folder / "b": b"new", tmp_path / "deep": b"new"})
    if is_new:
        assert [*tmp_path.iterdir()] == []
    else:
        assert {path.read_bytes() for path in folder.iterdir()} == {b"old"}
