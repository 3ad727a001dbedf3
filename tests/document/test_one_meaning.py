"""A symbol that a note explains has one meaning, whoever wrote the sentence.

The symbols of the tables are compared by their keys elsewhere; those of formulas and sentences
written by hand, «где ω — частота возмущения», are known from their explanations alone.
"""

from __future__ import annotations

import html
import re
from collections import defaultdict
from itertools import combinations
from unittest import mock

import pytest

from reports.document.figures.canvas import Pen, Point
from reports.document.figures.schemes import mechanism_sketch
from reports.document.text.symbols import inline_html
from reports.draw.writers import PT_PER_MM
from tests.document.test_report_parts import page_of

pytestmark = [pytest.mark.usefixtures("nothing_is_drawn"), pytest.mark.xdist_group("sentences")]

_TOLD = re.compile(r"(?:^(?:где )?|[,;(:] ?| и )([^\s,;:(]{1,12}) — ([^,;.()]+)")
_WORD = re.compile(r"[А-Яа-яё]{5,}")
_POINTS = "Отмечены"  # points of a diagram, not quantities
_JOINTS = {"O", "A", "B"}
_STEM = 4  # letters by which words are the same


def meanings(page: str) -> dict[str, set[str]]:
    """Explanations by symbol: of sentences, of lists, of tables with a column of symbols."""
    told: dict[str, set[str]] = defaultdict(set)
    for paragraph in re.findall(r"<(?:p|li)\b[^>]*>(.*?)</(?:p|li)>", page, re.DOTALL):
        text = _bare(paragraph)
        if _POINTS in text:
            continue
        for symbol, meaning in _TOLD.findall(text):
            if not _WORD.search(symbol) and not re.match("(?:на|по|от|в|до) ", meaning):
                told[symbol].add(meaning.strip())
    for head, body in re.findall(r"<thead>(.*?)</thead>.*?<tbody>(.*?)</tbody>", page, re.DOTALL):
        heads = [_bare(cell) for cell in re.findall(r"<th\b.*?</th>", head, re.DOTALL)]
        if "Обозначение" not in heads[:2]:
            continue
        for row in re.findall(r"<tr.*?</tr>", body, re.DOTALL):
            title, symbol, *_ = (_bare(cell) for cell in re.findall(r"<td.*?</td>", row, re.DOTALL))
            told[symbol].add(title)
    return told


def _bare(text: str) -> str:
    return re.sub(r"\s+", " ", html.unescape(re.sub("<[^>]+>", "", text))).strip()


def _stems(text: str) -> set[str]:
    return {word[:_STEM].lower() for word in re.findall(r"[А-Яа-яё]{4,}", text)}


def differ(one: str, other: str) -> bool:
    """Whether two explanations have hardly a word in common."""
    first, second = _stems(one), _stems(other)
    return not (first <= second or second <= first or len(first & second) > 1)


@pytest.mark.parametrize(
    "name", ["gots-diesel", "yamz-236", "two-stroke", "cycle-turbo-petrol", "V12", "one"]
)
def test_a_symbol_has_one_explanation(name: str):
    """ω was the shaft's speed and the vibration's, a_k the amplitude of an order and of a throw."""
    told = meanings(page_of(name))
    assert len(told) > 150
    several = {
        symbol: sorted(said)
        for symbol, said in told.items()
        if symbol != "—" and any(differ(*pair) for pair in combinations(said, 2))
    }
    assert several == {}


def _letters(offset: float) -> tuple[set[str], set[str]]:
    """Symbols on the left half of the mechanism's scheme, which has sizes, and on the right one."""
    halves: tuple[set[str], set[str]] = (set(), set())
    width = 150.0

    def noted(_: Pen, at: Point, text: str, *_more: object, **_named: object) -> None:
        for tex in re.findall(r"^\$([^=$]+)", text):
            halves[at[0] > width * PT_PER_MM / 2].add(_bare(inline_html(tex)))

    with mock.patch.object(Pen, "text", noted):
        mechanism_sketch(0.3, k=offset, width=width)
    return halves


@pytest.mark.parametrize("offset", [0.0, 0.2, -0.2])
def test_letters_of_the_scheme_are_those_of_the_note(offset: float):
    """S was the stroke in one half of figure 3 and the force along the rod in the other."""
    sizes, forces = _letters(offset)
    assert sizes & forces == _JOINTS
    assert len(forces - _JOINTS) == 6
    assert forces - _JOINTS <= meanings(page_of("gots-diesel")).keys()
