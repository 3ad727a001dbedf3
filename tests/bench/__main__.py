"""Run the benchmarks named on the command line, or all: ``python -m tests.bench report``."""

from __future__ import annotations

import importlib
import pkgutil
import sys

import tests.bench as bench


def names() -> list[str]:
    """The modules of this folder that measure something."""
    return sorted(item.name for item in pkgutil.iter_modules(bench.__path__) if item.name[0] != "_")


def main(wanted: list[str]) -> int:
    """Print the rows of each benchmark."""
    known = names()
    for name in wanted or known:
        if name not in known:
            print(f"нет замера {name}; есть: {', '.join(known)}", file=sys.stderr)
            return 2
        print(f"== {name}", flush=True)
        for label, value in importlib.import_module(f"tests.bench.{name}").rows():
            print(f"{label:<60} {value}", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
