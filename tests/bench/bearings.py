"""Orbits of four bearings with two clearances over three cycles: at most a second is promised."""

from __future__ import annotations

import time
from collections.abc import Iterator

import numpy as np

from kshm.mechanics.oil_orbit import orbits, squeeze_force
from reports.inputs.load import load_toml
from reports.inputs.solve_input import solved
from reports.shared.resources import samples_dir
from tests.bench._figure import Figure, interleaved, median

BEARINGS, CYCLES = 8, 3


def figures() -> Iterator[Figure]:
    """Figures."""
    phi = np.linspace(0, 4 * np.pi, 73)
    rng = np.random.default_rng(1)
    firing = 8 * np.exp(-((phi - 6.8) ** 2) / 0.05)
    loads = rng.uniform(0.7, 1.5, BEARINGS)[:, None] * (
        firing + 2 * np.exp(1j * phi) + np.exp(2j * phi)
    )
    half, width = np.full(loads.shape, 0.5), np.full(BEARINGS, 0.5)

    def ours() -> None:
        state = loads
        for _ in range(CYCLES - 2):
            orbits(phi, state, half, width, 1)
        orbits(phi, state, half, width, 2)

    times = interleaved({"ours": ours}, rounds=3)
    what = "орбиты: 4 подшипника × 2 зазора × 3 цикла"
    yield Figure(what, median(times["ours"]), "с", "не больше 1 с")
    yield from _again()
    yield from _map()


def _map() -> Iterator[Figure]:
    """The map of a width, which is solved once: well under a second is promised."""
    gamma, e = (each.ravel() for each in np.meshgrid(np.linspace(0, np.pi, 37),
                                                     np.tanh(np.linspace(0, 5, 33))))  # fmt: skip
    times = interleaved({"ours": lambda: squeeze_force(e, gamma, 0.5)}, rounds=3)
    what = "карта подвижности плёнки одного B/d"
    yield Figure(what, median(times["ours"]), "с", "не больше 0,5 с")


def _again() -> Iterator[Figure]:
    """What a build saves where the door, the sheets and the report ask for the same results."""
    model = load_toml(samples_dir() / "d-240-bearings.toml").model
    for wording in ("впервые", "снова"):
        start = time.process_time()
        solved(model)
        yield Figure(f"решение с орбитами, {wording}", time.process_time() - start, "с")
