"""A figure stands on the page of its first mention, or on one beside it."""

import re

import pytest

from reports.document.page.placing import Block, Spot, filled
from tests.document.pdftools import pages_of
from tests.document.report_samples import shipped_pdf

_CAPTION = re.compile(r"^\s*Рисунок (\d+) —", re.MULTILINE)
_MENTION = re.compile(r"рисун[а-я]+ (\d+(?:(?:, | и |–)\d+)*)")


def first_mentions(pages):
    """Page of the first mention of each figure, by number."""
    first = {}
    for number, page in enumerate(pages):
        text = re.sub(r"\s+", " ", re.sub(r"[‐-]\n\s*", "", page))
        for told in _MENTION.findall(text):
            named = set(map(int, re.findall(r"\d+", told)))
            for low, high in re.findall(r"(\d+)–(\d+)", told):
                named |= set(range(int(low), int(high) + 1))
            for figure in named:
                first.setdefault(figure, number)
    return first


@pytest.mark.parametrize("name", ["gots-diesel", "two-stroke", "mwm-6"])
def test_a_figure_stands_within_a_page_of_its_mention(name, tmp_path):
    """The unrolled load on the pin stood two pages after the sentence that names it."""
    pages = pages_of(shipped_pdf(name), tmp_path)
    start = next(
        n for n, page in enumerate(pages) if re.search(r"^\s+ВВЕДЕНИЕ", page, re.MULTILINE)
    )
    pages = pages[start:]
    first = first_mentions(pages)
    standing = {int(n): at for at, page in enumerate(pages) for n in _CAPTION.findall(page)}
    assert len(standing) > 20
    assert {n: at - first[n] for n, at in standing.items() if abs(at - first[n]) > 1} == {}


def test_a_figure_named_early_does_not_wait():
    """Full pages alone would keep it for the end of the chapter."""
    text = [Block(f"<p>{n}</p>", "text", 100.0, line=20.0) for n in range(24)]
    named = Block('<p>на <a href="#ris-a">1</a></p>', "text", 100.0, line=20.0)
    figure = Block('<figure id="ris-a"></figure>', "float", 950.0, figure=900.0, least=1.0)
    placed, _ = filled([named, figure, *text], Spot(50.0), 1000.0, 20.0)
    before = sum(100 for html in placed[: placed.index(figure.html)])
    assert before + 50 < 2000
