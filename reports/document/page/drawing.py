"""Draws the figures in a second process while the first one sets text and formulas.

The worker is a plain child process: unlike ``multiprocessing`` it neither forks a process with
threads nor imports the caller's main module.  It gets picklable calls and gives back SVG
in the same order; if it fails, the figures are drawn here.
"""

from __future__ import annotations

import os
import pickle  # between our own two processes only
import subprocess
import sys
import threading
from collections.abc import Callable, Mapping
from pathlib import Path
from types import TracebackType
from typing import BinaryIO

from reports.document.page import store

_LEAST = 4  # figures from which a second process pays
_PACKAGE = Path(__file__).resolve().parents[3]


class Drawing:
    """Figures by key, drawn ahead of their use."""

    def __init__(self, calls: Mapping[str, Callable[[], str]]) -> None:
        self._calls = dict(calls)
        self._keys = {name: _key(call) for name, call in self._calls.items()}
        kept = ((name, store.store().get(key)) for name, key in self._keys.items() if key)
        self._done: dict[str, str] = {name: svg for name, svg in kept if svg is not None}
        self._left = [item for item in self._calls.items() if item[0] not in self._done]
        self._news = threading.Condition()
        self._ended = True
        self._process: subprocess.Popen[bytes] | None = None
        if len(self._left) >= _LEAST and (os.cpu_count() or 1) > 1:
            self._start()

    def __enter__(self) -> Drawing:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._process is not None:
            self._process.kill()
            self._process.wait()

    def svg(self, key: str) -> str:
        """The figure; waits for the worker or draws it.

        Raises:
            KeyError: there is no such figure.
            ValueError: the figure cannot be drawn from its data.
        """
        with self._news:
            self._news.wait_for(lambda: key in self._done or self._ended)
            found = self._done.get(key)
        svg = self._calls[key]() if found is None else found
        if self._keys[key]:
            store.store().put(self._keys[key], svg)
        return svg

    def _start(self) -> None:
        paths = [str(_PACKAGE), *filter(None, [os.environ.get("PYTHONPATH")])]
        try:
            # -P: the current folder must not shadow the worker's modules.
            self._process = subprocess.Popen(
                [sys.executable, "-P", "-m", "reports.document.page.drawing"],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL,
                env={**os.environ, "PYTHONPATH": os.pathsep.join(paths)},
            )
        except OSError:
            return
        self._ended = False
        threading.Thread(target=self._read, args=(self._process,), daemon=True).start()
        threading.Thread(target=self._write, args=(self._process,), daemon=True).start()

    def _write(self, process: subprocess.Popen[bytes]) -> None:
        if process.stdin is None:
            return
        try:
            with process.stdin as pipe:
                pickle.dump(self._left, pipe)
        except (OSError, pickle.PicklingError, AttributeError):
            process.kill()

    def _read(self, process: subprocess.Popen[bytes]) -> None:
        try:
            while process.stdout is not None:
                key, svg = pickle.load(process.stdout)
                with self._news:
                    self._done[key] = svg
                    self._news.notify_all()
        except (EOFError, OSError, pickle.UnpicklingError, ValueError):
            pass
        finally:
            with self._news:
                self._ended = True
                self._news.notify_all()


def _key(call: Callable[[], str]) -> str:
    """Key of a figure in the store; empty for a call that cannot be told from others."""
    try:
        return store.key("figure", pickle.dumps(call, protocol=5))
    except (pickle.PicklingError, AttributeError, TypeError):
        return ""


def serve(source: BinaryIO, target: BinaryIO) -> None:
    """Draw what comes as ``[(key, call), …]`` and hand each figure out when it is ready."""
    for key, draw in pickle.load(source):
        pickle.dump((key, draw()), target)
        target.flush()


if __name__ == "__main__":
    serve(sys.stdin.buffer, sys.stdout.buffer)
