"""What a library writes into its log is collected, not shown."""

from __future__ import annotations

import logging
from collections.abc import Iterator
from contextlib import contextmanager


class _Collector(logging.Handler):
    def __init__(self) -> None:
        super().__init__(logging.WARNING)
        self.lines: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        line = record.getMessage()
        if line not in self.lines:
            self.lines.append(line)


@contextmanager
def complaints(name: str) -> Iterator[list[str]]:
    """Warnings of a logger, each once, while nothing of them reaches the screen."""
    logger, collector = logging.getLogger(name), _Collector()
    handlers, propagate = logger.handlers[:], logger.propagate
    logger.handlers[:], logger.propagate = [collector], False
    try:
        yield collector.lines
    finally:
        logger.handlers[:], logger.propagate = handlers, propagate
