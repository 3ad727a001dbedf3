"""From an input to files: what ``kshm build`` and ``kshm solve`` do."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cache, cached_property, partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from reports.inputs.load import Loaded, load_toml
from reports.inputs.sections.report import USUAL_FORMATS, Format
from reports.shared.aside import aside
from reports.shared.doctor import need_packages
from reports.shared.errors import SystemPartMissing
from reports.shared.files import make_dir, write_bytes
from reports.shared.progress import Progress

if TYPE_CHECKING:
    from reports.document.report import Report
    from reports.model.blocks import Model
    from reports.model.evaluation import Values

Kind = Format
Further = Sequence[Callable[[Any], Any]]  # chapters, see `reports.document.report`
BOOKS = (".xlsx", ".xlsm", ".xls", ".ods")
# What the files of a kind are called behind the name of the input.
ENDINGS: dict[Kind, tuple[str, ...]] = {
    "xlsx": (".xlsx",),
    "pdf": (".pdf",),
    "html": (".html",),
    "docx": (".docx",),
    "sheet": ("-sheet.pdf", "-sheet.dxf", "-throw.dxf", "-mechanism.dxf"),
}


@dataclass(frozen=True, slots=True)
class Built:
    """Files written, what could not be made and why, failed checks and explained ones."""

    files: tuple[Path, ...]
    missing: SystemPartMissing | None = None
    failed: tuple[str, ...] = ()
    accepted: tuple[str, ...] = ()


def load_input(path: Path) -> Loaded:
    """The checked input of a TOML file or of an edited workbook, told by the suffix.

    Raises:
        InputError: everything that is wrong with it.
    """
    if path.suffix.lower() in BOOKS:
        from reports.workbook.read import load_workbook_input

        loaded = load_workbook_input(path)
    else:
        loaded = load_toml(path)
    if loaded.model.bearings is not None:
        from reports.inputs.solved import solved

        solved(loaded.model, path.name)  # whether the oil films carry their loads
    return loaded


def kinds_of(loaded: Loaded, only: tuple[Kind, ...] = ()) -> tuple[Kind, ...]:
    """What a person asks for, or the input, or the workbook and the PDF."""
    return only or loaded.model.report.formats or USUAL_FORMATS


def find_templates(path: Path, loaded: Loaded, style: Path | None = None) -> None:
    """Look for the folder of own templates and the style file that an input or a person names.

    Raises:
        InputError: there is none, nothing in the folder replaces a template, or the style file
            has a fault.
    """
    if style is not None or loaded.model.report.style:
        from reports.document.report import find_style

        find_style(loaded.model.report, path.parent, style)
    if loaded.model.report.templates:
        from reports.document.page import overrides

        overrides.find(loaded.model.report.templates, path.parent)


def build(
    path: Path,
    loaded: Loaded,
    folder: Path,
    kinds: tuple[Kind, ...],
    further: Further = (),
    style: Path | None = None,
) -> Built:
    """Write the workbook and the report of a checked input, with further chapters.

    Without pango the report is written as print-ready HTML instead of a PDF.

    Raises:
        OutputError: the folder cannot be written.
        InputError: the input gives no finite result.
    """
    from reports.inputs.checks.flywheel import solution_remarks
    from reports.model.evaluation import evaluate_model
    from reports.tables.registry import build_model
    from reports.tables.verdicts import failed_checks

    needs(kinds)
    make_dir(folder)
    remarks = (*remarks_of(loaded), *solution_remarks(loaded.model))
    model = build_model(loaded.model, remarks)
    missing: SystemPartMissing | None = None
    with Progress("Расчёт") as progress:
        values = evaluate_model(model)
        checks = failed_checks(model, values)
        wants_html = "html" in kinds
        has_report = wants_html or bool({"pdf", "docx"} & set(kinds))
        making = _Making(path, folder, model, values, style, further, progress, has_report)
        book = making.workbook(beside="pdf" in kinds) if {"xlsx", "pdf"} & set(kinds) else bytes
        if "pdf" in kinds:
            try:
                making.pdf(book)
            except SystemPartMissing as error:
                missing, wants_html = error, True
        if "docx" in kinds:
            making.docx()
        if "sheet" in kinds:
            making.sheet()
        if "xlsx" in kinds:
            making.written(".xlsx", book(), first=True)
        if wants_html:
            making.html()
    failed = tuple(check.line() for check in checks if not check.reason)
    if wants_html or {"pdf", "docx"} & set(kinds):
        from reports.document.report import remarks_on

        failed += remarks_on(loaded.model, path.parent, style)
    accepted = tuple(check.line() for check in checks if check.reason)
    return Built(tuple(making.files), missing, failed, accepted)


def needs(kinds: Sequence[Kind]) -> None:
    """Refuse documents whose packages are not here, before anything is written.

    Raises:
        SystemPartMissing: some packages are missing.
    """
    if "docx" in kinds:
        need_packages("нужен для записки Word", docx="python-docx", resvg_py="resvg-py")
    if "sheet" in kinds:
        need_packages("нужен для чертежей DXF", ezdxf="ezdxf")


@dataclass
class _Making:
    """One input's documents in the making and the files written so far."""

    path: Path
    folder: Path
    model: Model
    values: Values
    style: Path | None
    further: Further
    progress: Progress
    has_report: bool
    files: list[Path] = field(default_factory=list)

    def written(self, ending: str, data: bytes, *, first: bool = False) -> None:
        """Write a file, whole or not at all."""
        target = self.folder / f"{self.path.stem}{ending}"
        write_bytes(target, data)
        self.files.insert(0 if first else len(self.files), target)

    def workbook(self, *, beside: bool) -> Callable[[], bytes]:
        """What gives the workbook; a report takes longer, so both are made at the same time."""
        self.progress.step("Книга Excel")
        # Before the process is split: what this reads and compiles serves the report too.
        model = self.report.numbered if self.has_report else self.model
        make = partial(_workbook, model, self.values)
        return cache(aside(make) if beside else make)

    def pdf(self, book: Callable[[], bytes]) -> None:
        self.progress.step("Отчёт PDF")
        self.written(".pdf", self.report.pdf(self.path, book))

    def docx(self) -> None:
        from reports.word.write import report_docx

        self.progress.step("Записка Word")
        self.written(".docx", report_docx(self.report))

    def sheet(self) -> None:
        from reports.sheet.write import sheet_files

        self.progress.step("Лист динамики")
        for ending, data in sheet_files(self.model, self.values).items():
            self.written(ending, data)

    def html(self) -> None:
        self.progress.step("Отчёт HTML")
        self.written(".html", self.report.page("screen").encode())

    @cached_property
    def report(self) -> Report:
        """The report that all documents and the numbers of the charts come from."""
        from reports.document.report import Report

        return Report.of(self.model, self.values, self.path, self.style, self.further)


def _workbook(model: Model, values: Values) -> bytes:
    from reports.workbook.write import workbook_bytes

    return workbook_bytes(model, values)


def remarks_of(loaded: Loaded) -> tuple[str, ...]:
    """Lines about an input that stand beside the checks of its calculation."""
    return (
        *(f"Внимание: {problem.line()}" for problem in loaded.warnings),
        *(f"Принято: {accepted.line()}" for accepted in loaded.accepted),
        *(f"К сведению: {note}" for note in loaded.notes),
    )
