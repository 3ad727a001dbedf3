"""Processes that make files for the page: kshm and what it lacks, with little memory."""

from __future__ import annotations

import os
import sys

from reports.grading.batch.worker import limit_memory

MEMORY = 3 * 2**30  # bytes of address space beyond what the empty process has


def book_as_toml(path: str) -> int:
    """Print the input that an edited workbook holds as a file; the exit code."""
    from pathlib import Path

    from reports.shared.errors import KshmError
    from reports.web.engine import toml_text
    from reports.workbook.read import load_workbook_input

    try:
        sys.stdout.write(toml_text(load_workbook_input(Path(path)).model))
    except KshmError as error:
        sys.stderr.write("\n".join(error.lines()))
        return error.exit_code
    return 0


def begin() -> None:
    """Limit what this process may take, before it reads anything."""
    limit_memory(MEMORY)
    if hasattr(os, "nice"):
        os.nice(5)  # who waits for a number comes before who waits for a file


def zip_tables() -> None:
    """The tables that ``solve --csv`` has just written as one file."""
    from pathlib import Path

    from reports.web.files import zip_folder

    zip_folder(Path("csv"), Path("out/tables.zip"))


if __name__ == "__main__":
    begin()
    if sys.argv[1] == "book":
        sys.stdout.reconfigure(encoding="utf-8")  # type: ignore[union-attr]
        sys.exit(book_as_toml(sys.argv[2]))
    zip_tables()
