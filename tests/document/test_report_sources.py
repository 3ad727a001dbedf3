"""A chapter that quotes a method stands on several sources, each named in its text."""

import re

import pytest

from tests.document.bare_pages import bare_page
from tests.document.test_report_factors import full

pytestmark = [pytest.mark.usefixtures("nothing_is_drawn"), pytest.mark.xdist_group("sentences")]
_LEAST = 4
_METHODS = re.compile(
    "Расчёт рабочего цикла|Уравновешенность|Крутильные|Масляная|Прочность деталей|Подбор"
)


@pytest.mark.parametrize(
    ("name", "sections", "count"),
    [
        ("yamz-236", {"strength": {"kind": "diesel"}, "bearings": {}, "torsion": {},
                      "counterweight": {}}, 5),
        ("cycle-turbo-diesel", {}, 2), ("mwm-6", {}, 2),
    ],
)  # fmt: skip
def test_a_chapter_of_a_method_has_four_sources(name, sections, count):
    page = bare_page(full(name, **sections))
    listed = set(re.findall(r'<li id="([^"]+)"><span class="num">\d+', page))
    chapters = {}
    for chapter in re.split(r"(?=<h1)", page):
        title = re.sub("<[^>]+>", "", chapter[: chapter.find("</h1>")])
        if title[:1].isdigit() and _METHODS.search(title):
            chapters[title] = set(re.findall(r'<a class="ref" href="#(src[^"]*)"', chapter))
    assert len(chapters) == count
    assert {title: len(cited) for title, cited in chapters.items() if len(cited) < _LEAST} == {}
    assert set.union(*chapters.values()) <= listed
