"""The program's own streams: UTF-8 out of a terminal, no failure over a letter or a gone reader."""

from __future__ import annotations

import errno
import io
import os
import select
import sys
from contextlib import suppress
from typing import TextIO


def prepare() -> None:
    """Make both streams fit for every letter, and there even where they were closed.

    What is redirected is a file of the program and as such UTF-8, whatever the system's code page
    is; a terminal keeps its encoding and shows «?» for what it does not have.
    """
    _open_closed()
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is None:
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: SIM115, PTH123
        elif isinstance(stream, io.TextIOWrapper):
            encoding = stream.encoding if stream.isatty() else "utf-8"
            stream.reconfigure(encoding=encoding, errors="replace")


def _open_closed() -> None:
    """The number of a closed stream would go to the next file opened: its place is held."""
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.set_inheritable(os.open(os.devnull, os.O_RDWR), True)


def without_reader(error: OSError) -> bool:
    """Whether the reader of a stream is gone; Windows has no number of its own for it."""
    if isinstance(error, BrokenPipeError):
        return True
    return os.name == "nt" and error.errno == errno.EINVAL and error.filename is None


def is_lost(stream: TextIO) -> bool:
    """Whether nobody reads a stream; where the system cannot be asked it is taken for granted."""
    if not hasattr(select, "poll"):
        return True
    poll = select.poll()
    poll.register(stream.fileno(), select.POLLOUT)
    return any(event & (select.POLLERR | select.POLLHUP) for _, event in poll.poll(0))


def forget(stream: TextIO) -> None:
    """Write out what waits; where it cannot be, let it go, so that the end does not mind."""
    try:
        stream.flush()
    except OSError:
        with suppress(OSError):  # a stream without a number
            os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
