"""What ``kshm validate`` does: the book as HTML, PDF and CSV in a folder."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from reports.document.page.render import render_pdf
from reports.shared.errors import SystemPartMissing
from reports.shared.files import make_dir, write_bytes, write_text
from reports.shared.progress import Progress
from reports.validation.book import Book, validate
from reports.validation.listing import listing
from reports.validation.page import validation_page

Kind = Literal["csv", "html", "pdf"]
KINDS: tuple[Kind, ...] = ("csv", "html", "pdf")


def write(folder: Path, kinds: tuple[Kind, ...]) -> tuple[Book, list[Path], str]:
    """Write the book.

    Returns:
        The book, the files, and why the PDF is missing (one Russian line, or empty).

    Raises:
        OutputError: the folder cannot be written.
    """
    make_dir(folder)
    files = []
    missing = ""
    with Progress("Пересчёт печатных таблиц") as progress:
        book = validate()
        for kind in kinds:
            target = folder / f"validation.{kind}"
            if kind == "csv":
                write_text(target, listing(book))
            elif kind == "html":
                write_text(target, validation_page(book, media="screen"))
            else:
                progress.step("Книга сверки PDF")
                try:
                    write_bytes(target, render_pdf(validation_page(book, media="print")))
                except SystemPartMissing as error:
                    missing = "\n".join(error.lines())
                    continue
            files.append(target)
    return book, files, missing
