"""What a strict reader sees: nothing off the page, no number broken, no hole in the page.

Looked at as ink on the rendered pages and as words with their places, never as code.
"""

import os
import random
import re
from pathlib import Path
from unittest import mock

import pytest

from reports.document.page import numbering
from reports.document.page.render import render
from reports.document.report import Report
from reports.document.text.terms import Terms
from reports.inputs.fields import to_mapping
from reports.inputs.load import load_mapping
from reports.model.evaluation import evaluate_model
from reports.tables.registry import build_model
from tests.conftest import sample, sample_names
from tests.cover import ALL, examples
from tests.document import ink
from tests.document.pdftools import pages_of
from tests.document.report_samples import (
    BOX,
    pdf,
    print_page,
    shipped_pdf,
    terms_of,
    text_of,
    with_detail,
)
from tests.layouts import MAKERS

FIELD = ink.Field()
ENGINES = int(os.environ.get("KSHM_ENGINES", examples(1, 2)))  # random; 30 for a thorough look
# A page takes a fifth of a second to set and look at: those that others look at too, an engine in
# line as a course project and a V; all samples with the thorough look only.
SAMPLES = [("gots-p3", "shipped"), ("yamz-236", "shipped")]
if ALL:
    SAMPLES += [("gots-diesel", "full"), ("ecoboost-10", "course")]
if ENGINES >= 30:
    SAMPLES = [(name, detail) for name in sample_names() for detail in ("course", "full")]
NUMBER = re.compile(r"[−+]?[\d\u00a0]+(,\d+)?")
# Blank share at the foot of a page that is not the last of a chapter: the largest and the mean.
MAX_BLANK = (0.30, 0.06)


def faults(pages: list[list[ink.Word]], sheets: list) -> list[tuple[int, list[str]]]:
    collected = []
    for number, (words, sheet) in enumerate(zip(pages, sheets, strict=True), 1):
        wrong = ink.outside(sheet, FIELD) + ink.struck_numbers(words, FIELD)
        if wrong:
            collected.append((number, wrong))
    return collected


def rows_of(page: str) -> list[list[str]]:
    """Cells of every row of every table, of long tables set as lines too."""
    rows = []
    for body in re.findall(r"<tbody>(.*?)</tbody>", page, re.DOTALL):
        for row in re.findall(r"<tr.*?</tr>", body, re.DOTALL):
            lines = re.search(r'<tr class="lines"><td><div[^>]*>(.*?)</div>', row, re.DOTALL)
            if lines:
                text = re.sub(r"<[^>]+>", "", lines[1])
                rows += [line.split("\t") for line in text.split("\n")]
            else:
                rows.append(re.findall(r"<td[^>]*>(.*?)</td>", row, re.DOTALL))
    return rows


def solid(text: str) -> str:
    return re.sub(r"\s", "", text)


def broken(page: str, text: str) -> list[list[str]]:
    """Rows of numbers that no line of the PDF holds whole."""
    lines = "\n".join(solid(line) for line in text.splitlines())
    missing = []
    for row in rows_of(page):
        numbers = [solid(cell) for cell in row if NUMBER.fullmatch(cell.strip("\u00a0 "))]
        whole = len(numbers) == len(row)
        if (whole and "".join(numbers) not in lines) or any(n not in lines for n in numbers):
            missing.append(row)
    return missing


def written(data: bytes, folder: Path) -> Path:
    path = folder / "r.pdf"
    path.write_bytes(data)
    return path


def looked_at(terms: Terms) -> tuple[str, bytes]:
    page = Report(terms.model, terms.values).page("print")
    result = render(page)
    assert result.warnings == ()
    return page, result.pdf


def made(name: str, detail: str) -> tuple[str, bytes]:
    """A sample's page and PDF; both are there already if others look at them."""
    if detail == "full":
        return print_page(name), pdf(name)
    if detail == "shipped":  # of the page its tables are read, which hold no figure
        model = build_model(sample(name))
        with mock.patch.object(numbering, "drawn", lambda plan: BOX):
            page = Report(model, evaluate_model(model)).page("print")
        return page, shipped_pdf(name)
    return looked_at(terms_of(with_detail(text_of(name), detail)))


