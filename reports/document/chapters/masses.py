"""Section on the masses: how the rod was replaced, measured or estimated (Gots 2.2)."""

from __future__ import annotations

from functools import partial

from markupsafe import Markup

from reports.document.chapters.chapter import Chapter
from reports.document.page.spec_tables import scalar_table
from reports.document.page.writer import TablePlan
from reports.spec.blocks import ScalarTable
from reports.tables.motion.rod_masses import SHEET


def mass_notes(chapter: Chapter) -> Markup:
    """How the masses were found, with their table."""
    given, terms = chapter.input.masses, chapter.terms
    keys = [
        scalar.key
        for block in chapter.model.blocks
        if isinstance(block, ScalarTable) and block.sheet == SHEET
        for scalar in block.scalars
        if scalar.of != "verdict"
    ]
    plan = TablePlan(partial(scalar_table, terms, keys), "Массы и шатун", size="dense")
    outside = [
        scalar.note
        for block in chapter.model.blocks
        if isinstance(block, ScalarTable) and block.id == "specific_masses"
        for scalar in block.scalars
        if scalar.of == "verdict" and terms.values.scalars[scalar.key] == "НЕТ"
    ]
    return chapter.page(
        "masses.html.j2",
        plan=plan,
        estimated=given.estimate_fuel is not None,
        weighed=given.rod_weighed_small_end_kg is not None,
        swung=given.swing_edges_mm is not None,
        outside=outside,
    )
