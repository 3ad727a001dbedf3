"""A crankpin's length is the whole pin's: a file that tells one rod's, and one too long."""

from __future__ import annotations

import io

import pytest

from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.inputs.own_engine import own_engine
from reports.inputs.own_similar import alternative
from reports.shared.errors import InputError
from reports.workbook.read import load_workbook_input
from tests.conftest import sample
from tests.inputs.slips import told
from tests.layouts import articulated

MEANT = "нужна длина всей шейки: если задана под одним шатуном, впишите "
NO_ROOM = "не помещается в колено: по плечам l2…l5 для неё "


def made(name: str | tuple) -> dict:
    if isinstance(name, str):
        return to_mapping(sample(name))
    cylinders, layout, kind = name
    return own_engine(cylinders, layout=layout, kind=kind).data


V = ["yamz-236", "yamz-238", (2, "v", "petrol"), (8, "v", "diesel"), (10, "v", "petrol"),
     (12, "v", "diesel")]  # fmt: skip


def with_pin(name: str | tuple, times: float) -> tuple[dict, float]:
    raw = made(name)
    whole = raw["crankshaft"]["pin_length_mm"]
    raw["crankshaft"]["pin_length_mm"] = whole * times
    return raw, whole


@pytest.mark.parametrize("name", V, ids=str)
def test_a_length_under_one_rod_is_told_with_the_whole_one(name):
    assert told(made(name)) == []
    raw, whole = with_pin(name, 0.5)
    (line,) = told(raw)
    assert line.startswith("f: crankshaft.pin_length_mm: шатунов на шейке рядом 2, и каждому ")
    assert line.endswith(MEANT + f"{whole:g}".replace(".", ","))


def test_one_length_of_a_list_is_told():
    raw = made("yamz-236")
    del raw["crankshaft"]["pin_length_mm"]
    raw["crankshaft"]["pin_lengths_mm"] = [84.0, 42.0, 84.0]
    (line,) = told(raw)
    assert line.startswith("f: crankshaft.pin_lengths_mm[2]: шатунов на шейке рядом 2")


@pytest.mark.parametrize("name", ["gots-diesel", "vw-1600", "ecoboost-10", "d-240"])
def test_a_pin_of_one_rod_is_not_taken_for_a_half(name):
    raw, _ = with_pin(name, 0.7)
    assert not [line for line in told(raw) if MEANT in line]


def test_an_articulated_rod_takes_none_of_the_pin():
    raw = articulated(made("gots-diesel"))
    raw["crankshaft"]["pin_length_mm"] = 19.0
    assert not [line for line in told(raw) if "pin_length" in line]


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
        "firing_offsets_deg": [0, 240, 120, 60, 300, 180],
    }  # fmt: skip
    with pytest.raises(InputError, match=f"половина шейки длиной .* {NO_ROOM}"):
        load_mapping(raw, source="f")
    shaft["pin_length_mm"] = whole / 2
    assert told(raw) == []


def test_a_refused_pin_does_not_hide_what_else_is_odd():
    raw = made("gots-diesel")
    raw["crankshaft"]["arms"][0] |= {"l2_mm": 3.0, "l5_mm": 3.0}
    lines = told(raw)
    assert NO_ROOM + "6 мм" in lines[0]
    assert any("arms[1].l2_mm: l_2/D" in line for line in lines)


def test_an_alternative_of_another_layout_keeps_what_a_rod_has():
    """Of a pin with one rod comes a pin with two, each with its own length of it."""
    old = sample("d-240-bearings")
    shaft = old.crankshaft
    made_ = alternative(old, 8, layout="v").data
    factor = (4 / 8) ** 0.5
    assert made_["crankshaft"]["pin_length_mm"] == pytest.approx(2 * shaft.pin_length_mm * factor)
    back = alternative(sample("yamz-238"), 8, layout="inline").data
    assert back["crankshaft"]["pin_length_mm"] == pytest.approx(42)
    arms = made_["crankshaft"]["arms"][0]
    assert sum(arms[f"l{i}_mm"] for i in (2, 3, 4, 5)) == pytest.approx(
        made_["crankshaft"]["pin_length_mm"]
    )
