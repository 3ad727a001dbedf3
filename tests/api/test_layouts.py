"""Engines of every layout from the public names: rods on a pin, banks, sizes of journals."""

from __future__ import annotations

import math
import re
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import kshm
from kshm import articulated_rod, assemble, banks, opposed, place, points, solve, throw

GAS = points([0, 300, 360, 370, 500, 720], [0.1, 0.4, 4.0, 6.0, 0.4, 0.1])
THROW = throw(arms_mm=[30, 25, 12, 14, 25, 32], web_kg=0.8, pin_kg=0.5, counterweight_kg=0.6,
              web_angle_deg=3, counterweight_angle_deg=8, web_thickness_mm=4)  # fmt: skip
ROD = articulated_rod(
    rod_length_mm=120, radius_mm=38, angle_deg=72, reciprocating_kg=0.8, big_end_kg=0.4
)


def made(places: Any, offsets: Any, **changes: Any) -> kshm.Engine:
    numbers: dict[str, Any] = {
        "bore_mm": 80, "crank_radius_mm": 40, "rod_length_mm": 160, "compression_ratio": 9,
        "speed_rpm": 3000, "gas": GAS, "reciprocating_kg": 0.7, "rod_big_end_kg": 0.5,
        "pin_diameter_mm": 45, "pin_length_mm": 40, "main_diameter_mm": 50, "main_lengths_mm": 28,
        "throws": THROW, "step_deg": 30,
    }  # fmt: skip
    return assemble(places, firing_offsets_deg=offsets, **(numbers | changes))


def fired(throws: list[float], axes: list[float], turns: list[int]) -> list[float]:
    """Offsets of banks on throws at the angles: θ = axis − γ, a turn later where asked."""
    plain = [axis - axes[0] - angle for axis in axes for angle in throws]
    return [offset % 360 + 360 * turn for offset, turn in zip(plain, turns, strict=True)]


V16 = made(banks(8, [0, 45]), fired([0, 90, 270, 180, 180, 270, 90, 0], [0, 45], [0, 1] * 8))
W12 = made(banks(4, [-60, 0, 60]), fired([0, 180, 180, 0], [-60, 0, 60], [0, 1, 0, 1] * 3))
RADIAL = made(banks(1, [0, 72, 144, 216, 288], articulated=True),
              [0, 72 + 360, 144, 216 + 360, 288],
              articulated=[articulated_rod(rod_length_mm=120, radius_mm=38, angle_deg=72 * i,
                                           reciprocating_kg=0.8, big_end_kg=0.4)
                           for i in range(1, 5)])  # fmt: skip
FORKED = made(banks(1, [0, 120, 240]), [0, 120, 240])
BOXER = made(opposed(4), [0, 180, 180, 360])
NARROW = made(banks(3, [0, 15], pins_deg=[0, -22]), fired([0, 240, 120], [0, 15 + 22], [0, 1] * 3),
              crank_offset_mm=3)  # fmt: skip
ENGINES = {
    "V16": V16, "W12": W12, "radial": RADIAL, "three rods": FORKED, "boxer": BOXER, "VR6": NARROW,
}  # fmt: skip


