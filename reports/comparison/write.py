"""What ``kshm compare`` does: engines beside each other in one file."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from reports.comparison.engines import read_engines
from reports.inputs.sections.input_file import InputFile
from reports.shared.errors import InputError, Problem
from reports.shared.files import write_bytes, write_text

SUFFIXES = (".xlsx", ".pdf", ".html")


def check_suffix(target: Path) -> None:
    """Refuse an ending that is none of ``SUFFIXES``.

    Raises:
        InputError: it is none of them.
    """
    if target.suffix.lower() not in SUFFIXES:
        what = f"нужно окончание {', '.join(SUFFIXES)}"
        raise InputError(Problem(target.name, what, "укажите имя ключом -o"))


def write(sources: Sequence[Path], models: Sequence[InputFile], target: Path) -> None:
    """Write the comparison of checked engines.

    Raises:
        InputError: an engine gives no finite result.
        OutputError: the file cannot be written.
        SystemPartMissing: pango is missing for a PDF.
    """
    engines = read_engines(sources, models)
    suffix = target.suffix.lower()
    if suffix == ".xlsx":
        from reports.comparison.book import book_bytes

        write_bytes(target, book_bytes(engines))
        return
    from reports.comparison.page import comparison_page
    from reports.document.page.render import render_pdf

    if suffix == ".html":
        write_text(target, comparison_page(engines, media="screen"))
    else:
        write_bytes(target, render_pdf(comparison_page(engines, media="print")))
