"""Cached values and the form of XML that all programs read."""

from __future__ import annotations

import io
import math
import zipfile

import pytest
from lxml import etree
from openpyxl import Workbook
from openpyxl.chart import Reference, ScatterChart, Series

from reports.shared.errors import CacheError
from reports.workbook.caches import finish
from reports.workbook.sheets import CacheValues
from tests.workbook.lint import MAIN, C
from tests.workbook.made import coarse_book

XDR = "{http://schemas.openxmlformats.org/drawingml/2006/spreadsheetDrawing}"
R = "{http://schemas.openxmlformats.org/officeDocument/2006/relationships}"


def problems(book: bytes) -> set[str]:
    """What some program stumbles over."""
    collected = set()
    with zipfile.ZipFile(io.BytesIO(book)) as archive:
        for name in archive.namelist():
            if not name.endswith((".xml", ".rels")):
                continue
            root = etree.fromstring(archive.read(name))
            if name.startswith(("xl/charts/", "xl/drawings/drawing")):
                inner = [e for e in root.iter(etree.Element) if e.nsmap != root.nsmap]
                collected |= {"namespaces inside"} if inner else set()
            if name.endswith(".rels"):
                paths = [r.get("Target") for r in root if r.get("TargetMode") != "External"]
                collected |= {"absolute"} if any(p.startswith("/") for p in paths) else set()
            frames = [frame.find(f".//{XDR}cNvPr") for frame in root.iter(f"{XDR}graphicFrame")]
            collected |= {"no text"} if any(not f.get("descr") for f in frames) else set()
            links = list(root.iter(f"{MAIN}hyperlink"))
            collected |= {"foreign link"} if any(k.get(f"{R}id") for k in links) else set()
            sides = [axis.find(f"{C}axPos").get("val") for axis in root.iter(f"{C}valAx")]
            collected |= {"sides"} if sides and sides != ["b", "l"] else set()
    return collected


def test_our_book_has_no_such_problem() -> None:
    assert problems(coarse_book("d-240")) == set()


@pytest.fixture(scope="module")
def plain() -> bytes:
    """A chart and a link as openpyxl writes them."""
    book = Workbook()
    sheet = book.active
    sheet.append([1, 2])
    sheet.append([2, 3])
    sheet["A5"].hyperlink = "#'Sheet'!A1"
    chart = ScatterChart()
    chart.title = "t"
    xs, ys = (Reference(sheet, range_string=f"Sheet!${c}$1:${c}$2") for c in "AB")
    chart.series.append(Series(ys, xs))
    sheet.add_chart(chart, "C1")
    stream = io.BytesIO()
    book.save(stream)
    return stream.getvalue()


def test_the_library_still_needs_each_mending(plain: bytes) -> None:
    """Where this fails, ``reports/workbook/caches.py`` has lost a reason: take it out."""
    wanted = {"namespaces inside", "absolute", "no text", "foreign link", "sides"}
    assert problems(plain) == wanted


@pytest.mark.parametrize("value", [None, math.nan, math.inf])
def test_a_formula_without_a_finite_value_is_refused(value: float | None) -> None:
    book = Workbook()
    book.active.title = "Лист"
    book.active["A1"] = "=1/3"
    values = {} if value is None else {"A1": value}
    with pytest.raises(CacheError, match="Лист!A1"):
        finish(book, CacheValues(values={"Лист": values}))
