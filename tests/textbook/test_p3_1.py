"""Table П3.1, piston of the designed diesel; book: see ``book``."""

from tests.textbook.book import cells, disagreeing, errata, solution


def test_331_of_333_cells_agree_and_the_others_are_the_misprints() -> None:
    found = cells("P3_1", solution("gots-p3").columns["P3_1"])
    count, wrong = disagreeing(found, 1.5)
    assert count == 333
    assert wrong == errata("P3_1") == {(60.0, "s_mm"), (150.0, "j1_m_s2")}
