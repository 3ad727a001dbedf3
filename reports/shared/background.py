"""Work in a forked process meanwhile, where the system can fork."""

from __future__ import annotations

import multiprocessing
import os
import signal
import sys
import threading
from collections.abc import Callable
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
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


def end_with_parent() -> None:
    """Let this child process end when the one that has started it ends, however it does."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        threading.Thread(target=_end_after, args=(parent,), daemon=True).start()


def _end_after(parent: BaseProcess) -> None:
    parent.join()
    os._exit(1)


def aside(work: Callable[[], Result]) -> Callable[[], Result]:
    """Start work in a fork; the returned function waits for its result.

    What the work raises is raised there.  Where the process cannot be split, or the second one
    ends before its time, the work is done then and here.
    """
    if not can_split():
        return work
    context = multiprocessing.get_context("fork")
    answer, question = context.Pipe(duplex=False)
    process = context.Process(target=_done, args=(work, answer, question), daemon=True)
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


def _done(work: Callable[[], object], answer: Connection, question: Connection) -> None:
    end_with_parent()
    answer.close()  # of the first process alone: without it a write fails
    # When the first process ends, this one has nothing to clean up and nothing to say.
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGTERM])
    try:
        value: tuple[bool, object] = (False, work())
    except Exception as error:
        value = (True, error)
    question.send(value)
    question.close()
