"""Studies of the API: bands of tolerances, a value sought, an optimum; a study that goes on."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from pathlib import Path

import kshm
from reports.api import load
from reports.studies.sweep import SweepOptions
from reports.studies.sweep import sweep as run_sweep
from tests.bench._figure import Figure, interleaved, median, ratio
from tests.bench.sweep import BASE, SOME, vary_text


def figures() -> Iterator[Figure]:
    """Figures."""
    engine = load(BASE)

    def sought() -> None:
        kshm.solve_for(engine, "bore_mm", "M_mean", 125.0, between=(80.0, 100.0))

    def best() -> None:
        kshm.optimise(engine, {"reciprocating_kg": (1.5, 3.0)}, "Rpin_max")

    def bands() -> None:
        kshm.tolerance(engine, {"bore_mm": 0.02, "crank_radius_mm": 0.05}, samples=1000)

    costs = interleaved({"sought": sought, "best": best, "bands": bands})
    yield Figure("обратная задача: значение одного исходного", 1000 * median(costs["sought"]), "мс")
    yield Figure("наименьшее по одному исходному", 1000 * median(costs["best"]), "мс")
    yield Figure("допуски: 1000 двигателей", 1000 * median(costs["bands"]), "мс")
    with tempfile.TemporaryDirectory() as folder:
        vary = vary_text(SOME)

        def whole() -> None:
            run_sweep(BASE, vary, Path(folder) / "a.csv", options=SweepOptions(jobs=1))

        def resumed() -> None:
            run_sweep(BASE, vary, Path(folder) / "a.csv",
                      options=SweepOptions(jobs=1, resume=True))  # fmt: skip

        whole()
        costs = interleaved({"whole": whole, "resumed": resumed}, rounds=3)
        gain = ratio(costs, "whole", "resumed")
        yield Figure("исследование: заново / продолжение готового", gain, "раз")
