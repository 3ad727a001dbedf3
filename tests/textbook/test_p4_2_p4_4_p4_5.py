"""Tables П4.2, П4.4, П4.5, torques of the designed diesel; book: see ``book``.

The program summed printed, rounded torques: half a newton metre each.
"""

import pytest

from tests.textbook.book import beyond, checks, recorded, rows_of, solution, tolerance_of


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
