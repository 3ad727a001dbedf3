"""The empty work-book of a student, and the check that it tells no answers.

An answer may lie in a book in disguise: moved by some rows, in another unit, with the
other sign, sorted, in the cache of a chart, in a remark.  Digits alone are compared, so
none of this hides it.  How many are alike by chance is reckoned, not guessed.
"""

from __future__ import annotations

import ast
import io
import re
import zipfile
import zlib
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from copy import copy
from dataclasses import dataclass, replace
from math import isfinite, sqrt
from typing import ClassVar

import numpy as np
from lxml import etree
from numpy.typing import NDArray
from openpyxl.packaging.custom import StringProperty
from openpyxl.styles import Protection
from openpyxl.styles.cell_style import StyleArray
from openpyxl.workbook import Workbook
from openpyxl.workbook.defined_name import DefinedName
from openpyxl.worksheet.worksheet import Worksheet

from kshm.nomenclature.quantity import Quantity
from reports.formula.parse import SCALE_FUNCTIONS, parse
from reports.grading.issuing.assignment import Assignment, Item
from reports.model.blocks import Block, Grid, Model, TableSpec, scalars_of
from reports.model.charts import ChartSpec
from reports.model.evaluation import Evaluation, Values, node_of
from reports.shared.errors import InputError, Problem
from reports.workbook import styles
from reports.workbook.caches import sheet_parts
from reports.workbook.inputs import shown
from reports.workbook.layout import (
    CONTENTS_SHEET,
    INPUT_SHEET,
    WAVES_SHEET,
    Cell,
    Layout,
    check_names,
)
from reports.workbook.sheets import BlockWriter
from reports.workbook.write import assemble, saved

TICKET_NAME = "kshm_ticket"
TICKET_TITLE = "Идентификатор"
INPUT_MARKS = "kshm_marks_"  # properties with two signs for each input, for ``kshm check``
_MARKS_LENGTH = 200  # a property may hold 255

_LEGEND = (
    (styles.ANSWER, "заполните: сюда пишутся формулы, остальные ячейки защищены"),
    (styles.INPUT, "исходные данные вашего варианта"),
    (styles.FORMULA, "дано: числа и формулы от ваших ячеек"),
    (styles.HEADER, "заголовок; в примечании — смысл величины и номер формулы"),
)
_DIGITS = 4  # that are compared within one place: as few as a table prints
_EXACT = 11  # that are compared of single values
_NOUGHT = 1e-12
_FEWEST = 4  # answers of a column in one place that are no chance
_PICKS = {"abs", "element", "following", "previous", "col_max", "col_min", "col_last"}
_REPEATS = SCALE_FUNCTIONS | _PICKS
_TURNS = np.radians(np.arange(1, 721))  # angles in radians: ω at 3000 rpm has the digits of π
_NUMBER = re.compile(r"(?<![\w.])[-+\u2212]?\d+(?:[.,]\d+)?(?:[eE][-+]?\d+)?(?![\w])")


class _HandoutWriter(BlockWriter):
    """Writes numbers where the solved book has formulas, formulas of what is asked, or nothing."""

    live: frozenset[Cell] = frozenset()
    tells: ClassVar[bool] = False
    shares: ClassVar[bool] = False  # cells of a column differ: numbers, formulas, nothing

    def column(
        self,
        sheet: Worksheet,
        index: int,
        texts: Sequence[str | None],
        values: Sequence[float],
        look: tuple[str, str],
    ) -> None:
        """Cell by cell: what is to be filled in gets its own look afterwards."""
        self.cells(sheet, index, dict(enumerate(texts)), values, look)

    def explained(self, quantity: Quantity, text: str | None, table: str = "") -> str:
        """Nothing: the formulas are what a student is asked for."""
        return ""

    def formula(
        self, sheet: Worksheet, row: int, column: int, text: str, value: float | str
    ) -> None:
        """A given number, or a formula without a saved value; a value to be found stays out."""
        # Sines of orders follow the student's own angles and tell no answer.
        if sheet.title == WAVES_SHEET or Cell(sheet.title, row, column) in self.live:
            super().formula(sheet, row, column, text, "")
            return
        cached = value if isinstance(value, str) else float(value)
        if isinstance(cached, str) or np.isfinite(cached):
            sheet.cell(row, column, cached or None if isinstance(cached, str) else cached)


