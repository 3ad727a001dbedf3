"""Letters and numbers on sketches with numbers are those of the text."""

from __future__ import annotations

import re

import pytest

from reports.document.page.charts import counterweight_of, flywheel_of
from reports.document.text.symbols import inline_html
from reports.document.text.terms import Terms
from reports.draw.canvas import Words
from reports.draw.sketched import letter
from reports.draw.weights import counterweight_drawing, flywheel_drawing
from reports.model.evaluation import evaluate_model
from reports.tables.registry import build_model
from tests.document.bare_pages import plain
from tests.document.test_report_parts import NEW, SAMPLES, page_of, with_every_part

pytestmark = [pytest.mark.usefixtures("nothing_is_drawn"), pytest.mark.xdist_group("sentences")]

_RADIUS = "r"  # of the crank: of the input, in mm


@pytest.mark.parametrize("name", [*SAMPLES, *NEW])
def test_sketches_say_what_the_tables_say(name: str):
    """«h = 19,6» and «b = 71,39» stood beside hм = 19,6 and bм = 71,4."""
    model = build_model(with_every_part(name))
    terms = Terms(model, evaluate_model(model))
    drawn = [*counterweight_drawing(counterweight_of(terms)), *flywheel_drawing(flywheel_of(terms))]
    told = dict[str, str]()
    for item in drawn:
        if isinstance(item, Words):
            sign, _, number = item.text.partition(" = ")
            told[sign] = re.sub("°$", "", number)
    del told[_RADIUS]
    assert len(told) == 7
    symbols = {letter(terms.tex(key)): terms.tex(key) for key in model.scalars
               if key.startswith(("fw_", "cw_"))}  # fmt: skip
    page = plain(re.sub("<tr[^>]*>", " | ", page_of(name)))
    rows = page.split(" | ")
    for sign, number in told.items():
        symbol = plain(str(inline_html(symbols[sign])))
        assert any(symbol in row and number in row for row in rows), (sign, number)
