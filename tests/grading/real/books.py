"""Books of the class: an issued work-book with what a student has written in it."""

from __future__ import annotations

import io
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from openpyxl import Workbook
from openpyxl.worksheet.formula import ArrayFormula

from reports.grading.issuing.handout import fill_cells
from reports.workbook.layout import Cell
from tests.grading.classroom import opened
from tests.grading.fill import Value
from tests.grading.real.desk import Desk, desk
from tests.grading.real.typed import typed
from tests.grading.real.written import FIRST, ROWS, WRITTEN

# What is written into the cells of a node: one template for all rows, or a list.
Cells = str | float | None | ArrayFormula | Sequence[str | float | None]
Edit = Callable[[Workbook, "Desk"], None]


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


def made(number: int, work: Work) -> bytes:
    """The book that a student hands in, before another program saves it."""
    here = desk(number)
    if work.edit is None:
        return typed(here, values(here, filling(here, work)))
    return saved(here, filling(here, work), work.edit)


def filling(here: Desk, work: Work) -> dict[str, Cells]:
    """What a student writes, node by node."""
    return {**WRITTEN, **work.change(here)}


def saved(here: Desk, filled: Mapping[str, Cells], edit: Edit | None = None) -> bytes:
    """A book as openpyxl writes it."""
    book = opened(here.assignment, here.issued.ticket)
    for position, value in values(here, filled).items():
        sheet = book[position.sheet]
        if isinstance(value, ArrayFormula):
            sheet[position.coordinate] = value
        else:
            sheet.cell(position.row, position.column).value = value
    if edit is not None:
        edit(book, here)
    stream = io.BytesIO()
    book.save(stream)
    return stream.getvalue()


def values(here: Desk, filled: Mapping[str, Cells]) -> dict[Cell, Value]:
    """Templates in the cells of their nodes."""
    collected: dict[Cell, Value] = {}
    for block in here.assignment.fill:
        for node, places in fill_cells(block, here.layout).items():
            if node not in filled:
                continue
            what = filled[node]
            if isinstance(what, ArrayFormula):
                collected[places[0]] = what
                continue
            one = isinstance(what, (str, float, int)) or what is None
            texts = [what] * len(places) if one else list(what)  # type: ignore[arg-type]
            for position, text in zip(
                places, texts, strict=False
            ):  # tables of one turn are shorter
                collected[position] = (
                    put(text, here, position.row) if isinstance(text, str) else text
                )
    return collected


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
