"""What was handed in before: kept beside the work that counts, each under its time."""

from __future__ import annotations

import shutil
from datetime import datetime
from pathlib import Path

from reports.shared.files import make_dir

_FOLDER = "earlier"
_MOST = 20  # of one student: thirty megabytes each


def keep_earlier(work: Path, coming: Path) -> None:
    """Copy a work that counts aside before ``coming`` takes its place; the same file once."""
    if not work.exists() or work.read_bytes() == coming.read_bytes():
        return
    make_dir(_folder(work))
    when = datetime.fromtimestamp(work.stat().st_mtime)
    shutil.copy2(work, _folder(work) / f"{when:%Y-%m-%d %H-%M-%S-%f}{work.suffix}")
    for old in earlier(work)[:-_MOST]:
        old.unlink(missing_ok=True)


def earlier(work: Path) -> list[Path]:
    """Works of the same student that have counted before, the first first."""
    return sorted(_folder(work).glob(f"*{work.suffix}"))


def _folder(work: Path) -> Path:
    return work.parent / _FOLDER / work.stem