def forces_balance(engine: kshm.Engine) -> None:
    """Bearings answer every rod and every turning mass in force and moment, from vectors."""
    raw = solve(engine).raw
    batch, area = raw.batch, engine.geometry.piston_area
    unit = engine.geometry.crank_radius * engine.omega**2
    force, moment = np.zeros((2, raw.phi.size)), np.zeros((2, raw.phi.size))
    starts = np.concatenate([[0], np.cumsum([t.length for t in engine.crankshaft.throws])])

    def add(at: float, angle: float, along: Any, ahead: Any) -> None:
        """A force along a crank at ``angle`` and in its direction of rotation; x left, y up."""
        vector = np.array([
            -np.sin(angle) * along - np.cos(angle) * ahead,
            np.cos(angle) * along - np.sin(angle) * ahead,
        ])  # fmt: skip
        force[:] += vector.reshape(2, -1)
        moment[:] += at * vector.reshape(2, -1)

    for i, cylinder in enumerate(engine.arrangement):
        one = engine.crankshaft.throws[cylinder.throw]
        l1, l2, l3, l4, *_ = one.arms
        rod = l1 + one.left_web_thickness + l2
        start, angle = starts[cylinder.throw], one.angle + cylinder.pin_angle
        at = start + rod + cylinder.rod_place * (l3 + l4)
        add(at, angle, batch.pin_mass[0, i, 0] * unit - raw.K[0, i] * area, raw.T[0, i] * area)
        rods = sum(c.throw == cylinder.throw for c in engine.arrangement)
        add(start + rod + l3, angle, one.pin_mass * unit / rods, 0.0)
    for start, one in zip(starts, engine.crankshaft.throws, strict=False):
        thick = one.left_web_thickness
        webs = ((one.left_web, one.arms[0] + thick / 2),
                (one.right_web, one.length - one.arms[5] - thick / 2))  # fmt: skip
        for web, at in webs:
            add(start + at, one.angle - web.angle, web.mass * unit, 0.0)
            opposite = one.angle + math.pi + web.counterweight_angle
            add(start + at, opposite, web.counterweight_mass * unit, 0.0)
    reactions = raw.journal[0] * area
    scale = np.abs(reactions).max()
    np.testing.assert_allclose(reactions.sum(axis=0).T, -force, atol=1e-9 * scale)
    turning = np.einsum("k,kad->da", starts, reactions)
    np.testing.assert_allclose(turning, -moment, atol=1e-9 * scale * starts[-1])


def everything_is_finite(engine: kshm.Engine) -> None:
    solution = solve(engine)
    for table, columns in solution.columns.items():
        for key, values in columns.items():
            assert np.isfinite(values).all(), (table, key)
    for key, value in solution.scalars.items():
        assert np.isfinite(value), key
    torque = solution.columns["P4_2"]
    each = [torque[f"M{i + 1}_Nm"] for i in range(engine.cylinders)]
    np.testing.assert_allclose(torque["Msum_Nm"], np.sum(each, axis=0), atol=1e-9)


@pytest.mark.parametrize("name", ENGINES)
def test_engines_of_every_layout_are_solved(name: str) -> None:
    everything_is_finite(ENGINES[name])
    forces_balance(ENGINES[name])


def test_three_rods_on_a_pin_have_their_columns() -> None:
    table = solve(FORKED).columns["rods_1"]
    rods = [key for key in table if key.startswith(("Trod", "Krod"))]
    assert rods == ["Trod1_MPa", "Krod1_MPa", "Trod2_MPa", "Krod2_MPa", "Trod3_MPa", "Krod3_MPa"]
    np.testing.assert_allclose(table["T_MPa"], sum(table[f"Trod{i}_MPa"] for i in (1, 2, 3)))


def test_a_radial_engine_is_its_master_and_what_hangs_on_it() -> None:
    """Pistons of all cylinders have the same displacement where the knuckle pins allow it."""
    raw = solve(RADIAL).raw
    assert raw.hung is not None
    assert raw.hung.stroke.shape == (1, 4, 1)
    # Mirror images of each other: cylinders 2 and 5, 3 and 4.
    strokes = raw.hung.stroke[0, :, 0]
    np.testing.assert_allclose(strokes, strokes[::-1], rtol=1e-9)
    assert solve(RADIAL).scalars["V_engine"] == pytest.approx(
        1e3 * RADIAL.geometry.piston_area * (0.08 + strokes.sum())
    )


