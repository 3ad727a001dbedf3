"""What in a work tells who wrote it: rare formulas, mistakes, idle steps, helper columns.

A formula of the textbook, however it is spelt, tells nothing; how rare the rest is, the class
tells (``similarity``).  A trait is a digest: no name, no number and no mark is in it.
"""

from __future__ import annotations

import hashlib
import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from reports.grading.issuing.assignment import Assignment
from reports.grading.judging.canonical import Reader, Tree, leaves, subtrees
from reports.grading.judging.judgement import EMPTY, WRONG
from reports.grading.judging.work_digest import Trait, idle_steps
from reports.grading.reading.restoring import own_formulas
from reports.grading.reading.student import StudentBook
from reports.recalculation.formulas import Formula, Token, render
from reports.recalculation.grid import Run
from reports.shared.errors import UnknownFormula
from reports.workbook.layout import Layout

FORM, SLIP, ERROR, IDLE, HELPER, TEXT, LAYOUT, NAME = (
    "form", "slip", "error", "idle", "helper", "text", "layout", "name",
)  # fmt: skip
_MAX_HELPERS = 300  # runs outside the tables that are looked at
_LONGEST = 300  # signs of a formula that a person compares
_PASTED = 6  # formulas of the program on a sheet that green cells only refer to
_TELLING = 6  # tokens of a formula that may tell who wrote it
_MAX_NAMES = 100  # sets of names for which trees are kept
Names = frozenset[tuple[str, tuple[str, int, int]]]
_PLAIN_TITLES = ("лист", "sheet", "таблица")
_ISSUED_NAMES = ("col_", "cell_", "_xlnm", "_xlfn", "_xlpm", "kshm", "print_", "_filter")
_HABIT = 8  # columns in which a step that does nothing is a manner of writing
_CELL = re.compile(r"R(\[?)(-?\d+)\]?C(\[?)(-?\d+)\]?")


def digest(value: object) -> str:
    """Sixteen signs that tell things from each other."""
    return hashlib.sha256(repr(value).encode()).hexdigest()[:16]


@dataclass
class Textbook:
    """The formulas of the textbook as trees, the same for a class."""

    assignment: Assignment
    layout: Layout
    known: dict[tuple[str, Formula, int, Names], Tree | None] = field(default_factory=dict)
    names_of: dict[Names, Names] = field(default_factory=dict)  # each set of names once

    @cached_property
    def formulas(self) -> dict[str, tuple[Formula, ...]]:
        """Node → the program's formula in each row."""
        return own_formulas(self.assignment, self.layout, self.assignment.fill_nodes)

    @cached_property
    def patterns(self) -> frozenset[tuple[Token, ...]]:
        """The program's formulas that are long enough to tell."""
        return frozenset(
            formula.pattern
            for formulas in self.formulas.values()
            for formula in formulas
            if len(formula.pattern) >= _TELLING
        )

    @cached_property
    def trees(self) -> dict[str, Tree]:
        """Node → its tree."""
        reader = Reader(self._node_at, lambda *_: None, lambda *_: None, self._named)
        trees = {}
        for node, formulas in self.formulas.items():
            formula = Counter(formulas).most_common(1)[0][0]
            index = formulas.index(formula)
            sheet, rows, column = self.places[node]
            try:
                trees[node] = reader.tree(formula.pattern, (sheet, rows[index], column), index)
            except UnknownFormula:
                continue
        return trees

    @cached_property
    def parts(self) -> frozenset[Tree]:
        """All that stands in the formulas, by itself."""
        return frozenset(part for tree in self.trees.values() for part in subtrees(tree))

    @cached_property
    def places(self) -> dict[str, tuple[str, tuple[int, ...], int]]:
        """Sheet, rows and column of each name, as issued."""
        layout = self.layout
        locations: dict[str, tuple[str, tuple[int, ...], int]] = {
            name: (cell.sheet, (cell.row,), cell.column) for name, cell in layout.cells.items()
        }
        for name, (table, column) in layout.columns.items():
            locations[name] = (table.sheet, tuple(layout.rows_of(table)), column)
        return locations

    @cached_property
    def cells(self) -> dict[tuple[str, int, int], tuple[str, int, int]]:
        """Cell → its name, the index of its value and how many there are, as issued."""
        return {
            (sheet, row, column): (name, index, len(rows))
            for name, (sheet, rows, column) in self.places.items()
            for index, row in enumerate(rows)
        }

    def _node_at(self, sheet: str, row: int, column: int) -> tuple[str, int, int] | None:
        return self.cells.get((sheet, row, column))

    def _named(self, name: str) -> tuple[str, int, int] | None:
        return self.names.get(name)

    @cached_property
    def names(self) -> dict[str, tuple[str, int, int]]:
        """Name, folded by case → its cell, as issued."""
        cells = self.layout.cells
        return {
            name.casefold(): (cell.sheet, cell.row, cell.column) for name, cell in cells.items()
        }


