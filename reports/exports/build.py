"""From an input to files: what ``kshm build`` and ``kshm solve`` do."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path
from typing import Any

from reports.inputs.load import Loaded, load_toml
from reports.inputs.sections.report import USUAL_FORMATS
from reports.inputs.sections.report import Format as Kind
from reports.shared.aside import aside
from reports.shared.errors import SystemPartMissing
from reports.shared.files import make_dir, write_bytes, write_text
from reports.shared.progress import Progress

Further = Sequence[Callable[[Any], Any]]  # chapters, see `reports.document.report`
# What the files of a kind are called behind the name of the input.
ENDINGS: dict[Kind, tuple[str, ...]] = {
    "xlsx": (".xlsx",),
    "pdf": (".pdf",),
    "html": (".html",),
    "docx": (".docx",),
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
    if path.suffix.lower() in (".xlsx", ".xlsm", ".xls", ".ods"):
        from reports.workbook.read import load_workbook_input

        return load_workbook_input(path)
    return load_toml(path)


def kinds_of(loaded: Loaded, only: Kind | None = None) -> tuple[Kind, ...]:
    """What a person asks for, or the input, or the workbook and the PDF."""
    if only is not None:
        return (only,)
    return loaded.model.report.formats or USUAL_FORMATS


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
    from reports.inputs.checks.grid import grid_remark
    from reports.shared.doctor import need_packages
    from reports.spec.evaluation import evaluate_model
    from reports.tables.overview.verdicts import failed_checks
    from reports.tables.registry import build_model

    if "docx" in kinds:
        need_packages("нужен для записки Word", docx="python-docx", resvg_py="resvg-py")
    make_dir(folder)
    grid = grid_remark(loaded.model)
    model = build_model(loaded.model, (*remarks_of(loaded), *((grid,) if grid else ())))
    files: list[Path] = []
    missing: SystemPartMissing | None = None
    with Progress("Расчёт") as progress:
        values = evaluate_model(model)
        checks = failed_checks(model, values)
        wants_html = "html" in kinds
        if "xlsx" in kinds or "pdf" in kinds:
            from reports.workbook.write import workbook_bytes

            progress.step("Книга Excel")
            # A report takes longer than a workbook: both are made at the same time.
            make = partial(workbook_bytes, model, values)
            book = cache(aside(make) if "pdf" in kinds else make)
        if "pdf" in kinds:
            from reports.document.report import report_pdf

            progress.step("Отчёт PDF")
            try:
                pdf = report_pdf(
                    model, values, source=path, workbook=book, style=style, further=further
                )
                target = folder / f"{path.stem}.pdf"
                write_bytes(target, pdf)
                files.append(target)
            except SystemPartMissing as error:
                missing, wants_html = error, True
        if "docx" in kinds:
            from reports.word.write import report_docx

            progress.step("Записка Word")
            target = folder / f"{path.stem}.docx"
            write_bytes(
                target, report_docx(model, values, source=path, style=style, further=further)
            )
            files.append(target)
        if "xlsx" in kinds:
            target = folder / f"{path.stem}.xlsx"
            write_bytes(target, book())
            files.insert(0, target)
        if wants_html:
            from reports.document.report import report_html

            progress.step("Отчёт HTML")
            target = folder / f"{path.stem}.html"
            write_text(
                target, report_html(model, values, source=path, style=style, further=further)
            )
            files.append(target)
    failed = tuple(check.line() for check in checks if not check.reason)
    if wants_html or {"pdf", "docx"} & set(kinds):
        from reports.document.report import remarks_on

        failed += remarks_on(loaded.model, path.parent, style)
    accepted = tuple(check.line() for check in checks if check.reason)
    return Built(tuple(files), missing, failed, accepted)


def remarks_of(loaded: Loaded) -> tuple[str, ...]:
    """Lines about an input that stand beside the checks of its calculation."""
    return (
        *(f"Внимание: {problem.line()}" for problem in loaded.warnings),
        *(f"Принято: {accepted.line()}" for accepted in loaded.accepted),
    )
