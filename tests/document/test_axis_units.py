"""Every axis of a note and of the sheet of dynamics names its unit, or has none to name."""

from __future__ import annotations

import re
from functools import lru_cache
from unittest import mock

import pytest

from reports.document.figures import polar
from reports.document.figures.axes import Axes
from reports.document.report import Report
from reports.document.text.symbols import inline_html
from reports.document.text.terms import Terms
from reports.draw.canvas import Words
from reports.model.evaluation import evaluate_model
from reports.sheet.write import sheet_items
from reports.tables.registry import build_model
from tests.document.bare_pages import plain
from tests.document.test_report_parts import NEW, SAMPLES, page_of, with_every_part

# A share, an order of vibration, an amplitude in those of the first mass, a number of a mass.
BARE = {r"$k'_{\mathrm{пв}}$", r"$\nu$", r"$\alpha$", r"$i_{\mathrm{м}}$"}
# Sums of amplitudes in those of the first mass, an orbit in parts of the clearance.
BARE |= {"$x_{1}$", "$y_{1}$", "$x$ (по вращению)", "$y$"}
_SCALES = re.compile(r", \S.* \(М [\d,]+ \S+/мм; по горизонтали [\d,]+ \S+/мм\)$")


@lru_cache(maxsize=2)
def terms_of(name: str) -> Terms:
    """Terms of an engine with every chapter."""
    model = build_model(with_every_part(name))
    return Terms(model, evaluate_model(model))


def axes_of(name: str) -> set[str]:
    """Names of all axes of the figures of its note."""
    named: set[str] = set()

    def noted(draw):
        def name_axis(self: Axes, text: str) -> None:
            named.add(text)
            draw(self, text)

        return name_axis

    def ends_noted(*given):
        named.update(given[-1])
        return ends(*given)

    ends = polar._ends
    draws = {each: noted(getattr(Axes, each)) for each in ("name_y", "name_x")}
    with mock.patch.multiple(Axes, **draws), mock.patch.object(polar, "_ends", ends_noted):
        terms = terms_of(name)
        Report(terms.model, terms.values).page("screen")
    return named


@pytest.mark.parametrize("name", [*SAMPLES, *NEW])
def test_every_axis_has_its_unit(name: str):
    named = axes_of(name)
    assert len(named) > 15
    assert {text for text in named if ", " not in text} <= BARE


@pytest.mark.parametrize("name", [*SAMPLES, *NEW])
def test_every_axis_of_the_sheet_has_its_unit(name: str):
    canvas, *_ = sheet_items(terms_of(name))
    scales = [item.text for item in canvas.items if isinstance(item, Words) and "(М " in item.text]
    assert len(scales) > 5
    assert [text for text in scales if not _SCALES.search(text)] == []


def test_an_axis_of_two_curves_has_the_symbols_of_both():
    """«Me» with an «e» of plain text stood at the curves of M_e and M_р, «A» at those of L."""
    name = "cycle-tractor-diesel"
    canvas, *_ = sheet_items(terms_of(name))
    words = {item.text for item in canvas.items if isinstance(item, Words)}
    titles = {text.partition(" (М ")[0] for text in words if "(М " in text}
    assert {"M_e, M_р, Н·м", "N_уд, S_уд, МПа", "K_уд, T_уд, МПа"} <= titles
    assert r"$L_{\mathrm{изб}}$, $L_{\mathrm{изб.г}}$, Дж" in axes_of(name)


@pytest.mark.parametrize("name", ["gots-diesel", "yamz-236", "two-stroke", "one"])
def test_a_symbol_of_an_axis_stands_in_the_note(name: str):
    """τ_раб1 and i_м stood on axes and nowhere else; a projection or a number may."""
    named = axes_of(name)
    assert len(named) > 15
    drawn = page_of.__wrapped__(name)  # kept pages are those of tests without figures
    text = plain(re.sub("(?s)<svg.*?</svg>", "", drawn)).replace(" ", "")
    symbols = {tex for words in named for tex in re.findall(r"\$([^$]+)\$", words)}
    said = {plain(str(inline_html(tex))).replace(" ", "") for tex in symbols}
    assert {sign for sign in said if re.sub(r"(?<=.)[xy\d]$", "", sign) not in text} == set()
