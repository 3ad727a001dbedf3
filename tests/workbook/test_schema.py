"""Microsoft's schema validator on finished workbooks, where node is present."""

from __future__ import annotations

import shutil
import subprocess
from functools import cache
from pathlib import Path

import pytest

from tests.conftest import missing
from tests.workbook.made import coarse_book

VALIDATOR = "@ooxml-tools/validate@0.4.6"


@cache
def validator() -> str:
    """Path of the validator; a skip where it cannot be fetched."""
    npx = shutil.which("npx")
    if npx is None:
        missing("node", "nodejs npm")
    found = subprocess.run(
        [npx, "--yes", "-p", VALIDATOR, "-c", "command -v ooxml-validate"],
        capture_output=True, text=True, timeout=300, check=False,
    )  # fmt: skip
    if found.returncode:
        pytest.skip("пакет проверки схемой недоступен")
    return found.stdout.strip()


def validated(path: Path) -> str:
    """What the validator says of a file."""
    done = subprocess.run(
        [validator(), str(path), "-f", path.suffix[1:], "--office-version", "Microsoft365"],
        capture_output=True, text=True, timeout=600, check=False,
    )  # fmt: skip
    return (done.stdout + done.stderr)[-3000:]


def test_the_schema_validator_finds_nothing(tmp_path: Path) -> None:
    path = tmp_path / "book.xlsx"
    path.write_bytes(coarse_book("d-240"))
    assert "Found 0 errors" in validated(path)