class OwnFormulas:
    """Trees of one student's formulas."""

    def __init__(self, student: StudentBook, book: Textbook) -> None:
        self.student, self.book = student, book

    @cached_property
    def _cells(self) -> dict[tuple[str, int, int], tuple[str, int, int]]:
        if self.student.as_laid_out:
            return self.book.cells
        return {
            (location.sheet, row, location.column): (name, index, len(location.rows))
            for name, location in self.student.placement.places.items()
            for index, row in enumerate(location.rows)
            if row is not None
        }

    def node_at(self, sheet: str, row: int, column: int) -> tuple[str, int, int] | None:
        """Name, index and length of the value of a cell."""
        return self._cells.get((self._title(sheet), row, column))

    def _title(self, sheet: str) -> str:
        return self.student.grid.title(sheet) or sheet

    def formula_at(self, sheet: str, row: int, column: int) -> tuple[Token, ...] | None:
        """Tokens of the formula of a cell."""
        for run in self.student.grid.column(self._title(sheet), column).runs_in(row, row):
            return run.formula.pattern if run.formula is not None else None
        return None

    def _constant_at(self, sheet: str, row: int, column: int) -> object:
        return self.student.grid.constant(self._title(sheet), row, column)

    def _named(self, name: str) -> tuple[str, int, int] | None:
        area = self.student.grid.named(name)
        return (area.sheet, area.first_row, area.first_column) if area is not None else None

    def tree(self, run: Run, node: str = "") -> Tree | None:
        """Tree of a run; that of a table is known where another student has it too."""
        if run.formula is None:
            return None
        known = self.node_at(run.sheet, run.first, run.column)
        index = known[1] if known is not None else 0
        key = node, run.formula, index, self._names
        shared = bool(node) and self.student.as_laid_out
        if shared and key in self.book.known:
            return self.book.known[key]
        # Kept nowhere: a circle of references would keep the whole book with it.
        reader = Reader(self.node_at, self.formula_at, self._constant_at, self._named)
        try:
            at = run.sheet, run.first, run.column
            tree: Tree | None = reader.tree(run.formula.pattern, at, index)
        except (UnknownFormula, RecursionError):
            tree = None
        if shared and not reader.helped and len(self.book.known) < 50_000:
            self.book.known[key] = tree
        return tree

    @cached_property
    def _names(self) -> Names:
        """Names of the book with their cells: the very same set for all books that have it."""
        grid = self.student.grid
        areas = ((name, (a.sheet, a.first_row, a.first_column)) for name, a in grid.areas.items())
        names = frozenset((*grid.names.items(), *areas))
        if len(self.book.names_of) > _MAX_NAMES:  # a class must not fill the memory
            self.book.names_of.clear()
            self.book.known.clear()
        return self.book.names_of.setdefault(names, names)

    @cached_property
    def helpers(self) -> list[Run]:
        """Runs outside the tables, as many as are looked at."""
        runs = (
            run
            for run in self.student.grid.runs()
            if run.formula is not None and self.node_at(run.sheet, run.first, run.column) is None
        )
        return [run for run, _ in zip(runs, range(_MAX_HELPERS), strict=False)]


def traits_of(formulas: OwnFormulas, lines: Sequence[Mapping[str, Any]]) -> list[Trait]:
    """Traits of a work; ``lines`` are those of its feedback."""
    student, book = formulas.student, formulas.book
    by_item = {line["id"]: line for line in lines}
    traits: list[Trait] = []
    idle: list[tuple[str, list[str], str]] = []
    for item in student.assignment.items:
        line = by_item[item.id]
        runs = [_main(student.runs(node)) for node in item.nodes]
        if line["verdict"] == EMPTY or any(run is None or run.formula is None for run in runs):
            continue
        patterns = [run.formula.pattern for run in runs if run is not None and run.formula]
        spelt = digest([_spelling(run) for run in runs if run is not None])
        if steps := [step for tokens in patterns for step in idle_steps(tokens)]:
            idle.append((item.id, steps, spelt))
        pairs = list(zip(item.nodes, runs, strict=True))
        trees = [formulas.tree(run, node) for node, run in pairs if run is not None]
        right = [book.trees.get(node) for node in item.nodes]
        if trees == right or None in trees:
            continue
        mark = digest(trees)
        if line["verdict"] == WRONG:
            kind = SLIP if line["cause"] else ERROR
            traits.append((kind, item.id, mark, spelt, line["cause"] or item.id))
        else:
            traits.append((FORM, item.id, mark, spelt, _manner(trees, right) or item.id))
    return [*traits, *_idle_traits(idle), *_helper_traits(formulas), *_name_traits(formulas)]


