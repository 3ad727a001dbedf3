"""The textbook's diesel: workbook and report in each profile."""

from __future__ import annotations

import re
import tempfile
from collections.abc import Iterator
from pathlib import Path

from reports.inputs.sections.report import DETAILS
from reports.shared.resources import samples_dir
from tests.bench._figure import Figure, costs
from tests.bench._process import kshm, median


def figures() -> Iterator[Figure]:
    """Times of whole commands, medians of three; pages and size."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        text = (samples_dir() / "gots-diesel.toml").read_text(encoding="utf-8")
        for kind in DETAILS:
            data = text.replace("[report]\n", f'[report]\ndetail = "{kind}"\n')
            (folder / f"{kind}.toml").write_text(data, encoding="utf-8")

        def build(kind: str, only: str = "") -> list[str]:
            more = ("--only", only) if only else ()
            return kshm("build", str(folder / f"{kind}.toml"), "-o", str(folder / "out"), *more)

        yield from costs("только книга", median(build("full", "xlsx")))
        for kind in DETAILS:
            yield from costs(f"{kind}: книга и отчёт", median(build(kind)))
            pdf = (folder / "out" / f"{kind}.pdf").read_bytes()
            yield Figure(f"{kind}: страниц", _pages(pdf))
            yield Figure(f"{kind}: отчёт с вложенной книгой", len(pdf) / 1024, "КБ")


def _pages(pdf: bytes) -> int:
    """Pages of a PDF, by the count in its page tree."""
    import zlib

    texts = [pdf]
    for stream in re.findall(rb"/ObjStm.*?stream\r?\n(.*?)endstream", pdf, re.DOTALL):
        texts.append(zlib.decompress(stream))
    return max(int(count) for text in texts for count in re.findall(rb"/Count (\d+)", text))
