import math
import re

import pytest

from reports.document.figures.curves import Curve, Panel, curves_figure
from tests.document.figure_samples import FIGURES, FORCE, PHI, T, texts


def one(y):
    return curves_figure(PHI, [Panel([Curve("a", y)], "y")], "x")


def test_patterns_differ_without_colour():
    dashes = set(re.findall(r'stroke-dasharray="([^"]*)"', FIGURES["line"]()))
    assert len(dashes) >= 3  # two curves dashed differently and the level


def test_curves_are_named_and_a_crowd_gets_a_legend():
    assert {"среднее", "max"} <= set(texts(FIGURES["line"]()))
    assert sum(text.strip().startswith("a") for text in texts(FIGURES["legend"]())) == 8


def test_panels_are_lettered_and_one_is_not():
    assert {"а)", "б)", "в)"} <= set(texts(FIGURES["stacked"]()))
    assert "а)" not in texts(one(T))


def test_panels_of_one_scale_have_the_same_marks():
    panels = [Panel([Curve("", T)], "y"), Panel([Curve("", 5 * T)], "y")]
    said = texts(curves_figure(PHI, panels, "x", same_scale=True))
    assert said.count("10") == 2
    assert texts(curves_figure(PHI, panels, "x")).count("10") == 1


@pytest.mark.parametrize("bad", [math.nan, math.inf])
def test_not_finite_is_refused(bad):
    curve = FORCE.copy()
    curve[3] = bad
    with pytest.raises(ValueError, match="не число"):
        one(curve)


def test_shapes_are_checked():
    with pytest.raises(ValueError, match="Кривая «a»"):
        one(T[:-1])
