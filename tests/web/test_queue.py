"""The queue is fair, full only for who fills it, and survives what dies around it."""

from __future__ import annotations

import asyncio
import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any
from unittest.mock import AsyncMock

import httpx2
import psutil
import pytest
from starlette.testclient import TestClient

from reports.shared.errors import InputError
from reports.web import jobs as room
from reports.web.app import Settings, create_app
from reports.web.jobs import _KSHM, MAX_OWN, Jobs, run
from tests.web.conftest import MARK, Page, finished, serving
from tests.web.test_files import made


def waiting(folder: Path) -> Jobs:
    built = Jobs(folder, b"secret", None)
    folder.mkdir(exist_ok=True)
    return built


def added(jobs: Jobs, *visitors: str) -> list[str]:
    return [jobs.add({"a": str(i)}, ["solve"], who) for i, who in enumerate(visitors)]


def test_everybodys_first_comes_before_anybodys_second(tmp_path: Path) -> None:
    jobs = waiting(tmp_path)
    one, two, three, other, last = added(jobs, "a", "a", "a", "b", "c")
    assert jobs.line() == [one, other, last, two, three]
    about: Any = jobs.about(other)
    assert about == {"state": "waiting", "place": 1, "wait": 10}


def test_nobody_fills_the_queue_alone(tmp_path: Path) -> None:
    jobs = waiting(tmp_path)
    added(jobs, *["a"] * MAX_OWN)
    with pytest.raises(InputError, match="дождитесь"):
        jobs.add({"a": "more"}, ["solve"], "a")
    jobs.add({"a": "more"}, ["solve"], "b")
    assert jobs.add({"a": "0"}, ["solve"], "b") in jobs.waiting  # the same content: the same job
    assert len(jobs.waiting) == MAX_OWN + 1


def test_a_command_ends_with_the_server_and_takes_along_what_it_has_started() -> None:
    """However the server ends: its end of the pipe is closed by the system."""
    child = "import subprocess as s, sys, time; print(s.Popen([sys.executable, '-c', "
    child += "'import time; time.sleep(60)']).pid, flush=True); time.sleep(60)"
    command = _KSHM.replace("from reports.shared", f"{child}\nfrom reports.shared", 1)
    process = subprocess.Popen(
        [sys.executable, "-c", command], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
        start_new_session=True,
    )  # fmt: skip
    assert process.stdout is not None and process.stdin is not None
    grandchild = psutil.Process(int(process.stdout.readline()))
    process.stdin.close()
    assert process.wait(10) != 0
    until(lambda: not grandchild.is_running() or grandchild.status() == psutil.STATUS_ZOMBIE, 5)


def test_names_hang_on_the_servers_secret(tmp_path: Path) -> None:
    one, other = waiting(tmp_path / "a"), Jobs(tmp_path / "b", b"other", None)
    other.folder.mkdir()
    assert added(one, "a") != added(other, "a")


def until(true: Callable[[], Any], seconds: float = 60.0) -> Any:
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        actual = true()
        if actual:
            return actual
        time.sleep(0.05)
    raise AssertionError


def test_a_killed_solver_and_a_killed_job_cost_one_answer(tmp_path: Path) -> None:
    app = create_app(Settings(tmp_path, per_s=1e6, workers=1))
    with TestClient(app, base_url="http://localhost") as client:
        page = Page(client)
        raw = page.sample()
        state = app.app.state  # type: ignore[attr-defined]
        for process in psutil.Process().children(recursive=True):
            if process.ppid() != os.getpid():  # its parent is the process of which it is a copy
                process.kill()
        time.sleep(0.2)
        assert page.post("/api/settle", {"raw": raw})["remarks"]

        with pytest.raises(TimeoutError):
            state.answers.workers.ask(time.sleep, 60, seconds=0.5).result()
        assert page.post("/api/settle", {"raw": raw})["remarks"]

        job = page.post("/api/files", {"raw": raw, "kind": "xlsx"})["id"]
        until(lambda: state.jobs.running)
        until(lambda: _children(job) or None)
        for process in _children(job):
            os.kill(process, signal.SIGKILL)
        done = until(lambda: (page.get(f"/api/files/{job}")["state"] == "failed") or None)
        assert done
        assert "прерван" in page.get(f"/api/files/{job}")["lines"][0]
        # Ordered again it is made again.
        assert made(page, raw=raw, kind="xlsx")[1]["state"] == "done"


