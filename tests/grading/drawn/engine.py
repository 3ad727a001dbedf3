"""A small class on a base file, whose first student fills in the solved book's formulas."""

from __future__ import annotations

import io
import random
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from tempfile import mkdtemp

import numpy as np
import pytest
import tomlkit
from openpyxl.utils import get_column_letter

from reports.grading.issuing import issue as issuing
from reports.grading.issuing.assignment import Assignment
from reports.grading.issuing.issue import assignment_for, issue
from reports.grading.issuing.register import Register
from reports.grading.judging.marking import Marker, Result
from reports.grading.reading.submissions import Submission
from reports.inputs.fields import to_mapping
from reports.model.evaluation import Evaluation
from reports.workbook.layout import Layout
from tests.conftest import sample
from tests.grading.classroom import opened, roster_text
from tests.grading.drawn.entries import Hand
from tests.grading.fill import Formula, filled_book, solved_formulas


@dataclass(frozen=True, eq=False)
class Engine:
    """A small class on a base file, filled in by the solved book's formulas."""

    base: str
    fill: tuple[str, ...]
    book: str = ""  # of the department, beside the base
    count: int = 2
    seed: int = 5

    @cached_property
    def register(self) -> Register:
        folder = Path(mkdtemp(prefix="kshm-entries-"))
        (folder / "base.toml").write_text(self.base, encoding="utf-8")
        (folder / "вентилятор.book").write_text(self.book, encoding="utf-8")
        (folder / "group.csv").write_text(roster_text(self.count), encoding="utf-8")
        rubric = tomlkit.dumps({"work": {"fill": list(self.fill)}})
        (folder / "rubric.toml").write_text(rubric, encoding="utf-8")
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(issuing.Handouts, "__call__", lambda *given: b"")
            return issue(folder / "base.toml", folder / "group.csv", folder / "issued",
                         seed=self.seed, rubric_file=folder / "rubric.toml",
                         secret_file=folder / "key").register  # fmt: skip

    @cached_property
    def marker(self) -> Marker:
        return Marker(self.register)

    @cached_property
    def assignment(self) -> Assignment:
        return assignment_for(self.register.books[0], self.register.rubric)

    @cached_property
    def layout(self) -> Layout:
        return Layout.of(self.assignment.model)

    @cached_property
    def right(self) -> dict[str, list[Formula]]:
        return solved_formulas(self.assignment, self.layout)

    @cached_property
    def empty(self) -> bytes:
        stream = io.BytesIO()
        opened(self.assignment, self.register.books[0].ticket).save(stream)
        return stream.getvalue()

    def marked(self, changes: dict[str, list[Formula]]) -> Result:
        """The result of the first student's book with other cells in some nodes."""
        data = filled_book(self.empty, self.assignment, changes)
        return self.marker.mark(Submission("р.xlsx", Path("р.xlsx"), None, None), data)

    def rows(self, node: str) -> list[int]:
        """Rows of a node's cells on its sheet."""
        if node in self.layout.columns:
            return list(self.layout.rows_of(self.layout.columns[node][0]))
        return [self.layout.cells[node].row]

    def values(self, number: int) -> dict[str, list[Formula]]:
        """Node → the right numbers of a student's variant."""
        run = Evaluation(
            assignment_for(self.register.books[number - 1], self.register.rubric).model
        )
        return {node: np.ravel(run.value(node)).tolist() for node in self.right}

    def hand(self, node: str, chance: random.Random) -> Hand:
        layout = self.layout
        names = [name for name in self.assignment.model.fields if name in layout.cells]
        if node in layout.columns:
            column = layout.columns[node][1]
            letters = get_column_letter(column)
            names += [f"{get_column_letter(c)}{{r}}" for c in range(1, column)] * 5
        else:
            letters = get_column_letter(layout.cells[node].column)
        names += [name for name in self.assignment.model.scalars if name in layout.cells]
        return Hand(chance, self.right[node], self.rows(node), letters, names)


def base_of(name: str, variants: dict[str, object], **more: object) -> str:
    """A sample at a coarse step with ranges and other sections."""
    raw = to_mapping(sample(name)) | more
    raw["calculation"]["step_deg"] = 30
    return tomlkit.dumps(raw | {"variants": variants})
