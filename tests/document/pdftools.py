"""Tools of the document tests: text and fonts of a PDF through poppler."""

import os
import shutil
import subprocess
from functools import lru_cache
from pathlib import Path
from tempfile import NamedTemporaryFile

import pytest


def poppler(tool: str, *args: str) -> str:
    if shutil.which(tool) is None:
        if os.environ.get("CI") == "true":
            pytest.fail(f"{tool} is missing")
        pytest.skip(f"{tool} is missing")
    return subprocess.run([tool, *args], check=True, capture_output=True, text=True).stdout


def fonts_of(pdf: bytes, folder: Path) -> set[str]:
    path = folder / "fonts.pdf"
    path.write_bytes(pdf)
    lines = poppler("pdffonts", str(path)).splitlines()[2:]
    return {line.split()[0].partition("+")[2] for line in lines}


def pages_of(pdf: bytes, folder: Path) -> list[str]:
    (folder / "text.pdf").write_bytes(pdf)
    return list(_pages(pdf))


@lru_cache(maxsize=4)
def _pages(pdf: bytes) -> tuple[str, ...]:
    with NamedTemporaryFile(suffix=".pdf") as file:
        file.write(pdf)
        file.flush()
        text = poppler("pdftotext", "-layout", file.name, "-")
    return tuple(text.split("\f")[:-1])
