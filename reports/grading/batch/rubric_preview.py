"""Who gains and who loses by another rubric, before it is applied."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from reports.grading.batch.decisions import FILE
from reports.grading.batch.grade import grade
from reports.grading.batch.setup import Effect, GradeSetup
from reports.shared.errors import InputError, Problem
from reports.shared.files import read_json

_SUMMARY = "summary.json"


def rubric_effects(
    issued: Path, submitted: Path, folder: Path, rubric_file: Path,
    *, secret_file: Path | None = None, options: GradeSetup | None = None,
) -> list[Effect]:  # fmt: skip
    """Return the students with their points under the rubric of today and under another.

    What people have decided stands in both; nothing of ``folder`` is changed.

    Raises:
        InputError: nothing has been graded into the folder, or the rubric is wrong.
    """
    before = _points(read_json(folder / _SUMMARY))
    if not before:
        hint = "сначала проверьте работы без --preview"
        raise InputError(Problem(str(folder), "здесь нет проверенных работ", hint))
    with tempfile.TemporaryDirectory(prefix="kshm-rubric-") as name:
        other = Path(name) / "graded"
        other.mkdir()
        if (folder / FILE).exists():
            shutil.copy2(folder / FILE, other / FILE)
        done = grade(issued, submitted, other, rubric_file=rubric_file, secret_file=secret_file,
                     options=options)  # fmt: skip
    after = _points(done.summary)
    return [(who, before.get(who), after.get(who)) for who in dict.fromkeys([*before, *after])]


def _points(summary: Mapping[str, Any]) -> dict[str, float | None]:
    """Return the points of each student who has any, those that wait for a decision among them."""
    rows = (row for row in summary.get("rows", ()) if row["number"])
    return {row["student"]: row["provisional"] for row in rows if row["provisional"] is not None}
