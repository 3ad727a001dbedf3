"""The slow referee: LibreOffice in a private profile that always recalculates on load.

LibreOffice keeps cached values unless told otherwise, and exits with 0 even when
it could not load a file: the profile carries OOXMLRecalcMode = 0 (always) and
every result is looked for.
"""

from __future__ import annotations

import shutil
import subprocess
import tempfile
from collections.abc import Sequence
from pathlib import Path

from reports.errors import SystemPartMissing
from reports.recalculation.protocol import Book, cached_values, formula_cells

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
            done = self.converted(books[start : start + CHUNK])
            results.extend(cached_values(book) for book in done)
        # Formulas that LibreOffice may have dropped must not vanish from the comparison.
        return [
            {
                sheet: {cell: result.get(sheet, {}).get(cell) for cell in cells}
                for sheet, cells in formula_cells(book).items()
            }
            for book, result in zip(books, results, strict=True)
        ]

    def converted(self, books: Sequence[bytes], suffix: str = "xlsx") -> list[bytes]:
        """The workbooks as LibreOffice saves them after recalculating."""
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
                    suffix,
                    "--outdir",
                    str(folder / "out"),
                    *sources,
                ],
                capture_output=True,
                timeout=self.timeout_s,
                check=False,
            )
            results = [folder / "out" / f"book{i}.{suffix}" for i in range(len(books))]
            missing = [path.name for path in results if not path.exists()]
            if missing:
                said = (done.stderr or done.stdout).decode(errors="replace").strip()
                msg = f"LibreOffice gave nothing for {', '.join(missing)}: {said}"
                raise RuntimeError(msg)
            return [path.read_bytes() for path in results]
