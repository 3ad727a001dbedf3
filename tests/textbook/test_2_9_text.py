"""Numbers in the text of section 2.9, masses by table 4; book: see ``book``."""

from __future__ import annotations

import pytest

from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.tables.registry import build_model
from reports.tables.values import evaluate_model
from tests.conftest import sample


def test_masses_from_masses_per_area() -> None:
    """m′п = 250, m′ш = 288, m′к = 150 кг/м² and m1 = 0,275 mш."""
    raw = to_mapping(sample("gots-diesel"))
    raw["masses"] = {
        "estimate_fuel": "diesel", "estimate_piston_kg_per_m2": 250.0,
        "estimate_rod_kg_per_m2": 288.0, "estimate_throw_kg_per_m2": 150.0,
    }  # fmt: skip
    raw["crankshaft"].pop("pin_mass_kg")
    for web in raw["crankshaft"]["webs"]:
        web.pop("mass_kg")
    values = evaluate_model(build_model(load_mapping(raw, source="2.9").model)).scalars
    printed = {
        "m_piston": 1.520, "m_rod": 1.752, "m_k": 0.912, "m_1": 0.482, "m_2": 1.269,
        "m_j": 2.002, "m_r": 2.181,
    }  # fmt: skip
    for key, value in printed.items():
        # The book multiplies with F = 0.006082 m² rounded and adds rounded numbers.
        assert values[key] == pytest.approx(value, abs=0.0015), key
