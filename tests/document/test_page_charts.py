"""Figures drawn from the chart specifications that the workbook is drawn from."""

from dataclasses import replace

import numpy as np
import pytest

from reports.document.page.charts import chart_figure, panels_figure
from tests.document.report_samples import terms

T = terms("gots-diesel")
CHARTS = T.model.charts_by_id


def panel(name, **more):
    return chart_figure(T, CHARTS[name], **more).draw.args[1][0]


def test_a_chart_says_its_caption_axes_and_curves():
    figure = chart_figure(T, CHARTS["fig46"], 80)
    x, (shown,), x_title = figure.draw.args
    assert figure.caption == "Удельные силы давления газов, инерции и их сумма"
    assert (x_title, shown.y_title) == (r"$\varphi$, °", "$p'$, МПа")
    assert [curve.name for curve in shown.curves] == [
        f"${T.tex(f'P4_1.{key}')}$" for key in ("Pg_MPa", "Pj_MPa", "Ps_MPa")
    ]
    assert np.array_equal(shown.curves[2].y, T.column("P4_1.Ps_MPa"))
    assert figure.draw.keywords == {"height": 80, "angle": True, "x_step": None} and x[-1] == 720


def test_one_curve_is_named_at_its_axis_with_its_levels_and_extremes():
    shown = panel("fig51")
    assert shown.y_title == r"$R'_{\mathrm{ш.ш}}$, МПа"
    assert [level.y for level in shown.levels] == [T.value("Rpin_mean")]
    greatest, least = shown.marks
    assert (greatest.name, greatest.y) == ("max", T.column("crankpin.Rpin_MPa").max())
    assert least.y == T.column("crankpin.Rpin_MPa").min()


def test_a_curve_of_rounding_noise_is_not_drawn():
    four = terms("cycle-petrol")  # its first order is balanced
    drawn = chart_figure(four, four.model.charts_by_id["balance_F"]).draw.args[1][0].curves
    assert [curve.name for curve in drawn] == ["$F_2$", "$F_4$"]


def test_of_equal_extremes_the_first_is_marked_as_the_text_names_it():
    twin = terms("yamz-236")  # its torque repeats thrice a cycle
    marks = chart_figure(twin, twin.model.charts_by_id["fig49"]).draw.args[1][0].marks
    named = [twin.value(f"phi_M_{which}_deg") for which in ("max", "min")]
    assert [mark.x for mark in marks] == named


def test_rows_are_marked_and_a_path_is_closed():
    shown = panel("pv", rows=[("$a$", 3)], closed=True)
    assert shown.marks[0].x == T.column("gas.volume_dm3")[3]
    assert len(shown.curves[0].y) == len(T.column("gas.p_MPa")) + 1
    assert shown.curves[0].y[-1] == shown.curves[0].y[0]


def test_a_path_has_its_poles_and_directions():
    draw = chart_figure(T, CHARTS["fig50"], 122).draw
    poles = draw.keywords["poles"]
    rod, throw = T.value("K_r_rod"), T.value("K_r_throw")
    assert [pole.y for pole in poles] == pytest.approx([0.0, rod, rod + throw])
    assert draw.keywords["reverse"] == (False, True)
    assert chart_figure(T, CHARTS["fig53_2"], 100).draw.keywords["reverse"] == (True, False)


def test_wear_is_laid_off_opposite_to_the_rays():
    sums, places, hole = chart_figure(T, CHARTS["fig52"], 112, top="вверх").draw.args
    rays = T.model.input.calculation.wear_rays
    assert sums.tolist() == [T.value(f"pin_sum{i}") for i in range(1, rays + 1)]
    assert places.tolist() == [180.0 + 360 / rays * i for i in range(rays)]
    assert hole == T.value("hole_pin_deg")


def test_alternative_text_tells_the_extremes():
    figure = chart_figure(T, CHARTS["fig49"])
    assert figure.alt.startswith(f"{figure.caption}. ")
    assert "наибольшее" in figure.alt and "при фи = " in figure.alt and "Н·м" in figure.alt
    assert chart_figure(T, CHARTS["pv"]).alt == CHARTS["pv"].words


@pytest.mark.parametrize("name", ["gots-diesel", "ecoboost-10"])
def test_what_sums_leave_of_zero_is_told_as_zero(name):
    built = terms(name)
    lines = [chart_figure(built, c).alt for c in built.model.charts_by_id.values()
            if c.x_is_angle and c.drawn_by("report")]  # fmt: skip
    assert len(lines) > 10
    assert [words for words in lines if "0,0000000" in words] == []


def test_a_group_shares_a_figure():
    both = panels_figure(T, [CHARTS["fig56_2"], CHARTS["fig56_3"]], 50, same_scale=True)
    assert both.caption.replace("\u00a0", " ") == (
        "Набегающие моменты на коренные шейки: а — шейка 2; б — шейка 3"
    )
    assert len(both.draw.args[1]) == 2
    alone = panels_figure(T, [CHARTS["fig56_4"]], 50, same_scale=True)
    assert alone.caption == "Набегающие моменты на коренные шейки: шейка 4"


@pytest.mark.parametrize(
    ("title", "tex"),
    [
        ("s, мм", "$s$, мм"),
        ("p′, МПа", "$p'$, МПа"),
        ("МПа", "МПа"),
        ("j/(rω²)", r"$j/(r\omega ^2)$"),
        ("доля R, ωR", r"доля $R$, $\omega R$"),
    ],
)
def test_symbols_of_a_plain_title_are_set_as_such(title, tex):
    chart = replace(CHARTS["fig46"], y_title=title)
    assert chart_figure(T, chart).draw.args[1][0].y_title == tex
