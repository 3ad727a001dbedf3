"""A small class on a coarse grid, issued once for all tests of this folder."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import lru_cache
from pathlib import Path
from tempfile import NamedTemporaryFile, mkdtemp

import pytest
from openpyxl import Workbook

from reports.grading.batch.pool import Outcome
from reports.grading.batch.worker import marking
from reports.grading.issuing import handout as handouts
from reports.grading.issuing import issue as issuing
from reports.grading.issuing.assignment import Assignment
from reports.grading.issuing.issue import Result, assignment_for, issue
from reports.grading.issuing.register import Issued, Register
from reports.grading.judging.marking import Marker
from reports.grading.judging.marking import Result as Marks
from reports.grading.reading.submissions import Submission
from reports.shared.resources import samples_dir

RANGES = """
[variants]
"geometry.bore_mm" = { min = 84, max = 92, step = 0.5 }
"geometry.rod_length_mm" = { min = 144, max = 156, step = 1 }
"regime.speed_rpm" = { min = 4000, max = 4600, step = 50 }
"masses.reciprocating_kg" = { values = [1.8, 1.9, 2.0, 2.1, 2.2] }
"""
SURNAMES = ("Иванов", "Петров", "Сидорова", "Кузнецов", "Попова", "Васильев")


def base_text() -> str:
    """The textbook's diesel at 30° with ranges."""
    text = (samples_dir() / "gots-diesel.toml").read_text(encoding="utf-8")
    assert "step_deg = 10" in text
    return text.replace("step_deg = 10", "step_deg = 30") + RANGES


def roster_text(count: int) -> str:
    """A list of students with different surnames."""
    lines = ["Фамилия;Имя;Группа;Email"]
    for i in range(count):
        number = i // len(SURNAMES)
        surname = (
            SURNAMES[i % len(SURNAMES)] + "аи"[number % 2] * min(number, 1) + "н" * (number // 2)
        )
        lines.append(f"{surname};Имя;ДВС-1;s{i + 1}@example.org")
    return "\n".join(lines) + "\n"


def issue_class(folder: Path, count: int, rubric: str | None = None, *, jobs: int = 1) -> Result:
    """Issue variants to a class into ``folder``."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "base.toml").write_text(base_text(), encoding="utf-8")
    (folder / "group.csv").write_text(roster_text(count), encoding="utf-8")
    rubric_file = None
    if rubric is not None:
        rubric_file = folder / "rubric.toml"
        rubric_file.write_text(rubric, encoding="utf-8")
    return issue(
        folder / "base.toml",
        folder / "group.csv",
        folder / "issued",
        seed=7,
        rubric_file=rubric_file,
        secret_file=folder / "secret.key",
        jobs=jobs,
    )


def registered(folder: Path, count: int, rubric: str) -> Register:
    """A class whose books are made when their students open them."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(issuing.Handouts, "__call__", lambda *given: b"")
        return issue_class(folder, count, rubric).register


def opened(assignment: Assignment, ticket: str) -> Workbook:
    """A work-book as a program holds it: half the time goes into writing and reading it."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(handouts, "_charts", lambda assignment: ())  # most of the other half
        patch.setattr(handouts, "saved", lambda book, caches: book)
        return handouts.handout_bytes(assignment, ticket)


@lru_cache(maxsize=1)
def folder() -> Path:
    """The folder of the class."""
    return Path(mkdtemp(prefix="kshm-class-"))


@lru_cache(maxsize=1)
def register() -> Register:
    """The register of a class of four."""
    return issue_class(folder(), 4).register


def book(number: int = 1) -> Issued:
    """An issued work-book."""
    return register().books[number - 1]


@lru_cache(maxsize=8)
def assignment(number: int = 1) -> Assignment:
    """The tables of a work-book."""
    return assignment_for(book(number), register().rubric)


def handout(number: int = 1) -> bytes:
    """The empty work-book."""
    issued = book(number)
    return (folder() / "issued" / issued.folder / issued.file).read_bytes()


@lru_cache(maxsize=1)
def marker() -> Marker:
    """Grades against the class's register."""
    return Marker(register())


def marks(data: bytes, key: str = "работа.xlsx") -> Marks:
    """The result of one file."""
    return marker().mark(Submission(key, Path(key), None, None), data)


def verdicts(result: Marks) -> dict[str, str]:
    """Item → verdict, without those that are right."""
    return {line["id"]: line["verdict"] for line in result["items"] if line["verdict"] != "right"}


def graded_here(
    submissions: Sequence[Submission], register_file: Path, **_: object
) -> Iterator[Outcome]:
    """What `grade_all` gives, by this process: what becomes of marks needs no others."""
    mark = _marking(register_file.read_text(encoding="utf-8"))
    for submission in submissions:
        yield Outcome(submission, *mark(submission))


@lru_cache(maxsize=4)
def _marking(register_text: str):
    with NamedTemporaryFile("w", suffix=".json", encoding="utf-8") as file:
        file.write(register_text)
        file.flush()
        return marking(Path(file.name))