def _children(job: str) -> list[int]:
    """Processes that work in the folder of a job."""
    collected = []
    for path in Path("/proc").glob("[0-9]*"):
        try:
            if path.joinpath("cwd").readlink().name == job:
                collected.append(int(path.name))
        except OSError:
            continue
    return collected


def test_a_killed_server_makes_its_job_again(tmp_path: Path) -> None:
    with (
        serving(tmp_path) as served,
        httpx2.Client(headers=MARK, trust_env=False, timeout=60) as web,
    ):
        raw = web.post(f"{served.page}api/new", json={"sample": "gots-diesel"}).json()["raw"]
        order = {"raw": raw, "kind": "xlsx"}
        job = web.post(f"{served.page}api/files", json=order).json()["id"]
        about = f"api/files/{job}"
        until(lambda: web.get(served.page + about).json()["state"] == "running")
        until(lambda: _children(job))
        served.process.kill()
        served.process.wait()
        until(lambda: not _children(job), seconds=3)  # what it made ends with it
    folder = tmp_path / "jobs" / job
    assert (folder / "order.json").exists() and not (folder / "done.json").exists()
    with serving(tmp_path) as served, httpx2.Client(trust_env=False, timeout=60) as web:
        until(lambda: web.get(served.page + about).json()["state"] == "done")
        assert web.get(served.page + about).json()["files"][0]["file"] == "engine.xlsx"


def test_a_job_that_takes_too_long_is_ended(tmp_path: Path) -> None:
    said = finished(run(["solve", "x.toml"], tmp_path, timeout_s=0.05))
    assert said["state"] == "failed" and "не сделано" in said["lines"][0]


def test_a_bug_in_a_job_stops_no_other(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    async def broken(*_: Any) -> Any:
        raise ZeroDivisionError

    monkeypatch.setattr(room, "run", broken)
    jobs = waiting(tmp_path)
    names = added(jobs, "a", "b")

    async def work() -> list[Any]:
        async with jobs.working():
            for _ in range(200):
                if not (jobs.waiting or jobs.running):
                    break
                await asyncio.sleep(0.01)
        return [jobs.about(name) for name in names]

    lines = {"state": "failed", "lines": ["внутренняя ошибка: повторите"]}
    assert finished(work()) == [lines, lines]

    def full(*_: Any) -> None:
        raise OSError(28, "No space left on device")

    names = added(jobs, "c")
    monkeypatch.setattr(room, "write_json", full)  # its end finds no room: it is told all the same
    ((done),) = finished(work())
    assert done["state"] == "failed" and "не удаётся записать" in done["lines"][0]


def test_the_oldest_files_are_forgotten(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(room, "MAX_BYTES", 2500)
    jobs = waiting(tmp_path)
    for index in range(4):
        folder = tmp_path / f"{index}"
        folder.mkdir()
        (folder / "file").write_bytes(b"x" * 1000)
        (folder / "done.json").write_text(json.dumps({"state": "done"}), encoding="utf-8")
        os.utime(folder / "done.json", (time.time() - index, time.time() - index))
    jobs.clean()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["0", "1"]


@pytest.mark.parametrize(
    ("code", "state", "line"),
    [(0, "done", "сказано"), (1, "done", "сказано"), (2, "failed", "сказано"),
     (-9, "failed", "процесс прерван: повторите")],
)  # fmt: skip
def test_how_a_command_ended_is_seen_from_its_code(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, code: int, state: str, line: str
) -> None:
    async def started(*_: object, **__: object) -> Any:
        process = AsyncMock(pid=0, returncode=code)
        process.stderr.read.return_value = "сказано\n".encode()
        return process

    monkeypatch.setattr(os, "killpg", lambda *_: None)
    monkeypatch.setattr(asyncio, "create_subprocess_exec", started)
    assert finished(run((), tmp_path, 9.0)) == {"state": state, "lines": [line]}
