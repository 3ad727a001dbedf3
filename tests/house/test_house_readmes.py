"""Both READMEs tell the same, and their numbers are those of today."""

from __future__ import annotations

import io
import re
import zipfile
from collections import Counter

from reports.studies.validation_book import validate
from tests.manual.pages import READMES, ROOT, commands
from tests.workbook.made import book


def numbers(page):
    """All numbers of a page, thousands joined."""
    text = re.sub(r"(?<=\d)[,\u00a0 ](?=\d{3}\b)", "", page.read_text(encoding="utf-8"))
    return set(map(int, re.findall(r"\d+", text)))


def headings(page):
    text = re.sub(r"(?ms)^ *```.*?^ *```", "", page.read_text(encoding="utf-8"))
    return [len(line.split()[0]) for line in text.splitlines() if line.startswith("#")]


def rows(page):
    """What every row of the tables is about: its code, or its text where there is none."""
    found = []
    for line in page.read_text(encoding="utf-8").splitlines():
        if line.strip().startswith("|"):
            first, *others = re.split(r"(?<!\\)\|", line.strip())[1:-1]
            words = tuple(re.findall(r"--[a-z]+|kshm [a-z]+|[a-z0-9-]+\.[a-z]+", first))
            found.append((len(others), words, set(re.findall(r"\d+", first))))
    return found


def test_the_same_headings_tables_commands_and_pictures():
    one, other = READMES
    assert headings(one) == headings(other)
    assert len(headings(one)) == 11
    assert rows(one) == rows(other)
    assert commands(one) == commands(other)
    pictures = [re.findall(r"!\[[^]]+\]\(([^)]+)\)", page.read_text("utf-8")) for page in READMES]
    assert pictures[0] == pictures[1]
    assert len(pictures[0]) == 5
    assert all((ROOT / name).is_file() for name in pictures[0])


def links(page):
    return Counter(re.findall(r"\]\((docs/[\w-]+\.md)\)", page.read_text("utf-8")))


def test_the_same_pages_are_pointed_at():
    assert set(links(READMES[0])) == set(links(READMES[1]))


def test_the_numbers_of_the_validation_are_those_of_today():
    counts = validate().counts
    today = {counts.total, *counts.by_verdict.values()} - {0}
    assert len(today) == 5
    for page in READMES:
        assert today <= numbers(page), (page.name, today - numbers(page))


def test_the_workbook_is_about_as_large_as_the_pages_say():
    with zipfile.ZipFile(io.BytesIO(book())) as archive:
        names = archive.namelist()
        sheets = [name for name in names if name.startswith("xl/worksheets/sheet")]
        formulas = sum(archive.read(name).count(b"<f>") for name in sheets)
    drawn = sum(name.startswith("xl/charts/chart") for name in names)
    for count in (formulas, drawn, len(sheets)):
        near = [min(numbers(page), key=lambda n: abs(n - count)) for page in READMES]
        assert near[0] == near[1]
        assert abs(near[0] - count) < 0.01 * count
