"""Hand-computed cases of docs/bearings.md, inputs that are refused, the chapter's sentences."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest

from kshm import solve
from kshm.mechanics import bearings
from kshm.mechanics.bearings import BearingArrays
from reports.document.report import Report
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.inputs.to_si.engine import engine_and_cycle
from reports.model.evaluation import evaluate_model
from reports.shared.errors import InputError
from reports.tables.registry import build_model
from tests.bearings.files import tractor
from tests.conftest import sample


def one(*values: float) -> BearingArrays:
    return BearingArrays(*(np.array([value]) for value in values))


def test_the_published_pressure() -> None:
    bearing = one(0.068, 0.038, 1, 0.131e-3, 200.0, 0.005)
    assert 11745 / float(bearing.area[0]) / 1e6 == pytest.approx(4.545, abs=5e-4)


def test_the_largest_clearance_of_the_published_bearing_has_too_little_reserve() -> None:
    """At μ 0.00657 Pa·s and 2200 min⁻¹ less than 1.5 of the 3 μm that the sheet takes."""
    omega = 2200 * np.pi / 30
    gaps = []
    for clearance in (0.057e-3, 0.131e-3):
        bearing = one(0.068, 0.038, 1, clearance, omega, 0.005)
        number = bearing.load_number(np.array([11745.0]), np.array([0.00657]))
        e = bearings.steady_eccentricity(number, bearing.width)
        gaps.append(float(bearings.gap(e, bearing.clearance)[0]))
    assert gaps[1] < gaps[0]
    assert gaps[1] < 1.5 * 3e-6


def test_a_film_by_hand() -> None:
    actual = float(bearings.rotation_number(np.array(0.9), np.array(0.5)))
    assert actual == pytest.approx(5.378, abs=5e-4)


def test_torsion_by_hand() -> None:
    modulus = bearings.polar_modulus(np.array(0.06), np.array(0.0))
    swing = bearings.Swing.of(np.array(700.0), np.array(-300.0), modulus)
    factor = bearings.concentration(1.8, 0.7) / 0.75
    assert factor == pytest.approx(2.08)
    assert float(swing.amplitude) == pytest.approx(11.79e6, abs=5e3)
    assert float(bearings.safety(swing, 150e6, factor, 0.08)) == pytest.approx(6.02, abs=5e-3)


def test_bending_and_torsion_together_by_hand() -> None:
    assert float(bearings.together(np.array(3.0), np.array(4.0))) == pytest.approx(2.4)


def test_the_class_rule_by_hand() -> None:
    actual = bearings.class_strength(np.array(600e6), np.array(0.06), np.array(0.004), 1.05)
    assert float(actual) == pytest.approx(287.0e6, abs=5e4)


def test_the_heat_is_carried_away() -> None:
    actual = solve(*engine_and_cycle(tractor(30))).scalars
    for n in range(1, 13):
        carried = 850 * 2100 * actual[f"oil_through{n}_l_min"] / 6e4 * actual[f"oil_hot{n}_C"]
        assert carried == pytest.approx(actual[f"oil_friction{n}_W"], rel=1e-9)
        assert actual[f"oil_temp{n}_C"] == pytest.approx(80 + actual[f"oil_hot{n}_C"] / 2, rel=1e-9)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"pin_width_mm": 90.0}, "B/d"),
        ({"main_groove_mm": 30.0}, "B/d"),
        ({"pin_clearance_min_mm": 0.2}, "больше наибольшего"),
        ({"viscosity_40_mpa_s": 5.0}, "вязкость при 40"),
        ({"pin_bore_mm": 70.0}, "не меньше"),
        ({"journal_roughness_um": 0.0, "shell_roughness_um": 0.0, "form_um": 0.0}, "равна нулю"),
    ],
)
def test_what_contradicts_itself_is_refused(changes: dict[str, Any], said: str) -> None:
    with pytest.raises(InputError, match=re.escape(said)):
        tractor(30, **changes)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"torsion_limit_mpa": 300.0, "bending_limit_mpa": 200.0}, "предел при кручении 300 МПа"),
        ({"bending_limit_mpa": 700.0, "tensile_mpa": 600.0}, "не меньше предела прочности 600"),
        ({"oil_temperature_c": 20.0}, "холоднее, чем перед подшипником"),
    ],
)
def test_what_is_odd_about_another_value_is_told(changes: dict[str, Any], said: str) -> None:
    raw = to_mapping(sample("d-240-bearings"))
    raw["bearings"] |= changes
    assert any(said in str(warning) for warning in load_mapping(raw, source="").warnings)


def page(**bearings: Any) -> str:
    data = tractor(30, **bearings)
    report = data.report.model_copy(update={"chapters": ("oil",)})
    model = build_model(data.model_copy(update={"report": report}))
    text = Report(model, evaluate_model(model)).page("screen").replace("\u00a0", " ")
    text = re.sub(r"<(svg|style|script).*?</\1>", "", text, flags=re.S)
    return re.sub(r"\s+", " ", re.sub(r"<[^>]+>", "", text))


def test_the_sentences_follow_the_numbers() -> None:
    good, bad = page(), page(form_um=9.0, safety_allowed=9.0)
    assert "плёнки достаточно" in good
    assert "при сохранении массы масла плёнка тоньше" in good
    assert "прочность обеспечена" in good
    assert "запаса плёнки недостаточно" in bad
    assert "возможно касание неровностей" in bad
    assert "прочность недостаточна" in bad
