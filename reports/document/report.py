"""The report of a course project as PDF and as one HTML page.

The chapters stand in ``sections``, their prose in ``templates/report``.  Two passes: the
draft finds out what stands where, then figures are drawn and the text is written with all
numbers known (see :mod:`reports.document.writer`).
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Literal

from markupsafe import Markup

from reports.document.blocks import DocumentInfo
from reports.document.drawing import Drawing
from reports.document.render import AttachedFile, environment, render_pdf
from reports.document.sections import (
    closing,
    companions,
    crankpin,
    cycle,
    dynamics,
    journals,
    kinematics,
    opening,
)
from reports.document.sections import torque as torques
from reports.document.sections.chapter import Chapter
from reports.document.terms import Terms
from reports.document.writer import Draft, Writer
from reports.errors import SystemPartMissing
from reports.inputs.model import InputFile
from reports.tables.spec import Model
from reports.tables.values import Values

CHAPTERS: tuple[Callable[[Chapter], Markup], ...] = (
    opening.introduction,
    opening.input_data,
    cycle.cycle,
    kinematics.kinematics,
    dynamics.dynamics,
    torques.torque,
    crankpin.crankpin,
    journals.journals,
    torques.running,
    companions.companions,
    closing.checks,
    closing.conclusion,
    closing.sources,
    closing.appendices,
)


def report_pdf(model: Model, values: Values, *, source: Path, workbook: bytes) -> bytes:
    """The report as PDF with the input file and the workbook attached.

    Raises:
        SystemPartMissing: pango is not on this machine.
        RenderError: the page could not be set as the templates say.
    """
    from reports.doctor import PANGO_COMMAND, pango_loads

    if not pango_loads():
        raise SystemPartMissing("pango", PANGO_COMMAND, purpose="нужен для PDF")
    files = [
        AttachedFile(f"исходные-данные{source.suffix}", source.read_bytes(), "Исходные данные"),
        AttachedFile(f"{source.stem}.xlsx", workbook, "Книга Excel с формулами", "Supplement"),
    ]
    return render_pdf(report_page(model, values, media="print"), attachments=files)


def report_html(model: Model, values: Values) -> str:
    """The report as one self-contained page for the screen and for printing."""
    return report_page(model, values, media="screen")


def report_page(model: Model, values: Values, *, media: Literal["print", "screen"]) -> str:
    """The whole page as HTML with style sheet, formulas and figures inside."""
    env = environment(media=media)
    terms = Terms(model, values)
    draft = Draft()
    planned = Writer(env, draft)
    _write(Chapter(terms, planned, env))
    with Drawing({key: plan.draw for key, plan in planned.figures.items()}) as drawing:
        writer = Writer(env, draft.order.numbering(), drawing)
        body = _write(Chapter(terms, writer, env))
    writer.n.check()
    template = env.get_template("report/report.html.j2")
    return template.render(
        doc=_info(model.input),
        cover_page=opening.title_page(model.input),
        toc=writer.contents(),
        content=body,
    )


def _write(chapter: Chapter) -> Markup:
    return Markup("\n").join(write(chapter) for write in CHAPTERS)


def _info(model: InputFile) -> DocumentInfo:
    report = model.report
    return DocumentInfo(
        title=report.title,
        author=report.student,
        subject=model.engine.name,
        created=f"{report.year}-01-01",
    )