@st.composite
def layouts(draw: st.DrawFn) -> kshm.Engine:
    """Any number of banks and throws, plain, split or articulated, with or without an offset."""
    count, throws = draw(st.integers(1, 5)), draw(st.integers(1, 4))
    axes = [0.0, *(float(draw(st.integers(0, 350))) for _ in range(count - 1))]
    kind = draw(st.sampled_from(["plain", "split", "articulated"]))
    split = None
    if kind == "split":
        split = [0.0, *(float(draw(st.integers(-40, 40))) for _ in range(count - 1))]
    places = banks(throws, axes, pins_deg=split, articulated=kind == "articulated")
    cranks = [0.0, *(float(draw(st.integers(0, 359))) for _ in range(throws - 1))]
    pins = [axis - turn for axis, turn in zip(axes, split or [0.0] * count, strict=True)]
    turns = [0, *(draw(st.integers(0, 1)) for _ in range(count * throws - 1))]
    number = st.floats(20, 60)
    rods = [
        articulated_rod(rod_length_mm=draw(st.floats(110, 150)), radius_mm=draw(st.floats(0, 35)),
                        angle_deg=axes[i // throws + 1] + draw(st.floats(-9, 9)),
                        reciprocating_kg=0.8, big_end_kg=0.4)
        for i in range((count - 1) * throws)
    ] if kind == "articulated" else []  # fmt: skip
    return made(
        places, fired(cranks, pins, turns), articulated=rods,
        pin_diameter_mm=[draw(number) for _ in range(throws)],
        main_lengths_mm=[draw(number) for _ in range(throws + 1)],
        crank_offset_mm=draw(st.none() | st.floats(-6, 6)),
        method=draw(st.sampled_from(["textbook", "exact"])),
    )  # fmt: skip


@settings(max_examples=40, deadline=None)
@given(layouts())
def test_random_layouts_balance_and_are_finite(engine: kshm.Engine) -> None:
    everything_is_finite(engine)
    forces_balance(engine)


def test_every_journal_has_its_own_size() -> None:
    places, offsets = banks(2, [0, 90]), fired([0, 180], [0, 90], [0, 1, 1, 0])
    same = solve(made(places, offsets)).scalars
    sizes: dict[str, Any] = {
        "pin_diameter_mm": [45, 90],
        "pin_length_mm": [40, 20],
        "main_diameter_mm": [50, 25, 50],
        "main_lengths_mm": [28, 28, 14],
    }
    other = solve(made(places, offsets, **sizes)).scalars
    for key, factor in (("q_pin_max", 1), ("q_pin2_max", 1), ("q_main1_max", 1),
                        ("q_main2_max", 2), ("q_main3_mean", 2)):  # fmt: skip
        assert other[key] == pytest.approx(factor * same[key]), key
    assert other["Rmain2_max"] == same["Rmain2_max"]
    wide = solve(made(places, offsets, pin_diameter_mm=[45, 90])).scalars
    assert wide["q_pin2_max"] == pytest.approx(same["q_pin2_max"] / 2)
    assert wide["I_engine_mean"] > same["I_engine_mean"]
    assert wide["I_crank"] == same["I_crank"]


def one(**changes: Any) -> kshm.Engine:
    return made(None, [0.0], **changes)


REFUSED = {
    "mass": ({"reciprocating_kg": math.nan}, "reciprocating: must be not negative, not nan"),
    "infinite mass": ({"rod_big_end_kg": math.inf}, "rod_big_end: must be not negative, not inf"),
    "size": ({"bore_mm": math.nan}, "bore: must be positive, not nan"),
    "no size": ({"main_lengths_mm": [28, 0]}, "main_lengths: must be positive, not 0"),
    "journals": ({"main_lengths_mm": [28]}, "need a main journal more, not 1"),
    "pins": ({"pin_length_mm": [28, 28]}, "need a crankpin each, not 2"),
    "speed": ({"speed_rpm": -1}, "omega: must be positive"),
    "method": ({"method": "Exact"}, "the method is 'textbook' or 'exact', not 'Exact'"),
    "efficiency": ({"mechanical_efficiency": 79}, "from 0 to 1, not 79"),
    "no efficiency": ({"mechanical_efficiency": 0}, "must be above 0"),
    "short gas": ({"gas": points([0, 360, 540], [0.1, 4, 0.1])}, "must end with the cycle at 720°"),
    "two strokes": ({"strokes": 2}, "must end with the cycle at 360°"),
    "ratio": ({"compression_ratio": 1}, "compression ratio must be above 1"),
    "rod": ({"rod_length_mm": 41, "crank_offset_mm": 2}, "longer than the crank and the offset"),
    "throws": ({"throws": [THROW, THROW]}, "1 cylinders need throws for 1, not 2"),
    "hung": ({"articulated": [ROD]}, "0 articulated rods must be described, not 1"),
}


def assert_refused(changes: dict[str, Any], said: str) -> None:
    with pytest.raises(ValueError, match=said) as caught:
        one(**changes)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(("changes", "said"), REFUSED.values(), ids=REFUSED)
def test_what_no_engine_can_be_is_refused_in_a_line(changes: dict[str, Any], said: str) -> None:
    assert_refused(changes, said)


def test_layouts_that_cannot_be_are_refused() -> None:
    for places, offsets, said in (
        (banks(1, [0, 60]), [0, 30], "cylinder 2 fires where throw 1 stands 30° apart"),
        ((place(0), place(2)), [0, 360], "a throw of 3 carries no rod"),
        (banks(2, [0, 60]), [0, 180], "4 places need as many firing offsets, not 2"),
        ((place(0), place(0, master=1)), [0, 0], "on the same throw whose rod hangs"),
    ):
        with pytest.raises(ValueError, match=said):
            made(places, offsets, articulated=ROD)
    with pytest.raises(ValueError, match="pressures: must be positive, not nan"):
        points([0, 360, 720], [0.1, math.nan, 0.1])
    with pytest.raises(ValueError, match="mass: must be not negative"):
        throw(arms_mm=[30] * 6, web_kg=math.nan, pin_kg=0.2)


HUNG = {
    "rod_length_mm": 120, "radius_mm": 38, "angle_deg": 60, "reciprocating_kg": 0.8,
    "big_end_kg": 0.4,
}  # fmt: skip
DIAGRAM = {
    "intake_mpa": 0.1, "residual_mpa": 0.11, "max_mpa": 8, "compression_exponent": 1.35,
    "expansion_exponent": 1.28, "combustion_start_deg": 350, "injection_advance_deg": 20,
    "exhaust_open_deg": 490, "exhaust_close_deg": 560,
}  # fmt: skip
WRONG_KINDS = {
    "a text": ({"bore_mm": "80"}, "bore_mm: must be a number, not '80'"),
    "nothing": ({"rod_length_mm": None}, "rod_length_mm: must be a number, not None"),
    "a list": ({"reciprocating_kg": [1, 2]}, r"reciprocating_kg: must be a number, not \[1, 2\]"),
    "an array": ({"speed_rpm": np.ones(2)}, "speed_rpm: must be a number, not array"),
    "complex": ({"fullness": 1j}, "fullness: must be a number, not 1j"),
    "half a degree": ({"step_deg": 7.5}, "step_deg: must be a whole number, not 7.5"),
    "gas": ({"gas": THROW}, "gas: must be PolytropicGas or .*, not Throw"),
    "nose": ({"nose": (1, 2, 3)}, "nose: must be EndMass, not"),
    "throws": ({"throws": [{}]}, "throws: must be Throw or a list, each Throw, not"),
    "sizes": ({"pin_length_mm": "45"}, "pin_length_mm: must be a number or a list, each a number"),
}


@pytest.mark.parametrize(("changes", "said"), WRONG_KINDS.values(), ids=WRONG_KINDS)
def test_what_is_no_number_is_refused_by_its_name(changes: dict[str, Any], said: str) -> None:
    assert_refused(changes, said)


def test_lists_that_are_none_are_refused_by_their_names() -> None:
    for offsets in ("0", 0, None, [[0, 180]]):
        with pytest.raises(ValueError, match="firing_offsets_deg: must be a list, each a number"):
            made(None, offsets)
    with pytest.raises(ValueError, match="places: must be a list, each Cylinder"):
        made((0, 1), [0, 360])
    with pytest.raises(ValueError, match="three or more"):
        points([], [])
    with pytest.raises(ValueError, match="2 banks need a part of the pin each, not 1"):
        banks(2, [0, 60], pins_deg=[0])
    with pytest.raises(ValueError, match="an engine has a bank"):
        banks(2, [])
    with pytest.raises(ValueError, match="engine: must be Engine, not"):
        solve({})  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="unexpected keyword argument 'bore'"):
        one(bore=80)
    assert made([place(0), place(1)], [0, 360]).is_in_line


