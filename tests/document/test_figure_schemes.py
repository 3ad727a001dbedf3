"""Schemes of the mechanism, of the shaft and of the engine."""

import pytest

from reports.document.figures.mechanism import mechanism_sketch
from reports.document.figures.shaft import crank_scheme, engine_scheme
from tests.document.figure_samples import FIGURES, texts


def test_cranks_of_one_direction_share_a_ray():
    assert "1, 4" in texts(crank_scheme([0, 180, 180, 360]))


def test_engine_shows_rows_throws_and_strokes():
    said = texts(FIGURES["engine"]())
    assert {"1, 3", "2, 4", "1 (1)", "4 (2)", "720°"} <= set(said)


def test_what_cannot_be_drawn_is_refused():
    with pytest.raises(ValueError, match="λ"):
        mechanism_sketch(1.2)
    with pytest.raises(ValueError, match="колена"):
        crank_scheme([])
    with pytest.raises(ValueError, match="нет цилиндров"):
        engine_scheme([], [], [], [], 720.0)
