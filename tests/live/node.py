"""A compiled model in node: its numbers as they stand and after edits."""

from __future__ import annotations

import json
import shutil
import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from reports.live.program import CALCULATOR, LiveProgram
from tests.conftest import missing

Edit = Mapping[str, float | str]
LEAST = 1e-11  # of a sum that is zero but for rounding
_MAIN = """
import {readFileSync} from "node:fs";
import {functions} from "./program.js";
import {calculator} from "./calculator.js";
const {data, edits} = JSON.parse(readFileSync("./data.json"));
const plain = value => typeof value === "string" || Number.isFinite(value) ? value : null;
const model = calculator({functions, ...data}), found = [], times = [];
const told = () => Object.fromEntries(model.keys().map(key => {
  const value = model.get(key);
  return [key, typeof value === "object" ? Array.from(value, plain) : plain(value)];
}));
found.push(told());
for (const edit of edits) {
  const began = performance.now();
  model.set(edit);
  model.keys().forEach(model.get);
  times.push(performance.now() - began);
  found.push(told());
}
console.log(JSON.stringify({found, times}));
"""


def calculated(program: LiveProgram, folder: Path, edits: Sequence[Edit] = ()) -> dict[str, Any]:
    """What stands at the start and after each edit, and how long each took [ms]."""
    node = shutil.which("node")
    if node is None:
        missing("node", "nodejs npm")
    for name, text in {
        "package.json": '{"type": "module"}',
        "calculator.js": CALCULATOR.read_text("utf-8"), "program.js": program.script(),
        "data.json": json.dumps({"data": program.data(), "edits": [*map(dict, edits)]}),
        "main.js": _MAIN,
    }.items():  # fmt: skip
        (folder / name).write_text(text, "utf-8")
    done = subprocess.run(
        [node, "main.js"], cwd=folder, capture_output=True, text=True, timeout=120, check=False
    )
    assert done.returncode == 0, done.stderr[:2000]
    collected: dict[str, Any] = json.loads(done.stdout)
    return collected


def distance(values: Any, others: Any) -> float:
    """How far apart values are, as a share of the greatest; texts and gaps are equal or not."""
    first, second = (np.atleast_1d(np.asarray(each, dtype=object)) for each in (values, others))
    if first.shape != second.shape:
        return np.inf
    if any(isinstance(each, str) for each in first):
        return 0.0 if list(first) == list(second) else np.inf
    first, second = (each.astype(float) for each in (first, second))  # None is a gap
    gaps = ~np.isfinite(first)
    if (gaps != ~np.isfinite(second)).any():
        return np.inf
    separate = np.abs(first - second)[~gaps].max(initial=0.0)
    most = np.abs(first[~gaps]).max(initial=0.0)
    return 0.0 if separate <= LEAST else float(separate / most) if most else np.inf
