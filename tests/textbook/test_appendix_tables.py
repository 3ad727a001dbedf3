"""Tables П3.1, П3.2 and П4.1-П4.5 of the designed diesel; book: see ``book``.

Torques: the program summed printed, rounded ones, half a newton metre each.  Table П4.3
belongs to another run than the rest; the sample gots-p43 holds its data and gives its phases
explicitly.
"""

from __future__ import annotations

import pytest

from reports.studies.validation_checks import Verdict, check_cell
from reports.studies.validation_lookups import SWAPPED
from reports.studies.validation_registry import table
from tests.textbook.book import beyond, checks, recorded, rows_of, solution, tolerance_of


def test_331_of_333_cells_agree_and_the_others_are_the_misprints() -> None:
    assert tolerance_of("P3_1").units == 1.5
    assert len(checks("P3_1")) == 333
    assert beyond("P3_1") == recorded("P3_1") == {("60", "s_mm"), ("150", "j1_m_s2")}


def test_184_of_185_cells_agree_and_the_other_is_the_misprint() -> None:
    assert tolerance_of("P3_2").units == 1.5
    assert len(checks("P3_2")) == 185
    assert beyond("P3_2") == recorded("P3_2") == {("10", "beta_rad")}


def test_columns_of_eps_are_swapped_in_print() -> None:
    """By its own headers (1), (2) no row of ε but those of zeros would agree."""
    actual = checks("P3_2")
    wrong = {
        key
        for key, check in actual.items()
        if key[1] in SWAPPED
        and check_cell(
            table("P3_2"), check.cell, actual[key[0], SWAPPED[key[1]]].ours
        ).verdict != "agrees"
    }  # fmt: skip
    assert {column for _, column in wrong} == set(SWAPPED)
    assert len(wrong) == 2 * 34


MISPRINTS = {
    ("0", "N_MPa"), ("0", "S_MPa"), ("300", "K_MPa"),
    ("660", "N_MPa"), ("660", "S_MPa"), ("660", "T_MPa"), ("660", "K_MPa"),
}  # fmt: skip
# Printed 1.432; exact 1.4304. It agrees with the program's own 0.017453 rad per degree.
ROUNDED_PI = {("390", "S_MPa")}


def test_192_of_200_cells_agree_and_the_others_are_known() -> None:
    assert tolerance_of("P4_1").units == 1.5
    assert len(checks("P4_1")) == 200
    assert beyond("P4_1") == MISPRINTS | ROUNDED_PI
    assert recorded("P4_1", Verdict.MISPRINT) == MISPRINTS
    assert recorded("P4_1", Verdict.NOT_REPRODUCED) == ROUNDED_PI


def test_row_660_is_shifted_by_one_column_and_row_0_swapped_in_print() -> None:
    columns = solution("gots-diesel").columns["P4_1"]
    at = list(columns["phi_deg"]).index(660.0)
    printed_shifted = {"N_MPa": 0.297, "T_MPa": 1.047, "K_MPa": -0.261}
    for key, value in printed_shifted.items():
        assert abs(columns[key][at] - value) < 0.0015
    assert abs(columns["S_MPa"][0] - (-4.242)) < 0.0015


@pytest.mark.parametrize(
    ("table", "count", "misprints"),
    [("P4_2", 100, set()), ("P4_4", 125, set()), ("P4_5", 125, {("270", "Mpin2_Nm")})],
)
def test_within_one_newton_metre(table: str, count: int, misprints: set) -> None:
    assert tolerance_of(table).absolute == 1.0
    assert len(checks(table)) == count
    assert beyond(table) == misprints == recorded(table)


def test_sign_of_the_misprint() -> None:
    (row,) = [row for row in rows_of("P4_5") if row["phi_deg"] == "270"]
    columns = solution("gots-diesel").columns["P4_5"]
    at = list(columns["phi_deg"]).index(270.0)
    assert abs(columns["Mpin2_Nm"][at] + float(row["Mpin2_Nm"])) < 1.0


def test_printed_torques_are_shifted_copies_of_the_first_cylinder() -> None:
    """All of П4.2, П4.4 and П4.5 follow from the printed column M of П4.1."""
    torque = {float(row["phi_deg"]): float(row["M_Nm"]) for row in rows_of("P4_1")}
    for row in rows_of("P4_2"):
        angle = float(row["phi_deg"])
        shifted = [torque[(angle - offset) % 720] for offset in (0, 240, 480)]
        printed = [float(row[f"M{i}_Nm"]) for i in (1, 2, 3)]
        assert printed == shifted
        assert float(row["Msum_Nm"]) == sum(printed)


def test_extremes_of_section_2_9_belong_to_the_printed_grid() -> None:
    """829 and −697 N·m are values at multiples of 30°; the 3° grid gives 835 and −699."""
    coarse = solution("gots-diesel", 30).scalars
    assert (round(coarse["M_max"]), round(coarse["M_min"])) == (829, -697)
    fine = solution("gots-diesel", 3).scalars
    assert (round(fine["M_max"]), round(fine["M_min"])) == (835, -699)


LABELS = [float(row["phi_deg"]) for row in rows_of("P4_3")]


def test_142_of_144_cells_agree_and_the_others_are_the_misprints() -> None:
    assert tolerance_of("P4_3").units == 1.5
    assert len(checks("P4_3")) == 144
    assert beyond("P4_3") == recorded("P4_3") == {("220", "Ry_MPa"), ("610", "Rx_MPa")}


def test_missing_row_and_true_maximum() -> None:
    ours = solution("gots-p43", 3).columns["P4_3_3"]
    angles = list(ours["phi_deg"])
    assert 110.0 not in LABELS
    at = angles.index(111.0)
    assert abs(ours["Rx_MPa"][at] + 1.588) < 0.0015
    assert abs(ours["Ry_MPa"][at] + 1.212) < 0.0015
    at = angles.index(612.0)
    assert ours["R_MPa"].argmax() == at
    assert abs(ours["R_MPa"][at] - 2.766) < 0.0015


def test_consistent_phases_give_another_maximum() -> None:
    """With the phases that fit the shaft the same run peaks at 132° with 3.580 MPa."""
    from dataclasses import replace

    from kshm import solve

    engine = replace(solution("gots-p43", 3).engine, force_offsets=None)
    ours = solve(engine).columns["P4_3_3"]
    at = ours["R_MPa"].argmax()
    assert ours["phi_deg"][at] == 132.0
    assert abs(ours["R_MPa"][at] - 3.580) < 0.0015
