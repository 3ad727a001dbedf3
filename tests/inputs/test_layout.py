"""Layouts, phases and sizes of shafts that do not fit together, a pin's length among them."""

from __future__ import annotations

import io
import math

import pytest

from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.inputs.to_si.engine import to_engine
from reports.new.generate import generate_engine
from reports.new.part_sizes import decimals
from reports.new.scale_engine import alternative
from reports.shared.errors import InputError
from reports.workbook.read import load_workbook_input
from tests.conftest import sample
from tests.inputs.slips import remarks_of
from tests.layouts import MAKERS, articulated, in_line_four, v_six


def loaded(raw: dict):
    return load_mapping(raw, source="f.toml").model


def test_order_as_text_gives_even_offsets_and_throw_angles(raw):
    shaft = loaded(in_line_four(raw, firing_order="1-3-4-2")).crankshaft
    assert shaft.firing_offsets_deg == (0.0, 540.0, 180.0, 360.0)
    assert shaft.throw_angles_deg == (0.0, 180.0, 180.0, 0.0)
    assert shaft.firing_order is None


def test_order_may_begin_with_any_cylinder(raw):
    shaft = loaded(in_line_four(raw, firing_order="4 – 2 – 1 – 3")).crankshaft
    assert shaft.firing_offsets_deg == (0.0, 540.0, 180.0, 360.0)


def test_cylinders_that_fire_together_are_told(raw):
    """540° typed twice fits the throws: nothing else shows it."""
    offsets = [0.0, 540.0, 540.0, 360.0]
    given = in_line_four(raw, firing_offsets_deg=offsets, throw_angles_deg=[0, 180, 180, 0])
    (message,) = (w for w in load_mapping(given, source="f.toml").warnings if "то же" in w.what)
    assert message.where == "f.toml: crankshaft.firing_offsets_deg[3]"
    assert message.what == "начало рабочего хода то же, что у цилиндра 2: 540°"
    given["crankshaft"]["firing_offsets_deg"][2] = 180.0
    assert not any("то же" in w.what for w in load_mapping(given, source="f.toml").warnings)


def test_order_beside_uneven_offsets_that_agree(raw):
    raw = v_six(raw)
    raw["crankshaft"]["firing_order"] = "1-4-2-5-3-6"
    assert loaded(raw).crankshaft.firing_offsets_deg == (0.0, 240.0, 480.0, 90.0, 330.0, 570.0)


def test_throws_of_a_v_engine_from_offsets(raw):
    raw = v_six(raw)
    del raw["crankshaft"]["throw_angles_deg"]
    engine = to_engine(loaded(raw))
    angles = [math.degrees(throw.angle) for throw in engine.crankshaft.throws]
    assert angles == pytest.approx([0, 120, 240])
    assert [position.throw for position in engine.arrangement] == [0, 1, 2, 0, 1, 2]
    assert [position.rod_place for position in engine.arrangement] == [0, 0, 0, 1, 1, 1]


def test_split_pins_make_a_v_six_even(raw):
    raw = v_six(raw)
    del raw["crankshaft"]["firing_offsets_deg"], raw["crankshaft"]["throw_angles_deg"]
    raw["crankshaft"] |= {"firing_order": "1-4-2-5-3-6", "split_pin_deg": -30.0}
    engine = to_engine(loaded(raw))
    angles = [math.degrees(throw.angle) for throw in engine.crankshaft.throws]
    assert angles == pytest.approx([0, 120, 240])


def test_opposed_engine_alternates_its_throws(raw):
    raw = in_line_four(raw, firing_order="1-2-3-4")
    raw["engine"]["layout"] = "opposed"
    model = loaded(raw)
    assert model.crankshaft.bank_angle_deg == 180
    engine = to_engine(model)
    assert [position.throw for position in engine.arrangement] == [0, 2, 1, 3]
    angles = [math.degrees(throw.angle) for throw in engine.crankshaft.throws]
    assert angles == pytest.approx([0, 180, 180, 0])


