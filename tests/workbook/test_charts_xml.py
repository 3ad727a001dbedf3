"""Lint of the chart parts: what a picture made by LibreOffice cannot show of Excel."""

from __future__ import annotations

import pytest
from lxml import etree

from tests.workbook.made import model, parts

C = "{http://schemas.openxmlformats.org/drawingml/2006/chart}"
A = "{http://schemas.openxmlformats.org/drawingml/2006/main}"
CHARTS = sorted(parts("xl/charts/chart"))


def chart(name: str) -> etree._Element:
    return etree.fromstring(parts("xl/charts/chart")[name])


def values(root: etree._Element, path: str) -> list[str | None]:
    return [element.get("val") for element in root.iterfind(f".//{path}")]


def test_every_chart_of_the_model_is_there() -> None:
    assert len(CHARTS) == len(model().charts) >= 25


@pytest.mark.parametrize("name", CHARTS)
def test_axes_are_shown_low_and_not_linked_to_the_source(name: str) -> None:
    root = chart(name)
    axes = root.findall(f".//{C}valAx")
    assert len(axes) == 2
    for axis in axes:
        assert axis.find(f"{C}delete").get("val") == "0"
        assert axis.find(f"{C}tickLblPos").get("val") == "low"
        assert axis.find(f"{C}numFmt").get("sourceLinked") == "0"
        assert axis.find(f"{C}majorGridlines/{C}spPr/{A}ln") is not None


@pytest.mark.parametrize("name", CHARTS)
def test_titles_do_not_lie_over_the_plot(name: str) -> None:
    root = chart(name)
    titles = root.findall(f".//{C}title")
    assert titles
    for title in titles:
        assert title.find(f"{C}overlay").get("val") == "0"
    assert root.find(f"{C}roundedCorners").get("val") == "0"


@pytest.mark.parametrize("name", CHARTS)
def test_lines_are_straight_thin_and_without_markers(name: str) -> None:
    root = chart(name)
    assert values(root, f"{C}scatterStyle") == ["lineMarker"]
    series = root.findall(f".//{C}ser")
    assert series
    for one in series:
        assert one.find(f"{C}smooth").get("val") == "0"
        assert one.find(f"{C}marker/{C}symbol").get("val") == "none"
        line = one.find(f"{C}spPr/{A}ln")
        assert line.find(f"{A}noFill") is not None or line.get("w") == "19050"


@pytest.mark.parametrize("name", CHARTS)
def test_caches_of_every_series_are_filled(name: str) -> None:
    root = chart(name)
    for reference in root.iterfind(f".//{C}numRef"):
        cache = reference.find(f"{C}numCache")
        count = int(cache.find(f"{C}ptCount").get("val"))
        points = cache.findall(f"{C}pt/{C}v")
        assert len(points) == count > 1
        for point in points:
            float(point.text)


def test_polar_diagrams_are_square_with_equal_axes() -> None:
    squares = 0
    for name in CHARTS:
        root = chart(name)
        layout = root.find(f".//{C}plotArea/{C}layout/{C}manualLayout")
        if layout is None:
            continue
        squares += 1
        assert layout.find(f"{C}w").get("val") == layout.find(f"{C}h").get("val")
        assert layout.find(f"{C}layoutTarget").get("val") == "inner"
        texts = [formula.text for formula in root.iterfind(f".//{C}f")]
        limits = [axis.find(f"{C}scaling/{C}max") for axis in root.findall(f".//{C}valAx")]
        # Equal limits are fixed, or a corner series spans the same range on both axes.
        fixed = all(limit is not None for limit in limits)
        assert fixed or texts[-1] == texts[-2]
    assert squares == sum(spec.kind != "line" for spec in model().charts)
