"""The process that looks at people's files: little memory, no network, no other programs."""

from __future__ import annotations

import contextlib
import sys
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

MEMORY = 2 * 2**30  # bytes of address space beyond what the empty process has
_FORBIDDEN = (
    "socket.connect", "socket.bind", "socket.getaddrinfo", "socket.sendto", "subprocess.Popen",
    "os.system", "os.exec", "os.posix_spawn", "os.spawn", "os.fork", "os.forkpty",
    "os.startfile", "webbrowser.open", "ftplib.connect", "smtplib.connect", "urllib.Request",
)  # fmt: skip


def serve(connection: Connection, register_folder: Path, memory: int) -> None:
    """Grade the submissions that come through the connection until it closes."""
    from reports.grading.issuing.register import load_register
    from reports.grading.judging.marking import Marker
    from reports.grading.pages.pages import student_page
    from reports.grading.reading.submissions import Submission

    marker = Marker(load_register(register_folder))
    _warm_up()
    limit_memory(memory)
    forbid_the_world()
    connection.send(("ready", None, None))
    while True:
        try:
            submission = connection.recv()
        except (EOFError, OSError):
            return
        assert isinstance(submission, Submission)
        try:
            result = marker.mark(submission, submission.read())
            page = student_page(result, marker.register.rubric)
            answer: tuple[str, Any, Any] = ("done", result, page)
        except MemoryError:
            # The heap may be in pieces: a new process takes over.
            connection.send(("memory", None, None))
            return
        except Exception as error:  # a bug must cost one row, never the batch
            answer = ("failed", f"{type(error).__name__}: {error}"[:300], None)
        connection.send(answer)


def _warm_up() -> None:
    """Import what grading needs while importing is still allowed to use memory freely."""
    import formualizer
    import lxml.etree
    import numpy as np

    assert formualizer and lxml.etree
    np.ones((8, 8)) @ np.ones((8, 8))


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
    """Refuse network and programs from here on, whatever a parser may try."""

    def hook(event: str, _: tuple[Any, ...]) -> None:
        if event in _FORBIDDEN:
            raise PermissionError(f"forbidden while grading: {event}")

    sys.addaudithook(hook)
