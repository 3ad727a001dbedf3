"""A value in another unit is never silent: in whole files, with what they accept."""

from __future__ import annotations

import copy
import math
import tomllib

import pytest

from reports.inputs.own_engine import own_engine
from reports.inputs.template import list_samples
from reports.shared.resources import samples_dir
from tests.inputs.slips import changed, numbers, plain, told
from tests.inputs.test_plausibility import TOLERABLE

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
    before = set(told(raw))
    return [
        (plain(path), factor)
        for path, value in numbers(raw)
        for factor in factors(path)
        if plain(path) not in FREE and not set(told(changed(raw, (path, value * factor)))) - before
    ]


@pytest.mark.parametrize("name", list_samples())
def test_no_slip_in_a_sample_is_silent(name):
    """With its [checks]: what a file accepts says nothing of its other values."""
    assert silent(tomllib.loads((samples_dir() / f"{name}.toml").read_text("utf-8"))) == []


@pytest.mark.parametrize("named", [True, False])
@pytest.mark.parametrize("case", MADE, ids=str)
def test_no_slip_in_an_engine_made_of_usual_values_is_silent(case, named):
    cylinders, layout, strokes, kind = case
    raw = copy.deepcopy(own_engine(cylinders, layout=layout, strokes=strokes, kind=kind).data)
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
        lines = told(changed(raw, (DIESEL_RATIO, ratio)))
        assert any("geometry.compression_ratio: ε = " in line for line in lines)
        assert any("о котором говорит ρ" in line for line in lines) == unnamed


@pytest.mark.parametrize("name", ["Бензиновый двигатель", "Двигатель с искровым зажиганием"])
def test_a_petrol_engine_by_its_name_is_none(name):
    raw = tomllib.loads((samples_dir() / "ecoboost-10.toml").read_text("utf-8"))
    raw["engine"]["name"] = name
    assert told(raw) == []
    raw["engine"]["name"] = "Мой двигатель"
    (line,) = told(raw)
    assert "ε = 10 необычно для дизеля, о котором говорит ρ = 1,3" in line
