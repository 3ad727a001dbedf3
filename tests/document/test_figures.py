"""What holds of every figure: same bytes, fit for a page, on its sheet, Russian numbers."""

from __future__ import annotations

import math
import re
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

from reports.document import report
from reports.document.figures.schemes import crank_scheme, engine_scheme, mechanism_sketch
from tests.document.figure_samples import FIGURES, texts
from tests.document.report_samples import html_page, terms


@pytest.fixture(scope="module")
def drawn():
    return {name: make() for name, make in FIGURES.items()}


@pytest.mark.parametrize("name", FIGURES)
def test_same_bytes_again(drawn, name):
    assert FIGURES[name]() == drawn[name]


@pytest.mark.parametrize("name", FIGURES)
def test_fit_to_stand_in_a_page_with_others(drawn, name):
    svg = drawn[name]
    tree = ET.fromstring(svg)
    assert not [node for node in tree.iter() if "id" in node.attrib or "clip-path" in node.attrib]
    assert ' style="' not in svg.split(">", 1)[1]
    assert "<metadata" not in svg and "DOCTYPE" not in svg and "xlink" not in svg
    families = set(re.findall(r'font-family="([^"]*)"', svg))
    assert families == {"STIXGeneral, DejaVuSecond"}
    colours = set(re.findall(r"#[0-9a-f]{6}", svg))
    assert all(c[1:3] == c[3:5] == c[5:7] for c in colours), "only greys"


@pytest.mark.parametrize("name", FIGURES)
def test_everything_lies_on_the_sheet(drawn, name):
    tree = ET.fromstring(drawn[name])
    width, height = map(float, tree.attrib["viewBox"].split()[2:])
    assert width <= 165.01 / 25.4 * 72 and height <= 190 / 25.4 * 72
    for node in tree.iter():
        for x, y in re.findall(r"[ML] ?(-?[\d.]+) (-?[\d.]+)", node.attrib.get("d", "")):
            assert -1 <= float(x) <= width + 1 and -1 <= float(y) <= height + 1
        if node.tag.endswith("}text") and "x" in node.attrib:
            assert 0 <= float(node.attrib["x"].split()[0]) <= width
            assert 0 < float(node.attrib["y"].split()[0]) <= height


@pytest.mark.parametrize("name", FIGURES)
def test_no_decimal_point_and_no_hyphen_minus(drawn, name):
    for text in texts(drawn[name]):
        assert not re.search(r"\d\.\d", text)
        assert not re.search(r"-\d", text)


def test_cranks_of_one_direction_share_a_ray():
    assert "1, 4" in texts(crank_scheme([0, 180, 180, 360]))


def test_both_halves_of_a_split_pin_are_drawn():
    """They were drawn as one, so that the scheme showed another shaft."""
    said = texts(crank_scheme([0, 120, 240], split=30.0))
    assert {"1л", "1п", "3л", "3п"} <= set(said)
    assert {"1л, 2п", "2л, 1п"} <= set(texts(crank_scheme([0, 180], split=180.0)))


@pytest.mark.parametrize("rays", [[0, 45, 180, 225], [0, 54, 72, 270], [0, 120, 240], [45]])
def test_the_letter_of_the_rotation_hides_no_ray(rays):
    """At 45° always, it cut in two the second ray of eight throws or of split pins."""
    svg = crank_scheme(rays)
    left, top, width, height = map(float, re.findall(
        r'<rect x="([\d.]+)" y="([\d.]+)" width="([\d.]+)" height="([\d.]+)" [^>]*>'
        '<text font-style="italic"[^>]*>ω', svg)[0])  # fmt: skip
    x, low = map(float, re.findall(r'd="M([\d.]+) ([\d.]+)C', svg)[-1])  # the axis, last drawn
    turn = math.degrees(math.atan2(left + width / 2 - x, low - 2.5 - top - height / 2))
    assert min(abs(math.remainder(turn - ray, 360)) for ray in rays) > 15


def test_engine_shows_rows_throws_and_strokes():
    said = texts(FIGURES["engine"]())
    assert {"1, 3", "2, 4", "1 (1)", "4 (2)", "720°"} <= set(said)


def test_cylinders_of_a_narrow_engine_do_not_cover_one_another():
    """Of 15° between the banks the right one hid a number of the left."""
    rods, thirds = [1, 2, 3] * 2, [0.0, 240.0, 120.0]
    svg = engine_scheme([0.0] * 3 + [15.0] * 3, rods, thirds, [120.0 * n for n in range(6)], 720.0)
    boxes = [
        [float(x) for x in re.findall(r"[ML](-?[\d.]+) ", path)]
        for path in re.findall(r'<path d="([^"]+)z" fill="#e4e4e4"', svg)[:2]
    ]
    assert max(boxes[0]) < min(boxes[1])
    places = dict(re.findall(r'<text x="([\d.]+)"[^>]*>(\d, \d, \d)</text>', svg))
    (left, _), (right, _) = sorted(((float(x), text) for x, text in places.items()))
    assert left < min(boxes[0]) and right > max(boxes[1])


def test_what_cannot_be_drawn_is_refused():
    with pytest.raises(ValueError, match="λ"):
        mechanism_sketch(1.2)
    with pytest.raises(ValueError, match="колена"):
        crank_scheme([])
    with pytest.raises(ValueError, match="нет цилиндров"):
        engine_scheme([], [], [], [], 720.0)


def test_the_workbook_s_charts_have_the_numbers_of_the_report_s_figures():
    built = terms("one")
    charts = report.Report.of(built.model, built.values, Path("t.toml")).numbered.charts
    page = re.sub(r"<[^>]+>|&nbsp;", " ", html_page("one"))
    matches = {
        n: c.strip() for n, c in re.findall(r"Рисунок\s+([\d.]+)\s+—\s+([^\n]{10,80})", page)
    }
    numbered = [chart for chart in charts if chart.number]
    assert len(numbered) > 10
    alike = [c for c in numbered if matches[c.number].startswith(c.words[:12])]
    assert len(alike) > len(numbered) / 2  # the others share a figure, which has words of its own
    assert all(c.heading.startswith(f"Рис.\xa0{c.number}. {c.title}") for c in alike)
