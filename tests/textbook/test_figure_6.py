"""Figure 6, angle of the greatest speed and its ratio to the mean one; book: see ``book``.

The figure is drawn without numbers; the text gives its points: 77° at λ = 1/4, 1.57 for the
first order, and section 2.9 one more at λ = 0.317.
"""

from __future__ import annotations

import numpy as np
import pytest

from reports.validation.gots_text import figure_6
from tests.textbook.book import beyond, checks, recorded


@pytest.fixture(scope="module")
def figure() -> dict[str, np.ndarray]:
    return figure_6()


def at(figure: dict[str, np.ndarray], key: str, lam: float) -> float:
    return float(np.interp(lam, figure["lambda_value"], figure[key]))


def test_points_of_the_text() -> None:
    """77° and 1,57 at λ = 1/4."""
    assert len(checks("figure_6")) == 2
    assert beyond("figure_6") == recorded("figure_6") == set()


def test_first_order_ratio_is_the_same_whatever_lambda(figure: dict[str, np.ndarray]) -> None:
    assert np.ptp(figure["v1_ratio"]) < 1e-12


def test_angle_falls_and_ratio_rises_with_lambda(figure: dict[str, np.ndarray]) -> None:
    assert (np.diff(figure["phi_vmax_deg"]) < 0).all()
    assert (np.diff(figure["v_ratio"]) > 0).all()
    assert (figure["v_ratio"] > np.pi / 2).all()


def test_the_point_of_section_2_9(figure: dict[str, np.ndarray]) -> None:
    """λ = 0.317: 74°18′ (printed 74°25′, a misprint), vmax/cm = 22.625/(2·0.047·460.53/π)."""
    assert at(figure, "phi_vmax_deg", 0.317) == pytest.approx(74.3, abs=0.02)
    printed = 22.625 / (2 * 0.047 * 460.53 / np.pi)
    assert at(figure, "v_ratio", 0.317) == pytest.approx(printed, abs=0.001)
