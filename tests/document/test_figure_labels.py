import numpy as np
import pytest

from reports.document.figures.labels import Room, box_at, dense, label_curve, label_point, shown


def test_room_and_labels():
    room = Room((0, 0, 100, 100))
    room.curves.append(dense(np.array([[0.0, 50.0], [100.0, 50.0]])))
    assert not room.free((10, 45, 20, 55))
    assert room.free((10, 60, 20, 70))
    place = label_point(room, (50, 50), (10, 6), first=(0, 1))
    assert place is not None and place[1] > 53
    again = label_point(room, (50, 50), (10, 6), first=(0, 1))
    assert again != place
    assert label_point(Room((0, 0, 5, 5)), (2, 2), (10, 6)) is None
    assert box_at((0, 0), (10, 4), (1, 0), 2) == pytest.approx((2, -2, 12, 2))


def test_a_curve_is_named_beside_it():
    room = Room((0, 0, 100, 100))
    line = dense(np.array([[0.0, 50.0], [100.0, 50.0]]))
    room.curves.append(line)
    x, y = label_curve(room, line, [], (10, 6))
    assert 0 < x < 100 and abs(y - 50) > 3
    assert label_curve(Room((0, 0, 8, 8), [line]), line, [], (10, 6)) is None


def test_unpaired_dollar_is_refused():
    with pytest.raises(ValueError, match="Непарный"):
        shown("цена $5")


def test_names_of_two_curves_are_not_read_as_one():
    """Side by side on one line «без гасителя» and «с гасителем» would be one text."""
    room, size = Room((-20, 0, 220, 33)), (94, 8)  # no room above
    left, right = (dense(np.array([[x, 30.0], [x + 100, 30.0]])) for x in (0.0, 100.0))
    room.curves += [left, right]
    (x, y), (other_x, other_y) = (label_curve(room, line, [], size) for line in (left, right))
    assert y == other_y
    assert other_x - x >= size[0] + 8
