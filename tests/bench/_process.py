"""A command as a whole process: wall time, processor time and peak memory with its children."""

from __future__ import annotations

import json
import os
import statistics
import subprocess
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Cost:
    """Seconds and MB of one run, or medians of several."""

    wall: float
    cpu: float
    memory: float


# A small process in between: a child counts the memory of the one that started it as its own.
# Processes that the command leaves behind, as the one that copies itself, are waited for too.
_STARTER = """
import ctypes, json, os, resource, sys, time
PR_SET_CHILD_SUBREAPER = 36
if sys.platform == "linux":
    ctypes.CDLL(None).prctl(PR_SET_CHILD_SUBREAPER, 1)
quiet = [(os.POSIX_SPAWN_OPEN, 1, os.devnull, os.O_WRONLY, 0)]
begin = time.perf_counter()
child = os.posix_spawnp(sys.argv[1], sys.argv[1:], os.environ, file_actions=quiet)
_, status = os.waitpid(child, 0)
wall = time.perf_counter() - begin
try:
    while True:
        os.wait()
except ChildProcessError:
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
cpu = usage.ru_utime + usage.ru_stime
print(json.dumps([os.waitstatus_to_exitcode(status), wall, cpu, usage.ru_maxrss / 1024]))
"""


def run(command: Sequence[str], env: Mapping[str, str] | None = None) -> Cost:
    """Run once and wait; the memory is that of the greatest single process."""
    done = subprocess.run(
        [sys.executable, "-I", "-c", _STARTER, *command],
        env={**os.environ, **(env or {})}, stdout=subprocess.PIPE, check=True,
    )  # fmt: skip
    code, wall, cpu, memory = json.loads(done.stdout)
    if code:  # a traceback is 1, as is a check that fails: what did not work has no time
        msg = f"{' '.join(command)}: код {code}"
        raise RuntimeError(msg)
    return Cost(wall, cpu, memory)


def median(command: Sequence[str], times: int = 3, env: Mapping[str, str] | None = None) -> Cost:
    """Medians of several runs."""
    runs = [run(command, env) for _ in range(times)]
    return Cost(
        *(statistics.median(getattr(r, n) for r in runs) for n in ("wall", "cpu", "memory"))
    )


def kshm(*arguments: str) -> list[str]:
    """A ``kshm`` command of this checkout."""
    return [sys.executable, "-m", "reports", *arguments]
