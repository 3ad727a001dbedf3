"""The third referee: Gnumeric, which reads what Excel forgives in a package more strictly."""

from __future__ import annotations

import gzip
import re
import shutil
import subprocess
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path

from tools.referees.by_libreoffice import taken
from tools.referees.cells import Book, formula_cells

COMMAND = "ssconvert"
INSTALL = "sudo apt-get install -y --no-install-recommends gnumeric"
_RAW = ("-T", "Gnumeric_stf:stf_assistant", "-O", "separator=, format=raw quoting-mode=auto")


class Gnumeric:
    """Recalculates in a process of its own."""

    name = "Gnumeric"

    def recalculate(self, books: Sequence[bytes]) -> list[Book]:
        """Values of all formula cells of each workbook."""
        return [self._one(book) for book in books]

    def _one(self, book: bytes) -> Book:
        with tempfile.TemporaryDirectory(prefix="kshm-gnumeric-") as name:
            folder = Path(name)
            _convert(book, folder, "--recalc", "-S", *_RAW, str(folder / "%n.csv"))
            return {
                sheet: taken(folder / f"{number}.csv", cells)
                for number, (sheet, cells) in enumerate(formula_cells(book).items())
            }

    def edited(self, book: bytes, values: Mapping[str, float]) -> bytes:
        """Return the workbook as it saves it after an edit of cells of the first sheet."""
        typed = [word for at, value in values.items() for word in ("--set", f"{at}={value}")]
        with tempfile.TemporaryDirectory(prefix="kshm-gnumeric-") as name:
            saved = Path(name) / "saved.xlsx"
            _convert(book, Path(name), *typed, "--recalc", str(saved))
            return saved.read_bytes()

    def drawn(self, book: bytes) -> tuple[int, int, set[str]]:
        """Charts and curves that it keeps of a workbook, and the targets of its links."""
        with tempfile.TemporaryDirectory(prefix="kshm-gnumeric-") as name:
            saved = Path(name) / "book.gnumeric"
            _convert(book, Path(name), str(saved))
            text = gzip.decompress(saved.read_bytes()).decode()
        links = re.findall(r'HyperLink type="GnmHLinkCurWB" target="([^"]*)"', text)
        return text.count('type="GogXYPlot"'), text.count('role="Series"'), set(links)


def _convert(book: bytes, folder: Path, *words: str) -> None:
    source = folder / "book.xlsx"
    source.write_bytes(book)
    command = shutil.which(COMMAND) or COMMAND
    *options, target = words
    done = subprocess.run(
        [command, *options, str(source), target], capture_output=True, timeout=300, check=False
    )
    if done.returncode:
        raise RuntimeError(done.stderr.decode(errors="replace"))
