"""Pins and journals of their own size per throw: both statements agree, refusals name the keys."""

from __future__ import annotations

import numpy as np
import pytest

from kshm import solve
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.inputs.to_si.engine import engine_and_cycle
from reports.model.evaluation import evaluate_model
from reports.shared.errors import InputError
from reports.tables.registry import build_model
from tests.conftest import sample

LISTS = {"pin_diameter_mm": (0, -2.0), "pin_length_mm": (0, 1.0), "main_diameter_mm": (1, 3.0)}


def with_lists(name: str) -> dict:
    raw = to_mapping(sample(name))
    shaft = raw["crankshaft"]
    for key, (more, step) in LISTS.items():
        size, count = shaft.pop(key), len(shaft["throw_angles_deg"]) + more
        shaft[key.replace("_mm", "s_mm")] = [size + step * i for i in range(count)]
    return raw


@pytest.mark.parametrize("name", ["gots-diesel", "yamz-236"])
def test_both_statements_agree(name):
    model = load_mapping(with_lists(name), source="x").model
    engine, cycle = engine_and_cycle(model)
    solution = solve(engine, cycle=cycle)
    values = evaluate_model(build_model(model))
    assert set(solution.scalars) <= set(values.scalars)
    for key, expected in solution.scalars.items():
        assert float(values.scalars[key]) == pytest.approx(expected, rel=1e-9, abs=1e-9), key
    for table in set(values.columns) & set(solution.columns):
        for key in set(values.columns[table]) & set(solution.columns[table]):
            expected = solution.columns[table][key]
            allowed = 1e-9 * max(1.0, float(np.abs(expected).max()))
            gap = np.abs(np.asarray(values.columns[table][key], dtype=float) - expected)
            assert gap.max() <= allowed, (table, key)


def test_each_pin_has_its_own_pressure():
    model = load_mapping(with_lists("gots-diesel"), source="x").model
    engine, _ = engine_and_cycle(model)
    actual = solve(engine).scalars
    areas = [(56 - 2 * i) * (28 + i) for i in range(3)]
    pressures = [actual[f"q_pin{n}_max"] for n in ("", 2, 3)]
    # The pins of one row carry the same load at other angles of the shaft.
    assert [p * a for p, a in zip(pressures, areas, strict=True)] == pytest.approx(
        [pressures[0] * areas[0]] * 3
    )


@pytest.mark.parametrize("key", LISTS)
def test_a_size_is_given_once(key):
    raw = to_mapping(sample("gots-diesel"))
    each = key.replace("_mm", "s_mm")
    raw["crankshaft"][each] = [raw["crankshaft"][key]] * (3 + LISTS[key][0])
    with pytest.raises(InputError, match=f"crankshaft.{each}: размер задан дважды"):
        load_mapping(raw, source="x")
    del raw["crankshaft"][each], raw["crankshaft"][key]
    with pytest.raises(InputError, match=f"crankshaft.{key}: обязательный ключ не задан"):
        load_mapping(raw, source="x")
    raw["crankshaft"][each] = [50.0]
    with pytest.raises(InputError, match=f"crankshaft.{each}: записей 1, а нужно"):
        load_mapping(raw, source="x")


def test_a_file_of_24_cylinders():
    raw = to_mapping(sample("gots-diesel"))
    shaft, count = raw["crankshaft"], 24
    raw["engine"]["cylinders"] = count
    offsets = [(30.0 * i) % 720 for i in range(count)]
    shaft["firing_offsets_deg"] = offsets
    shaft["throw_angles_deg"] = [-offset % 360 for offset in offsets]
    shaft["main_lengths_mm"] = [32.0] * (count + 1)
    shaft["webs"], shaft["arms"] = shaft["webs"][:1] * 2 * count, shaft["arms"][:1] * count
    engine, _ = engine_and_cycle(load_mapping(raw, source="x").model)
    one, _ = engine_and_cycle(sample("gots-diesel"))
    assert solve(engine).scalars["M_mean"] == pytest.approx(8 * solve(one).scalars["M_mean"])
