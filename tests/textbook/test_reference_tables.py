"""Reference tables 1, 2, 3 and 5-8 of chapters 1 and 2; book: see ``book``."""

import pytest

from tests.textbook.book import beyond, checks, recorded, tolerance_of

AGREEING = {
    "table_1": 114, "table_2": 110, "table_3": 102, "table_5": 113,
    "table_6": 105, "table_7": 113, "table_8": 114,
}  # fmt: skip


@pytest.mark.parametrize("table", AGREEING)
def test_cells_agree_but_for_the_misprints(table: str) -> None:
    assert tolerance_of(table).units == 1.5
    numbers = {key for key in checks(table) if key[1].startswith("lambda")}
    assert len(numbers) == 114
    assert len(numbers - beyond(table)) == AGREEING[table]
    assert beyond(table) == recorded(table)


@pytest.mark.parametrize("table", [name for name in AGREEING if name != "table_1"])
def test_signs_agree_but_for_the_misprints(table: str) -> None:
    signs = {key for key in checks(table) if key[1].startswith("sign")}
    assert len(signs) == (36 if table == "table_7" else 38)  # two places are empty in print
    expected = {("80", "sign"), ("80", "sign_mirror")} if table == "table_3" else set()
    assert beyond(table) & signs == expected
    printed = {sign.cell.text for key, sign in checks(table).items() if key in signs}
    assert printed <= {"+", "-", "–", "—"}


def test_row_130_of_table_3_is_row_140_of_table_2() -> None:
    other = {key[1]: check.cell.text for key, check in checks("table_2").items() if key[0] == "140"}
    slipped = {key[1]: c.cell.text for key, c in checks("table_3").items()
               if key in beyond("table_3") and key[0] == "130"}  # fmt: skip
    assert slipped == {key: other[key] for key in slipped}
    assert len(slipped) == 5
