"""Submissions graded in parallel processes or on a Dask cluster.

A submission that hangs or kills its process costs itself alone.  A part for a cluster runs in
a process of its own beside the cluster's worker: Dask's workers may not start processes
themselves, and people's files are only opened in limited ones.
"""

from __future__ import annotations

import pickle
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, wait
from contextlib import suppress
from dataclasses import dataclass, replace
from importlib import import_module
from itertools import islice
from pathlib import Path
from typing import Any

from reports.grading.issuing.rubric import Rubric
from reports.grading.judging.work_digest import Work
from reports.grading.reading.submissions import Submission
from reports.shared.errors import Died, InputError, KshmError, NeverStarted
from reports.shared.parallel_map import in_order
from reports.shared.workers import MEMORY, Workers

TIMEOUT_S = 60.0
_NEEDS = "reports.grading.batch.worker"  # by name: this process marks nothing
_AHEAD = 2  # files for a process: writing a result must not keep it waiting

SLOW = "проверка заняла слишком много времени"
DIED = "проверка прервана: файл исчерпал память или повредил программу чтения"

Marked = tuple[dict[str, Any], str]
_COPIES = "reports.grading.pages.marked_copy"
Job = tuple[Submission, dict[str, Any], Work]
PART = 20  # files; starting the process costs as much as a few of them
Answers = list[tuple[str, dict[str, Any] | None, str, str]]  # key, result, page, problem


@dataclass(frozen=True, slots=True)
class Outcome:
    """Outcome of a submission; ``result`` is None where the worker failed."""

    submission: Submission
    result: dict[str, Any] | None
    page: str
    problem: str = ""


def grade_all(
    submissions: Sequence[Submission],
    register_folder: Path,
    *,
    workers: int,
    timeout_s: float = TIMEOUT_S,
    memory: int = MEMORY,
) -> Iterator[Outcome]:
    """Outcomes as they come, in no fixed order.

    Raises:
        KshmError: the processes do not start.
    """
    if not submissions:
        return
    count = min(workers, len(submissions))
    waiting, running = iter(submissions), dict[Future[Marked], Submission]()
    with Workers(count, _marking, register_folder, needs=_NEEDS, memory=memory) as pool:
        while True:
            for submission in islice(waiting, _AHEAD * count - len(running)):
                running[pool.ask(submission, seconds=timeout_s)] = submission
            if not running:
                return
            # Ctrl-C is heard between the waits.
            for future in wait(running, 0.5, FIRST_COMPLETED).done:
                yield _outcome(running.pop(future), future)


def _outcome(submission: Submission, future: Future[Marked]) -> Outcome:
    try:
        return Outcome(submission, *future.result())
    except TimeoutError:
        problem = SLOW
    except Died:
        problem = DIED
    except NeverStarted:
        msg = "процессы проверки не запускаются; подробности: --jobs 1 и ключ -v"
        raise KshmError(msg) from None
    except Exception as error:  # a bug must cost one row, never the batch
        problem = f"внутренняя ошибка проверки ({error})"
    return Outcome(submission, None, "", problem)


def _marking(register_folder: Path) -> Callable[[Submission], Marked]:
    begin: Callable[[Path], Callable[[Submission], Marked]] = import_module(_NEEDS).marking
    return begin(register_folder)


# --- copies --------------------------------------------------------------------------------------


def copies(
    jobs: Sequence[Job], rubric: Rubric, workers: int, timeout_s: float
) -> Iterator[tuple[Work, bytes]]:
    """Return marked copies as they come; a book that cannot be copied costs its copy alone."""
    if not jobs:
        return
    with Workers(min(workers, len(jobs)), _copying, rubric, needs=_COPIES, memory=MEMORY) as pool:
        futures = {pool.ask(one, result, seconds=timeout_s): work for one, result, work in jobs}
        for future, work in futures.items():
            with suppress(Exception):
                yield work, future.result()


def _copying(rubric: Rubric) -> Callable[..., bytes]:
    copying: Callable[..., bytes] = import_module(_COPIES).copying(rubric)
    return copying


# --- a Dask cluster ------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class ClusterPart:
    """Some submissions with their bytes, the register in force, seconds for a file."""

    register: str
    submissions: list[tuple[Submission, bytes]]
    timeout_s: float


def grade_far(
    submissions: Sequence[Submission], register_file: Path, *, timeout_s: float, dask: str
) -> Iterator[Outcome]:
    """Outcomes as they come, as ``grade_all`` gives them.

    Raises:
        KshmError: the cluster cannot be reached or lost too many workers.
    """
    whole = {item.key: item for item in submissions}
    unread: list[Submission] = []
    parts = _parts(submissions, register_file.read_text(encoding="utf-8"), timeout_s, unread)
    for answers in in_order(graded, parts, dask=dask):
        for key, result, page, problem in answers:
            yield Outcome(whole[key], result, page, problem)
    yield from grade_all(unread, register_file, workers=1, timeout_s=timeout_s)


def _parts(
    submissions: Sequence[Submission], register: str, timeout_s: float, unread: list[Submission]
) -> Iterator[ClusterPart]:
    """Return the parts, read as they are sent; what cannot be read stays here."""
    for begin in range(0, len(submissions), PART):
        read = []
        for item in submissions[begin : begin + PART]:
            try:
                read.append((item, item.read()))
            except InputError:
                unread.append(item)
        if read:
            yield ClusterPart(register, read, timeout_s)


def graded(part: ClusterPart) -> Answers:
    """Answers for a part, in the order of its files."""
    done = subprocess.run(
        [sys.executable, "-m", "reports.grading.batch.pool"],
        input=pickle.dumps(part), stdout=subprocess.PIPE, check=False,
    )  # fmt: skip
    if done.returncode != 0:
        msg = "процесс проверки на кластере не запустился; проверьте установку kshm на его узлах"
        raise KshmError(msg)
    answers: Answers = pickle.loads(done.stdout)
    return answers


def _grade_here(part: ClusterPart) -> Answers:
    with tempfile.TemporaryDirectory(prefix="kshm-part-") as name:
        register = Path(name) / "register.json"
        register.write_text(part.register, encoding="utf-8")
        moved = []
        for number, (item, data) in enumerate(part.submissions):
            path = Path(name) / f"{number}.bin"
            path.write_bytes(data)
            moved.append(replace(item, path=path, members=None))
        outcomes = grade_all(moved, register, workers=1, timeout_s=part.timeout_s)
        answers = {o.submission.key: (o.result, o.page, o.problem) for o in outcomes}
        return [(item.key, *answers[item.key]) for item in moved]


if __name__ == "__main__":
    sys.stdout.buffer.write(pickle.dumps(_grade_here(pickle.load(sys.stdin.buffer))))
