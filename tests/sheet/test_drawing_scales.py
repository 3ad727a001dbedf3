"""Where an angle points, which scales a drawing may have, which an axis of angles."""

import pytest

from reports.drawing.primitives import polar
from reports.drawing.scales import round_scale
from reports.sheet.parts import _SCALES, _said

# ГОСТ 2.302: enlargements and reductions.
ENLARGED = ("50", "40", "20", "10", "5", "4", "2,5", "2")
REDUCED = ("2", "2,5", "4", "5", "10", "15", "20", "25", "40", "50", "75", "100")


def test_angles_go_clockwise_from_the_vertical():
    assert polar((1, 2), 3, 0) == (1, 5)
    assert polar((1, 2), 3, 90) == pytest.approx((4, 2))
    assert polar((1, 2), 3, 120) == pytest.approx((1 + 3 * 0.75**0.5, 0.5))


def test_scales_are_those_of_the_standard_from_the_largest():
    named = {f"М {n}:1" for n in ENLARGED} | {f"М 1:{n}" for n in ("1", *REDUCED)}
    assert {_said(scale) for scale in _SCALES} <= named
    assert sorted(set(_SCALES), reverse=True) == list(_SCALES)


@pytest.mark.parametrize(("room", "unit"), [(720, 0.5), (719, 1.0), (100, 4.0), (18, 20.0)])
def test_an_axis_of_angles_has_the_largest_scale_that_fits(room, unit):
    assert round_scale(0.0, 360.0, room, angle=True).unit == unit


@pytest.mark.parametrize(("high", "unit"), [(200.0, 2.0), (200.1, 2.5), (1.5, 0.015), (-40.0, 1.0)])
def test_values_that_fit_exactly_have_the_scale_at_which_they_do(high, unit):
    low = min(high, 0.0) - 60.0 if high < 0 else 0.0
    assert round_scale(low, max(high, 0.0), 100.0).unit == pytest.approx(unit)
