"""Every bad input is refused with one Russian line per error, held in full as a snapshot."""

import pytest

GONE = object()
TABLE = [[0, 0.1], [180, 0.1], [360, 8], [720, 0.1]]


def put(data, path, value):
    *parents, last = path.split(".")
    for part in parents:
        data = data[int(part) if part.isdecimal() else part]
    last = int(last) if last.isdecimal() else last
    if value is GONE:
        del data[last]
    else:
        data[last] = value


CASES = {
    "text for number": {"geometry.bore_mm": "88,0 мм"},
    "bool for number": {"geometry.bore_mm": True},
    "list for number": {"geometry.bore_mm": [88]},
    "number for text": {"report.variant": 7},
    "number for section": {"regime": 5},
    "half a cylinder": {"engine.cylinders": 3.5},
    "no cylinder": {"engine.cylinders": 0},
    "negative length": {"geometry.bore_mm": -88},
    "zero length": {"geometry.rod_length_mm": 0},
    "nan": {"regime.speed_rpm": float("nan")},
    "inf": {"geometry.bore_mm": float("inf")},
    "integer beyond float": {"geometry.bore_mm": 10**400},
    "missing section": {"regime": GONE},
    "missing key": {"geometry.bore_mm": GONE},
    "misspelt section": {"geometri": {}, "geometry": GONE},
    "misspelt key": {"geometry.bore_mm": GONE, "geometry.bore_m": 88},
    "misspelt optional key": {"geometry.crank_radius_mm": GONE, "geometry.crank_radus_mm": 47},
    "misspelt key of a web": {"crankshaft.webs.2.mass_kg": GONE, "crankshaft.webs.2.mas_kg": 1},
    "key of another section": {"geometry.speed_rpm": 4400},
    "key of the other source": {"gas.points": []},
    "python's name of lambda": {"geometry.lambda_": 0.3},
    "true for one": {"calculation.step_deg": True},
    "unknown key": {"geometry.zzz": 1},
    "key with line break": {"geometry.a\nb": 1},
    "rod shorter than crank": {"geometry.rod_length_mm": 40},
    "lambda above one": {"geometry.rod_length_mm": GONE, "geometry.lambda": 1.2},
    "three that disagree": {"geometry.lambda": 0.32},
    "stroke that disagrees": {"geometry.stroke_mm": 95},
    "one of three": {"geometry.rod_length_mm": GONE},
    "offsets not one per cylinder": {"crankshaft.firing_offsets_deg": [0, 240]},
    "first offset not zero": {"crankshaft.firing_offsets_deg.0": 10},
    "throw against offset": {"crankshaft.throw_angles_deg.1": 121},
    "too few arms": {"crankshaft.arms.2": GONE},
    "too few webs": {"crankshaft.webs.5": GONE},
    "too few journals": {"crankshaft.main_lengths_mm.3": GONE},
    "force offsets of wrong count": {"crankshaft.force_offsets_deg": [0]},
    "throw without length": {"crankshaft.arms.1.l1_mm": 0, "crankshaft.arms.1.l2_mm": 0},
    "web is text": {"crankshaft.webs.2": "a"},
    "p_z below compression": {"gas.max_pressure_mpa": 8.0},
    "rho below one": {"gas.preexpansion_ratio": 0.9},
    "rho above compression ratio": {"geometry.compression_ratio": 2, "gas.preexpansion_ratio": 3},
    "combustion after TDC": {"gas.combustion_start_deg": GONE, "gas.ignition_delay_deg": 20},
    "combustion before injection": {"gas.combustion_start_deg": 300},
    "no exhaust": {"gas.exhaust_start_before_bdc_deg": 0, "gas.exhaust_end_after_bdc_deg": 0},
    "exhaust before firing": {"gas.exhaust_start_before_bdc_deg": 190},
    "unknown source": {"gas.source": "x"},
    "no source": {"gas.source": GONE},
    "masses mixed": {"masses.rod_kg": 1.7},
    "masses incomplete": {"masses.rod_big_end_kg": GONE},
    "centre given twice": {
        "masses": {
            "piston_group_kg": 1.5,
            "rod_kg": 1.7,
            "rod_centre_mm": 100,
            "rod_small_end_share": 0.3,
        }
    },
    "centre outside the rod": {
        "masses": {"piston_group_kg": 1.5, "rod_kg": 1.7, "rod_centre_mm": 150}
    },
    "other layout": {"engine.layout": "W"},
    "three strokes": {"engine.strokes": 3},
    "odd step": {"calculation.step_deg": 7},
    "name of two lines": {"engine.name": "a\nb"},
    "endless name": {"engine.name": "a" * 400},
}
TABLES = {
    "falling": [[0, 0.1], [180, 0.1], [170, 8], [720, 0.1]],
    "repeated": [[0, 0.1], [180, 0.1], [180, 8], [720, 0.1]],
    "short": [[0, 0.1], [180, 0.1], [700, 0.1]],
    "late": [[5, 0.1], [180, 0.1], [720, 0.1]],
    "open": [[0, 0.1], [180, 0.1], [720, 0.2]],
    "two points": [[0, 0.1], [720, 0.1]],
    "one number": [[0, 0.1], [5], [720, 0.1]],
    "three numbers": [[0, 0.1], [5, 1, 2], [720, 0.1]],
    "text": [[0, 0.1], [5, "x"], [720, 0.1]],
    "no list": 5,
}


