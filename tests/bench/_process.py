"""A command as a whole process: wall time, processor time and peak memory with its children."""

from __future__ import annotations

import os
import statistics
import sys
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Cost:
    """Seconds and MB of one run, or medians of several."""

    wall: float
    cpu: float
    memory: float

    def __str__(self) -> str:
        """In words."""
        return f"{self.wall:.2f} с, процессор {self.cpu:.2f} с, память {self.memory:.0f} МБ"


def run(command: Sequence[str], env: Mapping[str, str] | None = None) -> Cost:
    """Run once and wait; the memory is that of the greatest single process."""
    begin = time.perf_counter()
    quiet = (os.POSIX_SPAWN_OPEN, 1, os.devnull, os.O_WRONLY, 0)
    own = {**os.environ, **(env or {})}
    child = os.posix_spawnp(command[0], list(command), own, file_actions=[quiet])
    _, status, usage = os.wait4(child, 0)
    if os.waitstatus_to_exitcode(status) not in (0, 1):
        msg = f"{' '.join(command)}: код {os.waitstatus_to_exitcode(status)}"
        raise RuntimeError(msg)
    wall = time.perf_counter() - begin
    return Cost(wall, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024)


def median(command: Sequence[str], times: int = 3, env: Mapping[str, str] | None = None) -> Cost:
    """Medians of several runs."""
    runs = [run(command, env) for _ in range(times)]
    return Cost(
        *(statistics.median(getattr(r, n) for r in runs) for n in ("wall", "cpu", "memory"))
    )


def kshm(*arguments: str) -> list[str]:
    """A ``kshm`` command of this checkout."""
    return [sys.executable, "-m", "reports", *arguments]
