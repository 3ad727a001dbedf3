"""Options of a run of grading, and its outcome."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from reports.grading.batch.pool import TIMEOUT_S

Effect = tuple[str, float | None, float | None]  # whom, points before and after


@dataclass(frozen=True, slots=True)
class GradeSetup:
    """Options of grading; ``workers`` 0 takes all processors, ``dask`` a cluster instead."""

    workers: int = 0
    dask: str | None = None
    timeout_s: float = TIMEOUT_S
    pdf: bool = False
    decisions: Sequence[tuple[str, str, str, str]] = ()  # who, what, points, remark
    requests: Sequence[tuple[str, str, str]] = ()  # of students: who, column, words
    preview: bool = False  # what decisions would change; nothing is written
    author: str = ""
    worksheet: Path | None = None  # of Moodle, to be filled in
    roster: Path | None = None  # with the deadlines put off since the issue
    memory: Path | None = None  # folder with the traits of earlier classes
    form: Path | None = None  # of the institute, to be filled in
    copies: bool = False  # the students' books back with marks in them
    questions: bool = False  # for the defence
    anonymous: bool = False  # numbers for names on all pages


@dataclass(frozen=True, slots=True)
class Graded:
    """Outcome of a batch."""

    folder: Path
    summary: dict[str, Any]
    reused: int
    seconds: float
    effects: Sequence[Effect] = ()

    @property
    def needs_a_person(self) -> bool:
        """Whether anything could not be decided."""
        return bool(self.summary["manual"])


def progress_words(done: int, count: int, reused: int, started: float) -> str:
    """Progress of the batch and the time left."""
    text = f"Проверка работ: {done} из {count}"
    fresh = done - reused
    if fresh < 3 or done >= count:
        return text
    left = (time.monotonic() - started) / fresh * (count - done)
    return (
        f"{text}, осталось {left / 60:.0f} мин" if left > 90 else f"{text}, осталось {left:.0f} с"
    )
