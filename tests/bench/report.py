"""The textbook's diesel: workbook and report, full and short, with and without kept pictures."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from pathlib import Path

from reports.shared.resources import samples_dir
from tests.bench._figure import Figure, costs
from tests.bench._process import kshm, median, run


def figures() -> Iterator[Figure]:
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

        yield from costs("только книга", median(build("full", "xlsx"), env=keep))
        first = run(build("full"), keep)
        yield from costs("книга и отчёт, первый раз", first)
        full = median(build("full"), env=keep)
        yield from costs("книга и отчёт, снова", full)
        yield Figure("снова / первый раз", full.wall / first.wall, "раз")
        never = run(build("full"), {"KSHM_CACHE": ""})
        yield from costs("книга и отчёт, рисунки и формулы не хранятся", never)
        yield Figure("хранятся / не хранятся: процессор", full.cpu / never.cpu, "раз")
        short = median(build("short"), env=keep)
        yield from costs("книга и краткий отчёт, снова", short)
        yield Figure("краткий / полный", short.wall / full.wall, "раз")
        size = (folder / "out" / "full.pdf").stat().st_size
        yield Figure("полный отчёт с вложенной книгой", size / 1024, "КБ")
