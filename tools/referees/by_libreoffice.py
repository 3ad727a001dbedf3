"""The slow referee: LibreOffice in a private profile that always recalculates on load.

LibreOffice keeps cached values unless told otherwise, and exits with 0 even when
it could not load a file: the profile carries OOXMLRecalcMode = 0 (always) and
every result is looked for.
"""

from __future__ import annotations

import csv
import shutil
import subprocess
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from reports.shared.errors import SystemPartMissing
from tools.referees.cells import Book, CellValue, formula_cells, row_and_column, without_pictures

INSTALL = "sudo apt-get install -y libreoffice-calc-nogui python3-uno"

# One process for a few books: it starts slowly, and its memory grows with every book.
CHUNK = 10

_SETTINGS = """<?xml version="1.0" encoding="UTF-8"?>
<oor:items xmlns:oor="http://openoffice.org/2001/registry">
 <item oor:path="/org.openoffice.Office.Calc/Formula/Load">
  <prop oor:name="OOXMLRecalcMode" oor:op="fuse"><value>0</value></prop>
 </item>
 <item oor:path="/org.openoffice.Office.Calc/Formula/Load">
  <prop oor:name="ODFRecalcMode" oor:op="fuse"><value>0</value></prop>
 </item>
</oor:items>
"""

# Comma, quotes, UTF-8, from the first line, numbers as en-US writes them and with all digits
# instead of as shown, every sheet into a file of its own.
_EVERY_SHEET = "csv:Text - txt - csv (StarCalc):44,34,76,1,,1033,false,false,false,false,false,-1"


def find_soffice() -> str | None:
    """Path of LibreOffice's command, or None."""
    return shutil.which("soffice") or shutil.which("libreoffice")


class LibreOffice:
    """Recalculates in a process of its own."""

    name = "LibreOffice"

    def __init__(self, timeout_s: float = 300.0) -> None:
        self.timeout_s = timeout_s

    def recalculate(self, books: Sequence[bytes]) -> list[Book]:
        """Values of all formula cells of each workbook.

        Raises:
            SystemPartMissing: LibreOffice is not installed.
            RuntimeError: LibreOffice did not give a workbook back.
        """
        results: list[Book] = []
        for start in range(0, len(books), CHUNK):
            results.extend(self._values(books[start : start + CHUNK]))
        return results

    def converted(self, books: Sequence[bytes], suffix: str = "xlsx") -> list[bytes]:
        """Return the workbooks as LibreOffice saves them after recalculating."""
        names = [f"book{index}.{suffix}" for index in range(len(books))]
        with self._saved(books, suffix, names) as folder:
            return [(folder / name).read_bytes() for name in names]

    def _values(self, books: Sequence[bytes]) -> list[Book]:
        """Values by way of a text file for each sheet: saving a workbook takes twice as long.

        Formulas that LibreOffice may have dropped stand there as None.  Charts take half of the
        time.
        """
        formulas = [formula_cells(book) for book in books]
        names = [f"book{i}-{sheet}.csv" for i, sheets in enumerate(formulas) for sheet in sheets]
        with self._saved([*map(without_pictures, books)], _EVERY_SHEET, names) as folder:
            return [
                {
                    sheet: taken((folder / f"book{index}-{sheet}.csv"), cells)
                    for sheet, cells in sheets.items()
                }
                for index, sheets in enumerate(formulas)
            ]

    @contextmanager
    def _saved(self, books: Sequence[bytes], form: str, names: Sequence[str]) -> Iterator[Path]:
        """Yield the folder of the files that LibreOffice made of the workbooks."""
        command = find_soffice()
        if command is None:
            part = "LibreOffice"
            raise SystemPartMissing(part, INSTALL, purpose="пересчёт книг")
        with tempfile.TemporaryDirectory(prefix="kshm-office-") as name:
            folder = Path(name)
            (folder / "profile" / "user").mkdir(parents=True)
            (folder / "profile" / "user" / "registrymodifications.xcu").write_text(_SETTINGS)
            (folder / "in").mkdir()
            sources = []
            for index, book in enumerate(books):
                source = folder / "in" / f"book{index}.xlsx"
                source.write_bytes(book)
                sources.append(str(source))
            done = subprocess.run(
                [
                    command,
                    f"-env:UserInstallation={(folder / 'profile').as_uri()}",
                    "--headless",
                    "--convert-to",
                    form,
                    "--outdir",
                    str(folder / "out"),
                    *sources,
                ],
                capture_output=True,
                timeout=self.timeout_s,
                check=False,
            )
            missing = [name for name in names if not (folder / "out" / name).exists()]
            if missing:
                said = (done.stderr or done.stdout).decode(errors="replace").strip()
                msg = f"LibreOffice gave nothing for {', '.join(missing)}: {said}"
                raise RuntimeError(msg)
            yield folder / "out"


def taken(path: Path, cells: Sequence[str]) -> dict[str, CellValue]:
    """Values of some cells of a sheet saved as text: numbers where they read as numbers."""
    with path.open(encoding="utf-8", newline="") as stream:
        rows = list(csv.reader(stream))
    collected: dict[str, CellValue] = {}
    for cell in cells:
        row, column = row_and_column(cell)
        inside = row <= len(rows) and column <= len(rows[row - 1])
        collected[cell] = _read(rows[row - 1][column - 1]) if inside else None
    return collected


def _read(text: str) -> float | str:
    try:
        return float(text)
    except ValueError:
        return text
