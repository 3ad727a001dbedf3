"""Table П3.1, piston of the designed diesel; book: see ``book``."""

from tests.textbook.book import beyond, checks, recorded, tolerance_of


def test_331_of_333_cells_agree_and_the_others_are_the_misprints() -> None:
    assert tolerance_of("P3_1").units == 1.5
    assert len(checks("P3_1")) == 333
    assert beyond("P3_1") == recorded("P3_1") == {("60", "s_mm"), ("150", "j1_m_s2")}
