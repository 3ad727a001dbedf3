"""Processes that solve for the page: a hang or a death costs one answer, never the server."""

from __future__ import annotations

import asyncio
import multiprocessing
import os
import signal
from collections.abc import Callable
from typing import Any

from pebble import ProcessExpired, ProcessPool

from reports.grading.batch.worker import MEMORY, forbid_the_world, limit_memory
from reports.inputs.described import Data
from reports.shared.aside import processors
from reports.web import engine

TIMEOUT_S = 20.0
WAIT_S = 30.0  # before a process is free
_ANSWERS = 5_000  # then a new process: whatever a library leaks is given back


class Busy(Exception):  # noqa: N818 - no fault of the program
    """There was no answer in time."""


def _begin() -> None:
    """Make a process ready: warm, with little memory, no network, no other programs."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the server
    engine.warm()
    limit_memory(MEMORY)
    forbid_the_world()


def _answer(function: Callable[..., Data], *arguments: Any) -> Data:  # noqa: ANN401
    try:
        return function(*arguments)
    except MemoryError:  # the heap may be in pieces: a new process takes over
        os._exit(1)


class Pool:
    """As many solving processes as processors, each with one question at a time."""

    def __init__(self, size: int) -> None:
        self.size = size

    def start(self) -> None:
        """Start the processes; they import while the first page is read."""
        for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "RAYON_NUM_THREADS"):
            os.environ.setdefault(name, "1")
        spawn = multiprocessing.get_context("spawn")
        self._pool = ProcessPool(self.size, _ANSWERS, initializer=_begin, context=spawn)
        self._pool.schedule(processors)  # the first task starts them

    async def ask(
        self,
        function: Callable[..., Data],
        *values: Any,  # noqa: ANN401
        seconds: float = TIMEOUT_S,
    ) -> Data:
        """A function's answer from a process that has nothing else to do.

        Raises:
            Busy: the processes are busy, or the question took too long or killed its process.
        """
        if not self._pool.active:
            self.start()
        asked = self._pool.schedule(_answer, (function, *values), timeout=seconds)
        try:
            return await asyncio.wait_for(asyncio.wrap_future(asked), WAIT_S + seconds)
        except (TimeoutError, ProcessExpired):
            raise Busy from None

    def stop(self) -> None:
        """End the processes, whatever they do."""
        self._pool.stop()  # type: ignore[no-untyped-call]
        self._pool.join()
