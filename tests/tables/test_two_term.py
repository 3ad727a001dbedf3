"""The sheet on the error of the two-term formulas."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from kshm import solve
from reports.inputs.to_si.engine import to_engine
from tests.conftest import sample


def test_errors_are_the_differences_and_vanish_with_lambda() -> None:
    engine = to_engine(sample("gots-diesel"))
    table = solve(engine).columns["two_term"]
    for key in ("s", "v", "j"):
        unit = {"s": "mm", "v": "m_s", "j": "m_s2"}[key]
        np.testing.assert_allclose(
            table[f"e{key}_{unit}"],
            table[f"e{key}_two_{unit}"] - table[f"e{key}_exact_{unit}"],
            atol=1e-9,
        )

    # The first term left out is of the third power of λ: half of it leaves an eighth.
    def greatest(lam: float) -> float:
        geometry = replace(engine.geometry, rod_length=engine.geometry.crank_radius / lam)
        return solve(replace(engine, geometry=geometry)).scalars["es_max"]

    assert greatest(0.3) / greatest(0.15) == pytest.approx(8, rel=0.05)


def test_known_error_at_90_degrees() -> None:
    """s(90°) = r(1 + λ/2) against r[1 + (1 − √(1 − λ²))/λ]."""
    engine = to_engine(sample("gots-diesel"))
    actual = solve(engine)
    r, lam = engine.geometry.crank_radius, engine.geometry.lam
    row = list(actual.columns["two_term"]["phi_deg"]).index(90)
    expected = r * (lam / 2 - (1 - np.sqrt(1 - lam**2)) / lam)
    assert actual.columns["two_term"]["es_mm"][row] == pytest.approx(1000 * expected, rel=1e-9)
    assert actual.scalars["phi_es_deg"] == 90


def test_torque_error_belongs_to_the_force_error() -> None:
    """M = T·F·r in the errors too; the sheet does not depend on the chosen method."""
    engine = to_engine(sample("gots-diesel"))
    one = solve(engine).columns["two_term"]
    other = solve(replace(engine, method="exact")).columns["two_term"]
    for key, values in one.items():
        np.testing.assert_array_equal(values, other[key])
    arm = engine.geometry.piston_area * engine.geometry.crank_radius * 1e6
    np.testing.assert_allclose(one["eM_Nm"], one["eT_MPa"] * arm, atol=1e-9)
    by_method = (
        solve(engine).columns["P4_1"]["Pj_MPa"]
        - solve(replace(engine, method="exact")).columns["P4_1"]["Pj_MPa"]
    )
    np.testing.assert_allclose(by_method[: len(one["phi_deg"])], one["ePj_MPa"], atol=1e-12)
