"""Numbers in the text of section 2.9; book: see ``book``."""

from __future__ import annotations

import pytest

from reports.studies.validation_checks import Verdict
from tests.textbook.book import beyond, checks, ours, recorded, solution

MISPRINTS = {
    "phi_vmax", "phi_vmin", "p_j_factor", "K_r_spec", "M_factor", "R_pin_min", "R_pin_min_kN",
    "R_main_max", "phi_main_max", "R_main_max_kN",
}  # fmt: skip
UNKNOWN = {"M_dynamic", "M_error"}  # the mean torque 149.1 N·m

# The book multiplies and adds rounded numbers; everything else is held to half a digit.
ROUNDED_BY_THE_WAY = {
    "m_piston": 1.5, "m_k": 1.5, "m_1": 1.5, "m_2": 1.5, "m_j": 1.5, "m_r": 1.5, "K_r": 1.5,
    "s_90": 1.0, "M_main3_max": 1.0, "M_main3_min": 1.0, "M_pin3_max": 1.0, "M_pin3_min": 1.0,
    "R_pin_min_kN": 1.5, "R_main_min_kN": 3.5,
}  # fmt: skip


def test_30_of_42_numbers_agree_and_the_others_are_known() -> None:
    actual = checks("text_2_9")
    assert len(actual) == 42
    assert beyond("text_2_9") == recorded("text_2_9")
    assert {row for row, _ in recorded("text_2_9", Verdict.MISPRINT)} == MISPRINTS
    assert {row for row, _ in recorded("text_2_9", Verdict.NOT_REPRODUCED)} == UNKNOWN
    units = {row: check.cell.units for (row, _), check in actual.items()}
    assert {row: wide for row, wide in units.items() if wide != 0.5} == ROUNDED_BY_THE_WAY


def test_factors_lost_powers_of_ten_and_swapped_digits() -> None:
    """K_r уд in kPa's place, p′_j without 10⁻⁶, 0,22858 for 0,28585."""
    for row, factor in (("K_r_spec", 1000.0), ("p_j_factor", -1e-6)):
        printed = checks("text_2_9")[row, ""].printed.value
        assert ours("text_2_9", row) == pytest.approx(factor * printed, rel=2e-3)
    assert sorted("28585") != sorted("22858")
    assert ours("text_2_9", "M_factor") == pytest.approx(0.28585e-3, abs=2e-8)


def test_least_crankpin_load_is_a_local_minimum() -> None:
    """7.64 kN at 387° is printed; the least load is less than half of it."""
    pin = solution("gots-diesel", 3).columns["crankpin"]
    at = list(pin["phi_deg"]).index(387.0)
    printed = checks("text_2_9")["R_pin_min", ""].printed.value
    assert pin["Rpin_MPa"][at] == pytest.approx(printed, abs=0.005)
    assert pin["Rpin_MPa"][at] < min(pin["Rpin_MPa"][at - 1], pin["Rpin_MPa"][at + 1])
    assert ours("text_2_9", "R_pin_min") < printed / 2


def test_interval_between_the_firings() -> None:
    """θ = 720/3 = 240°."""
    engine = solution("gots-diesel").engine
    assert sorted(round(x * 57.29577951308232) for x in engine.firing_offsets) == [0, 240, 480]
