"""What holds of every figure: same bytes, fit for a page, on its sheet, Russian numbers."""

import re
from xml.etree import ElementTree as ET

import pytest

from tests.document.figure_samples import FIGURES, texts


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
    assert families == {"STIXGeneral"}
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
