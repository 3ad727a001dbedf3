"""What a chart says of itself."""

from __future__ import annotations

import pytest

from reports.model.charts import PHI, ChartLines, ChartSpec, Series
from reports.tables.registry import build_model
from tests.conftest import sample, sample_names


def made(word: str, head: str, *lines: str) -> ChartSpec:
    chart = ChartLines.opened(word, head, "лист")
    for line in lines:
        first, _, rest = line.partition(" ")
        chart = chart.take(first, rest)
    return chart.made()


def test_columns_over_the_angle_of_their_table() -> None:
    chart = made(
        "chart", "c over phi_deg: Момент", "y M, Н·м", "curve t.M_Nm", "curve u.M_Nm report"
    )
    assert chart.x_is_angle
    assert (chart.x_title, chart.words) == (PHI, "Момент")
    assert chart.drawn_by("workbook") == (Series("t.phi_deg", "t.M_Nm"),)
    assert [s.y for s in chart.drawn_by("report")] == ["t.M_Nm", "u.M_Nm"]
    assert not chart.equal_axes


def test_corners_of_a_polar_diagram_are_the_workbooks() -> None:
    chart = made("polar", "c in box.box: Д", "x x", "y y", "curve t.x t.y", "y_reversed")
    assert chart.equal_axes
    assert (chart.x_reversed, chart.y_reversed, chart.x_is_angle) == (False, True, False)
    assert [s.invisible for s in chart.drawn_by("workbook")] == [False, True]
    assert chart.drawn_by("report") == (Series("t.x", "t.y"),)


def test_other_charts_count_no_angle() -> None:
    assert not made("chart", "c: Д", "x λ", "y φ, °", "curve t.l t.y").x_is_angle
    assert made("wear", "c in g: Д", "hole hole_deg").x_reversed


@pytest.mark.parametrize("name", sample_names())
def test_every_chart_names_what_the_model_has(name: str) -> None:
    model = build_model(sample(name))
    known = {*model.nodes, *model.grid_runs}
    for chart in model.charts:
        assert {key for s in chart.series for key in (s.x, s.y)} <= known, chart.id
        assert {*chart.levels, chart.hole} <= {*model.scalars, *model.fields, ""}, chart.id
        assert not chart.sheet or chart.sheet in model.sheets, chart.id
    assert len(model.charts_by_id) == len(model.charts)
