"""Fixtures of the cycle tests."""

import pytest

from kshm.cycle.inputs import CycleInputs
from tests.cycle.cycle_engines import ENGINES


@pytest.fixture(params=sorted(ENGINES))
def engine(request) -> CycleInputs:
    """Each kind of engine in turn."""
    return ENGINES[request.param]


@pytest.fixture
def diesel() -> CycleInputs:
    return ENGINES["turbo_diesel"]


@pytest.fixture
def gasoline() -> CycleInputs:
    return ENGINES["petrol"]


@pytest.fixture
def engines() -> dict[str, CycleInputs]:
    return dict(ENGINES)
