"""``python -m tests.live [NAME …]``: every sample and ten drawn engines in node and Chromium.

Each has four edits of all its free inputs at once; the page's numbers stand beside those of a new
build and of ``solve`` of the same edited input.
"""

from __future__ import annotations

import random
import sys
import tempfile
from collections.abc import Iterator, Mapping
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np

from kshm import solve
from reports.inputs.fields import key_text
from reports.inputs.load import load_remote
from reports.inputs.template import list_samples
from reports.inputs.to_si.engine import engine_and_cycle
from reports.live.page import live_page
from reports.live.program import program_of
from reports.model.blocks import Model
from reports.model.evaluation import Evaluation, evaluate_model
from reports.shared.errors import KshmError
from reports.tables.registry import build_model
from reports.web import engine
from reports.workbook.course import short_model
from reports.workbook.write import workbook_bytes
from tests.browser import chromium
from tests.cover import model_of
from tests.live.node import calculated, distance
from tests.referee.changes import Change, changed_everywhere

DRAWN, EDITS, SPREAD = 10, 4, 0.02
SET = """pairs => { const refused = [];
    document.getElementById("back").click();
    for (const [key, value] of pairs)
        try { kshm.set(key, value); } catch (e) { refused.push(e.message); }
    const began = performance.now();
    const values = kshm.keys().map(key => [key, kshm.get(key)]);
    return [Object.fromEntries(values), refused, performance.now() - began, kshm.time()]; }"""


def drawn(number: int) -> Model:
    """An engine of ``new`` by chance."""
    chance = random.Random(number)
    while True:
        layout = chance.choice(("inline", "v", "opposed"))
        cylinders = chance.choice((1, 2, 3, 4, 5, 6, 8) if layout == "inline" else (2, 4, 6, 8))
        form = {"cylinders": cylinders, "layout": layout, "strokes": chance.choice((4, 4, 2)),
                "kind": chance.choice(("diesel", "petrol")),
                "bore": round(chance.uniform(60, 150), 1)}  # fmt: skip
        try:
            return build_model(load_remote(engine.fresh(form)["raw"]).model)
        except KshmError:
            continue


def engines(names: list[str]) -> Iterator[tuple[str, Model]]:
    """Yield the engines of the comparison."""
    yield from ((name, model_of(name)) for name in names or list_samples())
    yield from ((f"drawn {i}", drawn(i)) for i in range(0 if names else DRAWN))


def worst(keys: list[str], wanted: Mapping[str, Any], actual: Mapping[str, Any]) -> float:
    """The greatest distance of a value, as a share of its column's greatest."""
    return max((distance(np.asarray(wanted[key]).tolist(), actual[key]) for key in keys), default=0)


def compared(name: str, model: Model, browser: Any, folder: Path) -> tuple[float, ...]:
    """Share that is compiled, worst of node, of Chromium, of ``solve``; milliseconds of an edit."""
    short = short_model(model)
    program = program_of(model, short.nodes)
    moving = [key for key in short.nodes if key not in program.fixed]
    edits = [changed_everywhere(model.input, random.Random(f"{name} {i}"), SPREAD)
             for i in range(EDITS)]  # fmt: skip
    base = {each.field.path: each.field for changes, _ in edits for each in changes}

    def values(changes: list[Change]) -> dict[str, Any]:
        """All that any edit changes, the rest as it was."""
        all_ = {field.path: (field, field.value) for field in base.values()}
        all_ |= {each.field.path: (each.field, each.value) for each in changes}
        return {field.name: (field.choices or {}).get(str(value), value)
                for field, value in all_.values()}  # fmt: skip

    node = calculated(program, folder, [values(changes) for changes, _ in edits])["found"][1:]
    path = folder / "live.html"
    path.write_bytes(live_page(model, workbook_bytes(short, evaluate_model(model)), name))
    page = browser.new_page(viewport={"width": 1366, "height": 800}, reduced_motion="reduce")
    page.goto(path.as_uri())
    page.wait_for_selector("#charts canvas")
    titles, far, times = page.evaluate("live.state.titles"), [0.0] * 3, []
    for (changes, changed), found in zip(edits, node, strict=True):
        build = Evaluation(build_model(changed))
        wanted = {key: build.value(key) for key in moving}
        pairs = [[key_text(each.field.path), each.value] for each in changes]
        actual, refused, *spent = page.evaluate(SET, [p for p in pairs if p[0] in titles])
        assert not refused, refused[:2]
        solution = solve(*engine_and_cycle(changed))
        scalars = [key for key in moving if key in solution.scalars]
        columns = {f"{table}.{key}": values for table, all_ in solution.columns.items()
                   for key, values in all_.items()}  # fmt: skip
        far = [max(pair) for pair in zip(far, (
            worst(moving, wanted, found), worst(moving, wanted, actual),
            max(worst(scalars, solution.scalars, actual),
                worst([key for key in moving if key in columns], columns, actual)),
        ), strict=True)]  # fmt: skip
        times.append(spent)
    page.close()
    return len(moving) / len(short.nodes), *far, median(t[0] for t in times), len(moving)


def main(names: list[str]) -> None:
    """Print a line an engine."""
    from playwright.sync_api import sync_playwright

    print("engine | compiled | node | Chromium | solve | all values, ms | values")
    with sync_playwright() as driver, tempfile.TemporaryDirectory(prefix="kshm-live-") as folder:
        browser = driver.chromium.launch(
            executable_path=chromium(), args=["--no-sandbox", "--disable-gpu"]
        )
        for name, model in engines(names):
            share, node, seen, solved, spent, count = compared(name, model, browser, Path(folder))
            print(f"{name} | {share:.1%} | {node:.1e} | {seen:.1e} | {solved:.1e} | "
                  f"{spent:.1f} | {count}", flush=True)  # fmt: skip
        browser.close()


if __name__ == "__main__":
    main(sys.argv[1:])
