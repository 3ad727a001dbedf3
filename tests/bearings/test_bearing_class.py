"""Variants and grading of the oil film and the safety, and a study over its results."""

from __future__ import annotations

import csv
import re
from pathlib import Path

import pytest
import tomlkit

from reports.inputs.fields import to_mapping
from reports.shared.errors import InputError
from reports.studies.sweep import sweep
from tests.conftest import sample
from tests.grading.chapter_class import ChapterClass, carried_from, unlike_right

ADDED = """
[bearings]
pin_clearance_max_mm = 0.12
supply_c = 85.0

[variants]
"bearings.pin_clearance_max_mm" = { values = [0.11, 0.12, 0.13] }
"bearings.supply_c" = { min = 75.0, max = 95.0, step = 5.0 }
"""
RUBRIC = """
[work]
fill = [FILMS "oil_results", "safe_main", "safe_pins", "safety", "oil_orbits"]

[points]
"oil_results" = 2
"safe_main" = 2
"safety" = 2
""".replace("FILMS", "".join(f'"oil_film_{n}", ' for n in range(1, 11)))


CLASS = ChapterClass(ADDED, RUBRIC)


def test_values_of_the_program_are_never_graded() -> None:
    assignment = CLASS.assignment
    assert not [item for item in assignment.items if item.block == "oil_orbits" and not item.helper]
    assert [item for item in assignment.items if item.block == "oil_results"]


def test_a_wrong_modulus_is_wrong_once_and_carried_on() -> None:
    assert carried_from(CLASS, "safe_W2_cm3", "safe_main.safe_W2_cm3")


def test_what_a_refused_class_is_told_to_leave_out_makes_it_fit_to_issue() -> None:
    rubric = '[work]\nfill = ["oil_*"]\n'
    with pytest.raises(InputError, match="содержала бы ответы") as refusal:
        _ = ChapterClass(ADDED, rubric).assignment
    line = str(refusal.value).rpartition("work.")[2]
    issued = ChapterClass(ADDED, rubric + line)
    assert not {item.id for item in issued.assignment.items} & set(re.findall('"(.+?)"', line))
    result = issued.marks()
    assert unlike_right(result) == {}
    assert result["points"] == pytest.approx(100)


def test_a_study_over_the_clearance(tmp_path: Path) -> None:
    raw = to_mapping(sample("gots-diesel"))
    raw["bearings"] = {"pin_clearance_max_mm": 0.1}
    raw["calculation"]["step_deg"] = 30
    base, target = tmp_path / "base.toml", tmp_path / "a.csv"
    base.write_text(tomlkit.dumps(raw), encoding="utf-8")
    wanted = ("oil_chi2", "oil_K2", "safe_n_pin")
    sweep(base, ("bearings.pin_clearance_max_mm=0.1:0.2:3",), target, quantities=wanted)
    rows = list(csv.DictReader(target.open(encoding="utf-8")))
    collected = [float(row["oil_chi2"]) for row in rows]
    assert collected == sorted(collected)
    assert len({row["safe_n_pin"] for row in rows}) == 1
