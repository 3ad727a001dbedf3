"""Counts the functions that one input passes through: ``python tools/house/trace.py [ROOT]``.

A function counts if a local value of it, or what it returns, is the input in any unit: the bare
number or its text; also inside tuples, lists, dicts and longer texts; also inside records. Printed
are rows of the ruler, for the code below a root; ``--way KEY`` lists the functions instead.
"""

from __future__ import annotations

import os
import re
import sys
import tempfile
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from types import FrameType
from unittest import mock

import numpy as np

SHORT = 4  # elements of an array that still stands for one value
DEEP = 2  # records and containers within each other
LARGE = 64  # elements of a container that is no longer looked into
SOLVES, WRITES = "solve", "_write"  # of kshm.chain, and of a page in reports.document.report
LEVELS = ("bare", "in containers", "in records")


@dataclass(frozen=True)
class Input:
    """An input with a value that no other input has, and the lines that give it to a sample."""

    key: str
    value: float
    si: float
    section: str = ""

    def put_into(self, text: str) -> str:
        """Text of a sample with the input in it."""
        line = f"{self.key} = {self.value}"
        if self.section:
            return f"{text}\n{self.section}\n{line}\n"
        return re.sub(rf"{self.key} = .*", line, text)


INPUTS = (
    Input("max_pressure_mpa", 10.5913371, 1e6),
    Input("crown_mm", 17.5913371, 1e-3, '[strength]\nkind = "diesel"'),
    Input("flywheel_kg_m2", 3.5913371, 1, "[torsion]"),
)


class Watch:
    """Whether values hold an input, by level."""

    def __init__(self, given: Input) -> None:
        self._text = str(given.value)
        self._numbers = [given.value, given.value * given.si]

    def _is_bare(self, value: object) -> bool:
        if isinstance(value, str):
            return value == self._text
        if isinstance(value, np.ndarray):
            return value.dtype == float and value.size <= SHORT and any(
                self._is_bare(float(each)) for each in value.flat
            )  # fmt: skip
        return isinstance(value, float) and any(
            abs(value - number) <= 1e-9 * abs(number) for number in self._numbers
        )

    def level(self, value: object, depth: int = DEEP) -> int | None:
        """Place in LEVELS; None where the value does not hold the input."""
        if self._is_bare(value):
            return 0
        if isinstance(value, str):
            return 1 if self._text in value else None
        if depth == 0:
            return None
        inner = [self.level(each, depth - 1) for each in _members(value)]
        levels = [max(level, 1) for level in inner if level is not None]
        if levels:
            return min(levels)
        inner = [self.level(each, depth - 1) for each in _fields(value)]
        return 2 if any(level is not None for level in inner) else None


def _members(value: object) -> Iterator[object]:
    if not isinstance(value, dict | tuple | list) or hasattr(type(value), "_fields"):
        return
    if len(value) <= LARGE:
        yield from list(value.values()) if isinstance(value, dict) else value


def _fields(value: object) -> Iterator[object]:
    """Fields of a frozen dataclass, a named tuple or a model; no module, class or function."""
    if hasattr(type(value), "_fields") and isinstance(value, tuple):
        yield from value
    elif not isinstance(value, type):
        for record in ("__dataclass_fields__", "model_fields"):
            for name in getattr(type(value), record, ()):
                yield getattr(value, name, None)


def way(root: Path, given: Input) -> dict[tuple[str, str], int]:
    """Least level of the input in each file and function between the file and its cell."""
    functions: dict[tuple[str, str], int] = {}
    watch = Watch(given)

    def profile(frame: FrameType, event: str, result: object) -> None:
        path = frame.f_code.co_filename
        if event != "return" or not path.startswith(f"{root}{os.sep}") or ".venv" in path:
            return
        where = (os.path.relpath(path, root), frame.f_code.co_qualname)
        best = functions.get(where, len(LEVELS))
        for value in (result, *frame.f_locals.values()):
            if best == 0:
                break
            level = watch.level(value)
            best = best if level is None else min(best, level)
        if best < len(LEVELS):
            functions[where] = best

    source = (root / "samples" / "gots-diesel.toml").read_text(encoding="utf-8")
    with tempfile.TemporaryDirectory() as folder:
        engine = Path(folder) / "engine.toml"
        engine.write_text(given.put_into(source), encoding="utf-8")
        from reports.cli import main

        sys.setprofile(profile)
        with suppress(SystemExit):
            main(["build", str(engine), "-o", folder, "--only", "xlsx"])
        sys.setprofile(None)
        if not list(Path(folder).glob("*.xlsx")):
            raise RuntimeError(f"{given.key}: no workbook was built")
    return functions


def work_of_a_build(root: Path) -> str:
    """Pages written and engines solved in one build of workbook, PDF and Word."""
    from reports.cli import main
    from reports.document import report
    from reports.inputs import solve_input

    counts = {WRITES: 0, SOLVES: 0}

    def counting(module: object, name: str) -> mock._patch[object]:
        usual = getattr(module, name)

        def call(*args: object, **kwargs: object) -> object:
            counts[name] += 1
            return usual(*args, **kwargs)

        return mock.patch.object(module, name, call)

    with tempfile.TemporaryDirectory() as folder, counting(report, WRITES), \
            counting(solve_input, SOLVES), suppress(SystemExit):  # fmt: skip
        main(["build", str(root / "samples" / "two-stroke.toml"), "-o", folder,
              "--only", "xlsx", "--only", "pdf", "--only", "docx"])  # fmt: skip
    return f"{counts[WRITES]} / {counts[SOLVES]}"


def rows(root: Path) -> Iterator[tuple[str, str]]:
    """Titles and values of the ruler's rows."""
    for given in INPUTS:
        functions = way(root, given)
        for number, level in enumerate(LEVELS):
            reached = {where for where, least in functions.items() if least <= number}
            files = {file for file, _ in reached}
            yield (
                f"way of {given.key}, {level}: files / functions",
                f"{len(files)} / {len(reached)}",
            )
    yield "pages written / solves in one build of xlsx, pdf, docx", work_of_a_build(root)


def main_rows(arguments: list[str]) -> None:
    """Print the rows, or the way of one input."""
    root = Path(arguments[0] if arguments else ".").resolve()
    sys.path.insert(0, str(root))
    if "--way" in arguments:
        (given,) = (each for each in INPUTS if each.key == arguments[-1])
        for (file, function), level in sorted(way(root, given).items()):
            print(f"{LEVELS[level]:14} {file} {function}")
        return
    for title, value in rows(root):
        print(f"{title}\t{value}", flush=True)


if __name__ == "__main__":
    main_rows(sys.argv[1:])
