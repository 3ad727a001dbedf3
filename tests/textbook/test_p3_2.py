"""Table П3.2, rod of the designed diesel; book: see ``book``."""

from reports.validation.checks import check_cell
from reports.validation.gots import SWAPPED
from reports.validation.registry import table
from tests.textbook.book import beyond, checks, recorded, tolerance_of


def test_184_of_185_cells_agree_and_the_other_is_the_misprint() -> None:
    assert tolerance_of("P3_2").units == 1.5
    assert len(checks("P3_2")) == 185
    assert beyond("P3_2") == recorded("P3_2") == {("10", "beta_rad")}


def test_columns_of_eps_are_swapped_in_print() -> None:
    """By its own headers (1), (2) no row of ε but those of zeros would agree."""
    found = checks("P3_2")
    wrong = {
        key
        for key, check in found.items()
        if key[1] in SWAPPED
        and check_cell(
            table("P3_2"), check.cell, found[key[0], SWAPPED[key[1]]].ours
        ).verdict != "agrees"
    }  # fmt: skip
    assert {column for _, column in wrong} == set(SWAPPED)
    assert len(wrong) == 2 * 34
