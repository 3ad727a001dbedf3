"""Processes that solve for the page: a hang or a death costs one answer, never the server."""

from __future__ import annotations

import asyncio
import multiprocessing
import os
from collections.abc import Callable
from multiprocessing.connection import Connection
from typing import Any

from reports.web import engine

TIMEOUT_S = 20.0
WAIT_S = 30.0  # before a process is free
_START_S = 60.0
_MEMORY = 2 * 2**30  # bytes beyond what a warm process has
_ANSWERS = 5_000  # then a new process: whatever a library leaks is given back


class Busy(Exception):  # noqa: N818 - no fault of the program
    """There was no answer in time."""


def processors() -> int:
    """How many processors this program may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def _serve(connection: Connection) -> None:
    """Answer the questions that come through the connection until it closes."""
    import signal

    from reports.grading.batch.worker import forbid_the_world, limit_memory

    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the server
    engine.warm()
    limit_memory(_MEMORY)
    forbid_the_world()
    connection.send(None)
    for _ in range(_ANSWERS):
        try:
            function, arguments = connection.recv()
        except (EOFError, OSError):
            return
        try:
            connection.send(engine.answered(function, *arguments))
        except MemoryError:  # the heap may be in pieces: a new process takes over
            connection.send(None)
            return
        except Exception as error:  # a bug costs one answer
            what = f"внутренняя ошибка {type(error).__name__}"
            connection.send({"errors": [{"where": "", "what": what, "hint": "сообщите о ней"}]})


class _Worker:
    def __init__(self) -> None:
        for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "RAYON_NUM_THREADS"):
            os.environ.setdefault(name, "1")
        context = multiprocessing.get_context("spawn")
        self.connection, theirs = context.Pipe()
        self.process = context.Process(target=_serve, args=(theirs,), daemon=True)
        self.process.start()
        theirs.close()
        self.ready = False

    def ask(self, function: Callable[..., engine.Data], arguments: tuple[Any, ...]) -> Any:  # noqa: ANN401
        """What the process says; nothing in time is a TimeoutError, its end an EOFError."""
        if not self.ready:
            self._heard(_START_S)
            self.ready = True
        self.connection.send((function, arguments))
        return self._heard(TIMEOUT_S)

    def _heard(self, seconds: float) -> Any:  # noqa: ANN401
        if not self.connection.poll(seconds):
            raise TimeoutError
        return self.connection.recv()

    def stop(self) -> None:
        self.connection.close()
        self.process.kill()
        self.process.join()


class Pool:
    """As many solving processes as processors, each with one question at a time."""

    def __init__(self, size: int | None = None) -> None:
        self.size = size or processors()
        self._free: asyncio.Queue[_Worker] = asyncio.Queue()
        self._all: set[_Worker] = set()

    def start(self) -> None:
        """Start the processes; they import while the first page is read."""
        self._loop = asyncio.get_running_loop()
        for _ in range(self.size):
            self._add()

    def _add(self) -> None:
        worker = _Worker()
        self._all.add(worker)
        self._free.put_nowait(worker)

    def _drop(self, worker: _Worker) -> None:
        self._all.discard(worker)
        worker.stop()

    async def ask(self, function: Callable[..., engine.Data], *arguments: Any) -> engine.Data:  # noqa: ANN401
        """A function's answer from a process that has nothing else to do.

        Raises:
            Busy: the processes are busy, or the question took too long or killed its process.
        """
        try:
            worker = await asyncio.wait_for(self._free.get(), WAIT_S)
        except TimeoutError:
            raise Busy from None
        if not worker.process.is_alive():  # killed from outside, or at the end of its life
            self._drop(worker)
            self._add()
            worker = await self._free.get()
        answer: Any = None
        try:
            # The thread goes on when the person leaves; so does the wait for it.
            answer = await asyncio.shield(
                asyncio.to_thread(self._asked, worker, function, arguments)
            )
        except (TimeoutError, EOFError, OSError):
            raise Busy from None
        if not isinstance(answer, dict):
            raise Busy
        return answer

    def _asked(
        self, worker: _Worker, function: Callable[..., engine.Data], arguments: tuple[Any, ...]
    ) -> Any:  # noqa: ANN401
        fresh = False
        try:
            answer = worker.ask(function, arguments)
            fresh = isinstance(answer, dict)
        finally:
            self._loop.call_soon_threadsafe(self._returned, worker, fresh)
        return answer

    def _returned(self, worker: _Worker, healthy: bool) -> None:
        if healthy:
            self._free.put_nowait(worker)
        else:
            self._drop(worker)
            self._add()

    def stop(self) -> None:
        """End the processes, whatever they do."""
        for worker in list(self._all):
            self._drop(worker)

    @property
    def processes(self) -> list[int]:
        """Their numbers."""
        return [worker.process.pid or 0 for worker in self._all]
