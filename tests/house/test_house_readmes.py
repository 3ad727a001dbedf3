"""Both READMEs tell the same, and their numbers are those of today."""

from __future__ import annotations

import re
from collections import Counter

from reports.studies.validation_workbook import validate
from tests.manual.pages import READMES, ROOT, blocks, commands


def numbers(page):
    """All numbers of a page, thousands joined."""
    text = re.sub(r"(?<=\d)[,\u00a0 ](?=\d{3}\b)", "", page.read_text(encoding="utf-8"))
    return set(map(int, re.findall(r"\d+", text)))


def headings(page):
    text = re.sub(r"(?ms)^ *```.*?^ *```", "", page.read_text(encoding="utf-8"))
    return [len(line.split()[0]) for line in text.splitlines() if line.startswith("#")]


def rows(page):
    """What every row of the tables is about: its code, or its text where there is none."""
    collected = []
    for line in page.read_text(encoding="utf-8").splitlines():
        if line.strip().startswith("|"):
            first, *others = re.split(r"(?<!\\)\|", line.strip())[1:-1]
            words = tuple(re.findall(r"--[a-z]+|kshm [a-z]+|[a-z0-9-]+\.[a-z]+", first))
            collected.append((len(others), words, set(re.findall(r"\d+", first))))
    return collected


def test_the_same_headings_tables_commands_and_pictures():
    one, other = READMES
    assert headings(one) == headings(other)
    assert len(headings(one)) == 7
    assert rows(one) == rows(other)
    assert commands(one) == commands(other)
    pictures = [re.findall(r"!\[[^]]+\]\(([^)]+)\)", page.read_text("utf-8")) for page in READMES]
    assert pictures[0] == pictures[1]
    assert len(pictures[0]) == 6
    assert (ROOT / pictures[0][1]).stat().st_size < 1_500_000  # the clip
    assert all((ROOT / name).is_file() for name in pictures[0])


def links(page, pattern=r"\]\((docs/[\w-]+\.md)\)"):
    return Counter(re.findall(pattern, page.read_text("utf-8")))


def test_the_same_pages_are_pointed_at():
    assert set(links(READMES[0])) == set(links(READMES[1]))


def test_the_numbers_of_the_validation_are_those_of_today():
    counts = validate().counts
    today = {counts.total, *counts.by_verdict.values()} - {0}
    assert len(today) == 5
    for page in READMES:
        assert today <= numbers(page), (page.name, today - numbers(page))


def test_the_first_page_is_short_and_leads_to_every_page_of_the_manual():
    for page in READMES:
        text = page.read_text(encoding="utf-8")
        assert len(text.splitlines()) <= 150
        assert 'reports.load("samples/gots-diesel.toml")' in text
    listed = links(ROOT / "docs" / "index.md", r"\]\(([\w-]+\.md)\)")
    assert set(listed) == {page.name for page in (ROOT / "docs").glob("*.md")} - {"index.md"}


def test_the_first_lines_of_python_say_what_stands_beside_them():
    for page in READMES:
        (block,) = blocks(page, "python")
        names: dict = {}
        exec(compile(block, str(page), "exec"), names)
        peak = names["solution"].loads.crankpin_max
        said = re.search(r"# ([\d.,]+) (?:kN|кН)", block)[1]
        assert float(said.replace(",", ".")) == round(float(peak), 1)
