"""Run the benchmarks named on the command line, or all: ``python -m tests.bench solver``."""

from __future__ import annotations

import argparse
import importlib
import pkgutil
import sys
from dataclasses import replace
from pathlib import Path

import tests.bench as bench
from tests.bench._figure import keep
from tests.bench._history import draw

BY_NAME = {"copying", "web"}  # take long: only where they are asked for


def names() -> list[str]:
    """The modules of this folder that measure something."""
    return sorted(item.name for item in pkgutil.iter_modules(bench.__path__) if item.name[0] != "_")


def main(arguments: list[str]) -> int:
    """Print the figures of each benchmark; keep them where asked."""
    known = names()
    parser = argparse.ArgumentParser(prog="./run bench", description="Замеры времени и памяти.")
    parser.add_argument("names", nargs="*", metavar="ЗАМЕР", help=f"из: {', '.join(known)}")
    parser.add_argument("--history", type=Path, metavar="ФАЙЛ.csv", help="дописать строки в CSV")
    parser.add_argument("--draw", type=Path, metavar="ФАЙЛ.svg",
                        help="нарисовать историю из --history; ЗАМЕР отбирает строки")  # fmt: skip
    options = parser.parse_args(arguments)
    if options.draw:
        if not options.history or not options.history.exists():
            print("история не найдена: назовите её файл ключом --history", file=sys.stderr)
            return 2
        print(f"{options.draw}: линий {draw(options.history, options.draw, options.names)}")
        return 0
    unknown = [name for name in options.names if name not in known]
    if unknown:
        print(f"нет замера {unknown[0]}; есть: {', '.join(known)}", file=sys.stderr)
        return 2
    for name in options.names or [name for name in known if name not in BY_NAME]:
        print(f"== {name}", flush=True)
        collected = []
        for figure in importlib.import_module(f"tests.bench.{name}").figures():
            print(figure, flush=True)
            collected.append(replace(figure, name=f"{name}: {figure.name}"))
        if options.history:
            keep(options.history, collected)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