REFUSED = {
    "unreadable order": ("four", "crankshaft.firing_order", "один, три"),
    "order without a cylinder": ("four", "crankshaft.firing_order", "1-3-4-4"),
    "order against offsets": ("basic", "crankshaft.firing_order", "1-3-2"),
    "odd v": ("v_six", "engine.cylinders", 5),
    "bank angle against offsets": ("v_six", "crankshaft.bank_angle_deg", 60.0),
    "split pin against offsets": ("v_six", "crankshaft.split_pin_deg", 30.0),
    "bank angle in line": ("basic", "crankshaft.bank_angle_deg", 90.0),
    "no bank angle": ("v_six", "crankshaft.bank_angle_deg", None),
    "too few webs": ("v_six", "crankshaft.webs", []),
    "offset that locks": ("basic", "geometry.crank_offset_mm", 101.0),
    "pin offset that locks": ("basic", "geometry.pin_offset_mm", -150.0),
    "short articulated rod": ("articulated", "articulated.rod_length_mm", 40.0),
    "articulated pin beyond the master rod": ("articulated", "articulated.radius_mm", 150.0),
    "articulated in line": (
        "basic", "articulated",
        {"rod_length_mm": 110.0, "radius_mm": 38.0, "angle_deg": 60.0,
         "reciprocating_kg": 1.9, "big_end_kg": 0.6},
    ),
    "scavenging in a four-stroke": ("basic", "gas.scavenge_start_before_bdc_deg", 60.0),
    "no scavenging": ("two_stroke", "gas.scavenge_start_before_bdc_deg", None),
    "scavenging before the exhaust": ("two_stroke", "gas.scavenge_start_before_bdc_deg", 85.0),
    "offset beyond the cycle": ("two_stroke", "crankshaft.firing_offsets_deg", [0.0, 120.0, 600.0]),
}  # fmt: skip


@pytest.mark.parametrize("case", REFUSED)
def test_refused_with_one_line(case, raw, refused, snapshot):
    maker, path, value = REFUSED[case]
    raw = MAKERS[maker](raw)
    section, _, key = path.partition(".")
    if not key:
        raw[section] = value
    elif value is None:
        del raw[section][key]
    else:
        raw[section][key] = value
    (line,) = refused(raw)
    assert line == snapshot


@pytest.mark.parametrize("maker", MAKERS)
def test_accepted(maker, raw):
    to_engine(loaded(MAKERS[maker](raw)))


def test_forced_phases_only_in_line(raw, refused):
    raw = v_six(raw)
    raw["crankshaft"]["force_offsets_deg"] = [0.0, 240.0, 480.0]
    (line,) = refused(raw)
    assert "особые фазы сил возможны только у рядного двигателя" in line


@pytest.mark.parametrize("maker", ["offset", "articulated"])
def test_rounded_diagram_only_of_the_central_mechanism(maker, raw, refused):
    raw = MAKERS[maker](raw)
    gas = raw["gas"]
    gas |= {"source": "rounded", "kind": "diesel"}
    what = "скруглённая диаграмма построена только для центрального механизма"
    assert any(what in line for line in refused(raw))


def test_two_stroke_regime_needs_its_scavenging(raw, refused):
    raw = MAKERS["two_stroke"](raw)
    gas = {k: v for k, v in raw["gas"].items() if k != "scavenge_start_before_bdc_deg"}
    raw["regimes"] = [{"name": "второй", "speed_rpm": 2400.0, "gas": gas}]
    (line,) = refused(raw)
    assert line.startswith("f.toml: regimes[1].gas.scavenge_start_before_bdc_deg: начало продувки")


def test_unusual_offset_is_a_warning(raw):
    raw["geometry"]["crank_offset_mm"] = 20.0
    (warning,) = load_mapping(raw, source="f.toml").warnings
    assert "k = e/r = 0,4255 необычно" in warning.line()


def test_a_cycle_knows_no_offset():
    raw = to_mapping(sample("cycle-tractor-diesel"))
    with_sizes = {"bore_mm": 110.0, "stroke_mm": 125.0, "crank_offset_mm": 5.0}
    raw["geometry"] |= with_sizes
    for key in ("power_kw", "stroke_bore", "size_step_mm", "rounding"):
        raw["cycle"].pop(key, None)
    with pytest.raises(InputError, match="расчёт цикла ведётся для центрального механизма"):
        loaded(raw)


MEANT = "нужна длина всей шейки: если задана под одним шатуном, впишите "
NO_ROOM = "не помещается в колено: по плечам l2…l5 для неё "


def made(name: str | tuple) -> dict:
    if isinstance(name, str):
        return to_mapping(sample(name))
    cylinders, layout, kind = name
    return generate_engine(cylinders, layout=layout, kind=kind).data


V = ["yamz-236", "yamz-238", (2, "v", "petrol"), (8, "v", "diesel"), (10, "v", "petrol"),
     (12, "v", "diesel")]  # fmt: skip


def with_pin(name: str | tuple, times: float) -> tuple[dict, float]:
    raw = made(name)
    whole = raw["crankshaft"]["pin_length_mm"]
    raw["crankshaft"]["pin_length_mm"] = whole * times
    return raw, whole


@pytest.mark.parametrize("name", V, ids=str)
def test_a_length_under_one_rod_is_told_with_the_whole_one(name):
    assert remarks_of(made(name)) == []
    raw, whole = with_pin(name, 0.5)
    (line,) = remarks_of(raw)
    assert line.startswith("f: crankshaft.pin_length_mm: шатунов на шейке рядом 2, и каждому ")
    assert line.endswith(MEANT + f"{whole:g}".replace(".", ","))


