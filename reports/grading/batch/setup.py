"""Options of a run of grading, and its outcome."""

from __future__ import annotations

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
