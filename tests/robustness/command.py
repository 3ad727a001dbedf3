"""``kshm`` as a process of its own, and what it may leave behind."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

from reports.shared.resources import samples_dir

ROOT = Path(__file__).parents[2]
_RUSSIAN = re.compile("[а-яё]", re.IGNORECASE)


def small_input(folder: Path, name: str = "engine") -> Path:
    """The textbook's diesel on a coarse grid."""
    text = (samples_dir() / "gots-diesel.toml").read_text(encoding="utf-8")
    path = folder / f"{name}.toml"
    path.write_text(text.replace("step_deg = 10", "step_deg = 30"), encoding="utf-8")
    return path


def started(
    *arguments: object,
    temporary: Path | None = None,
    output: int = subprocess.DEVNULL,
    before: Callable[[], None] | None = None,
) -> subprocess.Popen[str]:
    """Start a command; ``temporary`` takes its temporary files."""
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "PYTHONIOENCODING": "utf-8"}
    if temporary is not None:
        temporary.mkdir(exist_ok=True)
        environment["TMPDIR"] = str(temporary)
    return subprocess.Popen(
        [sys.executable, "-m", "reports", *map(str, arguments)],
        stdout=output, stderr=subprocess.PIPE, text=True, encoding="utf-8",
        cwd=ROOT, env=environment, preexec_fn=before,  # noqa: PLW1509
    )  # fmt: skip


def refusal(process: subprocess.Popen[str]) -> str:
    """The only line of a command that must fail."""
    _, error = process.communicate()
    assert process.returncode == 2, (process.returncode, error)
    (line,) = error.splitlines()
    assert _RUSSIAN.search(line), line
    assert "Traceback" not in line
    assert "внутренняя ошибка" not in line
    return line


def leftovers(folder: Path) -> list[str]:
    """Temporary files in a folder."""
    return sorted(path.name for path in folder.iterdir() if path.name.startswith((".", "openpyxl")))
