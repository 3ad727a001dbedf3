"""Listings of columns and scalars, rows of grids."""

from __future__ import annotations

import pytest

from reports.spec.blocks import Column, Scalar
from reports.spec.listing import column_list, corners, grid_row, scalar_list


def test_columns_line_by_line() -> None:
    found = column_list("""
        phi_deg
        M_Nm = P4_1.M_Nm | Гоц, 2.5
        side_Nm of M_Nm = 2*M_Nm
            - 1 if M_Nm >= 0 else 0 | Гоц (34), (35)
        helpers:
        at = phi_deg
    """)
    assert found == (
        Column("phi_deg", None),
        Column("M_Nm", "P4_1.M_Nm", "Гоц, 2.5"),
        Column("side_Nm", "2*M_Nm - 1 if M_Nm >= 0 else 0", "Гоц (34), (35)", of="M_Nm"),
        Column("at", "phi_deg", helper=True),
    )


def test_several_listings_make_one() -> None:
    made = scalar_list("a = 1 | x", *(f"b{i} of b = a + {i}" for i in (1, 2)))
    assert made == (Scalar("a", "1", "x"), Scalar("b1", "a + 1", of="b"),
                    Scalar("b2", "a + 2", of="b"))  # fmt: skip


def test_a_source_may_stand_on_a_line_of_its_own() -> None:
    assert scalar_list("a = 1\n    | x") == (Scalar("a", "1", "x"),)


@pytest.mark.parametrize("text", ["a b", "a =1", "a of b c = 1"])
def test_what_is_no_line_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match="not a line"):
        column_list(text)


def test_a_scalar_needs_a_formula() -> None:
    with pytest.raises(ValueError, match="without a formula"):
        scalar_list("a")


def test_rows_of_grids_count_their_instances() -> None:
    row = grid_row("length", ("1", None, "2"), "x", "l{n}_{of}", first=2)
    assert row.of == "length"
    assert row.cells == (
        Scalar("l2_length", "1", "x", of="length"),
        None,
        Scalar("l4_length", "2", "x", of="length"),
    )


def test_corners_are_as_far_to_both_sides() -> None:
    (row,) = corners("a_box", "оси", "лист", "R_box", "R_max").rows
    assert [(cell.key, cell.expr) for cell in row.cells if cell] == [
        ("R_box1", "-R_max"), ("R_box2", "R_max"),
    ]  # fmt: skip
