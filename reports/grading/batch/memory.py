"""Memory over years: digests of rare formulas and errors of earlier classes, in a named folder.

A file a class; no name, no variant and no mark is in it.  To forget a class, delete its file.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from datetime import date
from pathlib import Path
from typing import Any

from reports.grading.judging.collusion import PastWork
from reports.grading.judging.work_digest import Work
from reports.shared.errors import InputError, Problem
from reports.shared.files import make_dir, write_text

_FORMAT, _VERSION = "kshm-memory", 1
_FIELDS = 5  # of a trait
_MAX_BYTES = 50_000_000


def remembered(folder: Path, batch: str) -> list[PastWork]:
    """Works of the classes kept in a folder, but for those of ``batch`` itself.

    Raises:
        InputError: a file of the folder is damaged.
    """
    past: list[PastWork] = []
    for path in sorted(folder.glob("*.json")):
        data = _read(path)
        if data["batch"] != batch:
            title = f"{data['date']}, {data['batch'][:6]}"
            past += [
                PastWork(title, number, tuple(tuple(trait) for trait in work))
                for number, work in enumerate(data["works"], 1)
            ]
    return past


def remember(folder: Path, batch: str, works: Sequence[Work]) -> None:
    """Keep the traits of a class; an earlier run of the same class is replaced.

    Raises:
        OutputError: the folder cannot be written.
    """
    make_dir(folder)
    month = f"{date.today():%Y-%m}"
    target = next(folder.glob(f"*-{batch}.json"), folder / f"{month}-{batch}.json")
    # In the order of the digests: that of the list would tell whose they are.
    traits = sorted([list(trait) for trait in work.traits] for work in works if work.traits)
    data = {"format": _FORMAT, "version": _VERSION, "batch": batch,
            "date": target.name[: len(month)], "works": traits}  # fmt: skip
    write_text(target, json.dumps(data, ensure_ascii=False) + "\n")


def kept_past(path: Path) -> list[PastWork]:
    """Tell what an earlier run has kept of earlier classes."""
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
        return [PastWork(b, n, tuple(map(tuple, traits))) for b, n, *traits in data]
    except (OSError, ValueError, TypeError):
        return []


def keep_past(path: Path, past: Sequence[PastWork]) -> None:
    """Keep what was remembered beside the results: decisions come without the memory."""
    data = [[work.batch, work.number, *map(list, work.traits)] for work in past]
    write_text(path, json.dumps(data, ensure_ascii=False) + "\n")


def _read(path: Path) -> dict[str, Any]:
    try:
        if path.stat().st_size > _MAX_BYTES:
            raise ValueError
        data = json.loads(path.read_text(encoding="utf-8"))
        whole = data["format"] == _FORMAT and data["version"] == _VERSION
        traits = [trait for work in data["works"] for trait in work]
        texts = all(len(t) == _FIELDS and all(isinstance(f, str) for f in t) for t in traits)
        if not (whole and texts and isinstance(data["batch"], str)):
            raise ValueError
    except (OSError, ValueError, TypeError, KeyError):
        problem = "это не память прошлых лет или она повреждена"
        raise InputError(
            Problem(str(path), problem, "удалите файл или верните его копию")
        ) from None
    return dict(data)
