"""The textbook's diesel: workbook and report, full and short, with and without kept pictures."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from pathlib import Path

from reports.resources import samples_dir
from tests.bench._process import Cost, kshm, median, run


def rows() -> Iterator[tuple[str, str]]:
    """Times of whole commands; medians of three but for the first report."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        text = (samples_dir() / "gots-diesel.toml").read_text(encoding="utf-8")
        for kind in ("full", "short"):
            data = text.replace("[report]\n", f'[report]\ndetail = "{kind}"\n')
            (folder / f"{kind}.toml").write_text(data, encoding="utf-8")
        keep = {"KSHM_CACHE": str(folder / "cache")}

        def build(kind: str, only: str = "") -> list[str]:
            more = ("--only", only) if only else ()
            return kshm("build", str(folder / f"{kind}.toml"), "-o", str(folder / "out"), *more)

        yield "только книга", str(median(build("full", "xlsx"), env=keep))
        first = run(build("full"), keep)
        yield "книга и отчёт, первый раз", str(first)
        full = median(build("full"), env=keep)
        yield "книга и отчёт, снова", f"{full}; {_share(full, first)} первого раза"
        short = median(build("short"), env=keep)
        yield "книга и краткий отчёт, снова", f"{short}; {_share(short, full)} полного"
        size = (folder / "out" / "full.pdf").stat().st_size // 1024
        yield "полный отчёт с вложенной книгой", f"{size} КБ"


def _share(one: Cost, other: Cost) -> str:
    return f"{one.wall / other.wall:.2f}"
