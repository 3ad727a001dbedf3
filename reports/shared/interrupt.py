"""Handle SIGINT and SIGTERM: clean up, then stop."""

from __future__ import annotations

import _thread
import signal
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

_SIGNALS = [signal.SIGINT, signal.SIGTERM]
_AGAIN_S = 0.03
_state = {"stopped": False, "ever": False, "over": False}


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
    _state["stopped"] = _state["over"] = False
    before = {number: signal.getsignal(number) for number in _SIGNALS}
    try:
        for number, handler in before.items():
            if handler is not signal.SIG_IGN:  # started in the background: stays as it is
                signal.signal(number, _stop)
        yield
    finally:
        answered()
        _state["stopped"] = False
        for number, handler in before.items():
            signal.signal(number, handler if handler is not None else signal.SIG_DFL)


def answered() -> None:
    """Ignore further stop signals: the first one has been obeyed."""
    _state["over"] = True


def _stop(number: int, frame: FrameType | None) -> None:
    _state["ever"] = True
    if _state["over"] or _is_cleaning():
        return
    if not _state["stopped"]:
        _state["stopped"] = True
        # No lock: the signal may have come in the midst of the module ``threading``.
        _thread.start_new_thread(_again, (number, threading.get_ident()))
    # An extension that is being loaded may die of an exception: the next signal stops.
    if frame is None or not frame.f_code.co_filename.startswith("<frozen importlib"):
        raise Stopped


def _is_cleaning() -> bool:
    """Whether the current code cleans up after ``Stopped``."""
    error = sys.exc_info()[1]
    while error is not None and not isinstance(error, Stopped):
        error = error.__context__
    return error is not None


def _again(number: int, main: int) -> None:
    """Repeat a signal until it is obeyed: callbacks and libraries swallow exceptions."""
    while True:
        time.sleep(_AGAIN_S)
        if _state["over"]:
            return
        if hasattr(signal, "pthread_kill"):
            signal.pthread_kill(main, number)
        else:  # Windows
            _thread.interrupt_main(signal.Signals(number))


def stopped() -> bool:
    """Whether a stop signal has come in this block."""
    return _state["stopped"]


def ever() -> bool:
    """Whether a stop signal has ever come to this process."""
    return _state["ever"]


def check() -> None:
    """Raise ``Stopped`` for a signal that was swallowed."""
    if stopped():
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
