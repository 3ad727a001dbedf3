"""A class drawn by chance on a base that no sample holds: honest students, rings, mistakes."""

from __future__ import annotations

import io
import json
import random
import subprocess
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from tempfile import mkdtemp

import pytest
from openpyxl import load_workbook

from reports.grading.issuing import issue as issuing
from reports.grading.issuing.assignment import Assignment
from reports.grading.issuing.issue import assignment_for, issue
from reports.grading.issuing.register import Register
from reports.grading.judging.collusion import Past, PastWork, Ring, rings_of
from reports.grading.judging.marking import Marker
from reports.grading.judging.work_digest import Work, work_of
from reports.grading.reading.submissions import Submission
from reports.model.blocks import TableSpec
from reports.workbook.layout import Layout
from tests.grading.classroom import roster_text
from tests.grading.drawn import manners
from tests.grading.fill import filled_cells, solved_formulas
from tests.grading.real.desk import Desk
from tests.grading.real.typed import typed
from tests.manual.pages import DOCS, blocks


@dataclass(frozen=True)
class Base:
    """An engine of ``kshm new``, ranges of its variants and chapters of its students' books."""

    options: tuple[str, ...]
    bores: tuple[float, float]
    rods: tuple[float, float]
    fill: tuple[str, ...] = ()
    own: str = ""


_FAN = "fan.book"
BASES = {
    "V8": Base(("--cylinders=8", "--layout=v", "--fuel=petrol", "--power=210", "--speed=5600",
                "--bore=94", "--stroke=86"), (92, 96), (150, 157)),
    "one cylinder, two strokes": Base(
        ("--cylinders=1", "--strokes=2", "--fuel=petrol", "--power=9", "--speed=6000",
         "--bore=54", "--stroke=54"), (53, 55), (101, 107)),
    "V6 with strength and a fan": Base(
        ("--cylinders=6", "--layout=v", "--fuel=diesel", "--power=176", "--speed=2100",
         "--bore=130", "--stroke=140", "--strength"), (128, 132), (262, 268),
        ("strength_piston", "strength_pin", "fan"), _FAN),
    "two strokes with strength and a fan": Base(
        ("--cylinders=1", "--strokes=2", "--fuel=petrol", "--power=9", "--speed=6000",
         "--bore=54", "--stroke=54", "--strength"), (53, 55), (101, 107),
        ("strength_piston", "strength_pin", "fan"), _FAN),
}  # fmt: skip
_RANGES = """
[variants]
"geometry.bore_mm" = {{ min = {0}, max = {1}, step = 0.25 }}
"geometry.rod_length_mm" = {{ min = {2}, max = {3}, step = 0.5 }}
"""
_FILL = ("geometry", "masses", "P3_1", "P3_2", "P4_1")
_RUBRIC = """
[work]
fill = {fill}
[credit]
typed = 0.0
"""


