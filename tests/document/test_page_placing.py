"""Where figures and tables float to, and how many lines WeasyPrint makes of a paragraph."""

from __future__ import annotations

import base64
import re
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
import weasyprint
from hypothesis import given, settings
from hypothesis import strategies as st
from weasyprint.text.fonts import FontConfiguration

from reports.document.figures.curves import Panel, PlotCurve, curves_figure
from reports.document.figures.polar import polar_path, wear_diagram
from reports.document.page import render
from reports.document.page.blocks import DocumentInfo
from reports.document.page.fitting import line_count
from reports.document.page.floating import _title_lines, arranged, smaller
from reports.document.page.placing import Block, Spot, after, filled
from reports.document.page.style import USUAL
from reports.document.report import Report
from reports.model.evaluation import evaluate_model
from reports.tables.registry import build_model
from tests.conftest import sample
from tests.document.bare_pages import bare_page
from tests.document.report_samples import terms

ROOM, LINE = 900.0, 28.0


def text(name, lines=3):
    return Block(f"<p>{name}</p>", "text", lines * LINE, line=LINE)


def heading(name):
    return Block(f"<h2>{name}</h2>", "heading", 24.0, 18.0, 10.0)


def figure(name, height=300.0):
    picture = f'<svg class="fig" style="width:100.0mm">{name}</svg>'
    return Block(picture, "float", height + 30, 13.0, 13.0, figure=height)


def table(name, rows=10, *, keep=False):
    kind = "float" if keep else "table"
    height = 70 + 22.0 * rows
    return Block(f"<table>{name}</table>", kind, height, 13.0, 13.0, head=60.0, rows=(22.0,) * rows)


def formula(name):
    return Block(f'<div class="eq">{name}</div>', "tied", 40.0, 8.0, 8.0)


def names(placed):
    return [re.sub("<[^>]+>", "", html) for html in placed]


def in_order(blocks):
    """What it costs to leave everything where it is."""
    spot = Spot(0.0)
    for block in blocks:
        spot = after(block, spot, ROOM)
    return spot.cost


blocks = st.lists(
    st.one_of(
        st.builds(text, st.just("t"), st.integers(1, 9)),
        st.builds(figure, st.just("f"), st.floats(100, 600)),
        st.builds(table, st.just("b"), st.integers(1, 60), keep=st.just(False)),
        st.builds(table, st.just("b"), st.integers(1, 20), keep=st.just(True)),
        st.builds(heading, st.just("h")),
        st.builds(formula, st.just("e")),
    ),
    min_size=1,
    max_size=25,
)


def numbered(drawn):
    """The same blocks, each with a name of its own; a chapter ends with text."""
    values = [*drawn, text("t")]
    return [
        Block(block.html.replace(">" + block.html.split(">")[1][0], f">{kind}{index} ", 1),
              *(getattr(block, key) for key in Block.__slots__[1:]))
        for index, block in enumerate(values)
        for kind in [block.html.split(">")[1][0]]
    ]  # fmt: skip


@settings(max_examples=30, deadline=None)
@given(blocks)
def test_everything_stands_once_and_each_series_in_its_order(drawn):
    built = numbered(drawn)
    before, (placed, spot) = names(b.html for b in built), filled(built, Spot(0.0), ROOM, LINE)
    shown = names(placed)
    assert sorted(shown) == sorted(before)
    for series in ("f", "b", "the"):
        assert [n for n in shown if n[0] in series] == [n for n in before if n[0] in series]
    places = {name: index for index, name in enumerate(before)}
    for index, name in enumerate(shown[1:], 1):
        above = shown[index - 1]
        if above[0] == "h" and places[name] < places[above]:
            raise AssertionError(f"{name} of the section before stands below {above}")
        if name[0] == "e":  # a formula stays with its sentence
            assert places[above] == places[name] - 1 or before[places[name] - 1][0] in "fb"
    assert spot.cost <= in_order(built) + 0.1


def test_a_table_does_not_wait_for_a_tall_figure():
    values = [text("a", 12), figure("tall", 850.0), table("long", 40), text("b", 6)]
    placed, spot = filled(values, Spot(0.0), ROOM, LINE)
    assert names(placed)[:2] == ["a", "long"] and spot.page == 3


def test_text_goes_on_where_a_figure_has_no_room():
    values = [text("a", 20), figure("f", 500.0), *(text(f"t{n}", 4) for n in range(5))]
    shown = names(filled(values, Spot(0.0), ROOM, LINE)[0])
    assert 2 <= shown.index("f") <= 5


def test_a_figure_that_misses_by_little_is_made_smaller():
    values = [text("a", 20), figure("f", 330.0), heading("h"), text("b", 20)]
    placed, spot = filled(values, Spot(0.0), ROOM, LINE)
    width = float(re.search(r"width:([\d.]+)mm", placed[1])[1])
    assert 70.0 <= width < 100.0 and spot.page == 2


