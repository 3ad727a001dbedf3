"""Foreign text, the HTML page, formulas with numbers."""

import json
import re
from pathlib import Path

import pytest

from reports.document.chapters.dynamics import _pressure_at, _pressure_tex
from reports.document.page.render import render
from reports.document.report import Report
from reports.document.text.mathsvg import formula, formula_lines
from reports.document.text.terms import book_place, plain_number, unit_tex
from reports.document.text.tex import case_parts
from reports.shared.errors import NotPrintable
from tests.document.pdftools import fonts_of, pages_of
from tests.document.report_samples import ONE, html_page, terms, terms_of

HOSTILE = (
    '<script>alert(1)</script><img src="http://127.0.0.1:9/x">{{ 7*7 }}{% raw %}'
    "$x^2$ \\frac{1}{2} &amp;"
)
LONG = "Ы" * 150 + "🚗"


@pytest.fixture(scope="module")
def hostile():
    fields = ("student", "group", "institution", "department", "supervisor", "variant", "city")
    report = "".join(
        f"{key} = {json.dumps(HOSTILE + LONG, ensure_ascii=False)}\n" for key in fields
    )
    report += f"title = {json.dumps(HOSTILE, ensure_ascii=False)}\n"
    text = ONE.replace("[report]\n", "[report]\n" + report)
    text = text.replace(
        'name = "Одноцилиндровый"', f"name = {json.dumps(HOSTILE, ensure_ascii=False)}"
    )
    return terms_of(text)


@pytest.mark.usefixtures("few_chapters")
def test_foreign_text_is_set_as_plain_text(hostile, tmp_path):
    page = Report(hostile.model, hostile.values).page("print")
    assert "<script" not in page and "<img" not in page
    result = render(page)
    assert result.warnings == ()
    pages = pages_of(result.pdf, tmp_path)
    assert "{{ 7*7 }}" in pages[0] and "<script>alert(1)</script>" in pages[0]
    assert "$x^2$" in pages[0]
    assert all(font.startswith("STIX") for font in fonts_of(result.pdf, tmp_path))


def test_html_is_one_self_contained_page(hostile):
    page = Report.of(hostile.model, hostile.values, Path("t.toml")).page("screen")
    assert "<script" not in page and "<img" not in page and "<link" not in page
    addresses = re.findall(r'(?:src|href)="([^"]*)"', page) + re.findall(r"url\(([^)]*)\)", page)
    assert addresses and all(a.strip("'\"").startswith(("#", "data:")) for a in addresses)
    assert 'class="tbox"' in page and "viewport" in page


def test_the_same_input_gives_the_same_page():
    # Equal pages give equal PDF files: see test_document_render.
    t = terms("one")
    first = html_page("one")
    formula.cache_clear()
    formula_lines.cache_clear()
    assert Report.of(t.model, t.values, Path("t.toml")).page("screen") == first


def test_substitution_shows_numbers_and_result():
    t = terms("gots-diesel")
    assert t.substitution("omega", symbols=True) == (
        r"\omega = \dfrac{\pi \, n}{30} = \dfrac{\pi \cdot 4400}{30}"
        r" = 460{,}77\;\mathrm{рад/с}"
    )
    assert t.formula("P3_1.s_mm") == r"s_{\mathrm{п}} = s_{\mathrm{п}1} + s_{\mathrm{п}2}"
    shown = t.substitution("P4_1.Ps_MPa", 390.0)
    assert shown.startswith(r"p'_{s} = 4{,}7749 + \left(-3{,}")


def test_rounding_noise_is_printed_as_zero():
    """Opposed throws: the sines of 180° leave 1e-16 in every sum."""
    t = terms("vw-1600")
    for at in (180.0, 360.0, 540.0):
        _, given, result = t.substitution("P4_3_1.Rx_MPa", at).split(" = ")
        assert result == r"0{,}000\;\mathrm{МПа}" and "10^" not in given and given[0] != "0"


def test_branch_in_force_is_the_one_shown():
    t = terms("gots-diesel")
    assert "гор" in t.formula("gas.p_MPa", 390.0) and "сж" in t.formula("gas.p_MPa", 300.0)
    assert t.formula("gas.p_MPa", 90.0) == "p_{\\mathrm{г}} = p_{a}"


@pytest.mark.parametrize("name", ["gots-diesel", "two-stroke", "cycle-petrol", "ecoboost-10"])
def test_the_pressure_is_told_by_symbols_that_are_known(name):
    t = terms(name)
    lead, branches = case_parts(_pressure_tex(t))
    assert lead == t.tex("gas.p_MPa") + " ="
    assert branches[-1][-1].endswith(",")  # «где» follows
    assert sum("n_" in formula for formula, _ in branches) >= 2
    own = [t.tex(f"gas.p_{part}_MPa") for part in ("compression", "burning", "exhaust")]
    assert [formula for formula, _ in branches if formula.strip(", ") in own] == []
    for at in (30.0, 300.0, 390.0, 500.0):
        message = _pressure_at(t, at)
        assert message.startswith(t.tex("gas.p_MPa") + " = ") and message.endswith("МПа}")
        assert not any(symbol in message for symbol in own)


OWN = ("P3_", "P4_", "gas", "crankpin")


def columns(t):
    for table in t.model.tables.values():
        for column in table.columns:
            if column.expr is not None and not column.helper and table.id.startswith(OWN):
                yield f"{table.id}.{column.key}"


@pytest.mark.parametrize("name", ["gots-diesel", "one"])
def test_formulas_of_all_tables_can_be_set(name):
    t, seen = terms(name), set()
    for key in columns(t):
        try:
            tex = t.formula(key, 390.0)
        except NotPrintable as reason:
            assert key == "gas.p_MPa" and "element" in str(reason)
            continue
        if tex not in seen:
            seen.add(tex)
            formula_lines(tex)
    assert len(seen) > 30


def test_words_of_the_book():
    assert book_place("Гоц (3)") == "формула\u00a0(3)"
    assert book_place("Гоц (51), (53), (55)") == "формулы\u00a0(51), (53), (55)"
    assert book_place("Гоц, 2.8") == "п.\u00a02.8"
    assert book_place("Гоц, рис. 33") == "рис.\u00a033"
    assert book_place("∫p dV") == ""


def test_units_and_plain_numbers():
    assert unit_tex("м/с²") == r"\;\mathrm{м/с}^{2}"
    assert unit_tex("°") == r"^{\circ}" and unit_tex("") == ""
    assert plain_number(0.245) == "0,245" and plain_number(88.0) == "88"
    assert plain_number(-0.5) == "−0,5"
    assert plain_number(5469.651566650598) == "5469,6516"
    assert plain_number(0.05 * 1.1) == "0,055"  # 0.05500000000000001
