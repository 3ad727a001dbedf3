"""Where several rays are loaded least, the oil hole stands opposite the middle of their arc."""

import numpy as np
import pytest

from kshm.results.case import least_loaded
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.model import blocks
from tests.conftest import sample
from tests.tables.test_two_statements import assert_agree


@pytest.mark.parametrize(
    ("unloaded", "ray"),
    [
        ((), 1),  # all alike: nothing tells
        ((4,), 4),
        ((4, 5), 4),
        ((5, 6, 7, 8, 9), 7),
        ((2, 6, 7, 8), 7),  # the widest
        ((11, 12, 1, 2, 3), 1),  # past the first ray
        ((10, 11, 12, 1), 11),
    ],
)
def test_the_middle_of_the_widest_unloaded_arc_is_taken(unloaded, ray):
    sums = np.full(12, 5e6)
    sums[np.array(unloaded, dtype=int) - 1] = 0
    actual, position = least_loaded(np.stack([sums, sums]))
    assert actual.tolist() == [ray, ray]
    assert np.degrees(position) == pytest.approx((30 * (ray - 1) + 180) % 360)


@pytest.mark.parametrize("size", [0.0, 5e6, 5e9])
def test_a_tie_is_the_same_in_both_statements_whatever_the_sums(size):
    tie = float(blocks.TIE) * 1e6  # of the formula, which counts in MPa
    for separate, ray in ((0.5 * tie, 4), (1.5 * tie, 3)):
        sums = np.full(12, size + 1e6)
        sums[[2, 3, 4]] = size, size + separate, size + separate
        assert least_loaded(sums)[0] == ray


def test_both_statements_take_it_whatever_the_step():
    for step in (10, 2):
        raw = to_mapping(sample("gots-diesel"))
        raw["calculation"]["step_deg"] = step
        raw["regime"]["speed_rpm"] = 6000  # a racer's pin is pressed from the axis outwards only
        model, solution = assert_agree(load_mapping(raw, source="t.toml").model)
        assert (solution.scalars["hole_pin_ray"], solution.scalars["hole_pin_deg"]) == (7, 0)
        assert {"hole_pin_ray", "hole_pin_deg"} <= set(model.scalars)
