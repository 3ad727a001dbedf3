"""Schemes of the mechanism, of the shaft and of the engine."""

import re

import pytest

from reports.document.figures.mechanism import mechanism_sketch
from reports.document.figures.shaft import crank_scheme, engine_scheme
from tests.document.figure_samples import FIGURES, texts


def test_cranks_of_one_direction_share_a_ray():
    assert "1, 4" in texts(crank_scheme([0, 180, 180, 360]))


def test_engine_shows_rows_throws_and_strokes():
    said = texts(FIGURES["engine"]())
    assert {"1, 3", "2, 4", "1 (1)", "4 (2)", "720°"} <= set(said)


def test_cylinders_of_a_narrow_engine_do_not_cover_one_another():
    """Of 15° between the banks the right one hid a number of the left."""
    rods, thirds = [1, 2, 3] * 2, [0.0, 240.0, 120.0]
    svg = engine_scheme([0.0] * 3 + [15.0] * 3, rods, thirds, [120.0 * n for n in range(6)], 720.0)
    boxes = [
        [float(x) for x in re.findall(r"[ML](-?[\d.]+) ", path)]
        for path in re.findall(r'<path d="([^"]+)z" fill="#e4e4e4"', svg)[:2]
    ]
    assert max(boxes[0]) < min(boxes[1])
    places = dict(re.findall(r'<text x="([\d.]+)"[^>]*>(\d, \d, \d)</text>', svg))
    (left, _), (right, _) = sorted(((float(x), text) for x, text in places.items()))
    assert left < min(boxes[0]) and right > max(boxes[1])


def test_what_cannot_be_drawn_is_refused():
    with pytest.raises(ValueError, match="λ"):
        mechanism_sketch(1.2)
    with pytest.raises(ValueError, match="колена"):
        crank_scheme([])
    with pytest.raises(ValueError, match="нет цилиндров"):
        engine_scheme([], [], [], [], 720.0)
