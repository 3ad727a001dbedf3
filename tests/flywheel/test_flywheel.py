"""The flywheel as a part: both statements, its numbers by summing rings, speed of the rim."""

from __future__ import annotations

import numpy as np
import pytest

from kshm.mechanics.flywheel import FlywheelRing, rim_stress
from kshm.results.solution import solve
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.inputs.to_si.engine import to_engine
from reports.model.evaluation import evaluate_model
from reports.tables.registry import build_model
from tests.conftest import sample


def test_ring_by_summing_thin_ones():
    ring = FlywheelRing(0.2632, 0.20003, 0.0575, 7200.0)
    r = np.linspace(ring.bore / 2, ring.outer / 2, 20001)
    per_radius = 2 * np.pi * ring.density * ring.width
    assert ring.mass == pytest.approx(per_radius * np.trapezoid(r, r), rel=1e-8)
    assert ring.inertia == pytest.approx(per_radius * np.trapezoid(r**3, r), rel=1e-7)
    assert rim_stress(7200.0, 66.7) == pytest.approx(32.03e6, rel=1e-3)


@pytest.mark.parametrize("section", [{}, {"material": "steel", "outer_mm": 300.0, "disc_mm": 20.0}])
@pytest.mark.parametrize("name", ["gots-diesel", "vw-1600", "two-stroke", "yamz-238"])
def test_both_statements_agree(name: str, section: dict[str, object]):
    raw = to_mapping(sample(name)) | {"flywheel": section}
    model = load_mapping(raw, source="").model
    values, actual = evaluate_model(build_model(model)).scalars, solve(to_engine(model)).scalars
    numbers = {key: each for key, each in actual.items() if key.startswith("fw_")}
    assert len(numbers) == 13
    for key, each in numbers.items():
        assert values[key] == pytest.approx(each, rel=1e-9), key
    # The rim is as narrow as the needed inertia lets it be.
    wide = numbers["fw_rim_mm"] > numbers["fw_disc_mm"] + 1e-9
    assert numbers["fw_I"] == pytest.approx(actual["I_flywheel"]) if wide else True
    assert numbers["fw_outer_most_mm"] / numbers["fw_outer_mm"] == pytest.approx(
        numbers["fw_limit"] / numbers["fw_speed"]
    )
