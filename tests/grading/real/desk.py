"""A student's place in the class: the variant, and all that may be known of it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
from pathlib import Path
from tempfile import mkdtemp

from reports.grading.issuing.assignment import Assignment
from reports.grading.issuing.issue import assignment_for
from reports.grading.issuing.register import Issued, Register
from reports.model.evaluation import Values, evaluate_model
from reports.workbook.layout import Layout
from tests.cover import ALL
from tests.grading.classroom import registered
from tests.grading.real.written import RUBRIC

COUNT = 160 if ALL else 80


@dataclass(frozen=True, eq=False)
class Desk:
    """All that a student (or a cheat, who has solved the variant) may know."""

    issued: Issued
    other: Issued
    assignment: Assignment
    layout: Layout

    @cached_property
    def values(self) -> Values:
        """The variant solved, where anybody looks."""
        return evaluate_model(self.assignment.model)

    def column(self, node: str) -> list[float]:
        """The right numbers of a column."""
        table, key = node.split(".")
        return [float(v) for v in self.values.columns[table][key]]

    def scalar(self, key: str) -> float:
        """The right number of a scalar."""
        return float(self.values.scalars[key])


@lru_cache(maxsize=1)
def classroom() -> tuple[Path, Register]:
    """The class, issued once."""
    folder = Path(mkdtemp(prefix="kshm-real-"))
    return folder, registered(folder, COUNT, RUBRIC)


@lru_cache(maxsize=1)
def _first() -> Assignment:
    register = classroom()[1]
    return assignment_for(register.books[0], register.rubric)


@lru_cache(maxsize=COUNT)
def desk(number: int) -> Desk:
    """The desk of a student."""
    register = classroom()[1]
    issued = register.books[number - 1]
    other = next(
        book for book in register.books
        if all(book.drawn[key] != issued.drawn[key] for key in issued.drawn)
    )  # fmt: skip
    assignment = assignment_for(issued, register.rubric, _first())
    return Desk(issued, other, assignment, Layout.of(assignment.model))
