"""Sheets before the text: title page, assignment, abstract; the title block of the frame.

Each gives its template words by name; what is empty becomes a line to write on or is left out.
"""

from __future__ import annotations

from typing import Any

from reports.document.chapters.chapter import Chapter
from reports.inputs.sections.input_file import InputFile

Words = dict[str, Any]

_KEYWORDS = (
    "кривошипно-шатунный механизм",
    "кинематика",
    "динамика",
    "индикаторная диаграмма",
    "крутящий момент",
    "шатунная шейка",
    "коренная шейка",
    "диаграмма износа",
    "уравновешенность",
)
_REPORT = ("title", "institution", "department", "discipline", "student", "group", "supervisor",
           "variant", "city", "head", "issued", "due")  # fmt: skip
# The data a task is usually given by.
_TASK = ("engine_cylinders", "engine_strokes", "geometry_bore_mm", "geometry_stroke_mm",
         "geometry_crank_radius_mm", "geometry_rod_length_mm", "geometry_lambda",
         "geometry_compression_ratio", "regime_speed_rpm", "regime_indicated_power_kw")  # fmt: skip


def title_page(model: InputFile) -> Words:
    """Words of the title page."""
    words = _words(model)
    department = words["department"]
    return words | {
        "subtitle": model.engine.name,
        "kind": "Расчётно-пояснительная записка к курсовому проекту",
        "ministry": "",
        "department": _department(department),
        "year": str(model.report.year),
    }


def _department(name: str) -> str:
    """«Кафедра …» whether or not the input says the word itself."""
    return name if not name or name.lower().startswith("кафедра") else f"Кафедра: {name}"


def assignment(chapter: Chapter) -> Words:
    """The assignment from the report's data and from what the report holds."""
    n, present = chapter.writer.n, chapter.model.fields
    words = _words(chapter.input)
    return words | {
        "department": _department(words["department"]),
        "engine": chapter.input.engine.name,
        "data": [(present[k].title, chapter.terms.val(k)) for k in _TASK if k in present],
        "chapters": [item.title for item in n.contents if item.level == 1 and item.number],
        "figures": n.count("figure"),
    }


def abstract(chapter: Chapter) -> Words:
    """Counts of what the report holds, and key words."""
    n = chapter.writer.n
    cycle = ("рабочий цикл",) if chapter.terms.has("cyc_N_e") else ()
    words = (_KEYWORDS[0], *cycle, *_KEYWORDS[1:])
    return {
        "figures": n.count("figure"),
        "tables": n.count("table"),
        "sources": n.count("source"),
        "appendices": sum(item.title.startswith("Приложение") for item in n.contents),
        "keywords": [word.upper() for word in words],
    }


def title_block(model: InputFile) -> Words | None:
    """Cells of the title block by ГОСТ 2.104; ``None`` where the input asks for no frame."""
    report = model.report
    if report.frame == "none":
        return None
    places = (report.institution, report.department, report.group)
    return {
        "designation": report.designation,
        "title": report.title,
        "engine": model.engine.name,
        "developed": report.student,
        "checked": report.supervisor,
        "controlled": report.controller,
        "approved": report.approver or report.head,
        "organisation": [place for place in places if place],
    }


def _words(model: InputFile) -> Words:
    return {name: getattr(model.report, name) for name in _REPORT}
