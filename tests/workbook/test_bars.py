"""Bars of values by their limits: ends are those of the ranges and of the inputs."""

from __future__ import annotations

import io

import openpyxl
import pytest

from kshm.ranges import RANGES
from reports.model.evaluation import evaluate_model
from reports.tables.registry import build_model
from reports.workbook.write import workbook_bytes
from tests.conftest import sample


@pytest.fixture(scope="module")
def book() -> openpyxl.Workbook:
    model = build_model(sample("vaz-2106"))
    return openpyxl.load_workbook(io.BytesIO(workbook_bytes(model, evaluate_model(model))))


def bar_at(book: openpyxl.Workbook, name: str) -> list[tuple[str, str | None]]:
    """Kinds and values of the ends of the bar in a named cell."""
    title, at = next(book.defined_names[name].destinations)
    rules = [rule for area in book[title].conditional_formatting
             if str(area.sqref) == at.replace("$", "") for rule in area.rules]  # fmt: skip
    (bar,) = (rule.dataBar for rule in rules if rule.dataBar is not None)
    assert any(rule.colorScale is not None for rule in rules)
    return [(end.type, end.val) for end in bar.cfvo]


@pytest.mark.parametrize(("check", "key"), [("crown", "st_crown_MPa"), ("q1", "st_q1_MPa")])
def test_a_full_bar_is_the_end_of_the_usual_range(book, check, key):
    (_, low), (kind, most) = bar_at(book, f"value_range_{check}")
    assert float(low) == 0 and kind == "num"
    assert float(most) == RANGES[key].of("aluminium")[1]


def test_a_full_bar_is_twice_the_least_safety(book):
    assert bar_at(book, "value_st_bolt")[1] == ("formula", "2*strength_safety_allowed")