def anchor_name(table: str, index: int) -> str:
    """Return defined name of a column's header cell, by which the column is found again."""
    return f"col_{table}_{index + 1}"


def cell_name(key: str) -> str:
    """Return defined name of a scalar's cell where the solved book has none."""
    return f"cell_{key}"


def handout_bytes(assignment: Assignment, ticket: str) -> bytes:
    """Return the work-book of one student."""
    full = assignment.model
    layout = Layout.of(full)
    check_names(layout)
    model = replace(full, blocks=assignment.blocks, charts=_charts(assignment))
    writer = _HandoutWriter(layout, _given_values(assignment))
    writer.live = _live_cells(assignment, layout)
    book = assemble(model, writer, _LEGEND)
    for block in assignment.fill:
        _open_cells(book[block.sheet], block, layout, assignment.fill_nodes)
    _anchors(book, model, layout)
    _identify(book, ticket)
    _mark_inputs(book, full)
    _lock(book, layout)
    book.properties.title = f"{full.input.engine.name}: рабочая книга"
    return saved(book, writer.caches)


def _given_values(assignment: Assignment) -> Values:
    """Values that stand in the work-book; what the student finds is not even calculated."""
    run, nodes = Evaluation(assignment.model), assignment.given_nodes
    scalars: dict[str, float | str] = {}
    columns: dict[str, dict[str, NDArray[np.float64]]] = {}
    for block in assignment.blocks:
        if isinstance(block, TableSpec):
            columns[block.id] = {
                column.key: run.value(f"{block.id}.{column.key}")
                if column.expr is None or f"{block.id}.{column.key}" in nodes
                else np.full(len(block.rows), np.nan)
                for column in block.columns
            }
        else:
            for scalar in scalars_of(block):
                scalars[scalar.key] = run.value(scalar.key) if scalar.key in nodes else np.nan
    return Values(scalars, columns)


def _charts(assignment: Assignment) -> tuple[ChartSpec, ...]:
    """Return the charts whose tables are all in the work-book."""
    ids = {block.id for block in assignment.blocks}
    sheets = {block.sheet for block in assignment.blocks}
    return tuple(
        chart
        for chart in assignment.model.charts
        if chart.sheet in sheets
        and all(key.split(".")[0] in ids for s in chart.series for key in (s.x, s.y))
    )


def fill_cells(block: Block, layout: Layout) -> dict[str, list[Cell]]:
    """Node → its cells in the book, for a block."""
    if isinstance(block, TableSpec):
        at_rows = layout.rows_of(block)
        nodes = [f"{block.id}.{c.key}" for c in block.columns if c.expr is not None]
        columns = {node: layout.column_of(node) for node in nodes}
        return {
            node: [Cell(block.sheet, row, at) for row in at_rows] for node, at in columns.items()
        }
    rows = [row.cells for row in block.rows] if isinstance(block, Grid) else [block.scalars]
    return {cell.key: [layout.cells[cell.key]] for row in rows for cell in row if cell is not None}


def _live_cells(assignment: Assignment, layout: Layout) -> frozenset[Cell]:
    """Cells that are formulas of the student's own."""
    return frozenset(
        cell
        for block in assignment.blocks
        for node, cells in fill_cells(block, layout).items()
        if node in assignment.live_nodes
        for cell in cells
    )


def _open_cells(sheet: Worksheet, block: Block, layout: Layout, to_fill: Collection[str]) -> None:
    for node, cells in fill_cells(block, layout).items():
        if node not in to_fill:
            continue
        looks: dict[str, StyleArray] = {}  # of openpyxl, which takes long to find one by its name
        for cell_at in cells:
            cell = sheet.cell(cell_at.row, cell_at.column)
            number_format = cell.number_format
            if number_format in looks:
                cell._style = copy(looks[number_format])
                continue
            cell.style = styles.ANSWER
            cell.number_format = number_format  # the style brings its own
            looks[number_format] = cell._style


