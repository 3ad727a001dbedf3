"""Submissions graded in parallel; one that hangs or kills its process costs itself alone."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, wait
from dataclasses import dataclass
from importlib import import_module
from itertools import islice
from pathlib import Path
from typing import Any

from reports.grading.reading.submissions import Submission
from reports.shared.errors import KshmError
from reports.shared.workers import MEMORY, Died, NeverStarted, Workers

TIMEOUT_S = 60.0
_NEEDS = "reports.grading.batch.marks"  # by name: this process marks nothing
_AHEAD = 2  # files for a process: writing a result must not keep it waiting

SLOW = "проверка заняла слишком много времени"
DIED = "проверка прервана: файл исчерпал память или повредил программу чтения"

Marked = tuple[dict[str, Any], str]


@dataclass(frozen=True, slots=True)
class Outcome:
    """What a worker said about a submission; ``result`` is None where it could not."""

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
    waiting, asked = iter(submissions), dict[Future[Marked], Submission]()
    with Workers(count, _marking, register_folder, needs=_NEEDS, memory=memory) as pool:
        while True:
            for submission in islice(waiting, _AHEAD * count - len(asked)):
                asked[pool.ask(submission, seconds=timeout_s)] = submission
            if not asked:
                return
            # Ctrl-C is heard between the waits.
            for future in wait(asked, 0.5, FIRST_COMPLETED).done:
                yield _outcome(asked.pop(future), future)


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
