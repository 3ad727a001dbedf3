"""From an input to files: what ``kshm build`` and ``kshm solve`` do."""

from __future__ import annotations

import gc
import tempfile
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cache, cached_property, partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from reports.inputs.load import Loaded, load_toml
from reports.inputs.sections.report import USUAL_FORMATS, Format
from reports.shared.background import aside
from reports.shared.doctor import need_packages
from reports.shared.errors import KshmError, SystemPartMissing
from reports.shared.files import make_dir, refuse_own, write_bytes
from reports.shared.parallel_map import in_order
from reports.shared.progress import Progress
from reports.shared.standing import Notice, Severity

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
    "live": ("-live.html",),
}
Input = tuple[Path, Loaded]
Chapters = Callable[[Path, Loaded], Further]


@dataclass(frozen=True, slots=True)
class Built:
    """Written files, skipped ones with reasons, failed checks, values beyond what is allowed."""

    files: tuple[Path, ...]
    missing: SystemPartMissing | None = None
    failed: tuple[str, ...] = ()
    weak: tuple[str, ...] = ()


def load_input(path: Path) -> Loaded:
    """Load a checked input from TOML or an edited workbook, by the suffix.

    Raises:
        InputError: everything that is wrong with it.
    """
    if path.suffix.lower() in BOOKS:
        from reports.workbook.read import load_workbook_input

        loaded = load_workbook_input(path)
    else:
        loaded = load_toml(path)
    if loaded.model.books:
        from reports.exports.department_chapters import refuse_faults

        refuse_faults(loaded.model)
    if loaded.model.bearings is not None:
        from reports.inputs.solve_input import solved

        solved(loaded.model, path.name)  # whether the oil films carry their loads
    if path.suffix.lower() in BOOKS:
        from reports.tables.registry import build_model
        from reports.workbook.lost_formulas import lost_formulas

        lost = lost_formulas(path, build_model(loaded.model))
        loaded = replace(loaded, warnings=(*loaded.warnings, *lost))
    return loaded


def kinds_of(loaded: Loaded, only: tuple[Kind, ...] = ()) -> tuple[Kind, ...]:
    """Kinds of documents: from the command, else the input, else workbook and PDF."""
    return only or loaded.model.report.formats or USUAL_FORMATS


def find_templates(path: Path, loaded: Loaded, style: Path | None = None) -> None:
    """Resolve the template folder and style file named by an input or the command.

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
    from reports.inputs.solve_input import solution_remarks
    from reports.model.evaluation import evaluate_model
    from reports.tables.registry import build_model
    from reports.tables.verdicts import failed_checks, weak_values

    needs(kinds)
    make_dir(folder)
    remarks = (*remarks_of(loaded), *(remark.line for remark in solution_remarks(loaded.model)))
    model = build_model(loaded.model, remarks)
    missing: SystemPartMissing | None = None
    with Progress("Расчёт") as progress:
        values = evaluate_model(model)
        checks = failed_checks(model, values)
        wants_html = "html" in kinds
        has_report = wants_html or bool({"pdf", "docx"} & set(kinds))
        making = _Making(
            path, folder, model, values, style, further, progress, has_report, "sheet" in kinds
        )
        book = (
            making.workbook(beside="pdf" in kinds)
            if {"xlsx", "pdf", "live"} & set(kinds)
            else bytes
        )
        if "pdf" in kinds:
            try:
                making.pdf(book)
            except SystemPartMissing as error:
                missing, wants_html = error, True
        if "docx" in kinds:
            making.docx()
        if "sheet" in kinds:
            making.sheet()
        if "live" in kinds:
            making.live(book())
        if "xlsx" in kinds:
            making.written(".xlsx", book(), first=True)
        if wants_html:
            making.html()
    failed = tuple(check.line() for check in checks if not check.reason)
    if wants_html or {"pdf", "docx"} & set(kinds):
        from reports.document.report import remarks_on

        failed += remarks_on(loaded.model, path.parent, style)
    return Built(tuple(making.files), missing, failed, weak_values(model, values))


def needs(kinds: Sequence[Kind]) -> None:
    """Refuse documents whose packages are missing, before anything is written.

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
    with_sheet: bool
    files: list[Path] = field(default_factory=list)

    def written(self, ending: str, data: bytes, *, first: bool = False) -> None:
        """Write a file, whole or not at all."""
        target = self.folder / f"{self.path.stem}{ending}"
        write_bytes(target, data)
        self.files.insert(0 if first else len(self.files), target)

    def workbook(self, *, beside: bool) -> Callable[[], bytes]:
        """Start the workbook in the background; return what waits for it."""
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

    def live(self, book: bytes) -> None:
        from reports.live.page import live_page

        self.progress.step("Живая страница")
        self.written("-live.html", live_page(self.model, book, self.path.stem))

    @cached_property
    def report(self) -> Report:
        """Report shared by all documents."""
        from reports.document.report import Report

        return Report.of(
            self.model, self.values, self.path, self.style, self.further,
            with_sheet=self.with_sheet,
        )  # fmt: skip