def _anchors(book: Workbook, model: Model, layout: Layout) -> None:
    for table in model.tables.values():
        for index, column in enumerate(table.columns):
            header = Cell(table.sheet, layout.places[table.id].row,
                         layout.column_of(f"{table.id}.{column.key}"))  # fmt: skip
            name = anchor_name(table.id, index)
            book.defined_names[name] = DefinedName(name, attr_text=header.absolute)
    for key in model.scalars:
        if key not in layout.named:
            name = cell_name(key)
            book.defined_names[name] = DefinedName(name, attr_text=layout.cells[key].absolute)


def _identify(book: Workbook, ticket: str) -> None:
    """Write the identifier as a cell, a defined name and a property: one of them survives."""
    sheet = book[CONTENTS_SHEET]
    row = sheet.max_row + 2
    sheet.cell(row, 1, TICKET_TITLE).style = styles.TEXT
    sheet.cell(row, 2, ticket).style = styles.TEXT
    sheet.cell(
        row + 1, 2, "не меняйте его: по нему работа связана с вашим вариантом"
    ).style = styles.NOTE
    ticket_cell = Cell(CONTENTS_SHEET, row, 2)
    book.defined_names[TICKET_NAME] = DefinedName(TICKET_NAME, attr_text=ticket_cell.absolute)
    book.custom_doc_props.append(StringProperty(name=TICKET_NAME, value=ticket))


def input_mark(value: object) -> str:
    """Two signs by which a value is known again."""
    text = f"{float(value):.12g}" if isinstance(value, (int, float)) else str(value)
    return f"{zlib.crc32(text.encode()) % 256:02x}"


def _mark_inputs(book: Workbook, model: Model) -> None:
    """Write marks by which the student is told that input data were changed."""
    texts = [""]
    for name, item in model.fields.items():
        entry = f"{name}={input_mark(shown(item))}"
        if len(texts[-1]) + len(entry) >= _MARKS_LENGTH:
            texts.append("")
        texts[-1] = f"{texts[-1]} {entry}".strip()
    for number, text in enumerate(texts, 1):
        book.custom_doc_props.append(StringProperty(name=f"{INPUT_MARKS}{number:03d}", value=text))


def _lock(book: Workbook, layout: Layout) -> None:
    """Only the cells to fill in can be typed into; widths and formats stay free."""
    sheet = book[INPUT_SHEET]
    for name in layout.model.fields:
        cell_at = layout.cells[name]
        sheet.cell(cell_at.row, cell_at.column).protection = Protection(locked=True)
    sheet.data_validations.dataValidation = []
    for line in book[CONTENTS_SHEET].iter_rows():  # the samples of colours
        for cell in line:
            cell.protection = Protection(locked=True)
    for sheet in book.worksheets:
        sheet.protection.sheet = True
        sheet.protection.formatCells = False
        sheet.protection.formatColumns = False
        sheet.protection.formatRows = False


# --- leaks ---------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Leak:
    """An asked item and where its values stand."""

    item: str
    part: str
    count: int


def check_for_leaks(book: bytes, assignment: Assignment, source: str) -> None:
    """Refuse a work-book that holds answers.

    Raises:
        InputError: the items and the places where their values stand.
    """
    leaks = leaks_of(book, assignment)
    if leaks:
        problem = "; ".join(f"{leak.item} — {leak.part}" for leak in leaks[:6])
        more = f" и ещё {len(leaks) - 6}" if len(leaks) > 6 else ""
        items = (leak.item.partition(" ")[0] for leak in leaks)
        names = ", ".join(f'"{item}"' for item in dict.fromkeys(items))
        hint = (
            "уберите эти таблицы из work.given или из work.fill рубрики либо выдайте ответы "
            f"числами: work.without = [{names}]"
        )
        raise InputError(
            Problem(source, f"выданная книга содержала бы ответы: {problem}{more}", hint)
        )


