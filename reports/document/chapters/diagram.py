"""Section on the rounded diagram of figure 22: its points and how they are joined."""

from __future__ import annotations

from functools import partial

from markupsafe import Markup

from reports.document.chapters.chapter import Chapter
from reports.document.page.blocks import Column, TableBlock, table_block
from reports.document.page.writer import TablePlan
from reports.document.text.terms import Terms
from reports.inputs.sections.gas import RoundedGasSection
from reports.shared.russian import fixed
from reports.tables.gas.diagram import NODES


def rounded_text(chapter: Chapter) -> Markup:
    """Text and table of the rounded diagram; nothing for another one."""
    if not isinstance(chapter.input.gas, RoundedGasSection):
        return Markup("")
    plan = TablePlan(
        partial(_points, chapter.terms), "Точки скруглённой индикаторной диаграммы", keep=True
    )
    return chapter.page("diagram.html.j2", plan=plan)


def _points(terms: Terms) -> TableBlock:
    names = [name.replace("′", "'").replace("″", "''") for name in NODES]
    rows = [
        [
            names[n - 1],
            fixed(terms.value(f"node_deg{n}"), 1),
            fixed(terms.value(f"node_MPa{n}"), 3),
            fixed(terms.value(f"node_slope{n}"), 4),
        ]
        for n in range(1, len(NODES) + 1)
    ]
    columns = [
        Column("Точка", text=True),
        Column("φ, °"),
        Column("p, МПа"),
        Column("Наклон, МПа/°"),
    ]
    return table_block(columns, rows)
