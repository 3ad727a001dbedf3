"""Input files of every layout, made from the textbook's diesel."""

from __future__ import annotations

import copy

from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.inputs.sections.input_file import InputFile
from tests.conftest import sample


def v_six(raw: dict) -> dict:
    """A V6 of 90° with common pins at 120°: it fires at 90 and 150 degrees in turn."""
    shaft = raw["crankshaft"]
    raw["engine"] |= {"cylinders": 6, "layout": "v"}
    shaft |= {
        "bank_angle_deg": 90.0,
        "firing_offsets_deg": [0.0, 240.0, 480.0, 90.0, 330.0, 570.0],
        "throw_angles_deg": [0.0, 120.0, 240.0],
    }
    return raw


def in_line_four(raw: dict, **shaft: object) -> dict:
    raw["engine"]["cylinders"] = 4
    old = raw["crankshaft"]
    for key in ("firing_offsets_deg", "throw_angles_deg"):
        del old[key]
    old |= {
        "main_lengths_mm": [30.0] * 5,
        "webs": [dict(old["webs"][0]) for _ in range(8)],
        "arms": [dict(old["arms"][0]) for _ in range(4)],
        **shaft,
    }
    return raw


def two_stroke(raw: dict) -> dict:
    raw["engine"] |= {"strokes": 2}
    shaft = raw["crankshaft"]
    shaft |= {"firing_offsets_deg": [0.0, 120.0, 240.0], "throw_angles_deg": [0.0, 240.0, 120.0]}
    raw["gas"] |= {
        "exhaust_start_before_bdc_deg": 80.0,
        "exhaust_end_after_bdc_deg": 80.0,
        "scavenge_start_before_bdc_deg": 60.0,
    }
    return raw


def articulated_section() -> dict:
    return {
        "rod_length_mm": 110.0,
        "radius_mm": 38.0,
        "angle_deg": 88.0,
        "reciprocating_kg": 1.9,
        "big_end_kg": 0.6,
    }


def articulated(raw: dict) -> dict:
    v_six(raw)["articulated"] = articulated_section()
    return raw


def basic(raw: dict) -> dict:
    return raw


def four(raw: dict) -> dict:
    return in_line_four(raw, firing_order="1-3-4-2")


def offset(raw: dict) -> dict:
    raw["geometry"] |= {"crank_offset_mm": 8.0, "pin_offset_mm": -0.5}
    return raw


def uneven_arms(raw: dict, throws: int) -> None:
    """Throws whose rods stand apart and off the middle, each otherwise: even ones cancel."""
    shaft = raw["crankshaft"]
    web, arm = shaft["webs"][0], shaft["arms"][0]
    shaft["webs"] = [
        dict(web, angle_deg=5.0 * i, counterweight_angle_deg=4.0 - 3.0 * i)
        for i in range(2 * throws)
    ]
    shaft["arms"] = [
        dict(arm, l2_mm=20.0 + i, l3_mm=11.0 + 2 * i, l4_mm=13.0 - i, l5_mm=24.0)
        for i in range(throws)
    ]
    shaft["main_lengths_mm"] = [30.0] * (throws + 1)


def v_apart(raw: dict) -> dict:
    uneven_arms(v_six(raw), 3)
    return raw


def split(raw: dict) -> dict:
    uneven_arms(v_six(raw), 3)
    shaft = raw["crankshaft"]
    del shaft["firing_offsets_deg"], shaft["throw_angles_deg"]
    shaft |= {"firing_order": "1-4-2-5-3-6", "split_pin_deg": -30.0}
    return raw


def opposed_four(raw: dict) -> dict:
    in_line_four(raw, firing_order="1-2-3-4")["engine"]["layout"] = "opposed"
    uneven_arms(raw, 4)
    return raw


def two_stroke_v(raw: dict) -> dict:
    two_stroke(raw)
    raw["engine"] |= {"cylinders": 4, "layout": "v"}
    shaft = raw["crankshaft"]
    del shaft["throw_angles_deg"]
    shaft |= {"bank_angle_deg": 90.0, "firing_offsets_deg": [0.0, 180.0, 90.0, 270.0]}
    uneven_arms(raw, 2)
    return raw


def offset_two_stroke(raw: dict) -> dict:
    return offset(two_stroke(raw))


def offset_articulated(raw: dict) -> dict:
    return offset(articulated(raw))


def offset_split(raw: dict) -> dict:
    return offset(split(raw))


def two_stroke_articulated(raw: dict) -> dict:
    two_stroke_v(raw)["articulated"] = articulated_section()
    return raw


def with_regimes(raw: dict) -> dict:
    """Every peculiarity that a further regime shares or has of its own."""
    offset_articulated(raw)
    gas = dict(raw["gas"], max_pressure_mpa=9.0, injection_advance_deg=14)
    raw["regimes"] = [{"name": "второй", "speed_rpm": 2400.0, "gas": gas}]
    return raw


def zero_offset(raw: dict) -> dict:
    raw["geometry"]["crank_offset_mm"] = 0.0
    return raw


MAKERS = {
    maker.__name__: maker
    for maker in (
        basic, four, offset, zero_offset, v_six, v_apart, split, opposed_four, articulated,
        two_stroke, two_stroke_v, offset_two_stroke, offset_articulated, offset_split,
        two_stroke_articulated, with_regimes,
    )
}  # fmt: skip


def layout_input(name: str, **calculation: object) -> InputFile:
    """The checked input of a layout."""
    raw = MAKERS[name](copy.deepcopy(to_mapping(sample("gots-diesel"))))
    raw["calculation"] |= calculation
    return load_mapping(raw, source=name).model
