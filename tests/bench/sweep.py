"""A study: an engine that is read as a revision beside one that is read as a file."""

from __future__ import annotations

import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping, load_toml
from reports.inputs.revisions import Revisions
from reports.inputs.to_si.engine import engine_and_cycle
from reports.shared.resources import samples_dir
from reports.studies.sweep import SweepOptions
from reports.studies.sweep import sweep as run_sweep
from tests.bench._figure import Figure, interleaved, median, ratio
from tests.bench._process import run

MANY, SOME, SIDE = 100_000, 4000, 20
VARIED = ("geometry.bore_mm=84:92:{}", "masses.reciprocating_kg=1.8:2.6:{}")
BASE = samples_dir() / "gots-diesel.toml"


def figures() -> Iterator[Figure]:
    """Figures."""
    raw = to_mapping(load_toml(BASE).model)
    paths = (("geometry", "bore_mm"), ("masses", "reciprocating_kg"))
    rows = [(84 + 0.01 * number, 2.0) for number in range(200)]

    def files() -> None:
        for bore, mass in rows:
            raw["geometry"]["bore_mm"], raw["masses"]["reciprocating_kg"] = bore, mass
            engine_and_cycle(load_mapping(raw, source="a.toml").model)

    def revisions() -> None:
        revised = Revisions(raw, "a.toml", paths)
        for row in rows:
            revised.engine(row)

    costs = interleaved({"files": files, "revisions": revisions})
    name = "двигатель исследования: файлом / изменением"
    yield Figure(name, ratio(costs, "files", "revisions"), "раз")
    each = 1000 * median(costs["revisions"]) / len(rows)
    yield Figure("двигатель исследования: чтение изменения", each, "мс")
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder) / "study.parquet"
        vary = _vary(SOME)
        begin = time.process_time()
        points = run_sweep(BASE, vary, target, options=SweepOptions(jobs=1)).points
        spent = time.process_time() - begin
        yield Figure("исследование на одном ядре: двигатель", 1000 * spent / points, "мс")
        command = [sys.executable, "-m", "reports", "sweep", str(BASE), "-o", str(target)]
        cost = run([*command, *(word for text in _vary(MANY) for word in ("--vary", text))])
        yield Figure(f"исследование {MANY} двигателей на всех ядрах: время", cost.wall, "с")
        yield Figure(f"исследование {MANY} двигателей: память", cost.memory, "МБ")


def _vary(points: int) -> list[str]:
    counts = (points // SIDE, SIDE)
    return [text.format(count) for text, count in zip(VARIED, counts, strict=True)]