def leaks_of(book: bytes, assignment: Assignment) -> list[Leak]:
    """Everything in a work-book that gives an asked value away.

    Columns that only serve others may repeat a given one: they are copied by right.
    """
    numbers_by_place = dict(_places(book))
    run = Evaluation(assignment.model)
    columns: dict[str, set[str]] = {}
    scalars: dict[str, float] = {}
    for item in assignment.items:
        values = _asked(item, run, assignment)
        if item.is_column and not item.helper:
            columns[item.id] = _digits(values.tolist(), _DIGITS)
        elif not item.is_column and values.size:
            scalars |= {f"{item.id} {label}".strip(): float(v)
                        for label, v in zip(item.labels, values, strict=False)}  # fmt: skip
    return [*_of_columns(columns, numbers_by_place, _known(assignment)),
            *_of_scalars(scalars, numbers_by_place, _known(assignment))]  # fmt: skip


def _asked(item: Item, run: Evaluation, assignment: Assignment) -> np.ndarray:
    """Values of an item that are an answer: no copies of what is given anyway."""
    nodes = [node for node in item.nodes if not _is_given_anyway(node, assignment)]
    parts = [run.value(node) for node in nodes]
    parts = [np.ravel(np.asarray(v, dtype=float)) for v in parts if not isinstance(v, str)]
    return np.concatenate(parts) if parts else np.array([])


def _is_given_anyway(node: str, assignment: Assignment) -> bool:
    """Whether a value by its formula repeats or picks out an input or a given number."""
    graph, seen = assignment.graph, set()
    while node not in seen:
        seen.add(node)
        tree = parse(graph.expression(node) or "0")
        while isinstance(tree, (ast.UnaryOp, ast.Call)):
            if isinstance(tree, ast.Call) and ast.unparse(tree.func) not in _REPEATS:
                return False
            tree = tree.operand if isinstance(tree, ast.UnaryOp) else tree.args[0]
        if not isinstance(tree, (ast.Name, ast.Attribute)):
            return False
        node = node_of(ast.unparse(tree), node.partition(".")[0], assignment.model)
        if graph.expression(node) is None or node in assignment.given_nodes:
            return True
    return False


def _digits(values: Iterable[float], count: int) -> set[str]:
    """Return the first digits of numbers without sign and point; short and round ones tell nothing.

    Nor does what is left of the cosine of 90°.
    """
    least = min(count, 4) - 1
    texts = {f"{abs(v):.{count - 1}e}"[: count + 1] for v in values if abs(v) > _NOUGHT}
    digits = {text.replace(".", "") for text in texts}
    return {text for text in digits if text.isdigit() and len(text.rstrip("0")) >= least}


def _of_columns(
    answers: Mapping[str, set[str]],
    numbers_by_place: Mapping[str, list[float]],
    constants: set[str],
) -> list[Leak]:
    owners: dict[str, list[str]] = {}
    for item, digits in answers.items():
        for text in digits - constants:
            owners.setdefault(text, []).append(item)
    leaks = []
    for part, numbers in numbers_by_place.items():
        given = _digits(numbers, _DIGITS)
        hits = Counter(item for text in given for item in owners.get(text, ()))
        for item, count in hits.items():
            # So many of the asked would be among so many numbers by chance; a column is
            # alike where most of it is, or far more than chance allows.
            size = len(answers[item])
            chance = size * len(given) / 9000
            if count >= max(_FEWEST, chance + 5 * sqrt(chance) + 2, 0.5 * size):
                leaks.append(Leak(item, part, count))
    return sorted(leaks, key=lambda leak: (leak.item, leak.part))


def _of_scalars(
    answers: Mapping[str, float], numbers_by_place: Mapping[str, list[float]], constants: set[str]
) -> list[Leak]:
    exact = {name: _digits([value], _EXACT) for name, value in answers.items()}
    printed = {name: _digits([value], 5) for name, value in answers.items()}
    leaks = []
    angles = _digits(_TURNS.tolist(), _EXACT)
    for part, numbers in numbers_by_place.items():
        exact_digits, short = _digits(numbers, _EXACT) - angles - constants, _digits(numbers, 5)
        hits = [n for n, d in exact.items() if d & exact_digits and not _short(answers[n])]
        few = [n for n, d in printed.items() if d & short - constants and not _is_round(d)]
        chance = len(answers) * len(short) / 90_000
        alike = set().union(*(printed[n] for n in few)) if few else set()
        if not hits and len(alike) >= max(3, chance + 5 * sqrt(chance) + 2):
            hits = few
        leaks += [Leak(name, part, 1) for name in hits]
    return leaks


