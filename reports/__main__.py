"""``python -m reports`` is ``kshm``."""

from __future__ import annotations

import atexit
import gc
import os
import signal
import sys
from contextlib import suppress


def start() -> None:
    """Run the command line."""
    if not {"-v", "--verbose"} & set(sys.argv):
        # What cannot be raised, as an error while something half-written is thrown away,
        # would print a traceback between the messages.
        sys.unraisablehook = lambda _: None
    # While the program is loading there is nothing to clean up: Ctrl-C ends it without a word.
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    if sys.argv[1:2] == ["build"]:
        gc.disable()  # what a build makes stays to its end; between builds garbage is looked for
    from reports.shared import interrupt

    code = None
    atexit.register(lambda: _end(code if interrupt.ever() else None))
    from reports.cli import main

    try:
        main()
    except SystemExit as error:
        code = error.code
        raise


def _end(code: object) -> None:
    """End the process, one that was stopped with its exit code."""
    gc.freeze()  # a process that ends need not be searched
    if isinstance(code, int):
        # Libraries that were stopped while they were being loaded may die of being taken apart.
        for stream in (sys.stdout, sys.stderr):
            with suppress(OSError):
                stream.flush()
        os._exit(code)


if __name__ == "__main__":
    start()
