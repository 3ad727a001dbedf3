"""Figures that a page has less room for are drawn anew: their type is never small."""

from __future__ import annotations

import base64
import re
from functools import partial

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reports.document.figures.curves import Curve, Panel, curves_figure
from reports.document.figures.polar import polar_path
from reports.document.figures.wear import wear_diagram
from reports.document.page.redrawing import smaller
from reports.document.report import Report
from reports.model.evaluation import evaluate_model
from reports.tables.registry import build_model
from tests.conftest import sample

LEAST_PT = 7.0
IMAGE = re.compile(
    r'<img class="fig" style="width:([\d.]+)mm"[^>]*? alt="([^"]*)" src="[^,]*,([^"]+)"'
)
PHI = np.linspace(0, 720, 73)
TURN = np.radians(PHI)
DRAWS = (
    partial(curves_figure, PHI, (Panel((Curve("T", np.sin(TURN)),), "T, МПа"),), "φ", height=76.0),
    partial(polar_path, np.sin(TURN), 2 * np.cos(TURN / 2), PHI, ("x", "y"), most=100.0),
    partial(wear_diagram, 50 + 40 * np.cos(TURN[:12]), 30.0 * np.arange(12), 90.0, size=112.0),
)


def sizes(svg: str, width_mm: float | None = None) -> list[float]:
    """Sizes of the type on paper [pt]."""
    shown = width_mm or float(re.search(r'style="width:([\d.]+)mm', svg)[1])
    scale = shown * 72 / 25.4 / float(re.search(r'viewBox="0 0 ([\d.]+)', svg)[1])
    return [scale * float(size) for size in re.findall(r'font-size="([\d.]+)"', svg)]


def height(svg: str) -> float:
    return float(re.search(r'data-size="[\d.]+/([\d.]+)"', svg)[1])


@pytest.mark.parametrize("name", ["gots-diesel", "d-240-bearings", "ecoboost-10"])
def test_no_type_of_a_printed_figure_is_small(name: str) -> None:
    model = build_model(sample(name))
    page = Report(model, evaluate_model(model)).page("print")
    found = {
        alt[:60]: min(sizes(base64.b64decode(data).decode(), float(width)), default=LEAST_PT)
        for width, alt, data in IMAGE.findall(page)
    }
    assert len(found) > 15
    assert {words: least for words, least in found.items() if least < LEAST_PT} == {}


@settings(max_examples=15)
@given(draw=st.sampled_from(DRAWS), share=st.floats(0.7, 0.99))
def test_a_figure_keeps_its_type_and_fits_its_height(draw: partial[str], share: float) -> None:
    whole = draw()
    found = smaller(draw, share * height(whole))
    assert found is not None
    assert 0.9 * share * height(whole) <= height(found) <= share * height(whole)
    assert min(sizes(found)) >= min(sizes(whole)) - 0.05


def test_a_drawing_without_a_size_is_left() -> None:
    assert smaller(partial(str, "<svg/>"), 10.0) is None
    assert smaller(lambda: "<svg/>", 10.0) is None
