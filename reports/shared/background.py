"""Work in a forked process meanwhile, where the system can fork."""

from __future__ import annotations

import multiprocessing
import os
import signal
import sys
from collections.abc import Callable
from multiprocessing.connection import Connection
from typing import TypeVar

from reports.shared.interrupt import held

Result = TypeVar("Result")


def processors() -> int:
    """How many processors this program may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def can_split() -> bool:
    """Whether a fork is cheap here and has its own processor.

    A copy of the running process needs neither to import nor to read anything again.  Workers
    of a pool, which share the processors already, do not split.
    """
    if sys.platform != "linux" or multiprocessing.parent_process() is not None:
        return False
    return processors() > 1


def aside(work: Callable[[], Result]) -> Callable[[], Result]:
    """Start work in a fork; the returned function waits for its result.

    What the work raises is raised there.  Where the process cannot be split, or the second one
    ends before its time, the work is done then and here.
    """
    if not can_split():
        return work
    context = multiprocessing.get_context("fork")
    answer, question = context.Pipe(duplex=False)
    process = context.Process(target=_done, args=(work, question), daemon=True)
    # Ctrl-C is for the process that the person has started; SIGTERM waits until it is answered.
    with held(signal.SIGINT, signal.SIGTERM):
        process.start()
    question.close()

    def result() -> Result:
        try:
            failed, value = answer.recv()
        except EOFError:
            return work()
        finally:
            answer.close()
            process.join()
        if failed:
            raise value
        return value  # type: ignore[no-any-return]

    return result


def _done(work: Callable[[], object], question: Connection) -> None:
    # When the first process ends, this one has nothing to clean up and nothing to say.
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGTERM])
    try:
        value: tuple[bool, object] = (False, work())
    except Exception as error:
        value = (True, error)
    question.send(value)
    question.close()
