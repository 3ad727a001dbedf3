"""The list of the book's formulas (1)-(60) is complete and up to date; book: see ``book``."""

from __future__ import annotations

import re

import pytest

from tests.textbook.formula_list import (
    FORMULAS,
    LAST,
    REASONS,
    ROOT,
    numbers,
    places,
    render,
)


@pytest.mark.parametrize("number", range(1, LAST + 1))
def test_the_formula_is_named_in_the_solver_or_the_tables(number: int) -> None:
    solver, tables = places()[number]
    assert solver or tables or REASONS.get(number), FORMULAS[number]


def test_docs_hold_the_list() -> None:
    """Every row is there and names nothing that has gone; the module renews the file."""
    written = (ROOT / "docs" / "formulas.md").read_text(encoding="utf-8")
    rows = dict(re.findall(r"^\| (\d+) \| (.*) \|$", written, flags=re.M))
    actual = places()
    assert [int(number) for number in rows] == list(range(1, LAST + 1))
    for number, row in rows.items():
        solver, tables = actual[int(number)]
        assert row.startswith(FORMULAS[int(number)])
        named = set(re.findall(r"`([^`]+)`", row.split(" | ", 1)[1]))
        assert named <= {*solver, *tables}, number
    assert render().splitlines()[:8] == written.splitlines()[:8]


def test_numbers_are_read_from_texts() -> None:
    assert numbers("Piston force [N], Gots (30), (33)-(35).") == {30, 33, 34, 35}
    assert numbers("Гоц (19а)") == {19}
    assert numbers("Segal (1.14), Ilchenko (19)") == set()
    assert numbers("the chain, Gots (1)-(60)") == set()
    assert set(FORMULAS) == set(range(1, LAST + 1))
