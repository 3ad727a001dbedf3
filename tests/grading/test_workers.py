"""Processes that answer questions: each loss costs one answer, a start that fails is told."""

from __future__ import annotations

import os
import signal
import socket
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from reports.grading.batch import pool
from reports.grading.batch.pool import grade_all
from reports.grading.reading.submissions import collect
from reports.shared import workers as room
from reports.shared.errors import Died, InputError, NeverStarted
from reports.shared.workers import Workers


def calling() -> Callable[..., Any]:
    return lambda function, *values: function(*values)


def slow_start() -> Callable[..., Any]:
    time.sleep(1.0)
    return calling()


def no_start() -> Callable[..., Any]:
    os._exit(3)


def no_memory() -> None:
    raise MemoryError


def wrong() -> None:
    raise InputError("так нельзя")


def test_a_loss_costs_one_answer() -> None:
    with Workers(1, calling) as workers:
        first = workers.ask(os.getpid, seconds=30).result()
        with pytest.raises(TimeoutError):
            workers.ask(time.sleep, 60, seconds=0.2).result()
        second = workers.ask(os.getpid, seconds=30).result()
        for end in (no_memory, os.abort):
            with pytest.raises(Died):
                workers.ask(end, seconds=30).result()
        third = workers.ask(os.getpid, seconds=30).result()
        os.kill(third, signal.SIGKILL)  # while it has nothing to do
        time.sleep(0.2)
        fourth = workers.ask(os.getpid, seconds=30).result()
        with pytest.raises(InputError, match="так нельзя"):
            workers.ask(wrong, seconds=30).result()
        with pytest.raises(RuntimeError, match=r"ValueError: .*'x'"):
            workers.ask(int, "x", seconds=30).result()
        assert workers.ask(os.getpid, seconds=30).result() == fourth
    assert len({first, second, third, fourth}) == 4
    with pytest.raises(ProcessLookupError):
        os.kill(fourth, 0)


def test_a_process_reaches_neither_network_nor_programs() -> None:
    with Workers(1, calling) as workers:
        for forbidden in ((socket.create_connection, ("127.0.0.1", 9)), (os.system, "true")):
            with pytest.raises(RuntimeError, match="forbidden in this process"):
                workers.ask(*forbidden, seconds=30).result()


def test_seconds_of_an_answer_are_not_those_of_the_start() -> None:
    with Workers(1, slow_start) as workers:
        assert workers.ask(abs, -1, seconds=0.5).result() == 1


def test_after_so_many_answers_comes_another_process() -> None:
    with Workers(1, calling, most=2) as workers:
        seen = [workers.ask(os.getpid, seconds=30).result() for _ in range(5)]
    assert [seen.count(each) for each in dict.fromkeys(seen)] == [2, 2, 1]


def test_the_end_waits_for_nobody() -> None:
    started = time.monotonic()
    with Workers(2, calling) as workers:
        requested = [workers.ask(time.sleep, 60, seconds=60) for _ in range(5)]
        while not all(each.running() for each in requested[:2]):
            time.sleep(0.05)
    assert time.monotonic() - started < 20
    assert all(each.done() for each in requested)


def test_processes_that_never_start_are_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(room, "_START_S", 20.0)
    with Workers(1, no_start) as workers, pytest.raises(NeverStarted):
        workers.ask(abs, -1, seconds=1).result()
    (tmp_path / "a.xlsx").write_bytes(b"x")
    with pytest.raises(Exception, match="процессы проверки не запускаются"):  # no register there
        list(grade_all(collect(tmp_path), tmp_path, workers=1))


def test_a_part_takes_one_process_and_the_time_it_brings(monkeypatch: pytest.MonkeyPatch) -> None:
    """The cluster counts its workers by processors, and a person has set the seconds."""
    requested: list[dict[str, object]] = []
    monkeypatch.setattr(pool, "grade_all", lambda *_, **how: requested.append(how) or [])
    assert pool._grade_here(pool.ClusterPart("{}", [], 7.0)) == []
    assert requested == [{"workers": 1, "timeout_s": 7.0}]
