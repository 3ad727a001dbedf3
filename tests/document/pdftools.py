"""Tools of the document tests: text and fonts of a PDF through poppler."""

import os
import shutil
import subprocess
from pathlib import Path

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
    path = folder / "text.pdf"
    path.write_bytes(pdf)
    return poppler("pdftotext", "-layout", str(path), "-").split("\f")[:-1]
