"""Lint of the chart parts: what a picture made by LibreOffice cannot show of Excel.

Every sample's charts are held in ``test_every_sample``; here the lint itself must see each
defect, and the charts of the textbook's diesel on its own grid are clean.
"""

from __future__ import annotations

import re
from functools import lru_cache

import pytest
from lxml import etree

from tests.workbook.lint import A, C, chart_problems
from tests.workbook.made import MOVING, coarse_opened, drawn, model, parts


@lru_cache(maxsize=1)
def charts() -> list[str]:
    return sorted(parts("xl/charts/chart"))


def chart(name: str) -> etree._Element:
    return etree.fromstring(parts("xl/charts/chart")[name])


def test_every_chart_of_the_model_is_there() -> None:
    assert len(charts()) == len(drawn(model())) + MOVING >= 25


def test_every_chart_keeps_the_rules() -> None:
    collected = {name: chart_problems(chart(name)) for name in charts()}
    assert {name: problems for name, problems in collected.items() if problems} == {}


def test_polar_diagrams_are_square() -> None:
    squares = [name for name in charts() if chart(name).find(f".//{C}manualLayout") is not None]
    assert len(squares) == MOVING // 2 + sum(s.kind != "line" for s in drawn(model()))


CURVES = "'Кривые'!"
AREA = re.compile(r"('(?:[^']|'')+'|[^',!(]+)!([$A-Z\d:]+)")


def test_points_of_charts_are_those_of_the_cells() -> None:
    """Caches of curves, marks and rays, of six digits, against the values of their cells."""
    opened, compared, saved = coarse_opened("gots-diesel"), 0, dict[str, int]()
    for name, text in parts("xl/charts/chart", coarse=True).items():
        for reference in etree.fromstring(text).iterfind(f".//{C}numRef"):
            where = reference.findtext(f"{C}f") or ""
            cells: list[object] = []
            for sheet, position in AREA.findall(where):
                actual = opened[sheet.strip("'").replace("''", "'")][position.replace("$", "")]
                rows = actual if isinstance(actual, tuple) else ((actual,),)
                cells += [cell.value for row in rows for cell in row]
            points = [float(p.text) for p in reference.iterfind(f"{C}numCache/{C}pt/{C}v")]
            rows = [int(p.get("idx")) for p in reference.iterfind(f"{C}numCache/{C}pt")]
            noise = 1e-12
            if CURVES in where:  # as many digits as a picture needs
                noise = max(map(abs, points)) / 700 if len(cells) > 1 else 0.006
                saved |= {where: len(rows)} if len(cells) > 1 else {}
            else:
                assert len(rows) == len(cells), where
            cells = [cells[row] for row in rows]
            assert points == pytest.approx(cells, rel=5.1e-6, abs=noise), (name, where)
            compared += len(points)
    assert compared > 2000
    assert len(saved) > 20 and 73 <= max(saved.values()) < 500


def _set(path: str, **attributes: str):
    def change(root: etree._Element) -> None:
        root.find(f".//{path}").attrib.update(attributes)

    return change


def _drop(path: str):
    def change(root: etree._Element) -> None:
        element = root.find(f".//{path}")
        element.getparent().remove(element)

    return change


def _text(path: str, text: str):
    def change(root: etree._Element) -> None:
        root.find(f".//{path}").text = text

    return change


CACHE = f"{C}numRef/{C}numCache"


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (_set(f"{C}valAx/{C}delete", val="1"), "hidden"),
        (_drop(f"{C}valAx/{C}delete"), "hidden"),
        (_set(f"{C}valAx/{C}tickLblPos", val="nextTo"), "not low"),
        (_set(f"{C}valAx/{C}numFmt", sourceLinked="1"), "linked"),
        (_drop(f"{C}valAx/{C}majorGridlines"), "gridlines"),
        (_drop(f"{C}valAx"), "1 axes"),
        (_set(f"{C}title/{C}overlay", val="1"), "over the plot"),
        (_drop(f"{C}chart/{C}title"), "no title"),
        (_text(f"{C}title//{A}t", " "), "empty title"),
        (_set(f"{C}roundedCorners", val="1"), "rounded"),
        (_drop(f"{C}scatterStyle"), "scatterStyle"),
        (_set(f"{C}ser/{C}smooth", val="1"), "smoothed"),
        (_drop(f"{C}ser/{C}smooth"), "smoothed"),
        (_set(f"{C}ser/{C}marker/{C}symbol", val="circle"), "markers"),
        (_set(f"{C}ser/{C}spPr/{A}ln", w="28575"), "1.5 pt"),
        (_drop(f"{CACHE}/{C}pt"), "not filled"),
        (_drop(CACHE), "not filled"),
        (_text(f"{CACHE}/{C}pt/{C}v", "#DIV/0!"), "no number"),
    ],
)
def test_the_lint_sees_each_defect(change, said: str) -> None:
    root = chart(charts()[1])
    assert chart_problems(root) == []
    change(root)
    assert any(said in problem for problem in chart_problems(root)), chart_problems(root)


def test_the_lint_sees_an_oblong_polar_diagram() -> None:
    name = next(name for name in charts() if chart(name).find(f".//{C}manualLayout") is not None)
    root = chart(name)
    root.find(f".//{C}manualLayout/{C}w").set("val", "0.9")
    assert chart_problems(root) == ["the plot area is not square"]
