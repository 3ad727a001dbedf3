"""Workers that grade in parallel; one that hangs or dies costs one file, never the batch."""

from __future__ import annotations

import multiprocessing
import os
import signal
import time
from collections import deque
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from multiprocessing.connection import wait
from pathlib import Path
from typing import Any

from reports.grading.batch.worker import MEMORY, serve
from reports.grading.reading.submissions import Submission
from reports.shared.errors import KshmError
from reports.shared.interrupt import held

TIMEOUT_S = 60.0
_START_S = 120.0  # a cold start of a worker on a loaded machine
FILES_PER_WORKER = 500  # then a new process: whatever a library leaks is given back

SLOW = "проверка заняла слишком много времени"
DIED = "проверка прервана: файл исчерпал память или повредил программу чтения"


@dataclass(frozen=True, slots=True)
class Outcome:
    """What a worker said about a submission; ``result`` is None where it could not."""

    submission: Submission
    result: dict[str, Any] | None
    page: str
    problem: str = ""


class _Worker:
    def __init__(self, folder: Path, memory: int) -> None:
        context = multiprocessing.get_context("spawn")
        self.connection, theirs = context.Pipe()
        self.process = context.Process(target=serve, args=(theirs, folder, memory), daemon=True)
        with held(signal.SIGINT):  # Ctrl-C is for the process that the person has started
            self.process.start()
        theirs.close()
        self.ready = self.started = False
        self.task: Submission | None = None
        self.since = time.monotonic()
        self.done = 0

    def give(self, submission: Submission) -> None:
        self.task, self.since = submission, time.monotonic()
        self.connection.send(submission)

    def stop(self) -> None:
        self.connection.close()
        self.process.kill()
        self.process.join()


def grade_all(
    submissions: Sequence[Submission],
    register_folder: Path,
    *,
    workers: int,
    timeout_s: float = TIMEOUT_S,
    memory: int = MEMORY,
) -> Iterator[Outcome]:
    """Outcomes as they come, in no fixed order."""
    waiting = deque(submissions)
    if not waiting:
        return
    # One thread each: the processes are the parallelism.
    for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "RAYON_NUM_THREADS"):
        os.environ.setdefault(name, "1")
    pool = [_Worker(register_folder, memory) for _ in range(min(workers, len(waiting)))]
    failures = 0
    try:
        while pool:
            heard = wait([worker.connection for worker in pool], timeout=0.5)
            for worker in [item for item in pool if item.connection in heard]:
                outcome = _listen(worker)
                if worker.ready and worker.task is None:
                    # The next file first: writing this result must not keep the worker waiting.
                    if waiting and worker.done < FILES_PER_WORKER:
                        worker.give(waiting.popleft())
                    elif not waiting:
                        worker.stop()
                        pool.remove(worker)
                if outcome is not None:
                    yield outcome
            for worker in list(pool):
                lost = _lost(worker, timeout_s)
                if not lost and worker.done >= FILES_PER_WORKER and waiting:
                    lost = "spent"
                if not lost:
                    continue
                task = worker.task
                if lost == "spent" and task is not None:
                    continue
                worker.stop()
                pool.remove(worker)
                if task is not None:
                    yield Outcome(task, None, "", lost)
                failures += not worker.started
                if failures > 3:
                    msg = "процессы проверки не запускаются; подробности: --jobs 1 и ключ -v"
                    raise KshmError(msg)
                if waiting:
                    pool.append(_Worker(register_folder, memory))
    finally:
        for worker in pool:
            worker.stop()


def _listen(worker: _Worker) -> Outcome | None:
    try:
        kind, result, page = worker.connection.recv()
    except (EOFError, OSError):
        worker.ready = worker.ready and worker.task is not None
        worker.process.join(timeout=1)
        return None
    if kind == "ready":
        worker.ready = worker.started = True
        return None
    task = worker.task
    assert task is not None
    worker.task = None
    worker.done += 1
    if kind == "done":
        return Outcome(task, result, page)
    if kind == "memory":
        worker.ready = False
        return Outcome(task, None, "", DIED)
    return Outcome(task, None, "", f"внутренняя ошибка проверки ({result})")


def _lost(worker: _Worker, timeout_s: float) -> str:
    """Why a worker must go, empty while it may stay."""
    if not worker.process.is_alive():
        return DIED
    limit = timeout_s if worker.ready else _START_S
    if (worker.task is not None or not worker.ready) and time.monotonic() - worker.since > limit:
        return SLOW
    return ""