@pytest.mark.parametrize("case", CASES)
def test_refused_with_one_line(case, raw, refused, snapshot):
    for path, value in CASES[case].items():
        put(raw, path, value)
    (line,) = refused(raw)
    assert line == snapshot


@pytest.mark.parametrize("case", TABLES)
def test_pressure_table_refused(case, raw, refused, snapshot):
    raw["gas"] = {"source": "table", "points": TABLES[case]}
    (line,) = refused(raw)
    assert line == snapshot


def test_all_errors_at_once(raw, refused):
    for path, value in {
        "geometry.bore_mm": -1,
        "geometry.lambda": 0.4,
        "geometry.compression_ratio": GONE,
        "engine.nane": "x",
        "masses": GONE,
        "crankshaft.webs.0.mass_kg": -1,
        "crankshaft.webs.5": GONE,
        "crankshaft.throw_angles_deg": [0, 240, 120],
        "gas.max_pressure_mpa": 0.1,
    }.items():
        put(raw, path, value)
    keys = [line.split(": ")[1] for line in refused(raw)]
    assert sorted(keys) == sorted(
        [
            "geometry.bore_mm",
            "geometry.lambda",
            "geometry.compression_ratio",
            "engine.nane",
            "masses",
            "crankshaft.webs[1].mass_kg",
            "crankshaft.webs",
            "crankshaft.throw_angles_deg[2]",
            "crankshaft.throw_angles_deg[3]",
            "gas.max_pressure_mpa",
        ]
    )


def test_many_errors_are_capped(raw, refused):
    raw["geometry"] |= {f"zz{i}": 1 for i in range(1000)}
    raw |= {f"zz{i}": 1 for i in range(1000)}
    lines = refused(raw)
    assert len(lines) == 201
    assert lines[-1] == "f.toml: и ещё ошибок: 1800"


def test_an_order_is_blamed_by_its_own_key(raw, refused):
    """The file has no firing_offsets_deg: they follow from its order."""
    shaft = raw["crankshaft"]
    shaft.pop("firing_offsets_deg", None)
    shaft["firing_order"] = "1-2-3"
    shaft["throw_angles_deg"] = [0, 120, 200]
    lines = refused(raw)
    assert lines and all("firing_offsets_deg" not in line for line in lines)
    assert "(firing_order)" in lines[0]
