"""Table П4.1, specific forces of the designed diesel; book: see ``book``."""

from reports.validation.checks import Verdict
from tests.textbook.book import beyond, checks, recorded, solution, tolerance_of

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
