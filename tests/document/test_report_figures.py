"""The workbook and the report call a diagram by the same number."""

from __future__ import annotations

import re
from pathlib import Path

from reports.document import report
from tests.document.report_samples import html_page, terms


def test_the_workbook_s_charts_have_the_numbers_of_the_report_s_figures():
    made = terms("one")
    charts = report.Report.of(made.model, made.values, Path("t.toml")).numbered.charts
    page = re.sub(r"<[^>]+>|&nbsp;", " ", html_page("one"))
    found = {n: c.strip() for n, c in re.findall(r"Рисунок\s+([\d.]+)\s+—\s+([^\n]{10,80})", page)}
    numbered = [chart for chart in charts if chart.number]
    assert len(numbered) > 10
    alike = [c for c in numbered if found[c.number].startswith(c.words[:12])]
    assert len(alike) > len(numbered) / 2  # the others share a figure, which has words of its own
    assert all(c.heading.startswith(f"Рис.\xa0{c.number}. {c.title}") for c in alike)
