"""Figure 6, angle of the greatest speed and its ratio to the mean one; book: see ``book``.

The figure is drawn without numbers; the text gives its points: 77° at λ = 1/4, 1.57 for the
first order, and section 2.9 one more at λ = 0.317.
"""

from __future__ import annotations

import numpy as np
import pytest

from kshm import solve
from reports.inputs.convert import to_engine
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from tests.conftest import sample


@pytest.fixture(scope="module")
def figure() -> dict[str, np.ndarray]:
    raw = to_mapping(sample("gots-p3"))
    raw["reference"] = {}
    return solve(to_engine(load_mapping(raw, source="6").model)).columns["ref_fig6"]


def at(figure: dict[str, np.ndarray], key: str, lam: float) -> float:
    return float(np.interp(lam, figure["lambda_value"], figure[key]))


def test_angle_at_a_quarter_is_77_degrees(figure: dict[str, np.ndarray]) -> None:
    assert round(at(figure, "phi_vmax_deg", 0.25)) == 77


def test_first_order_ratio_is_1_57_whatever_lambda(figure: dict[str, np.ndarray]) -> None:
    assert set(np.round(figure["v1_ratio"], 2)) == {1.57}


def test_angle_falls_and_ratio_rises_with_lambda(figure: dict[str, np.ndarray]) -> None:
    assert (np.diff(figure["phi_vmax_deg"]) < 0).all()
    assert (np.diff(figure["v_ratio"]) > 0).all()
    assert (figure["v_ratio"] > np.pi / 2).all()


def test_the_point_of_section_2_9(figure: dict[str, np.ndarray]) -> None:
    """λ = 0.317: 74°18′ (printed 74°25′, a misprint), vmax/cm = 22.625/(2·0.047·460.53/π)."""
    assert at(figure, "phi_vmax_deg", 0.317) == pytest.approx(74.3, abs=0.02)
    printed = 22.625 / (2 * 0.047 * 460.53 / np.pi)
    assert at(figure, "v_ratio", 0.317) == pytest.approx(printed, abs=0.001)
