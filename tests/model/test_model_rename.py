"""Names in expressions are replaced in one way."""

from __future__ import annotations

from reports.model.blocks import Column, Grid, GridRow, Scalar, ScalarTable, TableSpec
from reports.model.charts import ChartSpec, Series
from reports.model.rename import copied, copied_chart, renamed, substituted


def second(name: str) -> str:
    head, dot, column = name.partition(".")
    return f"{head}_R2{dot}{column}"


def test_names_change_and_texts_stay() -> None:
    actual = renamed(
        'max(a, t.a) + 1e5*b - "a"', lambda name: name if name == "max" else second(name)
    )
    assert actual == 'max(a_R2, t_R2.a) + 1e5*b_R2 - "a"'


def test_only_what_is_replaced_changes() -> None:
    block = ScalarTable("s", "", "", (Scalar("a", "mass*r + mass_2"),))
    assert substituted((block,), {}) == (block,)
    (built,) = substituted((block,), {"mass": "m_est"})
    assert built == ScalarTable("s", "", "", (Scalar("a", "m_est*r + mass_2"),))


def test_a_copied_table_keeps_its_columns() -> None:
    table = TableSpec("t", "1", "", "", (Column("x", None), Column("y", "x*a + u.x")), (0.0,))
    built = copied(table, second)
    assert isinstance(built, TableSpec)
    assert built.id == "t_R2"
    assert [(c.key, c.expr) for c in built.columns] == [("x", None), ("y", "x*a_R2 + u_R2.x")]


def test_copied_scalars_remember_their_quantity() -> None:
    built = copied(ScalarTable("s", "", "", (Scalar("a", "b"),)), second)
    assert built == ScalarTable("s_R2", "", "", (Scalar("a_R2", "b_R2", of="a"),))
    grid = copied(
        Grid("g", "", "", ("1", "2"), (GridRow("q", (Scalar("q1", "b", of="q"), None)),)), second
    )
    assert isinstance(grid, Grid)
    assert grid.rows[0].cells == (Scalar("q1_R2", "b_R2", of="q"), None)


def test_charts_follow_their_tables() -> None:
    chart = copied_chart(
        ChartSpec("c", "лист", "", "line", (Series("t.phi_deg", "t.y"),), levels=("a",)), second
    )
    assert chart.series == (Series("t_R2.phi_deg", "t_R2.y"),)
    assert chart.levels == ("a_R2",)
    wear = ChartSpec("c", "лист", "", "wear", (), hole="hole", contact=("-t.x", "t.y"))
    assert copied_chart(wear, second).hole == "hole_R2"
    assert copied_chart(wear, second).contact == ("-t_R2.x", "t_R2.y")
