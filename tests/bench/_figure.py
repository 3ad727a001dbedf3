"""A figure of a benchmark, how it is printed and how it is kept."""

from __future__ import annotations

import csv
import platform
import statistics
import subprocess
import sys
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

from tests.bench._process import Cost, run

HEAD = ("date", "commit", "machine", "name", "value", "unit")


@dataclass(frozen=True, slots=True)
class Figure:
    """One measured number; ``note`` is only printed."""

    name: str
    value: float
    unit: str = ""
    note: str = ""

    def __str__(self) -> str:
        number = f"{self.value:.0f}" if abs(self.value) >= 1000 else f"{self.value:.3g}"
        return f"{self.name:<66} {number:>7} {self.unit:<6} {self.note}".rstrip()


def costs(name: str, cost: Cost) -> Iterator[Figure]:
    """A command's wall time, processor time and memory."""
    yield Figure(f"{name}: время", cost.wall, "с")
    yield Figure(f"{name}: процессор", cost.cpu, "с")
    yield Figure(f"{name}: память", cost.memory, "МБ")


def memory(name: str, code: str) -> Figure:
    """Peak memory of a process of its own that runs some Python."""
    return Figure(f"{name}: память", run([sys.executable, "-c", code]).memory, "МБ")


def interleaved(
    actions: Mapping[str, Callable[[], object]],
    rounds: int = 7,
    clock: Callable[[], float] = time.process_time,
) -> dict[str, list[float]]:
    """Seconds of each action in every round; a first round is not counted.

    Processor time by default, which other work on the machine disturbs less.
    """
    collected: dict[str, list[float]] = {name: [] for name in actions}
    for number in range(rounds + 1):
        for name, action in actions.items():
            start = clock()
            action()
            if number:
                collected[name].append(clock() - start)
    return collected


def median(times: Iterable[float]) -> float:
    """Median."""
    return statistics.median(times)


def ratio(times: Mapping[str, list[float]], one: str, other: str) -> float:
    """Median over the rounds of one time over the other's of the same round."""
    return median(a / b for a, b in zip(times[one], times[other], strict=True))


def keep(file: Path, figures: Iterable[Figure]) -> None:
    """Append a row per figure to a CSV."""
    new = not file.exists()
    commit = subprocess.run(
        ["git", "describe", "--always", "--dirty"], capture_output=True, text=True, check=False
    ).stdout.strip()
    date = datetime.now(UTC).strftime("%Y-%m-%dT%H:%M:%SZ")
    machine = f"{platform.machine()} {platform.system()} Python {platform.python_version()}"
    with file.open("a", encoding="utf-8", newline="") as stream:
        writer = csv.writer(stream)
        if new:
            writer.writerow(HEAD)
        for figure in figures:
            row = (date, commit, machine, figure.name, f"{figure.value:.6g}", figure.unit)
            writer.writerow(row)
