"""The public names as lines: ``python -m tests.api.public_names > tests/api/names.txt``."""

from __future__ import annotations

from collections.abc import Iterator

import kshm
import reports
from kshm import solve
from reports.inputs.to_si.engine import engine_and_cycle
from tests.conftest import sample, sample_names


def lines() -> Iterator[str]:
    """Names of the package; then tables with their columns, and scalars, with the samples."""
    for package in (kshm, reports):
        yield from (f"{package.__name__}.{name}" for name in package.__all__)
    collected: dict[str, list[str]] = {}
    for name in sample_names():
        solution = solve(*engine_and_cycle(sample(name)))
        for table, columns in solution.columns.items():
            collected.setdefault(f"table {table}: {' '.join(columns)}", []).append(name)
        for key in solution.scalars:
            collected.setdefault(f"scalar {key}", []).append(name)
    everywhere = len(sample_names())
    for line, names in sorted(collected.items()):
        yield line if len(names) == everywhere else f"{line} [{' '.join(names)}]"


if __name__ == "__main__":
    print("\n".join(lines()))