@dataclass
class DrawnClass:
    """A class of so many on a base; what its students write is drawn from a seed."""

    base: str
    count: int
    marker: Marker = field(init=False)

    def __post_init__(self) -> None:
        self.marker = Marker(self.register)

    @cached_property
    def folder(self) -> Path:
        return Path(mkdtemp(prefix="kshm-drawn-"))

    @cached_property
    def register(self) -> Register:
        """The register of the class; its books are made when they are handed in."""
        path = self.folder / "base.toml"
        base = BASES[self.base]
        command = [sys.executable, "-m", "reports", "new", *base.options, "-o", str(path)]
        subprocess.run(command, check=True, capture_output=True)
        text = path.read_text(encoding="utf-8")
        text += "\n[calculation]\nstep_deg = 30\n" if "[calculation]" not in text else ""
        if base.own:
            (self.folder / base.own).write_text(own_chapter(), encoding="utf-8")
            text = text.replace("[report]", f'[report]\nbooks = ["{base.own}"]', 1)
        path.write_text(text + _RANGES.format(*base.bores, *base.rods), encoding="utf-8")
        (self.folder / "group.csv").write_text(roster_text(self.count), encoding="utf-8")
        fill = [*_FILL, *base.fill]
        rubric = _RUBRIC.format(fill=json.dumps(fill))
        (self.folder / "rubric.toml").write_text(rubric, encoding="utf-8")
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(issuing.Handouts, "__call__", lambda *given: b"")
            return issue(path, self.folder / "group.csv", self.folder / "issued", seed=11,
                         rubric_file=self.folder / "rubric.toml",
                         secret_file=self.folder / "key").register  # fmt: skip

    @cached_property
    def first(self) -> Assignment:
        return assignment_for(self.register.books[0], self.register.rubric)

    @cached_property
    def _desks(self) -> dict[int, Desk]:
        return {}

    def desk(self, number: int) -> Desk:
        """All that may be known of a student."""
        if number not in self._desks:
            book = self.register.books[number - 1]
            assignment = assignment_for(book, self.register.rubric, self.first)
            layout = Layout.of(assignment.model)
            self._desks[number] = Desk(book, self.register.books[0], assignment, layout)
        return self._desks[number]

    def formulas(self, number: int, texts: Mapping[str, str]) -> dict[str, list[object]]:
        """Formulas of all cells to fill in: these, and the solved book's own spelt by hand."""
        here = self.desk(number)
        collected: dict[str, list[object]] = {
            node: [f"=({str(text)[1:]})" for text in own]
            for node, own in solved_formulas(here.assignment, here.layout).items()
        }
        for node, text in texts.items():
            block = here.assignment.model.tables.get(node.split(".")[0])
            rows = here.layout.rows_of(block) if isinstance(block, TableSpec) else [0]
            if node in collected:
                collected[node] = list(manners.rows_of(text, rows))
        return collected

    def book(self, number: int, texts: Mapping[str, str], helpers: Sequence[str] = ()) -> bytes:
        """The book that a student hands in."""
        data = self.typed(number, self.formulas(number, texts))
        return with_helpers(data, helpers) if helpers else data

    def typed(self, number: int, formulas: Mapping[str, Sequence[object]]) -> bytes:
        """A student's book with formulas or numbers in the cells to fill in."""
        here = self.desk(number)
        cells = filled_cells(here.assignment, here.layout, formulas)  # type: ignore[arg-type]
        return typed(here, cells, self.desk(1))

    def work(self, number: int, data: bytes, shared: dict) -> Work:
        """What the class keeps of a graded book."""
        return work_of(self.result(number, data), shared)

    def result(self, number: int, data: bytes) -> dict:
        file = self.register.books[number - 1].file
        return self.marker.mark(Submission(file, Path(file), None, None), data)

    def drawn(self, seed: int, rings: Sequence[int]) -> Drawn:
        """A class of a seed: honest students and rings of these sizes."""
        chance = random.Random(seed)
        shared: dict = {}
        works, members = [], []
        number = 1
        for size in rings:
            texts, helpers = manners.source(chance)
            ring = range(number, number + size)
            for i in ring:
                own = texts if i == ring[0] else manners.copied(chance, texts)
                works.append(self.work(i, self.book(i, own, helpers), shared))
            members.append(frozenset(ring))
            number += size
        for i in range(number, self.count + 1):
            texts = manners.honest(chance, chance.randrange(len(manners.MANNERS)))
            works.append(self.work(i, self.book(i, texts), shared))
        return Drawn(works, members)


@dataclass(frozen=True)
class Drawn:
    """Works of a class and the numbers of its rings."""

    works: list[Work]
    members: list[frozenset[int]]

    def rings(self, past: Past = ()) -> list[Ring]:
        return rings_of(self.works, past)

    def as_past(self, batch: str) -> list[PastWork]:
        return [PastWork(batch, i, work.traits) for i, work in enumerate(self.works, 1)]

    def named(self, rings: Sequence[Ring], *, held: bool) -> set[int]:
        """Students whom some rings name."""
        return {work.number or 0 for ring in rings if ring.held or not held for work in ring.works}


def own_chapter() -> str:
    """The book of the manual's page about own chapters."""
    (book,) = blocks(DOCS / "own-chapter.md", "book")
    return book


def with_helpers(data: bytes, helpers: Sequence[str]) -> bytes:
    """A book with helper columns of one's own beside a table."""
    book = load_workbook(io.BytesIO(data))
    sheet = book["П3.1"]
    for column, text in enumerate(helpers, 20):
        sheet.cell(5, column).value = f"вспом. {text[1:9]}"
        for row, formula in zip(range(6, 19), manners.rows_of(text, range(6, 19)), strict=True):
            sheet.cell(row, column).value = formula
    stream = io.BytesIO()
    book.save(stream)
    return stream.getvalue()