def _is_round(digits: set[str]) -> bool:
    """Tell whether the digits could be a row number."""
    return all(len(text.rstrip("0")) < _DIGITS for text in digits)


def _short(value: float) -> bool:
    """Whether a number has so few digits that anyone may have it."""
    return len(f"{value:.10e}".split("e")[0].replace(".", "").strip("-").rstrip("0")) < 6


def _known(assignment: Assignment) -> set[str]:
    """Digits of the input data, the angles and their sines: they stand in the book by right.

    Of all whole degrees: a circle round a bearing has its sines closer than the rays of wear.
    """
    numbers = [float(f.value) for f in assignment.model.inputs if isinstance(f.value, (int, float))]
    for table in assignment.model.tables.values():
        numbers += table.rows
    numbers += np.sin(_TURNS).tolist()
    return _digits(numbers, _DIGITS) | _digits(numbers, 5) | _digits(numbers, _EXACT)


# --- every number of a package -----------------------------------------------------------


def _places(book: bytes) -> Iterator[tuple[str, list[float]]]:
    """Numbers of each part of a book: columns and rows of sheets, series, other texts."""
    with zipfile.ZipFile(io.BytesIO(book)) as archive:
        titles = {part: title for title, part in sheet_parts(archive).items()}
        for name in archive.namelist():
            data = archive.read(name)
            if name in titles:
                yield from _of_sheet(titles[name], data)
            elif name.startswith("xl/charts/"):
                yield from _of_chart(name, data)
            elif name.endswith((".xml", ".rels", ".vml")) and name != "xl/styles.xml":
                yield name, _of_text(data)
            elif not name.endswith((".xml", ".rels", ".vml")):
                yield name, _numbers(data.decode("utf-8", errors="ignore"))


def _of_sheet(title: str, data: bytes) -> Iterator[tuple[str, list[float]]]:
    root = etree.fromstring(data)
    columns: dict[str, list[float]] = {}
    rows: dict[str, list[float]] = {}
    for cell in root.iter("{*}c"):
        where = cell.get("r", "")
        letters = where.rstrip("0123456789")
        numbers = []
        for part in cell:
            tag = str(part.tag).rpartition("}")[2]
            text = "".join(part.itertext()) if len(part) else part.text or ""
            if tag == "f":  # numbers typed into a formula
                numbers += [v for v in _numbers(text) if not float(v).is_integer()]
            elif cell.get("t") != "s":
                numbers += _numbers(text)
        if numbers:
            columns.setdefault(f"{title}!{letters}", []).extend(numbers)
            rows.setdefault(f"{title}!{where[len(letters) :]}", []).extend(numbers)
    yield from columns.items()
    yield from rows.items()


def _of_chart(name: str, data: bytes) -> Iterator[tuple[str, list[float]]]:
    root = etree.fromstring(data)
    for number, series in enumerate(root.iter("{*}ser"), 1):
        values = [v for item in series.iter("{*}v") for v in _numbers(item.text or "")]
        yield f"{name}, ряд {number}", values


def _of_text(data: bytes) -> list[float]:
    try:
        root = etree.fromstring(data)
    except etree.XMLSyntaxError:
        return _numbers(data.decode("utf-8", errors="ignore"))
    texts = [text for text in root.itertext() if text.strip()]
    texts += [value for element in root.iter() for value in element.attrib.values()]
    return [number for text in texts for number in _numbers(text)]


def _numbers(text: str) -> list[float]:
    numbers = []
    for match in _NUMBER.findall(text):
        value = float(match.replace(",", ".").replace("\u2212", "-"))
        if isfinite(value):
            numbers.append(value)
    return numbers
