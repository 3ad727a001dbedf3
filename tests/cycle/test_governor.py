"""Governor's branch of a diesel: from the rated point to idling, fuel in a straight line."""

from __future__ import annotations

import numpy as np
import pytest

from kshm.cycle.governor import Governor, branch
from kshm.errors import CycleError
from reports.inputs.to_si.engine import engine_and_cycle
from tests.conftest import sample

RATED = 2200 * np.pi / 30


def test_ends_of_the_branch():
    governor = Governor(0.08, 0.28)
    top = governor.idling(RATED)
    assert 2 * (top - RATED) / (top + RATED) == pytest.approx(0.08)
    curves = branch(59.73e3, RATED, 14.97 / 3600, governor, np.array([0.0, 0.5, 1.0]))
    assert curves.torque == pytest.approx([59.73e3 / RATED, 59.73e3 / RATED / 2, 0.0])
    assert curves.fuel_flow * 3600 == pytest.approx([14.97, 9.581, 4.192], abs=5e-4)
    assert curves.consumption[0] * 3.6e9 == pytest.approx(14970 / 59.73, rel=1e-4)
    assert curves.consumption[-1] == 0.0


@pytest.mark.parametrize(("irregularity", "idle"), [(0.0, 0.3), (1.0, 0.3), (0.08, 1.0)])
def test_no_such_governor(irregularity: float, idle: float):
    with pytest.raises(CycleError):
        Governor(irregularity, idle)


@pytest.mark.parametrize(("name", "has"), [("cycle-tractor-diesel", True), ("cycle-petrol", False)])
def test_diesels_alone_have_the_branch(name: str, has: bool):
    _, run = engine_and_cycle(sample(name))
    assert (run.governor is not None) is has
