"""The solver beside the bare cost of its trigonometry.

A crank mechanism needs sin φ, cos φ, sin β and cos β of every cylinder at every angle, so
the measure is numpy's sin and cos of two arrays (engines × cylinders × angles), φ and β,
taken in the same chunks of engines: 4 × 3 × 73 values an engine for the textbook's diesel
with a table every 10°.  Nothing else is counted on that side, while the solver's side
gives all arrays of ``ChainArrays``: pressures, forces, torques, reactions of all
journals, crankpin loads and the sums of all wear diagrams.  The ten thousand engines differ in
speed, bore, length of the rod and reciprocating mass.
"""

from __future__ import annotations

import itertools
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from kshm import solve
from kshm.chain.solve import chunk_size, solve_batch, solve_chunks, solve_stacked
from kshm.chain.stack import stack
from kshm.engine.engine import Engine
from kshm.mechanics import wear
from reports.inputs.load import load_toml
from reports.inputs.to_si.engine import to_engine
from reports.shared.resources import samples_dir
from tests.bench._figure import Figure, interleaved, median, memory, ratio

SIDE = 10  # values of each of four keys


def base() -> Engine:
    """The textbook's diesel."""
    return to_engine(load_toml(samples_dir() / "gots-diesel.toml").model)


def family(side: int = SIDE) -> Iterator[Engine]:
    """Engines of a grid over four keys."""
    first = base()
    steps = np.linspace(0.8, 1.2, side)
    for speed, bore, rod, mass in itertools.product(steps, steps, steps, steps):
        geometry = replace(
            first.geometry,
            bore=first.geometry.bore * bore,
            rod_length=first.geometry.rod_length * rod,
        )
        masses = replace(first.masses, reciprocating=first.masses.reciprocating * mass)
        yield replace(first, omega=first.omega * speed, geometry=geometry, masses=masses)


def solve_all() -> None:
    """All engines, one chunk after another."""
    for _ in solve_chunks(family()):
        pass


_FIRST_RUN = """
import sys, time
import kshm.chain.solve as chain
from tests.bench.solver import family
chain.KEPT_BYTES = int(sys.argv[1]) or chain.KEPT_BYTES
engines = list(family())
begin = time.process_time()
for _ in chain.solve_chunks(engines):
    pass
print(time.process_time() - begin)
"""


def first_run(kept_bytes: int) -> float:
    """Seconds of the first study of a process that frees a block of that size before it."""
    command = [sys.executable, "-c", _FIRST_RUN, str(kept_bytes)]
    return float(subprocess.run(command, capture_output=True, text=True, check=True).stdout)


def figures() -> Iterator[Figure]:
    """Figures."""
    engines = list(family())
    one = engines[0]
    values = np.random.default_rng(1).uniform(0, 6, (one.cylinders, 73))

    def bare(count: int) -> None:
        phi = np.broadcast_to(values, (count, *values.shape)).copy()
        beta = phi / 20
        for part in (phi, beta):
            np.sin(part)
            np.cos(part)

    size = chunk_size(one)
    batches = [stack(engines[i : i + size]) for i in range(0, len(engines), size)]
    phi = [np.array(np.broadcast_to(values, (len(b.engines), *values.shape))) for b in batches]
    beta = [part / 20 for part in phi]

    def trigonometry() -> None:
        for part in itertools.chain(phi, beta):
            np.sin(part)
            np.cos(part)

    def from_arrays() -> None:
        for batch in batches:
            solve_stacked(batch)

    def from_objects() -> None:
        for _ in solve_chunks(engines):
            pass

    solve_all()
    times = interleaved(
        {"bare": trigonometry, "arrays": from_arrays, "objects": from_objects}, rounds=7
    )
    count = len(engines)
    for name, label in (
        ("bare", "один sin и cos φ и β"), ("arrays", "решение из массивов"),
        ("objects", "решение из объектов Engine"),
    ):  # fmt: skip
        yield Figure(f"{count} двигателей, {label}", median(times[name]), "с",
                     f"{median(times[name]) / count * 1e6:.1f} мкс на двигатель")  # fmt: skip
    yield Figure("решение из массивов / sin и cos", ratio(times, "arrays", "bare"), "раз",
                 "цель 4")  # fmt: skip
    yield Figure("решение из объектов Engine / sin и cos", ratio(times, "objects", "bare"), "раз")
    single = interleaved(
        {"bare": lambda: bare(1), "batch": lambda: solve_batch([one]),
         "tables": lambda: solve(one).columns}, rounds=51
    )  # fmt: skip
    yield Figure("один двигатель", median(single["batch"]) * 1e3, "мс")
    yield Figure("один двигатель / sin и cos", ratio(single, "batch", "bare"), "раз",
                 "почти всё время — вызовы numpy")  # fmt: skip
    yield Figure("один двигатель со всеми таблицами", median(single["tables"]) * 1e3, "мс")
    memory_kept = [(first_run(1), first_run(0)) for _ in range(5)]
    yield Figure("первое исследование без удержанной памяти / с нею",
                 median(without / kept for without, kept in memory_kept), "раз")  # fmt: skip
    raw = solve_batch(engines[:100])
    up, against, size = raw.pin_up, -raw.pin_side, raw.pin_load
    sums = interleaved(
        {"rays": lambda: wear.ray_loads(up, against, 12)[..., :-1, :].sum(axis=-2),
         "sectors": lambda: wear.ray_sums(up, against, size, 12)}
    )  # fmt: skip
    yield Figure("износ по лучам / по секторам", ratio(sums, "rays", "sectors"), "раз")
    yield memory(f"{count} двигателей", "from tests.bench.solver import solve_all; solve_all()")
