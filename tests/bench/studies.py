"""Studies of the API: bands of tolerances, a value sought, an optimum."""

from __future__ import annotations

from collections.abc import Iterator

import kshm
from reports.api import load
from tests.bench._figure import Figure, interleaved, median
from tests.bench.sweep import BASE


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
