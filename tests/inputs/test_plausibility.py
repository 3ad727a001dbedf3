"""Slips of unit, decimal and key are named; real engines are not odd."""

from __future__ import annotations

import copy
import math
import tomllib

import pytest

from kshm.engine.torsion import Torsion
from kshm.mechanics.torsion import throw_inertias, train_of
from reports.inputs.checks import bands
from reports.inputs.load import load_mapping, load_toml
from reports.inputs.template import list_samples
from reports.inputs.to_si.engine import engine_and_cycle
from reports.inputs.units import number_text
from reports.new.generate import generate_engine
from reports.shared.resources import samples_dir
from tests.cover import examples, sparse
from tests.inputs.slips import (
    FACTORS,
    SWAPPED,
    at,
    changed,
    numbers,
    path_of,
    plain,
    random_engine,
    remarks_of,
)

# What a factor of ten leaves possible, and why.
TOLERABLE = {
    "calculation.step_deg": "any step of the list is a step",
    "crankshaft.nose_angle_deg": "a counterweight may stand at any angle",
    "crankshaft.rear_angle_deg": "a counterweight may stand at any angle",
    "cycle.charge_heating_k": "between none and little heating nothing changes",
    "torsion.masses.inertia_kg_m2": "the first mass may be a small pulley or a heavy damper",
    "torsion.masses.stiffness_nm_rad": "what joins a pulley may be a shaft or a soft coupling",
    "torsion.other_flywheel_kg_m2": "any other flywheel may be tried",
    "reference.angle_deg": "a scheme may show any angle",
}
# Told at what follows from them: the sizes found for a power, the lists of a shaft.
ELSEWHERE = ("cycle.power_kw", "regime.speed_rpm", "engine.cylinders")


def sample(name):
    raw = tomllib.loads((samples_dir() / f"{name}.toml").read_text(encoding="utf-8"))
    raw.pop("report", None)
    raw.pop("checks", None)
    return raw


def cases():
    yield from sparse(list_samples())
    yield from range(examples(5, 10))


@pytest.fixture(params=cases(), ids=str)
def engine(request):
    name = request.param
    return sample(name) if isinstance(name, str) else random_engine(name)


def test_every_factor_of_ten_is_named(engine):
    before = set(remarks_of(engine))
    for path, value in numbers(engine):
        for factor in FACTORS:
            if plain(path) in TOLERABLE:
                continue
            collected = set(remarks_of(changed(engine, (path, value * factor)))) - before
            assert collected, f"{plain(path)} × {factor} is not named"
            assert any(f"f: {path[0]}" in line for line in collected) or plain(path) in ELSEWHERE, (
                collected
            )


@pytest.mark.parametrize("factor", FACTORS)
@pytest.mark.parametrize("place", range(2, 8))
def test_every_throw_of_a_given_train_is_named(place, factor):
    raw = sample("mwm-6")
    keys = ["inertia_kg_m2", *(["stiffness_nm_rad"] if place < 7 else [])]
    for key in keys:
        path = ("torsion", "masses", place, key)
        actual = remarks_of(changed(raw, (path, factor * at(raw, path))))
        assert any(f"torsion.masses[{place + 1}].{key}" in line for line in actual), (key, actual)


@pytest.mark.parametrize("factor", FACTORS)
@pytest.mark.parametrize("name", ["gots-diesel", "yamz-236", "two-stroke", "vw-1600"])
def test_every_throw_of_a_train_that_is_given_in_lists_is_named(name, factor):
    raw = sample(name)
    engine = engine_and_cycle(load_mapping(raw, source="f").model)[0]
    inertias = throw_inertias(engine).tolist()
    springs = train_of(engine, Torsion(), 1.0).stiffnesses.tolist()
    raw["torsion"] = {
        "throws_kg_m2": inertias, "throws_nm_rad": springs[1:-1], "nose_nm_rad": springs[0],
        "rear_nm_rad": springs[-1],
    }  # fmt: skip
    if len(inertias) == 1:
        del raw["torsion"]["throws_nm_rad"]
    assert not [line for line in remarks_of(raw) if "torsion" in line]
    for key, given in list(raw["torsion"].items()):
        path = ("torsion", key, 0) if isinstance(given, list) else ("torsion", key)
        actual = remarks_of(changed(raw, (path, factor * at(raw, path))))
        assert any(f"torsion.{key}" in line for line in actual), (key, actual)


