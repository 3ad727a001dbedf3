"""What only the whole model of an engine shows of its own books, each by its line."""

from __future__ import annotations

import ast
import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from reports.formula.excel import compile_formula
from reports.formula.parse import parse
from reports.inputs.department_chapters import line_of_quantity, quantities_of
from reports.model.blocks import Column, Grid, Model, TableSpec, nodes_in
from reports.model.chapter_source import (
    BookLine,
    BookPlaces,
    Shelf,
    at_fragment,
    book_faults,
    cause_of,
)
from reports.model.contents import contents_of
from reports.model.context import CASE_MARK, FREE_MARK
from reports.model.evaluation import Evaluation
from reports.shared.errors import BookError, one_line
from reports.workbook.chapters import diagrams_of, place_of
from reports.workbook.layout import (
    CONTENTS_SHEET,
    INPUT_SHEET,
    OWN_SHEET,
    WAVES_SHEET,
    Layout,
    RowReferences,
)

MAX_FORMULA, MAX_NESTED, MAX_CELLS = 8000, 60, 300_000
_STARTS_FORMULA = ("=", "+", "@")
_CELL_LIKE = re.compile(r"[A-Za-z]{1,3}\d{1,7}|[Rr]\d*[Cc]\d*|[RrCc]")
_FORMULAS = re.compile(f"{CASE_MARK.pattern}|{FREE_MARK.pattern}")  # of a text, parsed elsewhere
_PREFIX = re.compile("^(?:check|value|allowed)_")
_SHEET = re.compile(r"sheet (?P<title>.+?)(?: in .+ \d+(?: full)?: .+)?")
_SIZES = "geometry"  # list of the mechanism's sizes, and their section of the input
_TAKEN_SHEETS = (INPUT_SHEET, CONTENTS_SHEET, OWN_SHEET, WAVES_SHEET)


@dataclass(frozen=True)
class Own:
    """A model, the own books of which it was made, and where they say what."""

    model: Model
    places: BookPlaces
    shelf: Shelf

    def fault(
        self, line: BookLine | None, problem: str, hint: str, fragment: str = ""
    ) -> BookError:
        """Return a mistake on a line; on the first one of the books where none is known."""
        at = line or BookLine(f"{self.shelf.names[0]}.book", 1, "")
        return at_fragment(at, self.shelf, problem, hint, fragment)

    def formulas(self) -> Iterator[tuple[str, str, BookLine]]:
        """Nodes of the books with their formulas and lines."""
        for key, line in self.places.nodes.items():
            node = self.model.nodes.get(key)
            if node is not None and node.expr is not None:
                yield key, node.expr, line

    def table_of(self, key: str) -> TableSpec | None:
        """Table of a column, None of a scalar."""
        return self.model.tables.get(key.partition(".")[0]) if "." in key else None


def short_of(key: str) -> str:
    """Return a node as its line calls it."""
    return _PREFIX.sub("", key.rpartition(".")[2])


def repeated(reading: Own) -> Iterator[BookError]:
    """Names that stand for two things, which no workbook tells apart."""
    seen: dict[str, str] = {field.name.casefold(): field.name for field in reading.model.inputs}
    ids: set[str] = set()
    named: set[tuple[BookLine, str]] = set()  # the value and the verdict of a check are one
    for block in reading.model.blocks:
        if block.id in ids:
            yield reading.fault(reading.places.line_of(block.id), f"блок «{block.id}» есть дважды",
                            "назовите его иначе", block.id)  # fmt: skip
        ids.add(block.id)
        for key, _ in nodes_in(block):
            line = reading.places.nodes.get(key)
            if (line, short_of(key)) in named:
                continue
            if key.casefold() in seen and line is not None:
                named.add((line, short_of(key)))
                name, other = short_of(key), short_of(seen[key.casefold()])
                problem = f"имя проверки «{name}» занято" if name != key else f"имя «{key}» занято"
                more = f" («{other}»)" if other != name else ""
                yield reading.fault(line, problem + more, "назовите иначе", name)
            elif line is not None and "." not in key and _CELL_LIKE.fullmatch(key):
                yield reading.fault(line, f"имя «{key}» похоже на адрес ячейки Excel",
                                "добавьте знак подчёркивания", key)  # fmt: skip
            seen.setdefault(key.casefold(), key)
    charts = Counter(chart.id for chart in reading.model.charts)
    for name, lines in reading.places.charts.items():
        if charts[name] > 1:
            yield reading.fault(
                lines[0], f"диаграмма «{name}» есть дважды", "назовите её иначе", name
            )


