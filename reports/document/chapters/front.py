"""Sheets before the text: title page, assignment, abstract; the title block of the frame.

Each gives its template words by name; what is empty becomes a line to write on or is left out.
"""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

from reports.document.chapters.chapter import Chapter, named_engine
from reports.document.page.fitting import type_pt
from reports.document.page.style import TitlePage
from reports.inputs.sections.input_file import InputFile
from reports.inputs.sections.report import SheetSection
from reports.shared.russian import joined_phrases, last_bound, surname

Words = dict[str, Any]

_OBJECT = "кривошипно-шатунный механизм"  # the first key word
# Chapters whose aims stand for the whole mechanism where the report has none.
_MECHANISM = ("kinematics", "dynamics", "crankpin")
_REPORT = ("title", "institution", "department", "discipline", "student", "group", "supervisor",
           "variant", "city", "head", "issued", "due")  # fmt: skip
# The data a task is usually given by.
_TASK = ("engine_cylinders", "engine_strokes", "geometry_bore_mm", "geometry_stroke_mm",
         "geometry_crank_radius_mm", "geometry_rod_length_mm", "geometry_lambda",
         "geometry_compression_ratio", "regime_speed_rpm", "regime_indicated_power_kw",
         "cycle_power_kw", "cycle_excess_air", "cycle_boost_ratio")  # fmt: skip
_READABLE = 7.0  # pt; a name that would be smaller leaves the surname alone, as ГОСТ 2.104 asks
_PERSONS = ("developed", "checked", "controlled", "approved")
# Words of the title block with width and height of their cells [mm] and their usual type [pt].
_CELLS = {
    "designation": (("Обозначение документа",), 108.0, 14.0, 14.0),
    "name": (("Тема работы", "название двигателя"), 68.0, 24.0, 10.0),
    "organisation": (("Учебное заведение", "кафедра", "группа"), 46.0, 14.0, 8.5),
    "developed": (("Студент",), 20.0, 4.6, 8.5),
    "checked": (("Руководитель",), 20.0, 4.6, 8.5),
    "controlled": (("Нормоконтроль",), 20.0, 4.6, 8.5),
    "approved": (("Утвердил",), 20.0, 4.6, 8.5),
}


def title_page(model: InputFile, style: TitlePage, frame: str | None = None) -> Words:
    """Words of the title page, some of them from the department's style file."""
    words = _words(model)
    department = words["department"]
    return words | {
        "title": last_bound(model.report.title),
        "subtitle": last_bound(model.engine.name),
        "kind": style.kind,
        "ministry": style.ministry,
        "department": _department(department),
        "year": str(model.report.year),
        # Without a frame the title page alone has room for them.
        "designation": "" if has_frame(model, frame) else model.report.designation,
        "controller": "" if has_frame(model, frame) else model.report.controller,
    }


def _department(name: str) -> str:
    """«Кафедра …» whether or not the input says the word itself."""
    return name if not name or name.lower().startswith("кафедра") else f"Кафедра «{name}»"


def assignment(chapter: Chapter, *, with_sheet: bool = False) -> Words:
    """Return the assignment from the report's data and from what the report and the sheet hold."""
    sheet = chapter.input.sheet or SheetSection()
    n, present = chapter.writer.n, chapter.model.fields
    words = _words(chapter.input)
    return words | {
        "department": _department(words["department"]),
        "named": named_engine(chapter.input, genitive=False),
        "data": [(chapter.terms.title(k), chapter.terms.val(k)) for k in _TASK if k in present],
        "chapters": [item.title for item in n.contents if item.level == 1 and item.number],
        "figures": n.count("figure"),
        "sheet": sheet.size if with_sheet else "",
    }


def abstract(chapter: Chapter) -> Words:
    """Return counts of what the report holds, and key words."""
    n = chapter.writer.n
    records = [record for record in chapter.records if record.name in chapter.relevant]
    words = [_OBJECT, *(word for record in records for word in record.keywords)]
    return {
        "figures": n.count("figure"),
        "tables": n.count("table"),
        "sources": n.count("source"),
        "appendices": sum(item.title.startswith("Приложение") for item in n.contents),
        "names": chapter.relevant,
        "keywords": [word.upper() for word in words],
        "aim": _aim(chapter),
    }


def _aim(chapter: Chapter) -> str:
    """Aim of the work from its chapters; by default the whole mechanism."""

    def of(names: Collection[str]) -> list[str]:
        return list(dict.fromkeys(r.aim for r in chapter.records if r.aim and r.name in names))

    return joined_phrases(of(chapter.relevant) or of(_MECHANISM))


def crowded(model: InputFile, frame: str | None = None) -> list[str]:
    """Remarks on texts too long for the title block."""
    block = title_block(model, frame)
    return [
        f"рамка листа: «{', '.join(_CELLS[cell][0])}» не помещается в графу; сократите"
        for cell, size in (block["type"].items() if block else ())
        if not size
    ]


def has_frame(model: InputFile, frame: str | None = None) -> bool:
    """Whether the style file or, where it says nothing, the input asks for a frame."""
    return (frame or model.report.frame) != "none"


def title_block(model: InputFile, frame: str | None = None) -> Words | None:
    """Cells of the title block by ГОСТ 2.104; ``None`` where no frame is asked for.

    Args:
        model: the input.
        frame: what the style file says about the frame, ``None`` for nothing.
    """
    report = model.report
    if not has_frame(model, frame):
        return None
    lines = (report.institution, report.department, report.group)
    words = {
        "designation": report.designation,
        "title": report.title,
        "engine": model.engine.name,
        "developed": report.student,
        "checked": report.supervisor,
        "controlled": report.controller,
        "approved": report.approver or report.head,
        "organisation": [unit for unit in lines if unit],
    }
    for cell in _PERSONS:
        name = str(words[cell])
        small = type_pt(name, *_CELLS[cell][1:]) < _READABLE
        words[cell] = surname(name) if small else name
    fields = words | {
        "name": f"{report.title} {model.engine.name}",
        "organisation": ", ".join(unit for unit in lines if unit),
    }
    types = {cell: type_pt(str(fields[cell]), *sizes) for cell, (_, *sizes) in _CELLS.items()}
    return words | {"type": types}


def _words(model: InputFile) -> Words:
    return {name: getattr(model.report, name) for name in _REPORT}
