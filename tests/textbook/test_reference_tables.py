"""Reference tables 1, 2, 3 and 5-8 of chapters 1 and 2; book: see ``book``."""

import pytest

from kshm.solution import reference_tables
from tests.textbook.book import cells, disagreeing, errata, rows_of

AGREEING = {
    "table_1": 114, "table_2": 110, "table_3": 102, "table_5": 113,
    "table_6": 105, "table_7": 113, "table_8": 114,
}  # fmt: skip


@pytest.mark.parametrize("table", AGREEING)
def test_cells_agree_but_for_the_misprints(table: str) -> None:
    count, wrong = disagreeing(cells(table, reference_tables()[table]), 1.5)
    assert count == 114
    assert count - len(wrong) == AGREEING[table]
    assert wrong == errata(table)


@pytest.mark.parametrize("table", [name for name in AGREEING if name != "table_1"])
def test_signs_agree_but_for_the_misprints(table: str) -> None:
    ours = reference_tables()[table]
    wrong = set()
    for index, row in enumerate(rows_of(table)):
        for key in ("sign", "sign_mirror"):
            printed = row[key].replace("–", "-").replace("—", "-").strip()
            vanishing = all(ours[name][index] < 5e-4 for name in ours if name.startswith("lambda"))
            if printed and not vanishing and printed != ours[key][index]:
                wrong.add((row["phi_deg"], key))
    expected = {("80", "sign"), ("80", "sign_mirror")} if table == "table_3" else set()
    assert wrong == expected
