"""Test of a rubric: sample works of known points, made from the base and graded by it."""

from __future__ import annotations

import io
import tomllib
from collections.abc import Iterable
from dataclasses import dataclass
from datetime import timedelta
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Annotated, Any

from openpyxl import load_workbook
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from reports.formula.excel import compile_formula
from reports.grading.issuing.assignment import Assignment, Item
from reports.grading.issuing.handout import fill_cells, handout_bytes
from reports.grading.issuing.issue import assignment_for, load_base
from reports.grading.issuing.register import Issued, Register, ticket
from reports.grading.issuing.roster import Student
from reports.grading.issuing.rubric import Rubric, load_rubric
from reports.grading.judging.marking import Marker
from reports.grading.reading.submissions import MOODLE, Submission
from reports.inputs.normalise import read_text
from reports.model.blocks import TableSpec
from reports.model.evaluation import Evaluation
from reports.shared.errors import InputError, Problem
from reports.workbook.layout import Cell, Layout, RowReferences, at_row

_POINTS_TOLERANCE = 0.05  # points: what is given in the file is rounded by hand
Names = Annotated[tuple[str, ...], Field(max_length=100)]
Content = str | float | None


class Sample(BaseModel):
    """[[works]]: a right work but for the items that are named, and the points it must get."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    name: Annotated[str, Field(min_length=1, max_length=200)]
    points: Annotated[float, Field(ge=0)]
    empty: Names = ()
    typed: Names = ()
    wrong: Names = ()
    hours_late: Annotated[float, Field(ge=0)] = 0.0


@dataclass(frozen=True, slots=True)
class TrialResult:
    """A sample with the points that the rubric gives."""

    sample: Sample
    points: float

    @property
    def is_as_expected(self) -> bool:
        """Whether the points are those of the sample."""
        return abs(self.points - self.sample.points) <= _POINTS_TOLERANCE


def try_rubric(
    base_file: Path, samples_file: Path, *, rubric_file: Path | None, ranges_file: Path | None
) -> list[TrialResult]:
    """Grade sample works made from the base.

    Raises:
        InputError: everything that is wrong with the files.
    """
    base, rubric = load_base(base_file, ranges_file), load_rubric(rubric_file)
    identifier = ticket(b"trial", batch="trial", student="1", file="1.xlsx", variant=base.raw)
    student = Student("1", "Пробная", "Работа")
    book = Issued(1, student, "1", "1.xlsx", identifier, {}, base.raw)
    assignment = assignment_for(book, rubric)
    samples = _samples(samples_file, assignment)
    marker = Marker(Register("trial", 1, base.source, rubric, (book,)))
    solved = _Solved(assignment, handout_bytes(assignment, identifier))
    return [
        TrialResult(
            sample, float(marker.mark(_handed(sample, rubric), solved.book(sample))["points"])
        )
        for sample in samples
    ]


def _samples(path: Path, assignment: Assignment) -> list[Sample]:
    names = {name for item in assignment.items for name in (item.id, item.block)}
    try:
        works = tomllib.loads(read_text(path)).get("works", [])
        samples = [Sample.model_validate(work) for work in works]
    except (tomllib.TOMLDecodeError, ValidationError, AttributeError, TypeError):
        problem = "это не список пробных работ"
        hint = 'нужны разделы [[works]] с ключами name и points; ещё empty, typed, wrong = ["P3_1"]'
        raise InputError(Problem(path.name, problem, hint)) from None
    problems = [
        Problem(f"{path.name}: {sample.name}", f"нет таблицы или столбца {name}", "исправьте имя")
        for sample in samples
        for name in (*sample.empty, *sample.typed, *sample.wrong)
        if not any(fnmatchcase(one, name) for one in names)
    ]
    if not samples:
        problems.append(Problem(path.name, "нет ни одной пробной работы", "впишите [[works]]"))
    if problems:
        raise InputError(problems)
    return samples


def _handed(sample: Sample, rubric: Rubric) -> Submission:
    deadline = rubric.late.deadline
    time = deadline and deadline.replace(tzinfo=None) + timedelta(hours=sample.hours_late)
    return Submission("1.xlsx", Path("1.xlsx"), None, time, clock=MOODLE)


class _Solved:
    """The solved work-book, and copies of it with some items filled in otherwise."""

    def __init__(self, assignment: Assignment, handout: bytes) -> None:
        self.assignment, self.layout = assignment, Layout.of(assignment.model)
        self.values = Evaluation(assignment.model)
        self._book: Any = load_workbook(io.BytesIO(handout))
        self._formulas = {
            cell: text
            for block in assignment.fill
            for node, cells in fill_cells(block, self.layout).items()
            for cell, text in self._of(node, block, cells)
        }
        self._write(self._formulas)

    def _of(self, node: str, block: object, cells: list[Cell]) -> Iterable[tuple[Cell, str]]:
        table = block if isinstance(block, TableSpec) else None
        expression = self.assignment.graph.expression(node) or "0"
        text = compile_formula(expression, RowReferences(self.layout, table))
        for cell in cells:
            yield cell, at_row(text, cell.row, last=cell is cells[-1]) if table else text

    def _write(self, content: dict[Cell, Any]) -> None:
        for cell, value in content.items():
            self._book[cell.sheet].cell(cell.row, cell.column).value = value

    def book(self, sample: Sample) -> bytes:
        """Return the work of a sample."""
        changes: dict[Cell, Content] = {}
        for item in self.assignment.items:
            for names, change in (
                (sample.wrong, self._wrong), (sample.typed, self._typed), (sample.empty, _nothing),
            ):  # fmt: skip
                if any(fnmatchcase(n, name) for n in (item.id, item.block) for name in names):
                    changes |= change(item, self._cells(item))
        self._write(changes)
        stream = io.BytesIO()
        self._book.save(stream)
        self._write({cell: self._formulas[cell] for cell in changes})
        return stream.getvalue()

    def _cells(self, item: Item) -> dict[str, list[Cell]]:
        block = next(block for block in self.assignment.fill if block.id == item.block)
        cells = fill_cells(block, self.layout)
        return {node: cells[node] for node in item.nodes}

    def _wrong(self, item: Item, cells: dict[str, list[Cell]]) -> dict[Cell, Content]:
        return {
            cell: f"=1.7*({self._formulas[cell][1:]})+3"
            for cells_of in cells.values()
            for cell in cells_of
        }

    def _typed(self, item: Item, cells: dict[str, list[Cell]]) -> dict[Cell, Content]:
        typed: dict[Cell, Content] = {}
        for node, cells_of in cells.items():
            value: Any = self.values.value(node)
            numbers = [value] if isinstance(value, (str, float, int)) else list(value)
            typed |= {c: float(v) for c, v in zip(cells_of, numbers, strict=True)}
        return typed


def _nothing(item: Item, cells: dict[str, list[Cell]]) -> dict[Cell, Content]:
    return {cell: None for cells_of in cells.values() for cell in cells_of}