def _workbook(model: Model, values: Values) -> bytes:
    from reports.workbook.course import short_model
    from reports.workbook.write import workbook_bytes

    return workbook_bytes(short_model(model), values)


def remarks_of(loaded: Loaded) -> tuple[str, ...]:
    """Warnings and remarks of an input."""
    return (
        *(Notice(Severity.WARNING, problem.line()).line for problem in loaded.warnings),
        *(f"Принято: {accepted.line()}" for accepted in loaded.accepted),
        *(f"К сведению: {note}" for note in loaded.notes),
    )


def _no_chapters(_path: Path, _loaded: Loaded) -> Further:
    return ()


@dataclass(frozen=True, slots=True)
class Order:
    """Job for another machine: a checked input and its build options."""

    name: str
    data: bytes
    loaded: Loaded
    kinds: tuple[Kind, ...]
    further: Further = ()


@dataclass(frozen=True, slots=True)
class Delivery:
    """Files by name, what the other machine lacked, failed checks."""

    files: list[tuple[str, bytes]]
    missing: tuple[str, str, str] | None = None
    failed: tuple[str, ...] = ()
    weak: tuple[str, ...] = ()


def build_each(
    inputs: Sequence[Input],
    folder: Path,
    only: tuple[Kind, ...] = (),
    dask: str | None = None,
    chapters: Chapters = _no_chapters,
    style: Path | None = None,
) -> Iterator[Built]:
    """Build each input, locally or on Dask; results in order.

    ``only`` are the kinds of documents in place of those that an input asks for.
    ``chapters`` gives the further chapters of an input's report.

    Raises:
        KshmError: results would fall on each other or on an input, or the cluster fails.
    """
    _refuse_overlap([path for path, _ in inputs])
    endings = [ending for kind in ENDINGS.values() for ending in kind]
    results = [folder / f"{path.stem}{ending}" for path, _ in inputs for ending in endings]
    refuse_own(results, [file for path, loaded in inputs for file in (path, *loaded.beside)])
    if dask is None:
        for number, (path, loaded) in enumerate(inputs):
            if number:
                gc.collect()  # see reports/__main__.py
            kinds = kinds_of(loaded, only)
            yield build(path, loaded, folder, kinds, chapters(path, loaded), style)
        return
    make_dir(folder)
    orders = (
        _order(path, loaded, kinds_of(loaded, only), chapters(path, loaded), style)
        for path, loaded in inputs
    )
    for delivery in in_order(delivered, orders, dask=dask):
        for name, data in delivery.files:
            write_bytes(folder / name, data)
        missing = None
        if delivery.missing:
            part, command, purpose = delivery.missing
            missing = SystemPartMissing(part, command, purpose=purpose)
        files = tuple(folder / name for name, _ in delivery.files)
        yield Built(files, missing, delivery.failed)


def delivered(order: Order) -> Delivery:
    """Build an order in a folder of its own."""
    with tempfile.TemporaryDirectory(prefix="kshm-build-") as name:
        source, out = Path(name) / order.name, Path(name) / "out"
        source.write_bytes(order.data)
        built = build(source, order.loaded, out, order.kinds, order.further)
        files = [(path.name, path.read_bytes()) for path in built.files]
        lacks = built.missing
        missing = (lacks.part, lacks.command, lacks.purpose) if lacks else None
        return Delivery(files, missing, built.failed)


def _order(
    path: Path, loaded: Loaded, kinds: tuple[Kind, ...], further: Further, style: Path | None
) -> Order:
    if style is not None or loaded.model.report.style:
        msg = f"{path}: файл оформления (report.style) есть только на этом компьютере; без --dask"
        raise KshmError(msg)
    if loaded.model.report.templates:
        msg = f"{path}: свои шаблоны (report.templates) есть только на этом компьютере; без --dask"
        raise KshmError(msg)
    return Order(path.name, path.read_bytes(), loaded, kinds, further)


def _refuse_overlap(paths: Sequence[Path]) -> None:
    stem, count = Counter(path.stem for path in paths).most_common(1)[0]
    if count > 1:
        msg = f"{stem}: два файла с этим именем дали бы один результат; стройте их в разные папки"
        raise KshmError(msg)
