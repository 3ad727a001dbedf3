"""axe-core, the checker of accessible pages: fetched as the other node programs of the tests."""

from __future__ import annotations

import shutil
import subprocess
import tarfile
from functools import lru_cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pytest

from tests.conftest import missing

PACKAGE = "axe-core@4.14.1"
_RUN = """async () => (await axe.run(document, {resultTypes: ["violations"]})).violations
    .filter(v => ["serious", "critical"].includes(v.impact))
    .map(v => `${v.id}: ${v.nodes.slice(0, 3).map(n => n.html.slice(0, 160)).join(" | ")}`)"""


@lru_cache
def _source() -> str:
    npm = shutil.which("npm")
    if npm is None:
        missing("node", "nodejs npm")
    with TemporaryDirectory() as folder:
        subprocess.run(
            [npm, "pack", PACKAGE, "--silent"], cwd=folder, timeout=300, check=False,
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        )  # fmt: skip
        collected = list(Path(folder).glob("*.tgz"))
        if not collected:
            pytest.skip("пакет axe-core недоступен")
        with tarfile.open(collected[0]) as archive:
            stream = archive.extractfile("package/axe.min.js")
            assert stream is not None
            return stream.read().decode("utf-8")


def faults(page: Any, schemes: tuple[str, ...] = ("light", "dark")) -> list[str]:
    """Serious and critical findings on a page as it stands, in each colour scheme."""
    collected = []
    for scheme in schemes:
        page.emulate_media(color_scheme=scheme)
        page.evaluate(_source())
        collected += [f"{scheme}: {each}" for each in page.evaluate(_RUN)]
    return collected
