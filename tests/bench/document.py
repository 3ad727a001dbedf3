"""The PDF report: time per page and per table cell, and what each means of speed gains."""

from __future__ import annotations

import re
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import nullcontext
from pathlib import Path
from unittest import mock

from matplotlib.font_manager import FontProperties
from matplotlib.mathtext import MathTextParser

from reports.document.page import render as pages
from reports.document.report import Report
from reports.document.text.mathtext import read
from reports.document.text.tex import for_mathtext
from reports.shared.resources import samples_dir
from tests.bench._figure import Figure, costs, interleaved, ratio
from tests.bench._process import kshm, run
from tests.document.pdftools import poppler
from tests.document.report_samples import terms


def figures() -> Iterator[Figure]:
    """Figures."""
    with tempfile.TemporaryDirectory(prefix="kshm-bench-") as name:
        folder = Path(name)
        source = str(samples_dir() / "gots-diesel.toml")

        def build(kind: str) -> list[str]:
            return kshm("build", source, "-o", name, "--only", kind)

        # The HTML page holds the same text and tables, so its time is what comes before layout.
        html, pdf = run(build("html")), run(build("pdf"))
        cells = len(re.findall(r"<t[dh][ >]", (folder / "gots-diesel.html").read_text("utf-8")))
        yield from costs("отчёт PDF", pdf)
        if shutil.which("pdfinfo") is None:
            print("страницы не посчитаны: нет pdfinfo (пакет poppler-utils)")
            return
        message = poppler("pdfinfo", str(folder / "gots-diesel.pdf"))
        pages = int(re.search(r"Pages:\s+(\d+)", message)[1])
        yield Figure("страниц", pages)
        yield Figure("ячеек таблиц", cells)
        layout = pdf.wall - html.wall
        yield Figure("на страницу", pdf.wall / pages * 1e3, "мс")
        yield Figure("вёрстка на страницу", layout / pages * 1e3, "мс")
        yield Figure("вёрстка на ячейку таблицы", layout / cells * 1e3, "мс")
        yield _collecting()
        yield _reading()


def _collecting() -> Figure:
    """What it gains to collect no garbage during the layout."""
    source = terms("gots-diesel")
    html = Report(source.model, source.values).page("print")

    def as_usual() -> None:
        with mock.patch.object(pages, "uncollected", nullcontext):
            pages.render(html)

    times = interleaved({"rarely": lambda: pages.render(html), "as usual": as_usual}, rounds=2)
    gained = ratio(times, "rarely", "as usual")
    return Figure("без сборки мусора / с ней: процессор", gained, "раз")


def _reading() -> Figure:
    """What it gains to read formulas without mathtext's parser."""
    source = terms("gots-diesel")
    tex = [source.substitution("P4_1.Ps_MPa", angle) for angle in range(0, 720, 60)]
    texts = [f"${for_mathtext(each)}$" for each in tex]
    font = FontProperties(family="STIXGeneral", size=1000, math_fontfamily="stix")

    def theirs() -> None:
        MathTextParser._parse_cached.cache_clear()
        for text in texts:
            MathTextParser("path").parse(text, dpi=72, prop=font)

    def ours() -> None:
        for text in texts:
            read(text, 1000.0)

    times = interleaved({"ours": ours, "theirs": theirs}, rounds=3)
    gained = ratio(times, "ours", "theirs")
    return Figure("формулы без разбора mathtext / с ним: процессор", gained, "раз")
