"""The HTML report in headless Chromium, on a phone and on a screen."""

import re
from pathlib import Path

import pytest

from reports.document.report import Report
from tests.browser import measure, photograph, print_out
from tests.document.pdftools import pages_of
from tests.document.report_samples import html_page, terms_of, text_of


@pytest.mark.parametrize("width", [390, 1280])
def test_the_page_does_not_scroll_sideways(width, tmp_path):
    found = measure(html_page("one"), width, tmp_path / "w", boxes=".tbox, .eq")
    assert found["width"] == width
    assert found["scroll"] <= width and found["wide"] == []
    assert found["scripts"] == 0
    assert "STIXGeneral" in found["fonts"]
    assert len(found["images"]) > 100 and min(found["images"]) > 0
    scrolled = [box for box in found["boxes"] if box[1] > box[0]]
    assert bool(scrolled) == (width == 390)  # wide tables scroll in their own box


def test_a_page_that_is_too_wide_is_noticed(tmp_path):
    found = measure('<main><div style="width:900px">x</div></main>', 390, tmp_path / "w")
    assert found["scroll"] > 390 and found["wide"]


def test_the_page_can_be_photographed(tmp_path):
    picture = photograph(html_page("one"), 390, 2000, tmp_path / "p.png", tmp_path / "w")
    assert picture.stat().st_size > 20_000


def test_what_the_browser_prints_reads_as_the_report_does(tmp_path):
    """The year is at the foot of the title page, and no number is missing in the abstract."""
    pdf = print_out(html_page("one"), tmp_path / "p.pdf", tmp_path / "w").read_bytes()
    title, *others = (" ".join(page.split()) for page in pages_of(pdf, tmp_path))
    assert re.search(r"Проверил:? .*20\d\d( 1)?$", title), title
    (abstract,) = (page for page in others if "РЕФЕРАТ" in page and "записка" in page)
    assert re.search(r"записка \d+ рис\.", abstract), abstract


def test_the_frame_takes_no_page_numbers_from_the_browser():
    """The sheets of a browser have no frame, hence no number in it: the usual one stays."""
    source = terms_of(text_of("one").replace("[report]\n", '[report]\nframe = "eskd"\n', 1))
    page = Report.of(source.model, source.values, Path("t.toml")).page("screen")
    assert "counter(page)" in page
    assert "form2" not in page
