"""The report of a course project as PDF and as one HTML page.

The chapters stand in ``chapters``, their prose in ``templates/report``.  Two passes: the
draft finds out what stands where, then figures are drawn and the text is written with all
numbers known (see :mod:`reports.document.page.numbering`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Literal, cast

from markupsafe import Markup

from reports.document.chapters import closing, front, opening, rationale
from reports.document.chapters.chapter import (
    ELSEWHERE,
    Chapter,
    Prototype,
    pin_stems,
    worst_pin,
)
from reports.document.chapters.contents import CHAPTERS
from reports.document.chapters.record import Write, chosen
from reports.document.page import overrides
from reports.document.page.blocks import DocumentInfo
from reports.document.page.floating import arranged, redrawn
from reports.document.page.numbering import Draft, Name, Writer
from reports.document.page.render import AttachedFile, environment, render_pdf
from reports.document.page.style import USUAL, Style
from reports.document.page.style import read as read_style
from reports.document.text import texts
from reports.document.text.terms import Terms
from reports.inputs.load import load_toml
from reports.inputs.reasons import prototype_file
from reports.inputs.sections.gas import TableGasSection
from reports.inputs.sections.input_file import InputFile
from reports.inputs.sections.report import ReportSection
from reports.inputs.solve_input import fine_columns
from reports.model.blocks import Model
from reports.model.evaluation import Values, evaluate_model
from reports.shared.errors import RenderError
from reports.tables.registry import build_model

if TYPE_CHECKING:
    from jinja2 import Environment

Further = Sequence[Write]

_RUN_ON = 0.25  # of a page that is left for the next chapter outside of the full report


@dataclass(frozen=True)
class Report:
    """The report of one engine: drafted once, and each page of it is written once.

    Attributes:
        model: specifications of the engine.
        values: their values.
        templates: a folder of own templates, see :mod:`reports.document.page.overrides`.
        style: margins, type and what else a department asks for.
        further: chapters from rooms above this one, before the checks.
        with_sheet: whether the sheet of dynamics is made beside it.
        prototype: the engine that the report's one is held against.
    """

    model: Model
    values: Values
    templates: Path | None = None
    style: Style = USUAL
    further: Further = ()
    with_sheet: bool = False
    prototype: Prototype | None = None

    @classmethod
    def of(
        cls,
        model: Model,
        values: Values,
        source: Path,
        style: Path | None = None,
        further: Further = (),
        *,
        with_sheet: bool = False,
    ) -> Report:
        """Return report of an input file: own templates and a style file are looked for beside it.

        Args:
            model: specifications of the engine.
            values: their values.
            source: the input file.
            style: a style file instead of the one that the input names.
            further: chapters from rooms above.
            with_sheet: whether the sheet of dynamics is made beside it.

        Raises:
            InputError: the folder of own templates or the style file is missing or wrong.
        """
        report = model.input.report
        folder = overrides.find(report.templates, source.parent)
        with_sheet = with_sheet or "sheet" in (report.formats or ())
        style_of = find_style(report, source.parent, style)
        other = prototype_of(model.input, source.parent)
        return cls(model, values, folder, style_of, further, with_sheet, other)

    def pdf(self, source: Path, workbook: bytes | Callable[[], bytes]) -> bytes:
        """Return report as PDF with the input file, the workbook and the diagram's points attached.

        Args:
            source: the input file.
            workbook: the workbook to attach, or what gives it when it is needed.

        Raises:
            SystemPartMissing: pango is not on this machine.
            RenderError: the page could not be set as the templates say.
            InputError: one of the own templates is wrong.
        """
        from reports.shared.doctor import need_pango

        need_pango()
        try:
            return render_pdf(
                self.page("print"), attachments=_files(self.model, source, workbook, self.style)
            )
        except (RenderError, RecursionError) as error:
            if self.templates is None:
                raise
            is_deep = isinstance(error, RecursionError)
            words = "элементы вложены слишком глубоко" if is_deep else str(error)
            raise overrides.style_error(self.templates, words) from error

    def page(self, media: Literal["print", "screen"], *, tagged: bool | None = None) -> str:
        """Return the whole page as HTML with style sheet, formulas and figures inside.

        Args:
            media: "print" for WeasyPrint, "screen" for a browser.
            tagged: whether each cell of a table is one; usually where cells are few.
        """
        if tagged is None:
            tagged = self.style.tagged_tables
        if tagged is None:  # cells for everyone's reader where they are few; lines are fast
            tagged = self.model.input.report.detail != "full"
        pages = self._pages
        if (media, tagged) not in pages:
            with overrides.template_errors(self.templates):
                pages[media, tagged] = self._written(media, tagged)
        return pages[media, tagged]

    @cached_property
    def numbered(self) -> Model:
        """The model with the number of each chart in the report, for other documents."""
        draft, chapter = self._draft
        numbers = {name: draft.label("figure", key).number for name, key in chapter.figures.items()}
        charts = (replace(chart, number=numbers.get(chart.id, "")) for chart in self.model.charts)
        return replace(self.model, charts=tuple(charts))

    @property
    def names(self) -> tuple[frozenset[Name], frozenset[Name]]:
        """Kinds and keys of all that the report numbers, and of what is left to other documents."""
        return frozenset(self._draft[0].declared), frozenset(self._absent)

    @cached_property
    def _pages(self) -> dict[tuple[str, bool], str]:
        return {}

    @cached_property
    def _terms(self) -> Terms:
        return Terms(self.model, self.values, fine_columns(self.model.input))

    @cached_property
    def _draft(self) -> tuple[Draft, Chapter]:
        """Draft of the chosen chapters: places and numbers."""
        env, draft = self._environment("print", tagged=True), Draft(by_chapter=self._by_chapter)
        chapter = Chapter(self._terms, Writer(env, draft), env, self.prototype, CHAPTERS)
        with overrides.template_errors(self.templates):
            _write(chapter, chosen(CHAPTERS, self.model.input), self.further)
        return draft, chapter

    @cached_property
    def _absent(self) -> dict[Name, str]:
        """Words for what stands in the chapters that are left out."""
        env, absent = self._environment("print", tagged=True), Draft()
        names = {record.name for record in CHAPTERS} - chosen(CHAPTERS, self.model.input)
        _write(Chapter(self._terms, Writer(env, absent), env, self.prototype, CHAPTERS), names)
        return _elsewhere(self._terms, absent)

    @property
    def _by_chapter(self) -> bool:
        return self.style.numbering == "chapter"

    def _environment(self, media: Literal["print", "screen"], *, tagged: bool) -> Environment:
        style = self.style.model_copy(update={"tagged_tables": tagged})
        return environment(self.templates, media=media, style=style)

    def _written(self, media: Literal["print", "screen"], tagged: bool) -> str:
        env, style = self._environment(media, tagged=tagged), self.style
        numbering = self._draft[0].numbering(elsewhere=self._absent)
        chapter = Chapter(self._terms, Writer(env, numbering), env, self.prototype, CHAPTERS)
        body = Markup(
            texts.unbroken(_write(chapter, chosen(CHAPTERS, self.model.input), self.further))
        )
        if media == "print":
            sheets = style.framed if front.has_frame(chapter.input, style.frame) else style
            placed = arranged(body, sheets, chapter.writer.figures, run_on=_run_on(style))
            body = Markup(redrawn(placed, chapter.writer.figures, env.filters["pictured"]))
        numbering.check()
        head, start, page = _whole(env, chapter, body, with_sheet=self.with_sheet).partition(
            "<body>"
        )
        return texts.spaces_inside(head + start + texts.unbroken(page))


def _files(
    model: Model, source: Path, workbook: bytes | Callable[[], bytes], style: Style
) -> Iterator[AttachedFile]:
    """Yield the files to attach; a workbook in the making is waited for here."""
    name = f"исходные-данные{source.suffix}"
    yield AttachedFile(name, source.read_bytes(), "Исходные данные")
    book = workbook if isinstance(workbook, bytes) else workbook()
    yield AttachedFile(f"{source.stem}.xlsx", book, "Книга Excel с формулами", "Supplement")
    step: int = model.input.calculation.step_deg
    if model.input.report.detail != "full":
        step = max(step, style.table_step_deg)
    if isinstance(model.input.gas, TableGasSection) and opening.printed(model.input, step)[1]:
        rows = "".join(f"{angle},{pressure}\n" for angle, pressure in model.input.gas.points)
        points = f"phi_deg,p_MPa\n{rows}".encode()
        yield AttachedFile(opening.POINTS_FILE, points, "Точки индикаторной диаграммы", "Data")


def remarks_on(model: InputFile, beside: Path, style: Path | None = None) -> tuple[str, ...]:
    """Remarks on the finished report."""
    return tuple(front.crowded(model, find_style(model.report, beside, style).frame))


def find_style(report: ReportSection, beside: Path, path: Path | None = None) -> Style:
    """Return the style file given, or the one named in the input, or the usual look.

    Raises:
        InputError: it cannot be read or something in it is wrong.
    """
    if path is None and report.style.strip():
        path = beside / report.style
    return USUAL if path is None else read_style(path)


def prototype_of(model: InputFile, beside: Path) -> Prototype | None:
    """Return the prototype of an input: its section, or the first file that it is compared with.

    Raises:
        InputError: the prototype's file is missing or wrong.
    """
    section, file = model.prototype, prototype_file(model, beside)
    if section is None:
        name = model.report.compare.split(";")[0].strip()
        file = beside / name if name.endswith(".toml") else None
    if file is not None:
        other = build_model(load_toml(file).model)
        name = section.name if section is not None else ""
        value = rationale.numbers(Terms(other, evaluate_model(other)))
        return Prototype(name or other.input.engine.name, value)
    return None if section is None else rationale.stated(section)


def _run_on(style: Style) -> float:
    """Share of a page from which a chapter follows on it; 1 for one that never does."""
    return 1.0 if style.chapters_on_new_page else _RUN_ON


def _elsewhere(terms: Terms, absent: Draft) -> dict[Name, str]:
    """Words for what stands in a chapter that is left out: the workbook has it."""
    words = {}
    for kind, key in absent.declared:
        table = terms.model.tables.get(key) if kind == "table" else None
        number = f"{table.number} " if table is not None and table.number else ""
        words[kind, key] = "" if kind == "formula" else f"{number}{ELSEWHERE}"
    return words


def _whole(env: Environment, chapter: Chapter, body: Markup, *, with_sheet: bool) -> str:
    """Return the whole page around the chapters."""
    terms, style = chapter.terms, cast(Style, env.globals["style"])
    return env.get_template("report/report.html.j2").render(
        doc=_info(chapter.input),
        input=chapter.input,
        t=terms,
        cover_page=front.title_page(chapter.input, style.title, style.frame),
        task=front.assignment(chapter, with_sheet=with_sheet),
        brief=front.abstract(chapter),
        block=front.title_block(chapter.input, style.frame),
        exact=chapter.exact,
        chapter=chapter,
        load=chapter.worst("worst_main_load"),
        pin=worst_pin(terms),
        pins=pin_stems(chapter.shape),
        verdict=closing.verdict(chapter, briefly=True),
        toc=chapter.writer.contents(),
        content=body,
    )


def _write(chapter: Chapter, names: set[str], further: Further = ()) -> Markup:
    """Return the chapters of those names; further ones stand before the checks and conclusions."""
    parts: dict[str, Markup] = {}
    for record in CHAPTERS:
        if record.name == "checks":
            parts |= {f"further {n}": added(chapter) for n, added in enumerate(further)}
        if record.name in names:
            parts[record.name] = record.write(chapter)
    if "notation" in parts and not chapter.writer.draft:
        others = Markup("\n").join(part for name, part in parts.items() if name != "notation")
        parts["notation"] = opening.notation(chapter, others)
    return Markup("\n").join(parts.values())


def _info(model: InputFile) -> DocumentInfo:
    report = model.report
    return DocumentInfo(
        title=report.title,
        author=report.student,
        subject=model.engine.name,
        created=f"{report.year}-01-01",
    )
