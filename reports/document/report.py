"""The report of a course project as PDF and as one HTML page.

The chapters stand in ``sections``, their prose in ``templates/report``.  Two passes: the
draft finds out what stands where, then figures are drawn and the text is written with all
numbers known (see :mod:`reports.document.page.writer`).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from markupsafe import Markup

from reports.document import store
from reports.document.chapters import (
    bearings,
    closing,
    companions,
    cycle,
    dynamics,
    front,
    journals,
    kinematics,
    opening,
    reference,
    regimes,
)
from reports.document.chapters import torque as torques
from reports.document.chapters.chapter import Chapter
from reports.document.page import overrides
from reports.document.page.blocks import DocumentInfo
from reports.document.page.numbering import Draft
from reports.document.page.render import AttachedFile, RenderError, environment, render_pdf
from reports.document.page.writer import Writer
from reports.document.text import texts
from reports.document.text.terms import Terms
from reports.inputs.sections.input_file import InputFile
from reports.spec.blocks import Model
from reports.spec.evaluation import Values

if TYPE_CHECKING:
    from jinja2 import Environment

Further = Sequence[Callable[[Chapter], Markup]]
CHAPTERS: tuple[Callable[[Chapter], Markup], ...] = (
    opening.introduction,
    opening.input_data,
    cycle.cycle,
    kinematics.kinematics,
    dynamics.dynamics,
    torques.torque,
    journals.crankpin,
    journals.journals,
    bearings.bearings,
    torques.running,
    regimes.regimes,
    reference.reference,
    companions.companions,
    closing.checks,
    closing.conclusion,
    closing.sources,
    closing.appendices,
)


def report_pdf(
    model: Model, values: Values, *, source: Path, workbook: bytes, further: Further = ()
) -> bytes:
    """The report as PDF with the input file and the workbook attached.

    ``further`` are chapters from rooms above this one, before the checks.

    Raises:
        SystemPartMissing: pango is not on this machine.
        RenderError: the page could not be set as the templates say.
        InputError: the folder of own templates is missing or one of them is wrong.
    """
    from reports.shared.doctor import need_pango

    need_pango()
    files = [
        AttachedFile(f"исходные-данные{source.suffix}", source.read_bytes(), "Исходные данные"),
        AttachedFile(f"{source.stem}.xlsx", workbook, "Книга Excel с формулами", "Supplement"),
    ]
    folder = overrides.find(model.input.report.templates, source.parent)
    page = report_page(model, values, media="print", templates=folder, further=further)
    try:
        return render_pdf(page, attachments=files)
    except RenderError as error:
        if folder is None:
            raise
        raise overrides.style_error(folder, str(error)) from error


def report_html(model: Model, values: Values, *, source: Path, further: Further = ()) -> str:
    """The report as one self-contained page for the screen and for printing.

    Raises:
        InputError: the folder of own templates is missing or one of them is wrong.
    """
    folder = overrides.find(model.input.report.templates, source.parent)
    return report_page(model, values, media="screen", templates=folder, further=further)


def report_page(
    model: Model,
    values: Values,
    *,
    media: Literal["print", "screen"],
    templates: Path | None = None,
    further: Further = (),
) -> str:
    """The whole page as HTML with style sheet, formulas and figures inside.

    Args:
        model: specifications of the engine.
        values: their values.
        media: "print" for WeasyPrint, "screen" for a browser.
        templates: a folder of own templates, see :mod:`reports.document.page.overrides`.
        further: chapters from rooms above this one.
    """
    with overrides.told(templates):
        return _page(model, values, environment(templates, media=media), further)


def _page(model: Model, values: Values, env: Environment, further: Further) -> str:
    terms = Terms(model, values)
    draft = Draft()
    _write(Chapter(terms, Writer(env, draft), env), further)
    chapter = Chapter(terms, Writer(env, draft.numbering()), env)
    body = _write(chapter, further)
    chapter.writer.n.check()
    store.store().save()
    return texts.unbroken_initials(texts.spaces_inside(_whole(env, chapter, body)))


def _whole(env: Environment, chapter: Chapter, body: Markup) -> str:
    """The page around the written chapters; what it counts is known by now."""
    terms = chapter.terms
    return env.get_template("report/report.html.j2").render(
        doc=_info(chapter.input),
        input=chapter.input,
        t=terms,
        cover_page=front.title_page(chapter.input),
        task=front.assignment(chapter),
        brief=front.abstract(chapter),
        block=front.title_block(chapter.input),
        exact=chapter.exact,
        load=chapter.worst("worst_main_load"),
        verdict=closing.verdict(terms),
        toc=chapter.writer.contents(),
        content=body,
    )


def _write(chapter: Chapter, further: Further) -> Markup:
    before = CHAPTERS.index(closing.checks)
    chapters = (*CHAPTERS[:before], *further, *CHAPTERS[before:])
    return Markup("\n").join(write(chapter) for write in chapters)


def _info(model: InputFile) -> DocumentInfo:
    report = model.report
    return DocumentInfo(
        title=report.title,
        author=report.student,
        subject=model.engine.name,
        created=f"{report.year}-01-01",
    )
