"""Main results under English names, and studies of an engine without files."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import kshm
import reports
from kshm.results.named import NAMES
from reports.inputs.to_si.engine import engine_and_cycle
from tests.conftest import sample, sample_names


@pytest.mark.parametrize("name", sample_names())
def test_every_name_is_a_result_of_an_engine_that_has_it(name):
    solution = kshm.solve(*engine_and_cycle(sample(name)))
    for group in NAMES:
        results = getattr(solution, group)
        for each in dir(results):
            values = getattr(results, each)
            for result in values if isinstance(values, tuple) else (values,):
                assert result == solution.scalars[result.key]
                assert result.title and result.symbol in repr(result)
    assert len(solution.loads.journal_max) == len(solution.engine.crankshaft.main_lengths)
    assert solution.loads.crankpin_max.unit == "кН"
    assert solution._repr_html_().count("<tr>") > 20


def test_every_name_stands_for_something():
    solutions = [kshm.solve(*engine_and_cycle(sample(name))) for name in ("d-240", "yamz-236")]
    collected = {(g, n) for s in solutions for g in NAMES for n in dir(getattr(s, g))}
    assert collected == {(group, name) for group, names in NAMES.items() for name in names}


def test_what_there_is_not_is_told():
    solution = kshm.solve(*engine_and_cycle(sample("ecoboost-10")))
    with pytest.raises(AttributeError, match=r"loads\.nothing: no such result; names: crankp"):
        _ = solution.loads.nothing
    with pytest.raises(AttributeError, match="is not calculated for this engine"):
        _ = solution.balance.rotating_force


def test_an_engine_of_a_file_and_of_its_mapping(tmp_path):
    from reports.inputs.fields import to_mapping

    path = "samples/d-240.toml"
    engine = reports.load(path)
    assert engine == engine_and_cycle(sample("d-240"))[0]
    assert reports.load(to_mapping(sample("d-240"))) == engine
    odd = to_mapping(sample("d-240"))
    odd["regime"]["mechanical_efficiency"] = 1.0
    with pytest.warns(UserWarning, match=r"regime\.mechanical_efficiency"):
        reports.load(odd)


def test_a_study_is_each_engine_alone():
    engine = reports.load("samples/gots-diesel.toml")
    vary = {"bore_mm": [84, 92], "speed_rpm": [2000, 3000, 4000], "gas.rho": [1.2, 1.3]}
    study = kshm.sweep(engine, vary, quantities=("M_mean", "Rmain2_max"))
    assert study.shape == (12, 6) and list(study["bore_mm"][:3]) == [84, 92, 84]
    row = study.iloc[7]
    alone = replace(
        engine,
        omega=row["speed_rpm"] * np.pi / 30,
        geometry=replace(engine.geometry, bore=row["bore_mm"] / 1000),
        gas=replace(engine.gas, rho=row["gas.rho"]),
    )
    scalars = kshm.solve(alone).scalars
    for key in ("M_mean", "Rmain2_max"):
        assert row[key] == pytest.approx(scalars[key], rel=1e-12)
    pairs = kshm.sweep(engine, {"bore_mm": [84, 92], "speed_rpm": [2000, 3000]}, pairwise=True)
    assert len(pairs) == 2 and pairs.attrs["units"]["Rpin_max_kN"] == "кН"


@pytest.mark.parametrize(
    ("vary", "words"),
    [
        ({}, "name something"),
        ({"bore": [1]}, "bore: no such name; similar: bore_mm"),
        ({"gas.rho.x": [1]}, r"gas\.rho\.x: no such name; similar: gas\.rho"),
        ({"bore_mm": []}, "bore_mm: the list of values is empty"),
        ({"bore_mm": ["a"]}, "bore_mm: must be a number, not 'a'"),
        ({"bore_mm": 88}, "bore_mm: must be a list of numbers"),
        ({"bore_mm": [1, 2], "speed_rpm": [1]}, "pairwise lists must have one length"),
        ({3: [1]}, "name: must be a text, not 3"),
    ],
)
def test_a_study_of_nothing_is_refused(vary, words):
    with pytest.raises(ValueError, match=words):
        kshm.sweep(reports.load("samples/gots-diesel.toml"), vary, pairwise="speed_rpm" in vary)


def test_a_bad_value_is_a_row_with_its_reason():
    engine = reports.load("samples/gots-diesel.toml")
    lines = []
    study = kshm.sweep(
        engine,
        {"geometry.bore_mm": [84, -1, 92], "gas.rho": [1.2]},
        quantities=["loads.journal_max", "torque.mean", "P4_1.N_MPa"],
        progress=lambda done, total: lines.append((done, total)),
    )
    assert list(study["error"].str.len() > 0) == [False, True, False] and lines == [(3, 3)]
    assert "bore_mm = -1, gas.rho = 1.2: " in study.loc[1, "error"]
    assert study[["Rmain1_max_kN", "M_mean", "P4_1.N_MPa.max_deg"]].isna().sum().tolist() == [1] * 3
    assert study.attrs["units"]["geometry.bore_mm"] == "мм"


def test_a_study_in_processes_is_the_same():
    engine = reports.load("samples/gots-diesel.toml")
    vary = {"geometry.bore_mm": np.linspace(84, 92, 200)}
    assert kshm.sweep(engine, vary, jobs=2).equals(kshm.sweep(engine, vary))
