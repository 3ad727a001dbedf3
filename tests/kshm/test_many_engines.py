"""Many engines at once give what each gives alone, in chunks of any size."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from kshm.chain.solve import solve_batch, solve_chunks
from kshm.engine.engine import Engine
from kshm.mechanics import wear
from reports.inputs.to_si.engine import to_engine
from tests.conftest import sample

FIELDS = ("torque_sum", "journal", "pin_load", "running_pin_statics", "pin_wear", "local_phi")


def family(count: int) -> list[Engine]:
    """Engines that differ in speed, bore, shaft and, every third, in the timing."""
    base = to_engine(sample("gots-diesel"))
    first = base.crankshaft.throws[0]
    values = []
    for i in range(count):
        shaft = replace(
            base.crankshaft,
            throws=(
                replace(first, pin_mass=first.pin_mass + 0.01 * i),
                *base.crankshaft.throws[1:],
            ),
        )
        values.append(
            replace(
                base,
                omega=base.omega * (1 + 0.02 * i),
                geometry=replace(base.geometry, bore=base.geometry.bore * (1 + 0.01 * i)),
                crankshaft=shaft if i % 2 else base.crankshaft,
                gas=replace(base.gas, exhaust_open=base.gas.exhaust_open + 0.02 * (i % 3)),
                method="exact" if i % 4 == 3 else "textbook",
            )
        )
    return values


@pytest.mark.parametrize("size", [1, 3, 100])
def test_chunks_give_every_engine_what_it_gives_alone(size: int) -> None:
    built = family(7)
    chunks = list(solve_chunks(iter(built), size))
    assert [len(chunk.batch.engines) for chunk in chunks] == {
        1: [1] * 7, 3: [3, 3, 1], 100: [7]
    }[size]  # fmt: skip
    for name in FIELDS:
        together = np.concatenate([getattr(chunk, name) for chunk in chunks])
        for engine, values in zip(built, together, strict=True):
            alone = getattr(solve_batch([engine]), name)[0]
            np.testing.assert_allclose(values, alone, rtol=1e-12, atol=1e-12 * np.abs(alone).max())


def test_engines_may_fire_at_other_angles() -> None:
    base = to_engine(sample("gots-diesel"))
    other = replace(base, firing_offsets=tuple(t + 0.1 for t in base.firing_offsets))
    together = solve_batch([base, other])
    for index, engine in enumerate((base, other)):
        alone = solve_batch([engine])
        np.testing.assert_array_equal(together.local_phi[index], alone.local_phi[0])
        np.testing.assert_array_equal(together.torque_sum[index], alone.torque_sum[0])


@pytest.mark.parametrize("rays", [12, 18])
def test_sums_by_sectors_are_the_sums_of_the_table(rays: int) -> None:
    """Forces in all directions, those along rays and window edges among them."""
    degrees = np.concatenate([np.arange(0, 360, 5.0), np.random.default_rng(1).uniform(0, 360, 60)])
    turn = np.radians(degrees)
    size = np.linspace(1e5, 3e6, len(turn))
    up, against = size * np.cos(turn), size * np.sin(turn)
    up[7] = against[7] = 0.0
    vectors = np.array([up, up[::-1]]), np.array([against, against[::-1]])
    actual = wear.ray_sums(*vectors, np.hypot(*vectors), rays)
    listed = wear.ray_loads(*vectors, rays)[:, :-1].sum(axis=1)
    np.testing.assert_allclose(actual, listed, rtol=1e-12)
    assert np.ptp(actual) > 0
