"""Variants and grading of the torsional vibration, and a study over its results."""

from __future__ import annotations

import csv
from pathlib import Path

import pytest

from kshm import solve
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.inputs.to_si.engine import engine_and_cycle
from reports.model.evaluation import Evaluation
from reports.studies.sweep import sweep
from tests.conftest import sample
from tests.grading.chapter_class import ChapterClass, carried_from

RANGES = """
[variants]
"torsion.flywheel_kg_m2" = { values = [1.2, 1.6, 2.0] }
"torsion.pulley_kg_m2" = { min = 0.015, max = 0.03, step = 0.005 }
"""
SECTION = """
[torsion]
pulley_kg_m2 = 0.02
flywheel_kg_m2 = 1.6
"""
RUBRIC = """
[work]
fill = ["torsion_train", "torsion_forms", "torsion_critical", "torsion_response"]

[points]
"torsion_train" = 1
"torsion_forms" = 2
"torsion_critical" = 2
"""


CLASS = ChapterClass(SECTION + RANGES, RUBRIC)


def test_values_of_the_program_are_never_graded() -> None:
    assignment = CLASS.assignment
    assert not [item for item in assignment.items if item.block == "torsion_response"]
    assert [item for item in assignment.items if item.block == "torsion_critical"]


def test_a_wrong_inertia_is_wrong_once_and_carried_on() -> None:
    actual = carried_from(CLASS, "torJ2", "torsion_train.tor_J_kgm2")
    assert "torsion_forms.tor_theta1" in actual


def test_every_variant_has_values_of_its_own() -> None:
    assignment = CLASS.assignment
    values = Evaluation(assignment.model).value("torsion_response.tor_tau_MPa")
    wanted = solve(*engine_and_cycle(assignment.model.input)).columns["torsion_response"]
    assert values == pytest.approx(wanted["tor_tau_MPa"])


def test_a_study_over_the_flywheel(tmp_path: Path) -> None:
    raw = to_mapping(sample("gots-diesel"))
    raw["torsion"] = {"flywheel_kg_m2": 1.0}
    raw["calculation"]["step_deg"] = 30
    import tomlkit

    base = tmp_path / "base.toml"
    base.write_text(tomlkit.dumps(raw), encoding="utf-8")
    target = tmp_path / "a.csv"
    wanted = ("tor_f1_hz", "tor_worst", "tor_worst_rpm", "tor_top_MPa")
    sweep(base, ("torsion.flywheel_kg_m2=0.5:2.5:3",), target, quantities=wanted)
    rows = list(csv.DictReader(target.open(encoding="utf-8")))
    collected = [float(row["tor_f1_hz"]) for row in rows]
    assert collected == sorted(collected, reverse=True)
    raw["torsion"]["flywheel_kg_m2"] = 1.5
    single = solve(*engine_and_cycle(load_mapping(raw, source="one").model)).scalars
    assert collected[1] == pytest.approx(single["tor_f1_hz"])
    assert float(rows[1]["tor_worst"]) == pytest.approx(single["tor_worst"])
    tops = [float(row["tor_top_MPa"]) for row in rows]
    assert len({round(top, 6) for top in tops}) == 3
    assert tops[1] == pytest.approx(single["tor_top_MPa"])
