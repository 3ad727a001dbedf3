"""Work-books as a student fills them in: the book's formulas, with seeded defects."""

from __future__ import annotations

import io
import re
import zipfile
from collections.abc import Callable, Mapping
from functools import lru_cache
from html import escape

from openpyxl import Workbook, load_workbook
from openpyxl.cell.cell import ERROR_CODES
from openpyxl.compat import safe_string
from openpyxl.worksheet.formula import ArrayFormula

from reports.formula.excel import compile_formula, number
from reports.grading.issuing.assignment import Assignment
from reports.grading.issuing.handout import fill_cells
from reports.model.blocks import TableSpec
from reports.workbook.caches import sheet_parts
from reports.workbook.layout import Cell, Layout, RowReferences, at_row
from tests.referee.changes import without_charts

Formula = str | float | None
Value = str | float | ArrayFormula | None
_CELL = re.compile(rb'(<c r="([A-Z]+[0-9]+)"(?: s="[0-9]+")?)[^>]*?(?:/>|>.*?</c>)')


def solved_formulas(
    assignment: Assignment, layout: Layout, *, typed: bool = True
) -> dict[str, list[Formula]]:
    """Node → what a student types, or the solved book has in its cells."""
    compiled = _typed if typed else _as_solved
    model = assignment.model
    collected: dict[str, list[Formula]] = {}
    for block in assignment.fill:
        if isinstance(block, TableSpec):
            rows = layout.rows_of(block)
            for column in block.columns:
                if column.expr is not None:
                    text = compiled(column.expr, layout, block)
                    collected[f"{block.id}.{column.key}"] = [
                        at_row(text, row, last=row == rows[-1]) for row in rows
                    ]
        else:
            for node in fill_cells(block, layout):
                expr = model.scalars[node].expr
                collected[node] = [compiled(expr, layout, None)]
    return collected


def _typed(expr: str, layout: Layout, block: TableSpec | None) -> str:
    """Formula of a student; only in a product are all cells of a function taken."""
    text = compile_formula(expr, TypedReferences(layout, block))
    return re.sub(r"\bSUM\((?=(COS|SIN)\([^()]*\*\([^()]*\*PI\()", "SUMPRODUCT(", text)


def _as_solved(expr: str, layout: Layout, block: TableSpec | None) -> str:
    return compile_formula(expr, RowReferences(layout, block))


class TypedReferences(RowReferences):
    """References of a student, who types the sines of an order."""

    def wave(self, turn: str, angle: str, order: float | str) -> str:
        """Sines or cosines of an order times a column."""
        return self._turned(turn, self.column(angle, repeat_last=False), order)

    def run_wave(self, turn: str, angles: str, order: float | str) -> str:
        """The same of a run."""
        return self._turned(turn, self.column(angles, repeat_last=True), order)

    def _turned(self, turn: str, angles: str, order: float | str) -> str:
        times = number(order) if isinstance(order, float) else self.name(order)
        return f"{turn.upper()}({angles}*({times}*PI()/180))"


def filled_book(
    handout: bytes | Workbook,
    assignment: Assignment,
    changes: Mapping[str, list[Formula]] | None = None,
    edit: Callable[[Workbook, Layout], None] | None = None,
    *,
    charts: bool = False,
) -> bytes:
    """A work-book with formulas in every cell to fill in; ``changes`` replace whole nodes.

    The charts of the handout are half of the time; with them it is as a student's program has it.
    """
    layout = Layout.of(assignment.model)
    formulas = {**solved_formulas(assignment, layout), **(changes or {})}
    texts = filled_cells(assignment, layout, formulas)
    if isinstance(handout, bytes) and edit is None and all(map(_plain, texts.values())):
        return _typed_into(handout, tuple(texts.items()), charts=charts)
    book = handout
    if isinstance(book, bytes):
        book = load_workbook(io.BytesIO(book if charts else without_charts(book)))
    for cell, text in texts.items():
        book[cell.sheet].cell(cell.row, cell.column).value = text
    if edit is not None:
        edit(book, layout)
    stream = io.BytesIO()
    book.save(stream)
    return stream.getvalue()


def filled_cells(
    assignment: Assignment, layout: Layout, formulas: Mapping[str, list[Formula]]
) -> dict[Cell, Formula]:
    """The formulas of the nodes in their cells."""
    return {
        cell: text
        for block in assignment.fill
        for node, cells in fill_cells(block, layout).items()
        for cell, text in zip(cells, formulas[node], strict=True)
    }


def _plain(text: object) -> bool:
    """No date."""
    return text is None or isinstance(text, (str, int, float))


# Many tests fill the same work-book, many of them in the same way.
@lru_cache(maxsize=8)
def _typed_into(handout: bytes, texts: tuple[tuple[Cell, Value], ...], *, charts: bool) -> bytes:
    """The values in the parts of the book: a program that holds it takes ten times as long."""
    parts, places = _parts(handout if charts else without_charts(handout))
    of_part: dict[str, dict[str, Value]] = {}
    for cell, text in texts:
        of_part.setdefault(places[cell.sheet], {})[cell.coordinate] = text
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as target:  # read at once: not worth compressing
        for name, data in parts.items():
            target.writestr(name, with_values(data, of_part.get(name, {})))
    return stream.getvalue()


@lru_cache(maxsize=2)
def _parts(handout: bytes) -> tuple[dict[str, bytes], dict[str, str]]:
    """Parts of a work-book, and where its sheets are."""
    with zipfile.ZipFile(io.BytesIO(handout)) as source:
        return {name: source.read(name) for name in source.namelist()}, sheet_parts(source)


def with_values(data: bytes, values: Mapping[str, Value]) -> bytes:
    """A sheet's part with values typed into its cells, as openpyxl writes them."""
    left = set(values)

    def replaced(match: re.Match[bytes]) -> bytes:
        at = match[2].decode()
        if at not in values:
            return match[0]
        left.discard(at)
        return match[1] + _spelled(values[at]).encode("ascii", "xmlcharrefreplace")

    built = _CELL.sub(replaced, data)
    assert not left, left  # all that is filled in has a look of its own
    return built


def _spelled(value: Value) -> str:
    if isinstance(value, ArrayFormula):
        text = escape(str(value.text)[1:], quote=False)
        return f'><f t="array" ref="{value.ref}">{text}</f><v></v></c>'
    if value is None or value == "":
        return ' t="n"></c>'
    if isinstance(value, bool):
        return f' t="b"><v>{value:d}</v></c>'
    if not isinstance(value, str):
        return f' t="n"><v>{safe_string(value)}</v></c>'
    text = escape(value, quote=False)
    if value in ERROR_CODES:
        return f' t="e"><v>{text}</v></c>'
    if value.startswith("="):
        return f"><f>{text[1:]}</f><v></v></c>"
    return f' t="inlineStr"><is><t>{text}</t></is></c>'
