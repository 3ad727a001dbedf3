"""Table П3.2, rod of the designed diesel; book: see ``book``."""

from tests.textbook.book import cells, disagreeing, errata, solution

# The print has the two columns of ε the other way round than its own headers (1), (2).
SWAPPED = {
    "eps_rod_exact_1_s2": "eps_rod_approx_1_s2",
    "eps_rod_approx_1_s2": "eps_rod_exact_1_s2",
}


def test_184_of_185_cells_agree_and_the_other_is_the_misprint() -> None:
    found = cells("P3_2", solution("gots-p3").columns["P3_2"], rename=SWAPPED)
    count, wrong = disagreeing(found, 1.5)
    assert count == 185
    assert wrong == errata("P3_2") == {(10.0, "beta_rad")}


def test_columns_of_eps_are_swapped_in_print() -> None:
    _, wrong = disagreeing(cells("P3_2", solution("gots-p3").columns["P3_2"]), 1.5)
    assert {column for _, column in wrong} == {"beta_rad", *SWAPPED}