def sheets(reading: Own) -> Iterator[BookError]:
    """Sheets that the workbook has already, and those of which no one says where they stand."""
    contents = contents_of(reading.shelf)
    theirs = {
        block.sheet for block in reading.model.blocks if block.id not in reading.places.blocks
    }
    theirs |= {title for title, line in _sheet_lines(reading.shelf, house=True)}
    titles = {title.casefold() for title in (*theirs, *_TAKEN_SHEETS)}
    titles |= {diagrams_of(chapter).casefold() for chapter in contents.chapters}
    for title, line in _sheet_lines(reading.shelf, house=False):
        if title.casefold() in titles:
            yield reading.fault(
                line, f"лист «{title}» есть у программы", "назовите лист иначе", title
            )
    for block in reading.model.blocks:
        lines = reading.places.blocks.get(block.id)
        if not lines or block.sheet.casefold() in titles:
            continue
        titles.add(block.sheet.casefold())
        try:
            place_of(block.sheet, contents)
        except LookupError:
            problem = f"лист «{block.sheet}» не назван" if block.sheet else "лист не назван"
            form = "пишите sheet НАЗВАНИЕ in ГЛАВА НОМЕР: ЗАГОЛОВОК"
            yield reading.fault(
                lines[0], f"{problem}: где стоять блоку «{block.id}»", form, block.id
            )


def _sheet_lines(shelf: Shelf, *, house: bool) -> Iterator[tuple[str, BookLine]]:
    """Titles of sheets that books of the house, or own ones, open, with their lines."""
    for name, text in shelf.texts():
        if (name in shelf.names) != house:
            for number, line in enumerate(text.splitlines(), 1):
                sheet = _SHEET.fullmatch(line)
                if sheet is not None:
                    yield sheet["title"].strip(), BookLine(f"{name}.book", number, line)


def symbols(reading: Own) -> Iterator[BookError]:
    """Quantities with the symbol of the mechanism's own, which every chapter means by it."""
    sizes = [block for block in reading.model.blocks if block.id == _SIZES]
    quantities = {node.quantity.symbol: (key, node.quantity.title)
             for block in sizes for key, node in nodes_in(block)}  # fmt: skip
    quantities |= {item.symbol: (item.name, item.title) for item in reading.model.inputs
              if item.path[0] == _SIZES}  # fmt: skip
    for name, text in reading.shelf.own:
        for key, quantity in quantities_of(((name, text),)).items():
            if quantity.symbol in quantities:
                other, title = quantities[quantity.symbol]
                line = BookLine(
                    f"{_stem(reading.shelf, name)}.book", line_of_quantity(text, key), ""
                )
                yield reading.fault(
                    line, f"обозначение «{quantity.symbol}» уже у «{other}» ({title})",
                    "дайте своей величине другое", quantity.tex,
                )  # fmt: skip


def _stem(shelf: Shelf, name: str) -> str:
    return next(stem for stem, (full_name, _) in zip(shelf.names, shelf.own, strict=True)
                if full_name == name)  # fmt: skip


def odd_words(reading: Own) -> Iterator[BookError]:
    """Texts that a spreadsheet takes for a formula or a page for a tag."""
    for block in reading.model.blocks:
        nodes = dict(nodes_in(block))
        if block.id not in reading.places.blocks:
            continue
        texts = [block.title, block.note, *(node.source for node in nodes.values())]
        texts += [getattr(node, "note", "") for node in nodes.values()]
        texts += block.labels if isinstance(block, Grid) else ()
        yield from _odd(reading, block.id, texts)
    for chart in reading.model.charts:
        if chart.id in reading.places.charts:
            texts = [chart.title, chart.caption, chart.x_title, chart.y_title, chart.group,
                     chart.panel, *(series.name for series in chart.series)]  # fmt: skip
            yield from _odd(reading, chart.id, texts)
    for chapter in reading.model.chapters:
        yield from _odd(reading, f"text {chapter.title}", [chapter.title])
        for line in chapter.lines:
            at = BookLine(line.book, line.number, line.text)
            yield from _odd(reading, at, [_FORMULAS.sub("x", line.text)])


def _odd(reading: Own, at: str | BookLine, texts: list[str]) -> Iterator[BookError]:
    for text in texts:
        tag = re.search(r"<\s*[A-Za-z/!]|&#|javascript:", text)
        if tag or (len(text) > 1 and text.startswith(_STARTS_FORMULA)):
            line = reading.places.line_of(at, text) if isinstance(at, str) else at
            yield reading.fault(line, f"текст «{one_line(text, 40)}» похож на формулу или код",
                            "оставьте обычные слова", tag[0] if tag else text)  # fmt: skip