# Keys of a shaft that no sample gives, in values that are usual.
FURTHER = {
    "bearings": {
        "main_clearance_min_mm": 0.07, "main_clearance_max_mm": 0.15, "pin_width_mm": 36.0,
        "main_width_mm": 30.0, "hole_mm": 6.0, "viscosity_40_mpa_s": 90.0,
        "viscosity_100_mpa_s": 9.0, "density_kg_m3": 860.0, "heat_j_kg_k": 2000.0,
        "reserve_allowed": 1.6, "tensile_mpa": 800.0, "bending_limit_mpa": 350.0,
        "torsion_limit_mpa": 200.0, "mean_bending": 0.16, "mean_torsion": 0.09, "fillet_mm": 4.0,
        "pin_bore_mm": 25.0, "main_bore_mm": 20.0, "fillet_bending": 2.1, "fillet_torsion": 1.6,
        "hole_bending": 2.3, "hole_torsion": 1.9, "sensitivity": 0.72, "size_factor": 0.7,
        "surface_factor": 1.1, "safety_allowed": 2.2,
    },
    "torsion": {"main_bore_mm": 20.0, "pin_bore_mm": 25.0, "web_width_mm": 130.0,
                "web_thickness_mm": 26.0, "damping_nms_rad": 1.5},
}  # fmt: skip


def test_a_factor_of_ten_is_named_of_what_no_sample_gives():
    raw = sample("d-240-bearings")
    for section, keys in FURTHER.items():
        raw[section] = raw.get(section, {}) | keys
    assert remarks_of(raw) == []
    silent = [
        (section, key, factor)
        for section, keys in FURTHER.items()
        for key, value in keys.items()
        for factor in (10, 0.1)
        if not remarks_of(changed(raw, ((section, key), value * factor)))
    ]
    assert silent == []


def test_heating_by_hundreds_of_kelvin_is_named():
    raw = sample("cycle-petrol")
    path = ("cycle", "charge_heating_k")
    assert remarks_of(changed(raw, (path, 10 * at(raw, path))))


def test_swapped_keys_are_named(engine):
    before = set(remarks_of(engine))
    for one, other in SWAPPED:
        first, second = at(engine, path_of(one)), at(engine, path_of(other))
        if first is None or second is None or abs(first - second) < 0.05 * max(first, second):
            continue
        swapped = changed(engine, (path_of(one), second), (path_of(other), first))
        assert set(remarks_of(swapped)) - before, (one, other)


@pytest.mark.parametrize("name", ["gots-diesel", "ecoboost-10", "two-stroke", "yamz-236"])
def test_a_stroke_for_a_radius_is_named(name):
    raw = sample(name)
    geometry = raw["geometry"]
    if "stroke_mm" in geometry:
        geometry["crank_radius_mm"] = geometry.pop("stroke_mm")
    else:
        geometry["crank_radius_mm"] *= 2
    assert any("geometry" in where for where in remarks_of(raw))


NAMED = {
    "bore in tenths": (("geometry.bore_mm", 880.0), "geometry.bore_mm"),
    "watts": (("regime.indicated_power_kw", 89300.0), "regime.indicated_power_kw"),
    "grams": (("masses.reciprocating_kg", 2000.0), "masses.reciprocating_kg"),
    "full efficiency": (("regime.mechanical_efficiency", 1.0), "regime.mechanical_efficiency"),
    "intake in bar": (("gas.intake_pressure_mpa", 1.65), "gas"),
    "top in bar": (("gas.max_pressure_mpa", 105.0), "gas.max_pressure_mpa"),
    "speed in rad/s": (("regime.speed_rpm", 460.8), "regime.speed_rpm"),
}


@pytest.mark.parametrize("case", NAMED)
def test_the_key_itself_is_named(case, raw):
    (key, value), where = NAMED[case]
    actual = remarks_of(changed(raw, (path_of(key), value)))
    assert any(where in position for position in actual), actual


