"""Counts the functions that one input passes through: ``python -m tools.house.trace``.

A function counts if a local value of it, or what it returns, is the input itself in any unit, as a
number, a text or a short array.
"""

from __future__ import annotations

import re
import sys
import tempfile
from contextlib import suppress
from pathlib import Path
from types import FrameType

import numpy as np

ROOT = Path(__file__).parents[2]
KEY, VALUE, SI = "max_pressure_mpa", 10.5913371, 1e6  # a value that no other input has
SHORT = 4  # elements of an array that still stands for one value


def holds(value: object) -> bool:
    """Whether a value is the input."""
    if isinstance(value, str):
        return value == str(VALUE)
    if isinstance(value, np.ndarray):
        return value.dtype == float and value.size <= SHORT and any(map(holds, value.flat))
    return isinstance(value, float) and bool(
        np.isclose(value, [VALUE, VALUE * SI], rtol=1e-9, atol=0).any()
    )


def way() -> set[tuple[str, str]]:
    """Files and functions that the input meets between the file and its cell."""
    functions: set[tuple[str, str]] = set()

    def watch(frame: FrameType, event: str, result: object) -> None:
        path = Path(frame.f_code.co_filename)
        if event == "return" and path.is_relative_to(ROOT) and ".venv" not in path.parts:
            values = [result, *frame.f_locals.values()]
            if any(holds(value) for value in values):
                functions.add((str(path.relative_to(ROOT)), frame.f_code.co_qualname))

    source = (ROOT / "samples" / "gots-diesel.toml").read_text(encoding="utf-8")
    with tempfile.TemporaryDirectory() as folder:
        engine = Path(folder) / "engine.toml"
        engine.write_text(re.sub(rf"{KEY} = .*", f"{KEY} = {VALUE}", source), encoding="utf-8")
        from reports.cli import main

        sys.setprofile(watch)
        with suppress(SystemExit):
            main(["build", str(engine), "-o", folder, "--only", "xlsx"])
        sys.setprofile(None)
    return functions


if __name__ == "__main__":
    functions = way()
    print(f"{KEY}: {len({file for file, _ in functions})} files, {len(functions)} functions")
    for file, function in sorted(functions):
        print(f"  {file} {function}")