@pytest.mark.parametrize("step", [8, 16, 24, 40, 72, 90, 180, 360, 720])
def test_steps_that_leave_a_turn_or_its_orders_unfinished_are_refused(step: int) -> None:
    with pytest.raises(ValueError, match=f"must divide 180° and be at most 60°, not {step}"):
        one(step_deg=step)


@pytest.mark.parametrize("step", [1, 4, 9, 12, 18, 20, 36, 45, 60])
def test_steps_that_divide_half_a_turn_are_solved(step: int) -> None:
    everything_is_finite(one(step_deg=step))


def test_articulated_rods_that_cannot_be_are_refused() -> None:
    def fan(places: Any, offsets: Any, **changes: Any) -> kshm.Engine:
        return made(places, offsets, articulated=articulated_rod(**(HUNG | changes)))

    pair = banks(1, [0, 60], articulated=True)
    everything_is_finite(fan(pair, [0, 60]))
    for changes, said in (
        ({"rod_length_mm": 20}, "articulated rod of cylinder 2 is 20 mm long: .* 36.* mm off"),
        ({"radius_mm": 138, "angle_deg": 200}, "articulated rod of cylinder 2 is 120 mm long"),
    ):
        with pytest.raises(ValueError, match=said):
            fan(pair, [0, 60], **changes)
    with pytest.raises(ValueError, match="on no other: cylinder 2"):
        fan((place(0), place(1, master=0)), [0, 360])
    with pytest.raises(ValueError, match="have no part of a split pin"):
        banks(1, [0, 60], pins_deg=[0, 10], articulated=True)