def test_a_wrong_bore_is_one_line(raw):
    raw["geometry"]["bore_mm"] = 880.0
    (warning,) = load_mapping(raw, source="f").warnings
    assert "D = 880 мм не вяжется с другими данными: S/D = 0,1068" in warning.line()


def test_poor_use_of_heat_is_named():
    raw = sample("cycle-turbo-diesel")
    raw["cycle"]["xi_b"] = 0.5
    assert any("xi_b" in where or "cycle" in where for where in remarks_of(raw))


@pytest.mark.parametrize("factor", [10, 100, 0.1])
def test_a_lone_point_of_a_diagram_is_named(raw, factor):
    near = {240: 0.17, 270: 0.32, 300: 0.7, 330: 2.7, 360: 8.6, 390: 5.5, 420: 2.4, 450: 1.1,
            480: 0.7, 510: 0.45, 540: 0.28}  # fmt: skip
    points = [[float(angle), near.get(angle, 0.11)] for angle in range(0, 721, 30)]
    raw["gas"] = {"source": "table", "points": points}
    assert not any("points" in where for where in remarks_of(raw))
    for index in range(1, len(points) - 1):
        slipped = changed(raw, (("gas", "points", index, 1), points[index][1] * factor))
        assert any("points" in where for where in remarks_of(slipped)), index


@pytest.mark.parametrize("name", list_samples())
def test_samples_are_not_odd(name):
    assert load_toml(samples_dir() / f"{name}.toml").warnings == ()


@pytest.mark.parametrize("seed", range(examples(20, 40)))
def test_random_engines_are_not_odd(seed):
    assert remarks_of(random_engine(seed)) == []


# Pressures that differ as much between engines as a slip of the comma makes them.
WIDE = (bands.MEAN_PRESSURE, bands.POINTS, bands.MIN_POINT)
RELATIONS = [b for b in vars(bands).values() if isinstance(b, bands.Band) and b not in WIDE]


@pytest.mark.parametrize("band", [*bands.BANDS, *RELATIONS], ids=lambda band: band.words)
def test_no_band_holds_a_factor_of_ten(band):
    assert band.high < 10 * band.low or band.key == "cycle.charge_heating_k"
    assert band.source


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ([("main_lengths_mm", 0, 90.0)], "шейка длиной 90 мм не помещается в колено"),
        ([("arms", 1, "l2_mm", 3.0), ("arms", 1, "l5_mm", 3.0)], "по плечам l2…l5 для неё 6 мм"),
    ],
)
def test_what_does_not_fit_the_arms_is_told(changes, said):
    raw = plain_sample()
    for *path, value in changes:
        part = raw["crankshaft"]
        for key in path[:-1]:
            part = part[key]
        part[path[-1]] = value
    assert said not in "".join(remarks_of(plain_sample()))
    assert said in "".join(remarks_of(raw))


@pytest.mark.parametrize(
    ("name", "distance"), [("gots-diesel", 128.0), ("yamz-238", 184.0), ("vw-1600", 140.0)]
)
def test_cylinders_that_overlap_are_told(name, distance):
    """Of one row: between them stand those of the other row of a V, as they may."""
    for share, said in ((1.01, False), (0.99, True)):
        raw = tomllib.loads((samples_dir() / f"{name}.toml").read_text("utf-8"))
        wanted = raw["geometry"]["bore_mm"] * share
        for arms in raw["crankshaft"]["arms"]:
            for key in arms:
                arms[key] *= wanted / distance
        words = f"между их осями по плечам колен {number_text(round(wanted, 2))} мм, а диаметр"
        assert any(words in line for line in remarks_of(raw)) == said


def plain_sample():
    return tomllib.loads((samples_dir() / "gots-diesel.toml").read_text("utf-8"))