@pytest.mark.parametrize(
    ("made", "pages"),
    [
        ([text("a", 20), figure("f", 330.0), text("b", 2)], 1),
        ([text("a", 7), figure("f"), figure("g"), table("t", 2, keep=True)], 1),
        ([text("a", 7), figure("f"), figure("g"), figure("h")], 2),  # they would be tiny
    ],
)
def test_figures_are_smaller_rather_than_one_alone_on_the_last_page(made, pages):
    placed, spot = filled(made, Spot(0.0), ROOM, LINE)
    widths = re.findall(r"width:([\d.]+)mm", "".join(placed))
    assert spot.page == pages and all(float(width) >= 70.0 for width in widths)


@pytest.mark.parametrize(
    ("rows", "fit", "here"),
    [(4, 3, 0), (5, 4, 0), (6, 3, 3), (6, 2, 0), (8, 7, 5), (8, 6, 5), (9, 4, 4)],
)
def test_three_rows_of_a_table_stand_together_at_both_ends(rows, fit, here):
    spot = after(table("b", rows), Spot(ROOM - 13 - 70 - 22.0 * fit - 5), ROOM)
    above = 13 + 70 if here == 0 else 60
    assert spot[:3] == (above + 22.0 * (rows - here), 13.0, 2)


@pytest.mark.parametrize("lines", range(24, 33))
def test_a_line_that_leads_to_a_formula_stands_with_it(lines):
    values = [text("a", lines), text("При φ = 30°", 1), formula("x = 1"), text("b", 3)]
    placed, _ = filled(values, Spot(0.0), ROOM, LINE)
    assert '<p class="lead">' in placed[1]
    first = after(values[0], Spot(0.0), ROOM)
    fits = first.used + LINE + 48.0 <= ROOM
    lead = after(Block("", "text", LINE, line=LINE, tail=48.0), first, ROOM)
    assert (lead.page == first.page) == fits


@pytest.mark.parametrize("lines", [1, 2, 3, 4, 7])
def test_a_paragraph_of_any_length_leads_to_its_formula(lines):
    """A short one stood at the foot of a page, its formula on the next."""
    values = [text("силы складывают:", lines), formula("x = 1")]
    assert '<p class="lead">' in filled(values, Spot(0.0), ROOM, LINE)[0][0]
    spot = after(replace(values[0], tail=48.0), Spot(ROOM - lines * LINE - 40.0), ROOM)
    assert spot.page == 2


@pytest.mark.parametrize("fill", range(100, 230, 20))
def test_the_last_lines_of_a_paragraph_stand_with_their_formula(fill):
    """As WeasyPrint divides it, so it is reckoned: two lines go over with the formula."""
    lead = Block('<p class="lead">a<br>b<br>c<br>d<br>e</p>', "text", 100.0, line=20.0)
    values = [lead, Block('<div class="eq">x</div>', "tied", 50.0, 8.0, 8.0), text("z", 1)]
    style = (
        "@page{size:400px 300px;margin:0}body{margin:0;font:16px/20px STIXGeneral}"
        "p{margin:0;orphans:2;widows:2}p.lead{break-after:avoid}"
        ".eq{height:50px;margin:8px 0;break-inside:avoid}"
    )
    body = f'<div style="height:{fill}px"></div>{lead.html}{values[1].html}'
    document = weasyprint.HTML(string=f"<style>{style}</style>{body}").render()
    first = document.pages[0]._page_box
    here = sum(box.element_tag == "p" and type(box).__name__ == "LineBox"
               for box in first.descendants())  # fmt: skip
    placed = filled(values, Spot(float(fill)), 300.0, 20.0)[0]
    message = replace(lead, html=placed[0], tail=58.0)
    spot = after(message, Spot(float(fill)), 300.0)
    assert (spot.used, spot.page) == ((fill + 100, 1) if here == 5 else (40.0, 2))
    assert here in (3, 5)


def lines_of(page):
    """Lines of each paragraph or heading that has a number as WeasyPrint sets it."""
    html = weasyprint.HTML(string=page, base_url=None, url_fetcher=render._fetcher())
    document = html.render(font_config=FontConfiguration())
    collected = {}
    waiting = [sheet._page_box for sheet in document.pages]
    while waiting:
        box = waiting.pop()
        children = getattr(box, "children", None) or ()
        message = getattr(box, "element_tag", "") in ("p", "h1", "h2", "h3")
        if message and type(box).__name__ == "BlockBox":
            number = int(box.element.get("id"))
            collected[number] = collected.get(number, 0) + len(children)
            continue
        waiting += children
    return collected


def set_alone(parts):
    """Lines of these parts of a page, by their places in the list."""
    body = "\n".join(re.sub(r'^<(\w+)(?: id="[^"]*")?', rf'<\1 id="{n}"', part)
                     for n, part in enumerate(parts))  # fmt: skip
    source = '{% extends "report/base.html.j2" %}{% block body %}' + body + "{% endblock %}"
    return lines_of(render.environment().from_string(source).render(doc=DocumentInfo("x")))


