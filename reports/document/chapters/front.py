"""Sheets before the text: title page, assignment, abstract; the title block of the frame."""

from __future__ import annotations

from dataclasses import dataclass, fields

from markupsafe import Markup

from reports.document.chapters.chapter import Chapter
from reports.inputs.sections.input_file import InputFile

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


@dataclass(frozen=True, slots=True)
class TitlePage:
    """Words of the title page; what is empty is left out or becomes a line to write on."""

    title: str
    subtitle: str = ""
    kind: str = "Расчётно-пояснительная записка к курсовому проекту"
    ministry: str = ""
    institution: str = ""
    department: str = ""
    discipline: str = ""
    student: str = ""
    group: str = ""
    supervisor: str = ""
    variant: str = ""
    city: str = ""
    year: str = ""


@dataclass(frozen=True, slots=True)
class Assignment:
    """Words of the assignment sheet; what is empty becomes a line to write on."""

    title: str
    engine: str
    institution: str
    department: str
    discipline: str
    head: str
    student: str
    group: str
    supervisor: str
    variant: str
    issued: str
    due: str
    data: tuple[tuple[str, Markup], ...]
    chapters: tuple[str, ...]
    figures: int


@dataclass(frozen=True, slots=True)
class Abstract:
    """Counts and key words of the abstract; its text is the template's."""

    figures: int
    tables: int
    sources: int
    appendices: int
    keywords: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class TitleBlock:
    """Cells of the title block by ГОСТ 2.104, forms 2 and 2а."""

    designation: str
    title: str
    engine: str
    developed: str
    checked: str
    controlled: str
    approved: str
    organisation: tuple[str, ...]


def title_page(model: InputFile) -> TitlePage:
    """Words of the title page; what is missing is left to be written by hand."""
    report = model.report
    return TitlePage(
        title=report.title,
        subtitle=model.engine.name,
        institution=report.institution,
        department=f"Кафедра: {report.department}" if report.department else "",
        discipline=report.discipline,
        student=report.student,
        group=report.group,
        supervisor=report.supervisor,
        variant=report.variant,
        city=report.city,
        year=str(report.year),
    )


def assignment(chapter: Chapter) -> Assignment:
    """The assignment from the report's data and from what the report holds."""
    report, n = chapter.input.report, chapter.writer.n
    names = {field.name for field in fields(Assignment)}
    words = {name: getattr(report, name) for name in names if hasattr(report, name)}
    chapters = tuple(item.title for item in n.contents if item.level == 1 and item.number)
    return Assignment(
        **words,
        engine=chapter.input.engine.name,
        data=_main_data(chapter),
        chapters=chapters,
        figures=n.count("figure"),
    )


def _main_data(chapter: Chapter) -> tuple[tuple[str, Markup], ...]:
    """The data a task is usually given by, as far as the input has them."""
    t = chapter.terms
    wanted = (
        "engine_cylinders",
        "engine_strokes",
        "geometry_bore_mm",
        "geometry_stroke_mm",
        "geometry_crank_radius_mm",
        "geometry_rod_length_mm",
        "geometry_lambda",
        "geometry_compression_ratio",
        "regime_speed_rpm",
        "regime_indicated_power_kw",
    )
    present = chapter.model.fields
    return tuple((present[n].title, t.val(n)) for n in wanted if n in present)


def abstract(chapter: Chapter) -> Abstract:
    """Counts of what the report holds, and key words."""
    n = chapter.writer.n
    appendices = sum(item.title.startswith("Приложение") for item in n.contents)
    words = list(_KEYWORDS)
    if chapter.terms.has("cyc_N_e"):
        words.insert(1, "рабочий цикл")
    return Abstract(
        n.count("figure"),
        n.count("table"),
        n.count("source"),
        appendices,
        tuple(word.upper() for word in words),
    )


def title_block(model: InputFile) -> TitleBlock | None:
    """Cells of the frame's title block; ``None`` where the input asks for no frame."""
    report = model.report
    if report.frame == "none":
        return None
    places = (report.institution, report.department, report.group)
    return TitleBlock(
        designation=report.designation,
        title=report.title,
        engine=model.engine.name,
        developed=report.student,
        checked=report.supervisor,
        controlled=report.controller,
        approved=report.approver or report.head,
        organisation=tuple(place for place in places if place),
    )
