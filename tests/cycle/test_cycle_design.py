"""Design mode: sizes from power, and what it refuses."""

import math
from dataclasses import replace

import pytest

from kshm.cycle.cycle import bore_for, cycle, design, round_to_series
from kshm.cycle.dizdn_listing import Listing
from kshm.cycle.inputs import FrictionLaw
from kshm.errors import CycleError
from reports.inputs.to_si.cycle import text_of
from tests.cycle.refusals import refused

LAWS = {"diesel": FrictionLaw(0.089e6, 0.0118e6), "petrol": FrictionLaw(0.024e6, 0.0053e6)}


@pytest.mark.parametrize("friction", ["efficiency", "law"])
def test_sizes_survive_the_round_trip(engine, friction):
    if friction == "law":
        engine = replace(engine, mechanical=LAWS[engine.kind])
    power = cycle(engine).effective.power_e
    actual = design(engine, power, engine.stroke / engine.bore)
    assert actual.bore_exact == pytest.approx(engine.bore, rel=1e-12)
    assert actual.stroke_exact == pytest.approx(engine.stroke, rel=1e-12)
    assert (actual.bore, actual.stroke) == (engine.bore, engine.stroke)
    assert actual.power_error == pytest.approx(0, abs=1e-12)


def test_listing_mode_survives_it_too(diesel):
    power = cycle(diesel, Listing()).effective.power_e
    actual = design(diesel, power, diesel.stroke / diesel.bore, listing=Listing())
    assert actual.bore_exact == pytest.approx(0.088, rel=1e-12)


def test_given_bore_and_stroke_do_not_matter(engine):
    bare = replace(engine, bore=None, stroke=None)
    assert design(bare, 60e3, 1.0) == design(engine, 60e3, 1.0)


def test_rounding_and_recalculation(engine):
    near = design(engine, 60e3, 1.0)
    up = design(engine, 60e3, 1.0, rounding="up")
    coarse = design(engine, 60e3, 1.0, step=0.005)
    assert abs(near.bore - near.bore_exact) <= 0.0005 + 1e-12
    assert up.bore_exact <= up.bore < up.bore_exact + 0.001
    assert up.power_error >= 0
    assert coarse.bore * 1000 % 5 == pytest.approx(0, abs=1e-9)
    assert near.cycle.effective.power_e == pytest.approx(60e3 * (1 + near.power_error))
    assert near.power_error == pytest.approx(
        near.bore**2 * near.stroke / (near.bore_exact**2 * near.stroke_exact) - 1, rel=1e-9
    )
    assert near.cycle.inputs.bore == near.bore


@pytest.mark.parametrize(
    ("size", "step", "rounding", "expected"),
    [
        (0.08779, 0.001, "nearest", 0.088),
        (0.0880, 0.001, "up", 0.088),
        (0.0880001, 0.001, "up", 0.089),
        (0.0873, 0.0005, "nearest", 0.0875),
        (0.0873, 0.005, "up", 0.090),
        (0.1000, 0.003, "nearest", 33 * 0.003),
        (0.1000, 0.003, "up", 34 * 0.003),
    ],
)
def test_series(size, step, rounding, expected):
    assert round_to_series(size, step, rounding) == expected


def test_bore_of_a_square_engine():
    assert bore_for(math.pi / 4 * 0.08**3, 1.0) == pytest.approx(0.08, rel=1e-14)


@pytest.mark.parametrize(
    ("power", "part"),
    [(2e3, "увеличьте мощность"), (40e6, "увеличьте число цилиндров")],
)
def test_no_bore_in_range(engine, power, part):
    with refused(part) as caught:
        design(engine, power, 1.0)
    assert caught.value.remark.field == "power"
    assert "мм" in text_of(caught.value.remark)
    assert "\n" not in text_of(caught.value.remark)


def test_the_refusal_names_power_and_bore(diesel):
    with pytest.raises(CycleError) as caught:
        design(diesel, 70e3, 1.068, bore_range=(0.1, 0.2))
    text = "N_e = 70 кВт требует D = 89,22 мм, допускается от 100 до 200 мм; увеличьте мощность"
    assert text in text_of(caught.value.remark)


def test_friction_that_leaves_nothing(gasoline):
    fast = replace(gasoline, omega=2000.0, mechanical=FrictionLaw(0.049e6, 0.0152e6))
    with refused("механические потери") as caught:
        design(fast, 300e3, 2.0)
    assert caught.value.remark.field == "mechanical"


@pytest.mark.parametrize(
    ("arguments", "field"),
    [((-5.0, 1.0), "power"), ((60e3, 9.0), "stroke_bore"), ((float("nan"), 1.0), "power")],
)
def test_arguments_out_of_range(engine, arguments, field):
    with pytest.raises(CycleError) as caught:
        design(engine, *arguments)
    assert caught.value.remark.field == field
