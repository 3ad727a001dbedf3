"""Marks of axes and where a name finds room."""

import numpy as np
import pytest

from reports.document.figures import axes as ax
from reports.document.figures.labels import (
    LabelField,
    box_at,
    dense,
    label_curve,
    label_point,
    shown,
)


def test_angle_marks():
    assert ax.angle_ticks(0, 720).texts[:3] == ("0", "60", "120")
    assert ax.angle_ticks(0, 360).texts[:3] == ("0", "30", "60")
    assert ax.angle_ticks(0, 720, step=90).places[-1] == 720
    assert ax.angle_ticks(0, 700).texts[-1] == ""


@pytest.mark.parametrize(
    ("low", "high", "texts"),
    [
        (-0.3, 0.9, ("−0,4", "−0,2", "0,0", "0,2", "0,4", "0,6", "0,8", "1,0")),
        (0, 13128, ("0", "2500", "5000", "7500", "10\u00a0000", "12\u00a0500", "15\u00a0000")),
        (0, 0.25, ("0,00", "0,05", "0,10", "0,15", "0,20", "0,25")),
        (5.0, 5.0, ("0", "1", "2", "3", "4", "5")),
    ],
)
def test_value_marks(low, high, texts):
    assert ax.value_ticks(low, high).texts == texts


def test_flat_curve_has_an_axis():
    ticks = ax.value_ticks(0.0, 0.0)
    assert ticks.low < 0 < ticks.high


def test_step_of_half_a_degree_is_written_with_its_decimals():
    assert ax.at_steps(-1, 3, 2.5).texts == ("−2,5", "0,0", "2,5")


def test_bounds_need_values():
    with pytest.raises(ValueError, match="пуста"):
        ax.bounds([[]])


def test_room_and_labels():
    room = LabelField((0, 0, 100, 100))
    room.curves.append(dense(np.array([[0.0, 50.0], [100.0, 50.0]])))
    assert not room.free((10, 45, 20, 55))
    assert room.free((10, 60, 20, 70))
    position = label_point(room, (50, 50), (10, 6), first=(0, 1))
    assert position is not None and position[1] > 53
    again = label_point(room, (50, 50), (10, 6), first=(0, 1))
    assert again != position
    assert label_point(LabelField((0, 0, 5, 5)), (2, 2), (10, 6)) is None
    assert box_at((0, 0), (10, 4), (1, 0), 2) == pytest.approx((2, -2, 12, 2))


def test_a_curve_is_named_beside_it():
    room = LabelField((0, 0, 100, 100))
    line = dense(np.array([[0.0, 50.0], [100.0, 50.0]]))
    room.curves.append(line)
    x, y = label_curve(room, line, [], (10, 6))
    assert 0 < x < 100 and abs(y - 50) > 3
    assert label_curve(LabelField((0, 0, 8, 8), [line]), line, [], (10, 6)) is None


def test_unpaired_dollar_is_refused():
    with pytest.raises(ValueError, match="Непарный"):
        shown("цена $5")


def test_names_of_two_curves_are_not_read_as_one():
    """Side by side on one line «без гасителя» and «с гасителем» would be one text."""
    room, size = LabelField((-20, 0, 220, 33)), (94, 8)  # no room above
    left, right = (dense(np.array([[x, 30.0], [x + 100, 30.0]])) for x in (0.0, 100.0))
    room.curves += [left, right]
    (x, y), (other_x, other_y) = (label_curve(room, line, [], size) for line in (left, right))
    assert y == other_y
    assert other_x - x >= size[0] + 8
