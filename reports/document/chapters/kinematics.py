"""Chapters on kinematics, of the central, offset and articulated mechanism (figures 41-45)."""

from __future__ import annotations

from functools import partial

from markupsafe import Markup

from reports.document.chapters.chapter import Chapter
from reports.document.figures.mechanism import mechanism_sketch
from reports.document.page.writer import Figure
from reports.shared.russian import NBSP, fixed

EXAMPLE = 30.0  # crank angle of the worked lines [deg]; every grid has it


def kinematics(chapter: Chapter) -> Markup:
    """Kinematics of piston and rod, and of articulated rods where there are some."""
    terms, offset = chapter.terms, chapter.shape.offset
    lam = min(max(terms.value("lam"), 0.1), 0.6)
    k = min(max(terms.value("k_offset"), -0.6), 0.6) if offset else 0.0
    word = "дезаксиального" if offset else "центрального"
    sketch = Figure(
        partial(mechanism_sketch, lam, k=k),
        f"Схема {word} кривошипно-шатунного механизма: а{NBSP}— размеры и углы; б{NBSP}— силы",
    )
    half = terms.value("P3_1.s_mm", 90.0) / (1000 * terms.value("S_stroke"))
    template = "offset" if offset else "kinematics"
    page = chapter.page(template, sketch=sketch, at=EXAMPLE, half=fixed(half, 3))
    return page + (chapter.page("articulated") if chapter.shape.articulated else "")