_TENS = (10, 0.1, 1000, 0.001)
# What a person takes for the unit of the key: tens and thousands, inches, kgf, rad/s, radians.
SLIPS = {
    "_mm": (*_TENS, 25.4, 1 / 25.4),
    "_kg": (*_TENS, 9.81, 1 / 9.81),
    "_mpa": (*_TENS, 10.2, 1 / 10.2),
    "_rpm": (10, 0.1, 60, 1 / 60, math.pi / 30, 30 / math.pi),
    "_deg": (10, 0.1, math.pi / 180, 180 / math.pi),
    "_kw": _TENS,
    "_kg_m2": (10, 0.1, 9.81, 1 / 9.81, 1e4, 1e-4),
    "_nm_rad": (*_TENS, 9.81, 1 / 9.81),
    "_um": _TENS,
    "_k": (10, 0.1),
    "_c": (10, 0.1),
    "compression_ratio": (10, 0.1, 0.4),
}
# Flywheels and pulleys differ by more than slips do; a solved train tells the gross ones.
FREE = TOLERABLE.keys() | {f"torsion.{part}_kg_m2" for part in ("flywheel", "pulley", "driven")}
MADE = [(4, "inline", 4, "petrol"), (6, "inline", 4, "diesel"), (8, "v", 4, "diesel"),
        (10, "v", 4, "petrol"), (4, "opposed", 4, "petrol"), (2, "inline", 2, "petrol"),
        (6, "inline", 2, "diesel")]  # fmt: skip


def factors(path: tuple[str | int, ...]) -> tuple[float, ...]:
    key = [part for part in path if isinstance(part, str)][-1]
    units = [unit for unit in SLIPS if key.endswith(unit)]
    return SLIPS[max(units, key=len)] if units else ()


def silent(raw: dict) -> list[tuple[str, float]]:
    raw.pop("report", None)
    before = set(remarks_of(raw))
    return [
        (plain(path), factor)
        for path, value in numbers(raw)
        for factor in factors(path)
        if plain(path) not in FREE
        and not set(remarks_of(changed(raw, (path, value * factor)))) - before
    ]


@pytest.mark.parametrize("name", sparse(list_samples()))
def test_no_slip_in_a_sample_is_silent(name):
    """With its [checks]: what a file accepts says nothing of its other values."""
    assert silent(tomllib.loads((samples_dir() / f"{name}.toml").read_text("utf-8"))) == []


@pytest.mark.parametrize("named", [True, False])
@pytest.mark.parametrize("case", sparse(MADE), ids=str)
def test_no_slip_in_an_engine_made_of_usual_values_is_silent(case, named):
    cylinders, layout, strokes, kind = case
    raw = copy.deepcopy(generate_engine(cylinders, layout=layout, strokes=strokes, kind=kind).data)
    raw.pop("prototype", None)  # another engine's numbers
    if not named:
        raw["engine"].pop("name")
    assert silent(raw) == []


DIESEL_RATIO = ("geometry", "compression_ratio")


@pytest.mark.parametrize(
    ("name", "ratio"),
    [("gots-diesel", 7.2), ("gots-diesel", 8.0), ("yamz-238", 6.6), ("d-240", 6.4),
     ("mwm-6", 6.8), ("gots-regimes", 9.5)],
)  # fmt: skip
def test_the_compression_ratio_of_a_diesel_is_told(name, ratio):
    raw = tomllib.loads((samples_dir() / f"{name}.toml").read_text("utf-8"))
    for unnamed in (False, True):
        if unnamed and raw["gas"]["source"] == "table":
            continue  # neither its name nor ρ says what it burns
        if unnamed:
            raw["engine"]["name"] = "Мой двигатель"
        lines = remarks_of(changed(raw, (DIESEL_RATIO, ratio)))
        assert any("geometry.compression_ratio: ε = " in line for line in lines)
        assert any("о котором говорит ρ" in line for line in lines) == unnamed


@pytest.mark.parametrize("name", ["Бензиновый двигатель", "Двигатель с искровым зажиганием"])
def test_a_petrol_engine_by_its_name_is_none(name):
    raw = tomllib.loads((samples_dir() / "ecoboost-10.toml").read_text("utf-8"))
    raw["engine"]["name"] = name
    assert remarks_of(raw) == []
    raw["engine"]["name"] = "Мой двигатель"
    (line,) = remarks_of(raw)
    assert "ε = 10 необычно для дизеля, о котором говорит ρ = 1,3" in line
