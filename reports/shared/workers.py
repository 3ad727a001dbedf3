"""Processes that answer questions; one that hangs or dies costs one answer, nothing else.

They look at people's files and inputs: little memory, no network, no other programs.
"""

from __future__ import annotations

import contextlib
import multiprocessing
import os
import signal
import sys
import tempfile
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from pathlib import Path
from queue import SimpleQueue
from typing import TYPE_CHECKING, Any

from reports.shared.background import end_with_parent
from reports.shared.errors import Died, KshmError, NeverStarted, one_line
from reports.shared.interrupt import held

if TYPE_CHECKING:
    from multiprocessing.context import ForkServerContext, SpawnContext


_LONGEST_FOLDER = 107 - 33
GROWN = 2**28  # bytes that a process may keep beyond what it had when it was ready
MEMORY = 2 * 2**30  # bytes of address space beyond what the ready process has
_START_S = 120.0  # a cold start on a loaded machine
_STARTS = 4
_THREADS = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "RAYON_NUM_THREADS")
_FORBIDDEN = (
    "socket.connect", "socket.bind", "socket.getaddrinfo", "socket.sendto", "subprocess.Popen",
    "os.system", "os.exec", "os.posix_spawn", "os.spawn", "os.fork", "os.forkpty",
    "os.startfile", "webbrowser.open", "ftplib.connect", "smtplib.connect", "urllib.Request",
)  # fmt: skip


def processes(needs: str) -> ForkServerContext | SpawnContext:
    """Context whose processes have a module imported: forkserver on Linux, else spawn."""
    # The name of forkserver's socket has at most 107 bytes, of them 33 behind the folder's.
    if sys.platform != "linux" or len(os.fsencode(tempfile.gettempdir())) > _LONGEST_FOLDER:
        return multiprocessing.get_context("spawn")
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload(["reports.shared.orphaned", needs])  # before the first copy
    return context


class Workers:
    """Pool of processes for one block, each with one question at a time.

    Args:
        count: how many.
        begin: what makes a process ready; it returns what answers the questions.
        given: arguments of ``begin``.
        needs: a module that ``begin`` imports, if it is not its own.
        memory: bytes that a ready process may take besides; without it nothing is forbidden.
        most: answers of a process; then a new one: whatever a library leaks is given back.
    """

    def __init__(
        self,
        count: int,
        begin: Callable[..., Callable[..., Any]],
        *arguments: Any,  # noqa: ANN401
        needs: str = "",
        memory: int | None = MEMORY,
        most: int | None = 500,
    ) -> None:
        self._threads = ThreadPoolExecutor(count)  # one waits for each process
        self._all = [
            _Worker(most, needs or begin.__module__, memory, begin, *arguments)
            for _ in range(count)
        ]
        self._idle, self._guarded = SimpleQueue[_Worker](), memory is not None

    def __enter__(self) -> Workers:
        # One thread each: the processes are the parallelism.
        for name in _THREADS if self._guarded else ():
            os.environ.setdefault(name, "1")
        for worker in self._all:
            worker.launch()
            self._idle.put(worker)
        return self

    def __exit__(self, *_: object) -> None:
        self._threads.shutdown(wait=False, cancel_futures=True)
        for worker in self._all:
            worker.over = True
            worker.end()
        self._threads.shutdown()

    def ask(self, *question: Any, seconds: float | None) -> Future[Any]:  # noqa: ANN401
        """Future answer of an idle process.

        Raises:
            TimeoutError: it took more than so many seconds, the start of the process apart.
            Died: it ended the process.
            NeverStarted: there is no process.
            KshmError: the answer itself.
            RuntimeError: any other error in the process, by its name.
        """
        return self._threads.submit(self._ask, question, seconds)

    def _ask(self, question: tuple[Any, ...], seconds: float | None) -> Any:  # noqa: ANN401
        worker = self._idle.get()
        try:
            good, said = worker.ask(question, seconds)
        finally:
            worker.renew()
            self._idle.put(worker)
        if not good:
            raise said
        return said


