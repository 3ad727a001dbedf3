"""Pages of the report without figures and formulas: sentences, tables, what is to be drawn."""

from __future__ import annotations

import html
import re
from unittest import mock

import numpy as np

from reports.document.chapters import chapter as chapters
from reports.document.report import Report
from reports.document.text.terms import Terms
from reports.inputs.sections.input_file import InputFile
from reports.model.charts import ChartSpec
from reports.model.evaluation import evaluate_model
from reports.tables.registry import build_model

Drawn = list[tuple[str, float]]


def plain(page: str) -> str:
    """Text of a page, spaces of every kind as one."""
    return re.sub(r"[ \xa0\n]+", " ", html.unescape(re.sub("<[^>]+>", "", page)))


def formulas_of(page: str) -> list[str]:
    """TeX of the formulas of a page, in their order."""
    return [html.unescape(tex) for tex in re.findall(r'data-tex="([^"]*)"', page)]


def bare_page(model: InputFile, drawn: Drawn | None = None) -> str:
    """HTML of the report; ``drawn`` gets each chart with its greatest ordinate.

    Needs the fixture ``nothing_is_drawn``.
    """
    one, several = chapters.chart_figure, chapters.panels_figure
    built = build_model(model)

    def note(terms: Terms, specs: list[ChartSpec]) -> None:
        for spec in specs if drawn is not None else ():
            series = [s for s in spec.drawn_by("report") if s.y in _columns(terms)]
            most = [float(np.abs(terms.column(s.y)).max()) for s in series]
            if most:
                drawn.append((spec.id, max(most)))

    def chart(terms, spec, *args, **more):
        note(terms, [spec])
        return one(terms, spec, *args, **more)

    def panels(terms, specs, *args, **more):
        specs = list(specs)
        note(terms, specs)
        return several(terms, specs, *args, **more)

    with (
        mock.patch.object(chapters, "chart_figure", chart),
        mock.patch.object(chapters, "panels_figure", panels),
    ):
        page = Report(built, evaluate_model(built)).page("screen")
    return page[page.index("<body") :]


def _columns(terms: Terms) -> set[str]:
    return {f"{table}.{key}" for table, keys in terms.values.columns.items() for key in keys}
