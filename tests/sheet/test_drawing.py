"""Angles, scales, sizes and words of drawings."""

import itertools
import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reports.document.page.charts import mechanism_of, throw_of
from reports.draw.canvas import (
    AXES,
    Canvas,
    Circle,
    Line,
    Words,
    interrupted,
    overlap,
    polar,
)
from reports.draw.fonts import parts_of, plain, width_of
from reports.draw.parts import MechanismSizes, ThrowSizes, mechanism_drawing, throw_drawing
from reports.draw.writers import svg_of
from reports.sheet.cell import _SCALES, CellArea, _said, shaft
from reports.sheet.diagrams import round_scale
from tests.sheet.sheet_samples import terms

# ГОСТ 2.302: enlargements and reductions.
ENLARGED = ("50", "40", "20", "10", "5", "4", "2,5", "2")
REDUCED = ("2", "2,5", "4", "5", "10", "15", "20", "25", "40", "50", "75", "100")


def test_angles_go_clockwise_from_the_vertical():
    assert polar((1, 2), 3, 0) == (1, 5)
    assert polar((1, 2), 3, 90) == pytest.approx((4, 2))
    assert polar((1, 2), 3, 120) == pytest.approx((1 + 3 * 0.75**0.5, 0.5))


def test_scales_are_those_of_the_standard_from_the_largest():
    named = {f"М {n}:1" for n in ENLARGED} | {f"М 1:{n}" for n in ("1", *REDUCED)}
    assert {_said(scale) for scale in _SCALES} <= named
    assert sorted(set(_SCALES), reverse=True) == list(_SCALES)


@pytest.mark.parametrize(("room", "unit"), [(720, 0.5), (719, 1.0), (100, 4.0), (18, 20.0)])
def test_an_axis_of_angles_has_the_largest_scale_that_fits(room, unit):
    assert round_scale(0.0, 360.0, room, angle=True).unit == unit


@pytest.mark.parametrize(("high", "unit"), [(200.0, 2.0), (200.1, 2.5), (1.5, 0.02), (-40.0, 1.0)])
def test_values_that_fit_exactly_have_the_scale_at_which_they_do(high, unit):
    low = min(high, 0.0) - 60.0 if high < 0 else 0.0
    assert round_scale(low, max(high, 0.0), 100.0).unit == pytest.approx(unit)


def crossed(items) -> list[str]:
    canvas = Canvas(list(items))
    texts = [item for item in items if isinstance(item, Words)]
    collected = [words.text for words in texts if not canvas.clear(words)]
    return collected + [one.text + other.text for one, other in itertools.combinations(texts, 2)
                    if overlap(one.box, other.box)]  # fmt: skip


@pytest.mark.parametrize("name", ["ecoboost-10", "gots-diesel", "two-stroke", "yamz-236"])
def test_no_line_runs_through_a_size(name):
    t = terms(name)
    for scale in (0.3, 1.0):
        assert crossed(throw_drawing(throw_of(t), letters=2.5, scale=scale)) == []


@settings(max_examples=40, deadline=None)
@given(st.lists(st.integers(8, 60), min_size=6, max_size=6), st.integers(0, 40),
       st.integers(30, 90), st.booleans())  # fmt: skip
def test_no_line_runs_through_a_size_of_any_throw(arms, web, radius, heavy):
    throw = ThrowSizes(
        tuple(arms), (web, web), radius, 60.0, (70.0, 70.0), (30.0, 30.0), (heavy, heavy)
    )
    lengths = [w for w in throw_drawing(throw, letters=2.5) if isinstance(w, Words)]
    texts = crossed(throw_drawing(throw, letters=2.5))
    assert not [text for text in texts if "_" in text]
    assert {words.text for words in lengths} >= {f"l_{n} = {arm}" for n, arm in enumerate(arms, 1)}


def test_axes_are_broken_where_a_size_stands():
    canvas = Canvas()
    canvas.line((0, 0), (100, 0), layer=AXES)
    canvas.words((50, -1), "Ø44", 3.5, align=0.5)
    lines = [item for item in interrupted(canvas.items) if isinstance(item, Line)]
    assert len(lines) == 2 and lines[0].points[1][0] < 47 and lines[1].points[0][0] > 53


def test_an_offset_mechanism_keeps_its_sizes():
    t = terms("ecoboost-10")
    texts = {
        i.text for i in mechanism_drawing(mechanism_of(t), letters=2.5) if isinstance(i, Words)
    }
    assert texts >= {"ØD = 71,9", "L = 137", "r = 41", "e = 8"}
    small = [i.text for i in mechanism_drawing(MechanismSizes(60, 20, 80), letters=2.5, scale=0.4)
             if isinstance(i, Words)]  # fmt: skip
    assert "r = 20" in small


def test_an_index_stands_lower_and_smaller():
    assert parts_of("h_Л = 26") == [("h", False), ("Л", True), (" = 26", False)]
    assert plain("l_1 = 18") == "l1 = 18" and width_of("l_1", 3) < width_of("l1", 3)
    svg = svg_of([Words((0, 0), "l_1 = 18", 3.0)], (-5, -5, 40, 10))
    assert svg.count("<path") == 3 and 'stroke-width="0.21"' in svg


@pytest.mark.parametrize("sizes", [(81, 45.15, 161.2, 2.5), (100, 47.5, 169.6), (96, 25, 100)])
@pytest.mark.parametrize("scale", [0.15, 0.2, 0.25, 0.3])
def test_no_line_runs_through_a_long_size_of_a_small_mechanism(sizes, scale):
    """The radius has a place past the circle on the other side, the rod beyond its end."""
    assert crossed(mechanism_drawing(MechanismSizes(*sizes), letters=2.5, scale=scale)) == []


@pytest.mark.parametrize("name", ["ecoboost-10", "gots-diesel", "two-stroke", "vw-1600"])
def test_no_axis_runs_through_the_number_of_a_throw(name):
    canvas = Canvas()
    shaft(canvas, CellArea(0.0, 0.0, 100.0, 60.0), terms(name))
    texts = [item for item in canvas.items if isinstance(item, Words)]
    axes = [item for item in canvas.items if isinstance(item, Line) and item.layer is AXES]
    assert len(axes) == 3
    assert [text.text for text in texts for axis in axes if overlap(text.box, axis.box)] == []


def test_a_circle_goes_there_and_back():
    (path,) = re.findall(r'<path d="([^"]+)"', svg_of([Circle((10, 12), 5)], (0, 0, 40, 30)))
    start, over, back = re.findall(r"([\d.]+ [\d.]+)(?=A|Z)", path)
    assert start == back == "5.000 18.000" and over == "15.000 18.000"  # y of SVG goes down
    assert path.count("A5.000 5.000 ") == 2