class _Worker:
    """A process with its own pipe."""

    def __init__(self, most: int | None, needs: str, *arguments: Any) -> None:  # noqa: ANN401
        self.most, self.needs, self.given, self.over = most, needs, arguments, False

    def launch(self) -> None:
        context = processes(self.needs)
        self.connection, theirs = context.Pipe()
        self.process = context.Process(target=_serve, args=(theirs, *self.given), daemon=True)
        _start(self.process, waits=context.get_start_method() == "forkserver")
        theirs.close()
        self.ready, self.is_grown, self.answers = False, False, 0
        if self.over:  # while it was started
            self.end()

    def end(self) -> None:
        self.process.kill()
        self.process.join()

    def renew(self) -> None:
        """Begin anew where a question has left much memory behind."""
        if self.is_grown and not self.over:
            self.end()
            self.launch()

    def ask(self, question: tuple[Any, ...], seconds: float | None) -> tuple[bool, Any]:
        for _ in range(_STARTS):
            if self._is_ready():
                break
            if self.over:
                raise Died
            self.end()
            self.launch()
        else:
            raise NeverStarted
        lost: Exception = TimeoutError()
        try:
            self.connection.send(question)
            if self.connection.poll(seconds):
                good, said, self.is_grown = self.connection.recv()
                self.answers += 1
                return good, said
        except (EOFError, OSError):
            lost = Died()
        self.end()
        raise lost

    def _is_ready(self) -> bool:
        with contextlib.suppress(EOFError, OSError):
            if not self.ready and self.connection.poll(_START_S):
                self.ready = self.connection.recv()
        fresh = self.most is None or self.answers < self.most
        return self.ready and self.process.is_alive() and fresh


def _start(process: BaseProcess, *, waits: bool) -> None:
    """Start a process that does not hear Ctrl-C: it is for the one that the person has started.

    A server of forks, which the processes inherit their signals from, may take seconds to answer
    the first time; meanwhile this process hears them.
    """
    if not waits:
        with held(signal.SIGINT):
            process.start()
        return
    from multiprocessing import forkserver, resource_tracker  # Windows has none

    resource_tracker.ensure_running()  # it would let the signals through
    with held(signal.SIGINT):
        forkserver.ensure_running()
    process.start()


def _serve(
    connection: Connection,
    memory: int | None,
    begin: Callable[..., Callable[..., Any]],
    *arguments: Any,  # noqa: ANN401
) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    end_with_parent()
    answer = begin(*arguments)
    if memory is not None:
        limit_memory(memory)
        forbid_the_world()
    before = _resident()
    with contextlib.suppress(EOFError, OSError):  # who asks is gone
        connection.send(True)
        while True:
            question = connection.recv()
            try:
                said = True, answer(*question)
            except MemoryError:  # the heap may be in pieces: a new process takes over
                return
            except KshmError as error:
                said = False, error
            except Exception as error:
                said = False, RuntimeError(one_line(f"{type(error).__name__}: {error}"))
            connection.send((*said, _resident() - before > GROWN))


def _resident() -> int:
    """Bytes that this process holds, where the system tells them."""
    with contextlib.suppress(OSError, ValueError, AttributeError):
        pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
        return pages * int(os.sysconf("SC_PAGESIZE"))
    return 0


def limit_memory(extra: int) -> None:
    """Cap the address space where the system can do that."""
    try:
        import resource
    except ImportError:  # Windows
        return
    with contextlib.suppress(OSError, ValueError):
        pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0])
        limit = pages * resource.getpagesize() + extra
        resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def forbid_the_world() -> None:
    """Forbid network and subprocesses in this process."""

    def hook(event: str, _: tuple[Any, ...]) -> None:
        if event in _FORBIDDEN:
            raise PermissionError(f"forbidden in this process: {event}")

    sys.addaudithook(hook)
