import pytest

from reports.document.figures import ticks as ax


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
