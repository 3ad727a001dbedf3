"""Handle SIGINT and SIGTERM: clean up, then stop."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

_SIGNALS = [signal.SIGINT, signal.SIGTERM]
_state = {"stopped": False, "ever": False}


class Stopped(KeyboardInterrupt):
    """A signal to stop has come.

    A plain ``KeyboardInterrupt`` that passes through ``exec`` of a text, as when a module is
    imported, makes Python end itself with the signal although it was caught.
    """


@contextmanager
def stoppable() -> Iterator[None]:
    """Raise ``Stopped`` on the first signal; those that follow let it clean up."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    _state["stopped"] = False
    before = {number: signal.getsignal(number) for number in _SIGNALS}
    try:
        for number, handler in before.items():
            if handler is not signal.SIG_IGN:  # started in the background: stays as it is
                signal.signal(number, _stop)
        yield
    finally:
        _state["stopped"] = False
        for number, handler in before.items():
            signal.signal(number, handler if handler is not None else signal.SIG_DFL)


def _stop(_: int, frame: FrameType | None) -> None:
    _state["ever"] = True
    # An extension that is being loaded may die of an exception: the next file stops, or the next
    # signal.
    if frame is not None and frame.f_code.co_filename.startswith("<frozen importlib"):
        _state["stopped"] = True
        return
    for number in _SIGNALS:
        signal.signal(number, signal.SIG_IGN)
    _state["stopped"] = True
    raise Stopped


def asked() -> bool:
    """Whether a stop signal has come in this block."""
    return _state["stopped"]


def ever() -> bool:
    """Whether a stop signal has ever come to this process."""
    return _state["ever"]


def check() -> None:
    """Raise ``Stopped`` for a signal that was swallowed."""
    if asked():
        raise Stopped


@contextmanager
def held(*numbers: signal.Signals) -> Iterator[None]:
    """Block signals in this block and in processes started inside it."""
    if not hasattr(signal, "pthread_sigmask"):  # Windows
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, numbers)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
