"""Table П4.1, specific forces of the designed diesel; book: see ``book``."""

from tests.textbook.book import cells, disagreeing, errata, solution

# Printed 1.432; exact 1.4304. It agrees with the program's own 0.017453 rad per degree.
ROUNDED_PI = {(390.0, "S_MPa")}


def test_192_of_200_cells_agree_and_the_others_are_known() -> None:
    count, wrong = disagreeing(cells("P4_1", solution("gots-diesel").columns["P4_1"]), 1.5)
    assert count == 200
    assert wrong == errata("P4_1") | ROUNDED_PI
    assert len(wrong) == 8


def test_row_660_is_shifted_by_one_column_and_row_0_swapped_in_print() -> None:
    columns = solution("gots-diesel").columns["P4_1"]
    at = list(columns["phi_deg"]).index(660.0)
    printed_shifted = {"N_MPa": 0.297, "T_MPa": 1.047, "K_MPa": -0.261}
    for key, value in printed_shifted.items():
        assert abs(columns[key][at] - value) < 0.0015
    assert abs(columns["S_MPa"][0] - (-4.242)) < 0.0015
