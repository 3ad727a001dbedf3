"""Variants and grading of the oil film and the safety, and a study over its results."""

from __future__ import annotations

import csv
from functools import lru_cache
from pathlib import Path
from tempfile import mkdtemp

import pytest
import tomlkit

from reports.grading.issuing.assignment import Assignment
from reports.grading.issuing.issue import assignment_for, issue
from reports.grading.judging.marking import Marker
from reports.grading.reading.submissions import Submission
from reports.inputs.fields import to_mapping
from reports.shared.resources import samples_dir
from reports.studies.run import sweep
from reports.workbook.layout import Layout
from tests.conftest import sample
from tests.grading.classroom import roster_text
from tests.grading.fill import filled_book, solved_formulas

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


@lru_cache(maxsize=1)
def issued():
    folder = Path(mkdtemp(prefix="kshm-bearings-"))
    text = (samples_dir() / "gots-diesel.toml").read_text(encoding="utf-8")
    text = text.replace("step_deg = 10", "step_deg = 30") + ADDED
    (folder / "base.toml").write_text(text, encoding="utf-8")
    (folder / "group.csv").write_text(roster_text(2), encoding="utf-8")
    (folder / "rubric.toml").write_text(RUBRIC, encoding="utf-8")
    result = issue(
        folder / "base.toml", folder / "group.csv", folder / "issued", seed=7,
        rubric_file=folder / "rubric.toml", secret_file=folder / "secret.key",
    )  # fmt: skip
    book = result.register.books[0]
    data = (folder / "issued" / book.folder / book.file).read_bytes()
    return result.register, assignment_for(book, result.register.rubric), data


def marks(changes=None) -> dict:
    register, assignment, handout = issued()
    data = filled_book(handout, assignment, changes)
    return Marker(register).mark(Submission("р.xlsx", Path("р.xlsx"), None, None), data)


def wrong(result: dict) -> dict[str, str]:
    return {line["id"]: line["verdict"] for line in result["items"] if line["verdict"] != "right"}


def test_values_of_the_program_are_never_graded() -> None:
    assignment: Assignment = issued()[1]
    assert not [item for item in assignment.items if item.block == "oil_orbits" and not item.helper]
    assert [item for item in assignment.items if item.block == "oil_results"]


def test_a_right_book_is_right_throughout() -> None:
    result = marks()
    assert wrong(result) == {}
    assert result["points"] == pytest.approx(100)


def test_a_wrong_modulus_is_wrong_once_and_carried_on() -> None:
    _, assignment, _ = issued()
    right = solved_formulas(assignment, Layout.of(assignment.model))["safe_W2_cm3"]
    found = wrong(marks({"safe_W2_cm3": [f"{right[0]}*1.5"]}))
    assert found.pop("safe_main.safe_W2_cm3") == "wrong"
    assert found
    assert set(found.values()) <= {"carried"}


def test_a_study_over_the_clearance(tmp_path: Path) -> None:
    raw = to_mapping(sample("gots-diesel"))
    raw["bearings"] = {"pin_clearance_max_mm": 0.1}
    raw["calculation"]["step_deg"] = 30
    base, target = tmp_path / "base.toml", tmp_path / "a.csv"
    base.write_text(tomlkit.dumps(raw), encoding="utf-8")
    wanted = ("oil_chi2", "oil_K2", "safe_n_pin")
    sweep(base, ("bearings.pin_clearance_max_mm=0.1:0.2:3",), target, quantities=wanted)
    rows = list(csv.DictReader(target.open(encoding="utf-8")))
    found = [float(row["oil_chi2"]) for row in rows]
    assert found == sorted(found)
    assert len({row["safe_n_pin"] for row in rows}) == 1
