"""``python -m reports`` is ``kshm``."""

from __future__ import annotations

import atexit
import gc
import signal
import sys


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
    atexit.register(gc.freeze)  # a process that ends need not be searched
    from reports.cli import main

    main()


if __name__ == "__main__":
    start()
