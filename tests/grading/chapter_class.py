"""A class of two over the sheets of one chapter, on the textbook's diesel at a coarse step."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from tempfile import mkdtemp
from typing import Any

import pytest

from reports.grading.issuing.assignment import Assignment
from reports.grading.issuing.issue import assignment_for, issue
from reports.grading.issuing.register import Register
from reports.grading.judging.marking import Marker
from reports.grading.reading.submissions import Submission
from reports.shared.resources import samples_dir
from reports.workbook.layout import Layout
from tests.grading.classroom import roster_text
from tests.grading.fill import filled_book, solved_formulas


@dataclass(frozen=True)
class ChapterClass:
    """Sections added to the base, and the rubric."""

    added: str
    rubric: str

    @cached_property
    def _issued(self) -> tuple[Register, Assignment, bytes]:
        folder = Path(mkdtemp(prefix="kshm-chapter-"))
        text = (samples_dir() / "gots-diesel.toml").read_text(encoding="utf-8")
        text = text.replace("step_deg = 10", "step_deg = 30") + self.added
        (folder / "base.toml").write_text(text, encoding="utf-8")
        (folder / "group.csv").write_text(roster_text(2), encoding="utf-8")
        (folder / "rubric.toml").write_text(self.rubric, encoding="utf-8")
        result = issue(
            folder / "base.toml", folder / "group.csv", folder / "issued", seed=7,
            rubric_file=folder / "rubric.toml", secret_file=folder / "secret.key",
        )  # fmt: skip
        book = result.register.books[0]
        data = (folder / "issued" / book.folder / book.file).read_bytes()
        return result.register, assignment_for(book, result.register.rubric), data

    @property
    def assignment(self) -> Assignment:
        """What the first student is asked."""
        return self._issued[1]

    def marks(self, times: dict[str, float] | None = None) -> dict[str, Any]:
        """Result of a book filled in rightly, but for first values taken so many times."""
        register, assignment, handout = self._issued
        right = solved_formulas(assignment, Layout.of(assignment.model))
        changes = {key: [f"{right[key][0]}*{factor}"] for key, factor in (times or {}).items()}
        data = filled_book(handout, assignment, changes)
        return Marker(register).mark(Submission("р.xlsx", Path("р.xlsx"), None, None), data)


def carried_from(chapter: ChapterClass, wrong: str, cause: str) -> set[str]:
    """Items that one wrong first value alone costs, once a right book is right throughout."""
    result = chapter.marks()
    assert unlike_right(result) == {}
    assert result["points"] == pytest.approx(100)
    actual = unlike_right(chapter.marks({wrong: 1.5}))
    assert actual.pop(cause) == "wrong"
    assert set(actual.values()) == {"carried"}
    return set(actual)


def unlike_right(result: dict[str, Any]) -> dict[str, str]:
    """Items that are not right, with their verdicts."""
    return {line["id"]: line["verdict"] for line in result["items"] if line["verdict"] != "right"}
