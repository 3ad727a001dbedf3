"""Books of the class: an issued work-book with what a student has written in it."""

from __future__ import annotations

import io
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from tempfile import mkdtemp

from openpyxl import Workbook
from openpyxl.worksheet.formula import ArrayFormula

from reports.grading.issuing.assignment import Assignment
from reports.grading.issuing.handout import fill_cells
from reports.grading.issuing.issue import assignment_for
from reports.grading.issuing.register import Issued, Register
from reports.spec.evaluation import Values, evaluate_model
from reports.workbook.layout import Layout
from tests.grading.classroom import opened, registered
from tests.grading.real.written import FIRST, ROWS, RUBRIC, WRITTEN

COUNT = 140
# What is written into the cells of a node: one template for all rows, or a list.
Cells = str | float | None | ArrayFormula | Sequence[str | float | None]
Edit = Callable[[Workbook, "Desk"], None]


@dataclass(frozen=True)
class Desk:
    """All that a student (or a cheat, who has solved the variant) may know."""

    issued: Issued
    other: Issued
    assignment: Assignment
    layout: Layout
    values: Values

    def column(self, node: str) -> list[float]:
        """The right numbers of a column."""
        table, key = node.split(".")
        return [float(v) for v in self.values.columns[table][key]]

    def scalar(self, key: str) -> float:
        """The right number of a scalar."""
        return float(self.values.scalars[key])


@dataclass(frozen=True)
class Work:
    """One student: what differs from the written book."""

    name: str
    change: Callable[[Desk], Mapping[str, Cells]] = lambda desk: {}
    edit: Edit | None = None
    form: str = "own"  # "own", "office", "excel"
    after: Callable[[bytes, Desk], bytes] | None = None
    file: str = ""  # name under which it is handed in
    # What must be said of it.
    verdicts: Mapping[str, str] = field(default_factory=dict)  # items that are not paid in full
    causes: Mapping[str, str] = field(default_factory=dict)
    unpaid: tuple[str, ...] = ()  # items of which a cheat gets nothing
    held: str = ""  # words of why a person decides before any points are given


@lru_cache(maxsize=1)
def classroom() -> tuple[Path, Register]:
    """The class, issued once."""
    folder = Path(mkdtemp(prefix="kshm-real-"))
    return folder, registered(folder, COUNT, RUBRIC)


@lru_cache(maxsize=1)
def _first() -> Assignment:
    register = classroom()[1]
    return assignment_for(register.books[0], register.rubric)


def desk(number: int) -> Desk:
    """The desk of a student."""
    register = classroom()[1]
    issued = register.books[number - 1]
    other = next(
        book for book in register.books
        if all(book.drawn[key] != issued.drawn[key] for key in issued.drawn)
    )  # fmt: skip
    assignment = assignment_for(issued, register.rubric, _first())
    return Desk(issued, other, assignment, Layout.of(assignment.model),
                evaluate_model(assignment.model))  # fmt: skip


def made(number: int, work: Work) -> bytes:
    """The book that a student hands in, before another program saves it."""
    here = desk(number)
    book = opened(here.assignment, here.issued.ticket)
    write(book, here, {**WRITTEN, **work.change(here)})
    if work.edit is not None:
        work.edit(book, here)
    stream = io.BytesIO()
    book.save(stream)
    return stream.getvalue()


def write(book: Workbook, here: Desk, filling: Mapping[str, Cells]) -> None:
    """Put templates into the cells of their nodes."""
    for block in here.assignment.fill:
        sheet = book[block.sheet]
        for node, places in fill_cells(block, here.layout).items():
            if node not in filling:
                continue
            what = filling[node]
            if isinstance(what, ArrayFormula):
                sheet[places[0].coordinate] = what
                continue
            one = isinstance(what, (str, float, int)) or what is None
            texts = [what] * len(places) if one else list(what)  # type: ignore[arg-type]
            for place, text in zip(places, texts, strict=False):  # tables of one turn are shorter
                value = put(text, here, place.row) if isinstance(text, str) else text
                sheet.cell(place.row, place.column).value = value


def put(text: str, here: Desk, row: int) -> str:
    """A template in one row; names in braces are the addresses of given cells."""
    text = text.replace("{r}", str(row))
    while "{" in text and "}" in text and not text.startswith("={"):
        name = text[text.index("{") + 1 : text.index("}")]
        if name not in here.layout.cells:
            break
        text = text.replace("{" + name + "}", here.layout.cells[name].absolute)
    return text


def rows() -> range:
    """Rows of the tables."""
    return range(FIRST, FIRST + ROWS)


def literals(template: str, numbers: Sequence[float]) -> list[str]:
    """A formula with the number of each row in the place of ``{v}``."""
    return [template.replace("{v}", repr(number)) for number in numbers]