def test_one_length_of_a_list_is_told():
    raw = made("yamz-236")
    del raw["crankshaft"]["pin_length_mm"]
    raw["crankshaft"]["pin_lengths_mm"] = [84.0, 42.0, 84.0]
    (line,) = remarks_of(raw)
    assert line.startswith("f: crankshaft.pin_lengths_mm[2]: шатунов на шейке рядом 2")


@pytest.mark.parametrize("name", ["gots-diesel", "vw-1600", "ecoboost-10", "d-240"])
def test_a_pin_of_one_rod_is_not_taken_for_a_half(name):
    raw, _ = with_pin(name, 0.7)
    assert not [line for line in remarks_of(raw) if MEANT in line]


def test_an_articulated_rod_takes_none_of_the_pin():
    raw = articulated(made("gots-diesel"))
    raw["crankshaft"]["pin_length_mm"] = 19.0
    assert not [line for line in remarks_of(raw) if "pin_length" in line]


def test_an_old_workbook_that_is_edited_is_told(tmp_path):
    from openpyxl import load_workbook

    from reports.workbook.layout import Layout
    from tests.workbook.made import coarse_book, coarse_model

    book, cell = load_workbook(io.BytesIO(coarse_book("yamz-236"))), None
    cell = Layout.of(coarse_model("yamz-236")).cells["crankshaft_pin_length_mm"]
    assert book[cell.sheet][cell.coordinate].value == 84
    book[cell.sheet][cell.coordinate].value = 42
    book.save(tmp_path / "old.xlsx")
    (problem,) = load_workbook_input(tmp_path / "old.xlsx").warnings
    assert problem.line().endswith(MEANT + "84")
    book[cell.sheet][cell.coordinate].value = 168
    book.save(tmp_path / "long.xlsx")
    with pytest.raises(InputError, match=NO_ROOM + "88 мм"):
        load_workbook_input(tmp_path / "long.xlsx")


@pytest.mark.parametrize("times", [1.06, 1.2, 2])
@pytest.mark.parametrize("name", [*V, "d-240", "vw-1600"], ids=str)
def test_a_pin_longer_than_its_arms_leave_is_refused(name, times):
    raw = made(name)
    arms = raw["crankshaft"]["arms"][0]
    room = sum(arms.get(f"l{i}_mm", 0) for i in (2, 3, 4, 5))
    raw["crankshaft"]["pin_length_mm"] = room * times
    with pytest.raises(InputError, match=NO_ROOM):
        load_mapping(raw, source="f")
    raw["crankshaft"]["pin_length_mm"] = room
    load_mapping(raw, source="f")


def test_both_halves_of_a_split_pin_need_room():
    raw = made((6, "v", "diesel"))
    shaft = raw["crankshaft"]
    shaft.pop("firing_order", None)
    whole = shaft["pin_length_mm"]
    shaft |= {
        "bank_angle_deg": 90, "split_pin_deg": 30.0, "throw_angles_deg": [0, 120, 240],
        "firing_offsets_deg": [0, 240, 480, 60, 300, 540],
    }  # fmt: skip
    with pytest.raises(InputError, match=f"половина шейки длиной .* {NO_ROOM}"):
        load_mapping(raw, source="f")
    shaft["pin_length_mm"] = whole / 2
    assert remarks_of(raw) == []


def test_a_refused_pin_does_not_hide_what_else_is_odd():
    raw = made("gots-diesel")
    raw["crankshaft"]["arms"][0] |= {"l2_mm": 3.0, "l5_mm": 3.0}
    lines = remarks_of(raw)
    assert NO_ROOM + "6 мм" in lines[0]
    assert any("arms[1].l2_mm: l_2/D" in line for line in lines)


def test_an_alternative_of_another_layout_keeps_what_a_rod_has():
    """Of a pin with one rod comes a pin with two, each with its own length of it."""
    old = sample("d-240-bearings")
    shaft = old.crankshaft
    made_ = alternative(old, 8, layout="v").data
    factor = (4 / 8) ** 0.5
    length = 2 * shaft.pin_length_mm * factor
    assert made_["crankshaft"]["pin_length_mm"] == round(length, decimals(length))
    back = alternative(sample("yamz-238"), 8, layout="inline").data
    assert back["crankshaft"]["pin_length_mm"] == pytest.approx(42)
    arms = made_["crankshaft"]["arms"][0]
    assert sum(arms[f"l{i}_mm"] for i in (2, 3, 4, 5)) == pytest.approx(
        made_["crankshaft"]["pin_length_mm"]
    )