def unknown_in_charts(reading: Own) -> Iterator[BookError]:
    """Yield what charts name and the model has not, and curves whose ends do not meet."""
    model = reading.model
    known = model.nodes.keys() | model.grid_runs.keys()
    for chart in model.charts:
        if chart.id not in reading.places.charts:
            continue
        names = {name for series in chart.series for name in (series.x, series.y)}
        unknown = sorted(names - known) + sorted({*chart.levels} - _single(model))
        unknown += [chart.hole] if chart.hole and chart.hole not in model.scalars else []
        unknown += [each for key in chart.contact if (each := key.lstrip("-")) not in known]
        for name in unknown:
            yield reading.fault(reading.places.line_of(chart.id, name),
                            f"диаграмма «{chart.id}»: нет «{name}»",
                            "назовите столбец ТАБЛИЦА.КЛЮЧ", name)  # fmt: skip
        for series in chart.series if not unknown else ():
            if _length(model, series.x) != _length(model, series.y):
                yield reading.fault(reading.places.line_of(chart.id, series.y),
                                f"у «{series.x}» и «{series.y}» разное число значений",
                                "возьмите столбцы одной таблицы", series.y)  # fmt: skip


def _single(model: Model) -> set[str]:
    """Names that stand for one number."""
    return {*model.scalars, *(name for name, item in model.fields.items() if item.choices is None)}


def _length(model: Model, name: str) -> int:
    if name in model.grid_runs:
        return len(model.grid_runs[name])
    table = model.tables.get(name.partition(".")[0])
    return len(table.rows) if table is not None else 0


def unknown_names(reading: Own) -> Iterator[BookError]:
    """Names that formulas do not know, and circles."""
    yield from book_faults(reading.model, reading.places.nodes, reading.shelf)


def unfit(reading: Own) -> Iterator[BookError]:
    """Formulas that no cell takes, and books of too many cells."""
    nodes = reading.places.nodes
    tables = reading.model.tables
    cells = sum(len(table.rows) for table in tables.values() for column in table.columns
                if f"{table.id}.{column.key}" in nodes)  # fmt: skip
    if cells + len(nodes) > MAX_CELLS:
        largest = max((tables[key] for key in reading.places.blocks if key in tables),
                      key=lambda table: len(table.rows))  # fmt: skip
        yield reading.fault(reading.places.line_of(largest.id), f"ячеек больше {MAX_CELLS}",
                            "уменьшите таблицы", largest.id)  # fmt: skip
        return
    layout = Layout.of(reading.model)
    for key, expr, line in reading.formulas():
        name = short_of(key)
        try:
            formula = compile_formula(expr, RowReferences(layout, reading.table_of(key)))
        except Exception as error:
            yield reading.fault(line, f"формула «{name}» не для ячейки: {cause_of(error)}",
                            "проверьте, где имя столбца, а где число", name)  # fmt: skip
            continue
        if len(formula) > MAX_FORMULA or _nested(parse(expr)) > MAX_NESTED:
            yield reading.fault(line, f"формула «{name}» для ячейки Excel велика",
                            "разделите её на несколько величин", name)  # fmt: skip


def _nested(node: ast.AST) -> int:
    """Functions within functions."""
    inner = max((_nested(child) for child in ast.iter_child_nodes(node)), default=0)
    return inner + isinstance(node, ast.Call | ast.IfExp | ast.BoolOp)


def infinite(reading: Own) -> Iterator[BookError]:
    """Values that are no numbers."""
    run = Evaluation(reading.model)
    for key, line in reading.places.nodes.items():
        node, name = reading.model.nodes.get(key), short_of(key)
        if node is None:
            continue
        is_text = False
        try:
            value = run.value(key)
            is_text = isinstance(value, str)
            if isinstance(node, Column):
                fine = bool(np.isfinite(np.asarray(value, dtype=float)).all())
            else:
                fine = is_text or bool(np.isfinite(float(value)))
        except Exception as error:
            yield reading.fault(line, f"«{name}» не вычисляется: {cause_of(error)}",
                            "проверьте формулу и то, от чего она зависит", name)  # fmt: skip
            return
        if is_text and node.of == "check_value":
            yield reading.fault(line, f"«{name}» — текст, а проверяют число",
                            "назовите величину с числом", name)  # fmt: skip
        if not fine:
            yield reading.fault(line, f"«{name}» — не число",
                            "проверьте деление на нуль, корни и логарифмы", name)  # fmt: skip
            return