def texts_of(student: StudentBook, traits: Sequence[Trait]) -> dict[str, str]:
    """Return the formulas of the items of some traits as they stand in their first rows."""
    telling = {item for _, item, *_ in traits}
    texts = {}
    for item in student.assignment.items:
        run = _main(student.runs(item.nodes[0])) if item.id in telling else None
        if run is not None and run.formula is not None:
            texts[item.id] = render(run.formula.pattern, run.first, run.column)[:_LONGEST]
    return texts


def _idle_traits(idle: Sequence[tuple[str, list[str], str]]) -> list[Trait]:
    """Idle steps by column and kind; what stands in column after column is one habit."""
    times = Counter(step for _, steps, _ in idle for step in {*steps})
    return [
        (IDLE, item, digest(steps), spelt, steps[0] if times[steps[0]] > _HABIT else item)
        for item, steps, spelt in idle
    ]


def _spelling(run: Run) -> tuple[tuple[str, str], ...]:
    """Tokens of a formula without spaces and without what ``$`` alone makes different."""
    assert run.formula is not None

    def placed(match: re.Match[str]) -> str:
        down, row, across, column = match.groups()
        at = int(column) + (run.column if across else 0)
        if run.count == 1 and down:
            down, row = "", str(int(row) + run.first)
        return f"R{down}{row}C{at}"

    return tuple(
        (kind, _CELL.sub(placed, value) if kind == "ref" else value.upper())
        for kind, value in run.formula.pattern
        if kind != "space"
    )


def _name_traits(formulas: OwnFormulas) -> list[Trait]:
    """Names that a student has given to cells himself."""
    grid = formulas.student.grid
    names = {*grid.names, *grid.areas} - formulas.book.names.keys()
    return [
        (NAME, "", digest(name), digest(name), "")
        for name in sorted(names)
        if len(name) > 1 and not name.startswith(_ISSUED_NAMES)
    ][:_MAX_HELPERS]


def _main(runs: Sequence[Run]) -> Run | None:
    return max(runs, key=lambda run: run.count, default=None)


def _manner(trees: Sequence[Tree | None], right: Sequence[Tree | None]) -> str:
    """Functions that a formula has and the textbook has not: one manner for all its items."""
    mine, theirs = (
        {leaf for tree in side if tree is not None for leaf in leaves(tree) if "(" not in leaf}
        for side in (trees, right)
    )
    return " ".join(sorted(mine - theirs))


def _helper_traits(formulas: OwnFormulas) -> list[Trait]:
    traits: dict[Trait, None] = {}
    book, grid = formulas.book, formulas.student.grid
    columns: set[tuple[str, int]] = set()
    for run in formulas.helpers:
        tree = formulas.tree(run)
        if tree is None or tree in book.parts or tree[0] in ("num", "node", "text", "blank"):
            continue
        assert run.formula is not None
        traits[HELPER, "", digest(tree), digest(run.formula.pattern), ""] = None
        columns.add((run.sheet, run.column))
        above = grid.constant(run.sheet, run.first - 1, run.column)
        if isinstance(above, str) and len(above.strip()) > 2:
            text = digest("".join(filter(str.isalnum, above.casefold())))
            traits[TEXT, "", text, text, ""] = None
    issued = {sheet for sheet, _, _ in book.places.values()}
    for title in {run.sheet for run in formulas.helpers} - issued:
        if not title.casefold().startswith(_PLAIN_TITLES):
            mark = digest(("sheet", title.casefold()))
            traits[TEXT, "", mark, mark, ""] = None
    if len(columns) > 2:  # whatever a sheet of one's own is called
        mark = digest(sorted((title if title in issued else "", at) for title, at in columns))
        traits[LAYOUT, "", mark, mark, ""] = None
    return list(traits)


def pasted(formulas: OwnFormulas) -> str:
    """The sheet of the program's own formulas that green cells only refer to, empty without one."""
    student, book = formulas.student, formulas.book
    of_program: Counter[str] = Counter()
    for node in student.assignment.fill_nodes:
        run = _main(student.runs(node))
        if run is None or run.formula is None:
            continue
        kinds = [kind for kind, _ in run.formula.pattern if kind != "space"]
        if kinds not in (["ref"], ["sheet", "ref"]):
            continue
        for area in student.grid.precedents(run):
            at = (area.sheet, area.first_row, area.first_column)
            tokens = None if formulas.node_at(*at) else formulas.formula_at(*at)
            if tokens is not None and tokens in book.patterns:
                of_program[area.sheet] += 1
    sheet, count = of_program.most_common(1)[0] if of_program else ("", 0)
    return sheet if count >= _PASTED else ""
