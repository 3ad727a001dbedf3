"""The class handed in and graded, once for all tests."""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from tempfile import mkdtemp
from typing import Any

import pytest

from reports.grading.batch import grade as grading
from tests.grading.classroom import graded_here
from tests.grading.forms import as_excel
from tests.grading.real.books import Work, made
from tests.grading.real.cheats import CHEATS
from tests.grading.real.desk import classroom, desk
from tests.grading.real.honest import HONEST
from tests.grading.real.mistakes import MISTAKES
from tests.grading.real.together import NAMES, paired, together
from tools.referees.by_libreoffice import LibreOffice


@lru_cache(maxsize=1)
def works() -> tuple[Work, ...]:
    """What is handed in, in the order of the students."""
    return (*paired(HONEST), *together(MISTAKES), *together(CHEATS))


@dataclass(frozen=True)
class Marked:
    """A work with its row of the gradebook and its result."""

    number: int
    work: Work
    row: dict[str, Any]
    result: dict[str, Any]

    @property
    def lines(self) -> dict[str, dict[str, Any]]:
        """Lines of the feedback by item."""
        return {line["id"]: line for line in self.result["items"]}


def books() -> dict[int, bytes]:
    """Number of the student → the file handed in."""
    collected = {number: made(number, work) for number, work in enumerate(works(), 1)}
    office = [number for number, work in enumerate(works(), 1) if work.form == "office"]
    saved = LibreOffice().converted([collected[number] for number in office])
    collected |= dict(zip(office, saved, strict=True))
    for number, work in enumerate(works(), 1):
        if work.form == "excel":
            collected[number] = as_excel(collected[number])
        if work.after is not None:
            collected[number] = work.after(collected[number], desk(number))
    return collected


@lru_cache(maxsize=1)
def marked() -> dict[str, Marked]:
    """Name of the work → what came of it."""
    folder, register = classroom()
    submitted, out = folder / "submitted", Path(mkdtemp(prefix="kshm-real-out-"))
    if not submitted.exists():
        submitted.mkdir()
        for number, data in books().items():
            issued = register.books[number - 1]
            (submitted / issued.file).write_bytes(data)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(grading, "grade_all", graded_here)
        done = grading.grade(folder / "issued", submitted, out, secret_file=folder / "secret.key")
    rows = {row["number"]: row for row in done.summary["rows"] if row["number"]}
    results = [json.loads(p.read_text(encoding="utf-8")) for p in (out / "results").glob("*.json")]
    by_file = {result["key"]: result for result in results if "key" in result}
    return {
        name: Marked(number, work, rows[number], by_file[register.books[number - 1].file])
        for number, work in enumerate(works(), 1)
        for name in work.name.split(NAMES)
    }
