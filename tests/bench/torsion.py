"""Forced torsional vibration beside numpy's bare batch of solves.

A train of ten masses at 1,000 speeds under 24 orders: 24,000 systems of ten complex equations.
On the other side stands ``numpy.linalg.solve`` on matrices that are there already; the solver
makes its own, eliminates, and gives torques and the energy balance besides.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from kshm.mechanics.torsion import Train, respond
from tests.bench._figure import Figure, interleaved, median, ratio

SPEEDS, ORDERS, MASSES = 1000, 24, 10


def figures() -> Iterator[Figure]:
    """Figures."""
    rng = np.random.default_rng(1)
    train = Train(rng.uniform(0.02, 2, MASSES), rng.uniform(5e5, 2e6, MASSES - 1))
    omega = np.linspace(100, 270, SPEEDS)[:, None] * np.arange(1, ORDERS + 1) / 2
    load = rng.normal(size=(MASSES, SPEEDS, ORDERS)) + 1j * rng.normal(
        size=(MASSES, SPEEDS, ORDERS)
    )
    damping = np.full(MASSES, 2.0)
    springs = np.diag(train.stiffnesses, 1)
    stiffness = np.diag(springs.sum(0) + springs.sum(1)) - springs - springs.T
    square = (omega**2)[..., None, None] * np.diag(train.inertias)
    matrices = stiffness * (1 + 0.035j) - square + 1j * omega[..., None, None] * np.diag(damping)
    right = np.moveaxis(load, 0, -1)[..., None]

    def bare() -> None:
        np.linalg.solve(matrices, right)

    def ours() -> None:
        respond(train, omega, load, damping, 0.035)

    times = interleaved({"bare": bare, "ours": ours}, rounds=5)
    what = f"{SPEEDS} частот × {ORDERS} порядков × {MASSES} масс"
    yield Figure(f"{what}, numpy.linalg.solve", median(times["bare"]), "с", "")
    yield Figure(f"{what}, вынужденные колебания", median(times["ours"]), "с", "")
    yield Figure("вынужденные колебания / numpy.linalg.solve", ratio(times, "ours", "bare"), "раз")