def test_places_and_numbers_that_cannot_be_are_refused() -> None:
    with pytest.raises(ValueError, match="rod_place must be from 0 to 1, not 5"):
        place(0, rod_place=5)
    for count in (5, 0, -2):
        with pytest.raises(ValueError, match=f"has pairs of cylinders, not {count}"):
            opposed(count)
    with pytest.raises(ValueError, match="reciprocating: must be positive, not 0"):
        one(reciprocating_kg=0)
    with pytest.raises(ValueError, match="indicated_power: must be positive, not 0"):
        one(indicated_power_kw=0)


@pytest.mark.parametrize(("changes", "strokes", "said"), [
    ({"combustion_start_deg": 6.1}, 4, "combustion starts at 180° … 360° .*, not at 6.1°"),
    ({"exhaust_open_deg": 560, "exhaust_close_deg": 490}, 4, "from 360° to 720°, not at 560°"),
    ({}, 2, "from 0° to 360°, not at 490° and 560°"),
    ({"exhaust_open_deg": 100, "exhaust_close_deg": 240}, 2, "scavenging .* while the exhaust"),
])  # fmt: skip
def test_timing_outside_the_cycle_is_refused(
    changes: dict[str, float], strokes: int, said: str
) -> None:
    gas = kshm.polytropic(**(DIAGRAM | changes))  # type: ignore[arg-type]
    with pytest.raises(ValueError, match=said):
        one(gas=gas, strokes=strokes)


@pytest.mark.parametrize(("changes", "said"), [
    ({"bore_mm": 0.08}, "stroke over bore is 1e\\+03, .* millimetres"),
    ({"speed_rpm": 3000 / 9.55}, "mean piston speed is 0.838 m/s, .* min⁻¹"),
    ({"gas": points([0, 360, 372, 720], [1, 40, 60, 1])}, "highest pressure is 60 MPa, .* MPa"),
    ({"reciprocating_kg": 700}, "reciprocating mass .* kg/m², .* kilograms"),
])  # fmt: skip
def test_units_mistaken_are_said(changes: dict[str, Any], said: str) -> None:
    with pytest.warns(UserWarning) as caught:
        one(**changes)
    lines = [str(each.message) for each in caught]
    assert any(re.search(said, line) for line in lines)
    assert all("\n" not in line for line in lines)
    assert caught[0].filename == __file__  # where the numbers were given


def test_radians_for_degrees_are_said() -> None:
    with pytest.warns(UserWarning, match="fire within 9.42°: are the offsets degrees"):
        made(None, [0, math.pi, 3 * math.pi, 2 * math.pi])
