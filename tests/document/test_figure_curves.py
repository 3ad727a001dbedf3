import math
import re
from itertools import pairwise

import numpy as np
import pytest

from reports.document.chapters.cycle import _characteristic_plan
from reports.document.figures.canvas import SMALL
from reports.document.figures.curves import Mark, Panel, PlotCurve, curves_figure, spread
from reports.document.figures.labels import text_size
from reports.document.text.terms import Terms
from reports.model.evaluation import evaluate_model
from reports.tables.registry import build_model
from tests.conftest import sample
from tests.document.figure_samples import FIGURES, FORCE, PHI, T, texts


def one(y):
    return curves_figure(PHI, [Panel([PlotCurve("a", y)], "y")], "x")


def test_patterns_differ_without_colour():
    dashes = set(re.findall(r'stroke-dasharray="([^"]*)"', FIGURES["line"]()))
    assert len(dashes) >= 3  # two curves dashed differently and the level


def test_curves_are_named_and_a_crowd_gets_a_legend():
    assert {"среднее", "max"} <= set(texts(FIGURES["line"]()))
    assert sum(text.strip().startswith("a") for text in texts(FIGURES["legend"]())) == 8


@pytest.mark.parametrize("wanted", [[50.0] * 8, [0.0, 1.0, 60.0, 61.0, 99.0], [98.0, 99.0, 100.0]])
def test_names_of_a_fan_keep_apart_and_inside(wanted):
    """Eight rays of a diagram of Campbell had names over one another in a legend of dashes."""
    places = spread(wanted, 10.0, 0.0, 100.0)
    assert all(b - a >= 10.0 - 1e-9 for a, b in pairwise(places))
    assert places[0] >= -1e-9 and places[-1] <= 100.0 + 1e-9


def test_a_fan_has_its_names_and_no_legend():
    x = np.linspace(0, 3000, 20)
    rays = [PlotCurve(f"ν = {n}", n * x / 60) for n in range(1, 9)]
    panel = Panel(rays, "f, Гц", marks=(Mark("ν = 3, форма 1", 1500.0, 75.0),), fan=True)
    svg = curves_figure(x, [panel], "n", angle=False)
    said = [text.replace("\xa0", " ") for text in texts(svg)]
    assert {f"ν = {n}" for n in range(1, 9)} <= set(said) and "ν = 3, форма 1" in said
    assert min(map(float, re.findall(r'font-size="([\d.]+)"', svg)), default=9.5) >= 9.5
    assert len(set(re.findall(r'stroke-dasharray="([^"]*)"', svg))) <= 2  # leaders alone


def test_panels_are_lettered_and_one_is_not():
    assert {"а)", "б)", "в)"} <= set(texts(FIGURES["stacked"]()))
    assert "а)" not in texts(one(T))


def test_panels_of_one_scale_have_the_same_marks():
    panels = [Panel([PlotCurve("", T)], "y"), Panel([PlotCurve("", 5 * T)], "y")]
    said = texts(curves_figure(PHI, panels, "x", same_scale=True))
    assert said.count("10") == 2
    assert texts(curves_figure(PHI, panels, "x")).count("10") == 1


def test_points_beyond_the_curve_are_within_the_axes():
    """Rows of the table stood above the sheet where the finer curve is lower."""
    most = 1.2 * float(max(T))

    def marks(**points):
        return texts(curves_figure(PHI / 1000, [Panel([PlotCurve("", T)], "y", **points)], "x"))

    def top(said):
        return max(float(text.replace(",", ".")) for text in said if re.fullmatch("[0-9,]+", text))

    assert top(marks(points=[(PHI[:2] / 1000, [most, 0.0])])) >= most > top(marks())


@pytest.mark.parametrize("bad", [math.nan, math.inf])
def test_not_finite_is_refused(bad):
    curve = FORCE.copy()
    curve[3] = bad
    with pytest.raises(ValueError, match="не число"):
        one(curve)


def test_shapes_are_checked():
    with pytest.raises(ValueError, match="Кривая «a»"):
        one(T[:-1])