def holes(texts: list[str], sheets) -> list[float]:
    """Blank share of each page but the last of a chapter and the sheets before the text."""
    first = next(n for n, text in enumerate(texts) if "СОДЕРЖАНИЕ" in text)
    starts = set()
    for text in texts[first : first + 3]:
        for title, page in re.findall(r"(?m)^\s*(\S.*?)\s?\.{4,}\s*(\d+)\s*$", text):
            if not re.match(r"\d+\.\d", title):
                starts.add(int(page))
    inner = range(min(starts), len(sheets))
    return [ink.blank(sheets[n - 1], FIELD) for n in inner if n + 1 not in starts]


@pytest.mark.parametrize(("name", "detail"), SAMPLES)
def test_every_sample_reads_well(name, detail, tmp_path):
    page, data = made(name, detail)
    path, texts = written(data, tmp_path), pages_of(data, tmp_path)
    sheets = ink.sheets(path)
    assert faults(ink.words(path), sheets) == []
    assert broken(page, "\n".join(texts)) == []
    blank = holes(texts, sheets)
    largest, mean = MAX_BLANK
    assert max(blank) <= largest and sum(blank) / len(blank) < mean


def engine(seed: int) -> Terms:
    """A random engine of a layout that the seed picks: sizes, speed, long names."""
    draw = random.Random(seed)
    names = list(MAKERS)
    raw = MAKERS[names[seed % len(names)]](to_mapping(sample("gots-diesel")))
    factor = draw.uniform(0.6, 2.2)
    for key in ("bore_mm", "stroke_mm"):
        if raw["geometry"].get(key):
            raw["geometry"][key] *= factor
    raw["regime"]["speed_rpm"] *= draw.uniform(0.4, 1.6)
    raw["engine"]["name"] = "Двигатель с очень длинным названием " * draw.randint(1, 4)
    raw["calculation"]["step_deg"] = draw.choice([10, 15, 30])
    raw["report"] |= {"detail": draw.choice(["course", "full"]), "title": "Тема " * 30}
    model = build_model(load_mapping(raw, source="t.toml").model)
    return Terms(model, evaluate_model(model))


@pytest.mark.parametrize("seed", range(1, ENGINES + 1))
def test_no_random_engine_leaves_its_page(seed, tmp_path, monkeypatch):
    monkeypatch.setattr(numbering, "drawn", lambda plan: BOX)
    page, data = looked_at(engine(seed))
    path = written(data, tmp_path)
    assert faults(ink.words(path), ink.sheets(path)) == []
    assert broken(page, "\n".join(pages_of(data, tmp_path))) == []


@pytest.mark.parametrize(
    ("html", "wrong"),
    [
        ('<div style="width:190mm;background:#000">x</div>', "right"),
        ('<div style="margin-left:-9mm;background:#000">x</div>', "left"),
        ('<div style="position:absolute;top:-9mm;background:#000">x</div>', "top"),
        ('<div style="height:256mm"></div><div style="height:20mm;background:#000"></div>', ""),
        ('<div class="eq"><span class="c" style="width:99%;text-align:right">abcdef</span>'
         '<span class="n" style="margin-left:-9mm">(7)</span></div>', "(7) abcdef"),
    ],
)  # fmt: skip
def test_ink_off_the_page_is_noticed(html, wrong, tmp_path):
    from reports.document.page.blocks import DocumentInfo
    from reports.document.page.render import environment

    source = '{% extends "report/base.html.j2" %}{% block body %}' + html + "{% endblock %}"
    path = tmp_path / "r.pdf"
    path.write_bytes(render(environment().from_string(source).render(doc=DocumentInfo("x"))).pdf)
    collected = [fault for _, page in faults(ink.words(path), ink.sheets(path)) for fault in page]
    assert (wrong in collected) if wrong else collected == []


def test_a_broken_number_is_noticed():
    page = "<tbody><tr><td>79,527</td><td>8,91</td></tr></tbody>"
    assert broken(page, "79,527   8,91\n") == []
    assert broken(page, "79,52   8,91\n7\n") == [["79,527", "8,91"]]
