"""The PDF report: time per page and per table cell; formulas and figures are not kept."""

from __future__ import annotations

import re
import shutil
import tempfile
from collections.abc import Iterator
from pathlib import Path

from reports.shared.resources import samples_dir
from tests.bench._figure import Figure, costs
from tests.bench._process import kshm, run
from tests.document.pdftools import poppler


def figures() -> Iterator[Figure]:
    """Figures."""
    with tempfile.TemporaryDirectory(prefix="kshm-bench-") as name:
        folder = Path(name)
        source = str(samples_dir() / "gots-diesel.toml")

        def build(kind: str) -> list[str]:
            return kshm("build", source, "-o", name, "--only", kind)

        # The HTML page holds the same text and tables, so its time is what comes before layout.
        run(build("html"), {"KSHM_CACHE": str(folder / "cache")})
        again = {"KSHM_CACHE": str(folder / "cache")}
        html, pdf = run(build("html"), again), run(build("pdf"), again)
        cells = len(re.findall(r"<t[dh][ >]", (folder / "gots-diesel.html").read_text("utf-8")))
        yield from costs("отчёт PDF, рисунки и формулы уже есть", pdf)
        if shutil.which("pdfinfo") is None:
            print("страницы не посчитаны: нет pdfinfo (пакет poppler-utils)")
            return
        told = poppler("pdfinfo", str(folder / "gots-diesel.pdf"))
        pages = int(re.search(r"Pages:\s+(\d+)", told)[1])
        yield Figure("страниц", pages)
        yield Figure("ячеек таблиц", cells)
        layout = pdf.wall - html.wall
        yield Figure("на страницу", pdf.wall / pages * 1e3, "мс")
        yield Figure("вёрстка на страницу", layout / pages * 1e3, "мс")
        yield Figure("вёрстка на ячейку таблицы", layout / cells * 1e3, "мс")