@pytest.mark.usefixtures("nothing_is_drawn")
def test_headings_have_the_lines_that_were_counted():
    """Bold and beside the indent; a title that misses a line by little takes two."""
    message = bare_page(sample("ecoboost-10")).partition("Введение</h1>")[2]
    parts = re.findall(r'<h([123])(?! [^>]*class="plain)([^>]*)>(.*?)</h', message, re.DOTALL)
    longer = [(level, look, f"{title} {more}") for level, look, title in parts
              for more in ("", "механизма", "двигателя внутреннего сгорания")]  # fmt: skip
    headings = [f"<h{level}{look}>{title}</h{level}>" for level, look, title in longer]
    actual = set_alone(headings)
    em, width = USUAL.em_px, USUAL.width_px - USUAL.indent_cm * 96 / 2.54
    counted = [_title_lines(heading, width / (em * (1.15 if heading[2] == "1" else 1)), bold=True)
               for heading in headings]  # fmt: skip
    assert len(headings) > 30 and len(set(counted)) > 1
    assert [headings[n] for n, lines in enumerate(counted) if lines != actual[n]] == []


def test_words_divide_before_two_letters_as_russian_books_do():
    """Whole words of four to eight letters went over and left a line twice as wide apart."""
    said = "нагрузка шейки и толщина плёнки " * 9
    widths = [5.5, 6.5, 8.5, 10.0]
    item = set_alone([f'<p class="flush" style="width:{w}em">{said}</p>' for w in widths])
    assert [item[n] for n in range(4)] == [line_count(said, w) for w in widths] == [32, 24, 18, 15]


@pytest.mark.usefixtures("nothing_is_drawn")
def test_paragraphs_have_the_lines_that_were_counted():
    """All but one or two in a hundred: letters are not set closer here as they are there."""
    message = bare_page(terms("one").model.input).partition("Введение</h1>")[2]
    paragraphs = re.findall(r"<p>(?:(?!<svg).)*?</p>", message, re.DOTALL)
    actual = set_alone(paragraphs)
    em = USUAL.em_px
    counted = [
        line_count(p, USUAL.width_px / em, indent=USUAL.indent_cm * 96 / 2.54 / em)
        for p in paragraphs
    ]
    wrong = [n for n, lines in enumerate(counted) if lines != actual[n]]
    assert len(paragraphs) > 60 and sum(counted) > 150
    assert len(wrong) <= 0.03 * len(paragraphs)
    assert all(abs(counted[n] - actual[n]) == 1 for n in wrong)


@pytest.mark.parametrize(("lines", "runs_on"), [(10, True), (16, False), (60, True)])
def test_a_chapter_does_not_run_on_to_leave_a_few_lines_on_its_last_page(lines, runs_on):
    """Three lines stood alone on a page where the last chapter might have begun on it."""

    def chapter(number, count):
        said = "\n".join("<p>Строка.</p>" for _ in range(count))
        return f'<h1 id="c{number}" class=""><span class="hn">{number}</span> Глава</h1>\n{said}'

    closing = '<h1 id="end" class="plain">Заключение</h1>\n<p>Строка.</p>'
    body = "\n".join([chapter(1, 18), chapter(2, lines), closing])
    placed = arranged(body, USUAL, run_on=0.3)
    assert ("runon" in placed) == runs_on
    assert placed.count("<p>") == 18 + lines + 1


MIN_PT = 7.0
IMAGE = re.compile(
    r'<img class="fig" style="width:([\d.]+)mm"[^>]*? alt="([^"]*)" src="[^,]*,([^"]+)"'
)
PHI = np.linspace(0, 720, 73)
TURN = np.radians(PHI)
DRAWS = (
    partial(
        curves_figure, PHI, (Panel((PlotCurve("T", np.sin(TURN)),), "T, МПа"),), "φ", height=76.0
    ),
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
    collected = {
        alt[:60]: min(sizes(base64.b64decode(data).decode(), float(width)), default=MIN_PT)
        for width, alt, data in IMAGE.findall(page)
    }
    assert len(collected) > 15
    assert {words: least for words, least in collected.items() if least < MIN_PT} == {}


@settings(max_examples=15)
@given(draw=st.sampled_from(DRAWS), share=st.floats(0.7, 0.99))
def test_a_figure_keeps_its_type_and_fits_its_height(draw: partial[str], share: float) -> None:
    whole = draw()
    actual = smaller(draw, share * height(whole))
    assert actual is not None
    assert 0.9 * share * height(whole) <= height(actual) <= share * height(whole)
    assert min(sizes(actual)) >= min(sizes(whole)) - 0.05


def test_a_drawing_without_a_size_is_left() -> None:
    assert smaller(partial(str, "<svg/>"), 10.0) is None
    assert smaller(lambda: "<svg/>", 10.0) is None
