"""A figure stands on the page of its first mention, or on one beside it."""

import re

import pytest

from reports.document.page.placing import Block, Spot, filled
from reports.document.report import Report
from reports.model.evaluation import evaluate_model
from reports.shared.resources import samples_dir
from reports.tables.registry import build_model
from tests.document.pdftools import pages_of
from tests.document.report_samples import shipped_pdf
from tests.document.test_report_parts import with_every_part


def first_mentions(pages, word):
    """Page of the first mention of each figure or table, by number."""
    first = {}
    for number, page in enumerate(pages):
        text = re.sub(r"\s+", " ", re.sub(r"[‐-]\n\s*", "", page))
        text = re.sub(r"Таблица \d+ —|(Продолжение|Окончание) таблицы \d+", "", text)  # captions
        for told in re.findall(word + r"[а-я]+ (\d+(?:(?:, | и |–)\d+)*)", text):
            named = set(map(int, re.findall(r"\d+", told)))
            for low, high in re.findall(r"(\d+)–(\d+)", told):
                named |= set(range(int(low), int(high) + 1))
            for figure in named:
                first.setdefault(figure, number)
    return first


@pytest.mark.parametrize("name", ["gots-diesel", "two-stroke", "mwm-6", "vaz-2106"])
@pytest.mark.parametrize(
    ("word", "caption", "count", "most"),
    [("рисун", r"^\s*Рисунок (\d+) —", 20, 1), ("табл", r"^\s*Таблица (\d+) —", 16, 2)],
)
def test_it_stands_within_a_page_or_two_of_its_mention(name, word, caption, count, most, tmp_path):
    """The unrolled load on the pin stood two pages after the sentence that names it.

    The table of the throws, which waits for that of the input data, stood five pages after it.
    """
    assert_near(pages_of(shipped_pdf(name), tmp_path), word, caption, count, most)


def test_a_figure_stands_near_in_a_note_with_every_part(tmp_path):
    """The sketch of the piston stood seventeen pages after its mention, of the rod thirteen."""
    model = build_model(with_every_part("cycle-turbo-diesel"))
    source = samples_dir() / "cycle-turbo-diesel.toml"
    pages = pages_of(Report.of(model, evaluate_model(model), source).pdf(source, b""), tmp_path)
    assert_near(pages, "рисун", r"^\s*Рисунок (\d+) —", 40, 1)


def assert_near(pages, word, caption, count, most):
    """Whether all figures or tables stand so many pages from their first mention at most."""
    start = next(
        n for n, page in enumerate(pages) if re.search(r"^\s+ВВЕДЕНИЕ", page, re.MULTILINE)
    )
    pages = pages[start:]
    first = first_mentions(pages, word)
    standing = {
        int(number): at
        for at, page in enumerate(pages)
        for number in re.findall(caption, page, re.MULTILINE)
    }
    assert len(standing) > count
    assert {n: at - first[n] for n, at in standing.items() if abs(at - first[n]) > most} == {}


def test_a_figure_named_early_does_not_wait():
    """Full pages alone would keep it for the end of the chapter."""
    text = [Block(f"<p>{n}</p>", "text", 100.0, line=20.0) for n in range(24)]
    named = Block('<p>на <a href="#ris-a">1</a></p>', "text", 100.0, line=20.0)
    figure = Block('<figure id="ris-a"></figure>', "float", 950.0, figure=900.0, least=1.0)
    placed, _ = filled([named, figure, *text], Spot(50.0), 1000.0, 20.0)
    before = sum(100 for html in placed[: placed.index(figure.html)])
    assert before + 50 < 2000
