"""Progress on stderr: only for a person at a terminal, only when it takes over two seconds."""

from __future__ import annotations

import os
import sys
import threading
from types import TracebackType
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.status import Status

DELAY_S = 2.0


class Progress:
    """A spinner with the current step, used as a context manager.

    Silent unless stderr is a terminal; appears after `delay` seconds and
    vanishes at the end.  `step` may be called from any thread.
    """

    def __init__(self, text: str = "", *, delay: float = DELAY_S) -> None:
        self._text = text
        self._lock = threading.Lock()
        self._status: Status | None = None
        self._over = False
        self._timer = threading.Timer(delay, self._show)
        self._timer.daemon = True

    def __enter__(self) -> Progress:
        if is_terminal():
            self._timer.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        with self._lock:
            self._over = True
            self._timer.cancel()
            if self._status is not None:
                self._status.stop()
                self._status = None

    def step(self, text: str) -> None:
        """Name what is being done now (Russian)."""
        with self._lock:
            self._text = text
            if self._status is not None:
                self._status.update(_plain(text))

    def _show(self) -> None:
        # rich is imported here: a quick command never pays for it.
        from rich.console import Console

        with self._lock:
            if self._over:
                return
            self._status = Console(stderr=True).status(_plain(self._text))
            self._status.start()


def is_terminal() -> bool:
    """Tell whether stderr is a terminal that can show a spinner."""
    return sys.stderr.isatty() and os.environ.get("TERM") != "dumb"


def _plain(text: str) -> str:
    # A name in square brackets is no markup.
    return text.replace("[", r"\[")