def test_orders_stand_on_stems_and_nothing_joins_them():
    """Amplitudes by order were joined by a line, as if there were something between two orders."""
    orders = np.array([1.0, 2.0, 3.0])
    curves = [PlotCurve("a", [3.0, 2.0, 0.0]), PlotCurve("b", [1.0, 4.0, 2.0])]
    drawn = curves_figure(orders, [Panel(curves, "y", stems=True)], "$k$", angle=False)
    stems = re.findall(r'd="([^"]*)" fill="none"[^>]*stroke-linecap="butt"', drawn)
    assert [data.count("M") for data in stems] == [2, 3]
    for foot, top in re.findall(r"M([\d.]+) [\d.]+L([\d.]+)", "".join(stems)):
        assert foot == top
    assert {"a", "b"} <= {text.strip() for text in texts(drawn)}


def test_an_abscissa_that_counts_has_a_mark_at_each_number():
    """Forms over masses 1 to 5 had marks at 0, 2, 4, 6, in the workbook at every half."""
    drawn = curves_figure(np.arange(1.0, 6.0), [Panel([PlotCurve("a", [1, 0, -9, 0, 1])], "y")],
                          "$i$",
                          angle=False, x_step=1.0)  # fmt: skip
    assert [text for text in texts(drawn) if text in list("012345678")][:5] == list("12345")
    forms = next(c for c in build_model(sample("mwm-6")).charts if c.id == "torsion_forms")
    assert forms.x_step == 1


@pytest.mark.parametrize(("low", "first"), [(900.0, "0"), (2400.0, "2000")])
def test_an_abscissa_far_from_zero_begins_where_the_curve_does(low, first):
    """A third of the chart was empty: speeds from 2400 to 6600 stood over marks from zero."""
    drawn = curves_figure([low, 6600.0], [Panel([PlotCurve("a", [1, 2])], "y")], "$n$", angle=False)
    assert texts(drawn)[0] == first


def rays(count):
    """A Campbell diagram: rays from one point leave no room for names beside them."""
    speed = np.array([0.0, 17160.0])
    curves = [PlotCurve(f"$\\nu = {2 * n}$", speed * n / 30) for n in range(1, count + 1)]
    return curves_figure(speed, [Panel(curves, "$f$, Гц")], "$n$, мин⁻¹", angle=False)


@pytest.mark.parametrize("count", [3, 6, 9])
def test_all_rows_of_a_legend_stand_on_the_sheet(count):
    drawn = rays(count)
    assert sum("= " in text or text.strip().isdigit() for text in texts(drawn)) >= count
    tops = [float(y) - 0.7 * float(size) for size, y in
            re.findall(r'<text[^>]*font-size="([\d.]+)"[^>]* y="(-?[\d.]+)"', drawn)]  # fmt: skip
    assert len(tops) > count and min(tops) >= 0


def test_the_name_of_an_axis_keeps_off_its_last_number():
    drawn = rays(3)
    placed = re.findall(r"<text([^>]*)>([^<]*)</text>", drawn)
    ((last, _),) = [p for p in placed if p[1] == "20\xa0000"]
    ((name, _),) = [p for p in placed if p[1] == "n"]
    start, end = (float(re.search(r' x="([\d.]+)"', look).group(1)) for look in (last, name))
    assert end >= start + text_size("20\xa0000", SMALL)[0]


@pytest.mark.parametrize("name", ["cycle-petrol", "cycle-turbo-diesel"])
def test_the_external_characteristic_is_one_field_with_its_adaptability(name):
    """Both torques stand at their speeds; K is their ratio; each scale holds its curve."""
    model = build_model(sample(name))
    said = texts(_characteristic_plan(Terms(model, evaluate_model(model))).draw())
    marked = "".join(said).replace("\xa0", "")
    most, rated, k = (
        float(re.search(rf"{symbol}=([\d,]+)", marked)[1].replace(",", "."))
        for symbol in ("max", "eN", "K")
    )
    assert most / rated == pytest.approx(k, abs=6e-4) and k > 1
    for unit in ("Н·м", "кВт", "г/(кВт·ч)", "кг/ч", "мин"):
        assert any(unit in text for text in said), unit
