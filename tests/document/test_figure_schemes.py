"""Schemes of the mechanism, of the shaft and of the engine."""

import math
import re

import pytest

from reports.document.figures.mechanism import mechanism_sketch
from reports.document.figures.shaft import crank_scheme, engine_scheme
from tests.document.figure_samples import FIGURES, texts


def test_cranks_of_one_direction_share_a_ray():
    assert "1, 4" in texts(crank_scheme([0, 180, 180, 360]))


def test_both_halves_of_a_split_pin_are_drawn():
    """They were drawn as one, so that the scheme showed another shaft."""
    said = texts(crank_scheme([0, 120, 240], split=30.0))
    assert {"1л", "1п", "3л", "3п"} <= set(said)
    assert {"1л, 2п", "2л, 1п"} <= set(texts(crank_scheme([0, 180], split=180.0)))


@pytest.mark.parametrize("rays", [[0, 45, 180, 225], [0, 54, 72, 270], [0, 120, 240], [45]])
def test_the_letter_of_the_rotation_hides_no_ray(rays):
    """At 45° always, it cut in two the second ray of eight throws or of split pins."""
    svg = crank_scheme(rays)
    left, top, width, height = map(float, re.findall(
        r'<rect x="([\d.]+)" y="([\d.]+)" width="([\d.]+)" height="([\d.]+)" [^>]*>'
        '<text font-style="italic"[^>]*>ω', svg)[0])  # fmt: skip
    x, low = map(float, re.findall(r'd="M([\d.]+) ([\d.]+)C', svg)[-1])  # the axis, last drawn
    turn = math.degrees(math.atan2(left + width / 2 - x, low - 2.5 - top - height / 2))
    assert min(abs(math.remainder(turn - ray, 360)) for ray in rays) > 15


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
